//! Replicas and their readable references live through the same histories: mutations allowed and refused,
//! deltas late, early, twice, lost, and resynchronisation. After every step they agree.
use crate::replica_support::Pair;
use dsr_core::{
    AttributeMap, AttributeUpdates, Delta, EdgeKey, ElementId, Mutation, MutationKind, NewVertex, Replica,
    ReplicaId, State, Value, VertexId, VertexLink, view,
};
use dsr_testkit::{Step, attempt, candidates, cases, dictionary, history};
use proptest::collection::vec;
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Replicas `r1`, `r2`, …, each beside its reference, and all deltas sent.
struct Pairs {
    pairs: Vec<Pair>,
    sent: Vec<Delta>,
}

impl Pairs {
    fn new(count: usize) -> Self {
        let agents = 1..=u32::try_from(count).unwrap();
        Self { pairs: agents.map(|agent| Pair::new(agent, dictionary())).collect(), sent: Vec::new() }
    }

    fn mutate(&mut self, replica: usize, mutation: &Mutation) -> bool {
        let made = self.pairs[replica].mutate(mutation);
        let allowed = made.is_ok();
        self.sent.extend(made);
        allowed
    }

    fn step(&mut self, step: &Step) {
        let count = self.pairs.len();
        match *step {
            Step::Attempt { replica, kind, choice } => {
                let pair = &self.pairs[replica % count];
                let shown = view(&pair.state, &pair.dictionary);
                if let Some(mutation) = attempt(&shown, kind, choice) {
                    self.mutate(replica % count, &mutation);
                }
            }
            Step::Try { replica, ref mutation } => {
                self.mutate(replica % count, mutation);
            }
            Step::Group { ref deltas, to } => {
                let sent = deltas.iter().filter_map(|delta| self.sent.get(delta % self.sent.len().max(1)));
                let all = sent.fold(Delta::new(), |all, delta| all.joined(delta));
                self.pairs[to % count].apply(&all);
            }
            Step::Restart { replica, keeps } => self.pairs[replica % count].restart(keeps),
            Step::Mutate { replica, kind, choice } => {
                let pair = &self.pairs[replica % count];
                let all = candidates(&view(&pair.state, &pair.dictionary), kind);
                // The first that is allowed, and those refused before it.
                let turned = (0..all.len().min(6)).map(|at| &all[(choice + at) % all.len()]);
                for mutation in turned {
                    if self.mutate(replica % count, mutation) {
                        break;
                    }
                }
            }
            Step::Deliver { delta, to } => {
                if !self.sent.is_empty() {
                    let delta = &self.sent[delta % self.sent.len()];
                    self.pairs[to % count].apply(delta);
                }
            }
            Step::Resynchronise { from, to } => self.resynchronise(from % count, to % count),
        }
    }

    fn resynchronise(&mut self, from: usize, to: usize) {
        let delta = self.pairs[from].replica.delta_for(&self.pairs[to].replica.digest());
        self.pairs[to].apply(&delta);
    }

    /// Everybody answers everybody.
    fn settle(&mut self) {
        let count = self.pairs.len();
        for round in 0..2 * count {
            self.resynchronise(round % count, (round + 1) % count);
        }
        let state = self.pairs[0].replica.state();
        for pair in &self.pairs {
            pair.check_thoroughly(&state);
            assert_eq!(pair.replica.state(), state, "all are equal");
        }
    }
}

proptest! {
    #![proptest_config(cases(600))]

    /// `[spec: REPLICA-1]` `[spec: EVENT-1]` `[spec: EVENT-2]` `[spec: EVENT-3]` `[spec: EVENT-4]`
    #[test]
    fn differential_histories(count in 1..=4_usize, steps in vec(history::any_step(4), 0..60)) {
        let mut pairs = Pairs::new(count);
        for step in &steps {
            pairs.step(step);
        }
        pairs.settle();
    }
}

/// Noise of Knuth's constants: the same on every run.
struct Noise(u64);

impl Noise {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % n.max(1)
    }

    fn pick<T: Clone>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())].clone()
    }
}

/// A mutation that somebody might want, in a graph of any size: mostly of what is there.
fn wish(replica: &Replica, noise: &mut Noise) -> Mutation {
    let vertices: Vec<VertexId> = replica.vertices().collect();
    // Half of all wishes meet at a few vertices.
    let some = |noise: &mut Noise| {
        let among = if noise.below(2) == 0 { vertices.len().min(7) } else { vertices.len() };
        vertices[noise.below(among)]
    };
    let vertex = some(noise);
    let attributes = if noise.below(3) == 0 {
        AttributeMap::from([("level".into(), 1.into())])
    } else {
        AttributeMap::new()
    };
    let key = |noise: &mut Noise| {
        let label = noise.pick(&["RT", "RT", "in", "near"]);
        EdgeKey::new(some(noise), label, some(noise))
    };
    let shown = |noise: &mut Noise| {
        let edges: BTreeSet<EdgeKey> = replica.edges_at_vertex(vertex).map(|(_, edge)| edge.key()).collect();
        let edges: Vec<EdgeKey> = edges.into_iter().collect();
        if edges.is_empty() { key(noise) } else { noise.pick(&edges) }
    };
    match noise.below(13) {
        0..=3 => {
            let name = format!("v{}", noise.below(400));
            let link = match noise.below(4) {
                0 => VertexLink::to("in", vertex),
                1 => VertexLink { outgoing: false, ..VertexLink::to("near", vertex) },
                _ => VertexLink::child_of(vertex),
            };
            Mutation::AddVertex { vertex: NewVertex { attributes, ..NewVertex::new("thing", &name) }, link }
        }
        4 | 5 => Mutation::AddEdge { key: key(noise), attributes },
        6 | 7 => {
            let target = match replica.edges_at_vertex(vertex).map(|(edge, _)| edge).min() {
                Some(edge) if noise.below(2) == 0 => ElementId::Edge(edge),
                _ => ElementId::Vertex(vertex),
            };
            let value = noise.pick(&[Some(Value::Int(1)), Some(Value::Int(2)), None]);
            Mutation::UpdateAttributes { target, updates: AttributeUpdates::from([("level".into(), value)]) }
        }
        8 => Mutation::RemoveEdge { key: shown(noise) },
        9..=11 => {
            let from = shown(noise);
            let to = EdgeKey { from: some(noise), ..from.clone() };
            let to = if noise.below(4) == 0 { key(noise) } else { to };
            Mutation::MoveEdge { from, to, attributes }
        }
        _ => Mutation::RemoveVertex { vertex },
    }
}

/// Long histories of eight replicas, with bursts in which nothing is delivered, so that claims pile up.
/// `turns` mutations are wished for.
fn live_long(seed: u64, turns: usize, count: usize) -> BTreeMap<&'static str, usize> {
    println!("seed {seed}");
    let mut noise = Noise(seed);
    let mut pairs = Pairs::new(count);
    let mut met: BTreeMap<&'static str, usize> = BTreeMap::new();
    for turn in 0..turns {
        let replica = noise.below(count);
        let mutation = wish(&pairs.pairs[replica].replica, &mut noise);
        let allowed = pairs.mutate(replica, &mutation);
        *met.entry(if allowed { mutation.kind().name() } else { "refused" }).or_default() += 1;
        let is_quiet = turn / 50 % 2 == 0;
        for _ in 0..noise.below(if is_quiet { 2 } else { 4 }) {
            if pairs.sent.is_empty() {
                break;
            }
            let late = noise.below(pairs.sent.len().min(120));
            let (delta, to) = (pairs.sent.len() - 1 - late, noise.below(count));
            let delta = pairs.sent[delta].clone();
            pairs.pairs[to].apply(&delta);
        }
        if noise.below(25) == 0 {
            pairs.resynchronise(noise.below(count), noise.below(count));
        }
        for repair in pairs.pairs[replica].replica.repairs() {
            *met.entry(repair.kind()).or_default() += 1;
        }
    }
    pairs.settle();
    met
}

/// `[spec: REPLICA-1]` `[spec: EVENT-1]` `[spec: SYNC-3]` `[spec: SYNC-5]`
#[test]
fn differential_long_histories_of_eight() {
    let mut met: BTreeMap<&str, usize> = BTreeMap::new();
    for seed in 1..=4 {
        for (what, count) in live_long(seed, 500, 8) {
            *met.entry(what).or_default() += count;
        }
    }
    check_met(&met, &[]);
}

/// The histories were not about nothing.
#[track_caller]
fn check_met(met: &BTreeMap<&str, usize>, more: &[&str]) {
    println!("{met:?}");
    let kinds = MutationKind::ALL.map(MutationKind::name);
    let repairs = ["functional", "rt-parent", "detached", "reattached", "name-clash", "refused"];
    for what in kinds.iter().chain(&repairs).chain(more) {
        assert!(met.get(what).is_some_and(|&count| count >= 5), "{what}: {met:?}");
    }
}

/// As above, ten thousand mutations. `[spec: REPLICA-1]`
#[test]
fn differential_the_longest_history() {
    let seed = std::env::var("SEED").ok().and_then(|seed| seed.parse().ok()).unwrap_or(1);
    check_met(&live_long(seed, 10_000, 8), &["cycle-broken", "same-key"]);
}

/// What a reader holds stays as it is, while the writer goes on in another thread. `[spec: REPLICA-2]`
#[test]
fn law_snapshots_stay() {
    const MUTATIONS: usize = 600;
    let mut noise = Noise(3);
    let mut replica = Replica::new(ReplicaId::agent(1), dictionary());
    let (hand_over, readers) = std::sync::mpsc::channel::<(dsr_core::Graph, State)>();
    std::thread::scope(|scope| {
        let reader = scope
            .spawn(move || readers.iter().map(|(snapshot, state)| check_snapshot(&snapshot, &state)).count());
        for _ in 0..MUTATIONS {
            hand_over.send((replica.snapshot(), replica.state())).unwrap();
            let mutation = wish(&replica, &mut noise);
            let _ = replica.mutate(&mutation, 0);
        }
        drop(hand_over);
        assert_eq!(reader.join().unwrap(), MUTATIONS);
    });
    assert!(replica.vertices().count() > 20);
}

fn check_snapshot(snapshot: &dsr_core::Graph, state: &State) {
    let dictionary = dictionary();
    let expected = view(state, &dictionary);
    let found = snapshot.state();
    let shown = snapshot.shown(&found);
    assert_eq!(&found, state);
    assert_eq!(dsr_core::Shows::edges(&shown), expected.edges());
    assert_eq!(dsr_core::Shows::writes(&shown), expected.writes());
    assert_eq!(dsr_core::Shows::repairs(&shown), expected.repairs());
    assert_eq!(snapshot.stranded(), expected.stranded());
}

/// A delta told once is told; again, it is not; and two joined are told as one. `[spec: EVENT-6]` `[spec: EVENT-5]`
#[test]
fn law_changes_are_told_once() {
    let mut noise = Noise(5);
    let mut author = Replica::new(ReplicaId::agent(1), dictionary());
    let mut reader = Pair::new(2, dictionary());
    let mut grouped = Pair::new(3, dictionary());
    for _ in 0..200 {
        let group: Vec<Delta> = (0..3)
            .filter_map(|_| {
                let wished = wish(&author, &mut noise);
                author.mutate(&wished, 0).ok()
            })
            .map(|made| {
                for change in &made.changes {
                    if let dsr_core::Change::VertexAdded { vertex } = change {
                        assert_eq!(vertex.0.replica, ReplicaId::agent(1), "by whom");
                    }
                }
                made.delta
            })
            .collect();
        for delta in &group {
            let told = reader.apply(delta);
            assert!(told > 0 || delta.is_empty());
            assert_eq!(reader.apply(delta), 0);
        }
        let joined = group.iter().fold(Delta::new(), |joined, delta| joined.joined(delta));
        grouped.apply(&joined);
        assert_eq!(grouped.state, reader.state);
    }
}
