//! The replica and the readable reference agree, after every step, on states, views, changes and errors.
use crate::replica_support::Pair;
use dsr_core::{
    Dictionary, Dot, Edge, MutationKind, Record, ReplicaId, State, ValueType, Vertex, VertexId, view,
};
use dsr_testkit::{Anchors, Fate, Universe, candidates, cases, dictionary, state, states};
use proptest::collection::vec;
use proptest::prelude::*;

/// Open, open with functional and typed names, closed to almost everything.
fn dictionaries() -> [Dictionary; 3] {
    let mut closed = Dictionary { closed: true, ..Dictionary::open().with_functional("in") };
    closed.attributes.insert("a".into(), ValueType::Int);
    [Dictionary::open(), dictionary(), closed]
}

/// Every mutation that there is in a state, allowed or not; how many were allowed.
#[track_caller]
fn try_mutations(pair: &Pair, limit: usize) -> usize {
    let shown = view(&pair.state, &pair.dictionary);
    let mut allowed = 0;
    for kind in MutationKind::ALL {
        let candidates = candidates(&shown, kind);
        let step = candidates.len().div_ceil(limit).max(1);
        for mutation in candidates.iter().step_by(step) {
            allowed += usize::from(pair.clone().mutate(mutation).is_ok());
        }
    }
    allowed
}

/// The comparison is no formality: a replica that has missed a delta, or looks through another dictionary, is
/// found out. `[spec: REPLICA-1]`
#[test]
fn law_a_replica_that_differs_is_found_out() {
    let whole = state(
        "r1.1 vertex t a @1
         r1.2 edge root -in-> r1.1 @1
         r1.3 edge root -in-> r1.1 @2
         r1.4 write r1.1 level=text @3",
    );
    let typed = dictionary();
    let expected = view(&whole, &typed);
    assert_eq!(Pair::of(1, &whole, dictionary()).disagreement(&whole, &expected), None);
    assert_eq!(Pair::new(1, dictionary()).disagreement(&whole, &expected), Some("state"));
    let open = Pair::of(1, &whole, Dictionary::open());
    assert_eq!(open.disagreement(&whole, &expected), Some("writes"));
    let functional =
        Pair::of(1, &whole, Dictionary { attributes: dictionary().attributes, ..Dictionary::open() });
    assert_eq!(functional.disagreement(&whole, &expected), Some("repairs"));
}

/// Small universes: two kinematic cycles and two parents; functional claims and equal keys; names; paths.
const UNIVERSES: [&str; 5] = [
    "r1.1 vertex t a @1
     r2.1 vertex t b @1
     r1.2 edge root -RT-> r1.1 @1
     r1.3 edge r2.1 -RT-> r1.1 @2
     r2.2 edge root -RT-> r2.1 @1
     r2.3 edge r1.1 -RT-> r2.1 @2
     r2.4 write r2.3 a=5 @3",
    "r1.1 vertex t a @1
     r2.1 vertex t a @1
     r1.2 edge r1.1 -in-> root @1
     r1.3 edge r1.1 -in-> r2.1 @1
     r2.2 edge r1.1 -in-> r2.1 @2
     r2.4 edge r2.1 -RT-> r1.1 @3",
    "r1.1 vertex t a @1
     r1.2 vertex t b @1
     r1.3 vertex t c @1
     r1.4 edge r1.1 -RT-> r1.2 @2
     r1.5 edge r1.2 -RT-> r1.3 @3
     r1.6 edge r1.3 -RT-> r1.1 @4
     r2.1 edge r1.3 -RT-> r1.2 @5",
    "r1.1 vertex t a @1
     r1.2 edge root -near-> r1.1 @1
     r1.3 vertex t b @2
     r1.4 edge r1.3 -near-> r1.1 @2
     r2.1 vertex t root @1
     r2.2 edge r2.1 -near-> r1.3 @3
     r2.3 edge r2.1 -near-> root @3",
    "r1.1 vertex t a @1
     r1.2 edge r1.1 -near-> root @1
     r1.3 write r1.1 a=1 @2
     r2.1 write r1.1 a=2 @2
     r2.2 write r1.2 a=text @2
     r2.3 write r1.2 b=text @3",
];

/// Every state over small universes, joined with every delta of at most two dots and with some large ones.
/// `[spec: REPLICA-1]` `[spec: EVENT-1]` `[spec: EVENT-2]` `[spec: EVENT-3]` `[spec: EVENT-4]`
#[test]
fn differential_every_small_join() {
    let (mut joins, mut told) = (0, 0);
    for text in UNIVERSES {
        let universe = Universe::of(&state(text));
        let mut all: Vec<State> = universe.all_states();
        all.dedup();
        let seen = |fates: &Vec<Fate>| fates.iter().filter(|fate| **fate != Fate::Unseen).count();
        let deltas: Vec<State> = universe
            .all_fates()
            .filter(|fates| seen(fates) <= 2)
            .map(|fates| universe.state(&fates))
            .collect();
        for (at, start) in all.iter().enumerate() {
            let dictionary = dictionaries()[at % 3].clone();
            let pair = Pair::of(1, start, dictionary);
            for delta in deltas.iter().chain(all.iter().skip(at % 41).step_by(41)) {
                told += pair.clone().apply(delta);
                joins += 1;
            }
        }
    }
    println!("{joins} joins, {told} changes");
    assert!(joins > 100_000 && told > joins, "{joins} joins, {told} changes");
}

/// Every mutation in every state over small universes: deltas, errors, what is changed, and that a refusal
/// changes nothing. `[spec: REPLICA-1]` `[spec: EVENT-1]`
#[test]
fn differential_every_mutation_in_every_small_state() {
    let mut allowed = 0;
    for text in UNIVERSES {
        for (at, start) in Universe::of(&state(text)).all_states().iter().enumerate() {
            let pair = Pair::of(3, start, dictionaries()[at % 3].clone());
            pair.check_thoroughly(&State::new());
            allowed += try_mutations(&pair, 24);
        }
    }
    println!("{allowed} mutations");
    assert!(allowed > 10_000, "{allowed}");
}

/// Ends whose short forms in the index of claims are equal are told apart. `[spec: STAMP-4]`
/// `[spec: REPLICA-1]`
#[test]
fn regress_ends_that_share_a_mix() {
    let mix = |dot: Dot| u64::from(dot.replica.agent.wrapping_mul(0x9e37_79b9)) ^ dot.sequence;
    let first = Dot::new(ReplicaId::agent(1), 1);
    let second = Dot::new(ReplicaId::agent(2), mix(first) ^ mix(Dot::new(ReplicaId::agent(2), 0)));
    let like_root = Dot::new(ReplicaId::agent(3), mix(Dot::new(ReplicaId::agent(3), 0)));
    assert_eq!((mix(first), mix(like_root)), (mix(second), 0));
    let vertex = |dot: Dot| {
        let (name, stamp) = (dot.to_string().into(), 1);
        (dot, Record::Vertex(Vertex { vertex_type: "t".into(), name, external_id: None, stamp }))
    };
    let source = Dot::new(ReplicaId::agent(4), 1);
    let edge = |sequence, to: Dot, label: &str| {
        let dot = Dot::new(ReplicaId::agent(5), sequence);
        (dot, Record::Edge(Edge { from: VertexId(source), to: VertexId(to), label: label.into(), stamp: 2 }))
    };
    let root = VertexId::ROOT.0;
    let vertices = [first, second, like_root, source].map(vertex);
    let edges = [first, second, like_root, root].map(|to| edge(10 + to.sequence % 1000, to, "near"));
    let mut pair = Pair::new(1, dictionary());
    let mut all = vertices.to_vec();
    all.extend(edges);
    all.extend([first, root].map(|to| edge(3000 + to.sequence, to, "in")));
    let context = all.iter().map(|(dot, _)| *dot).collect();
    pair.apply(&State::assemble(all, context));
    assert_eq!(pair.replica.repairs().filter(|repair| repair.kind() == "same-key").count(), 0);
    try_mutations(&pair, 200);
}

proptest! {
    #![proptest_config(cases(3000))]

    /// Hostile states, one joined after the other. `[spec: REPLICA-1]` `[spec: EVENT-1]`
    #[test]
    fn differential_joins_of_any_states(parts in states(4, 24, Anchors::Right), which in 0..3_usize) {
        let mut pair = Pair::new(1, dictionaries()[which].clone());
        for part in &parts {
            pair.apply(part);
        }
        pair.check_thoroughly(&parts[0]);
        pair.apply(&parts[0]);
        try_mutations(&pair, 5);
    }

    /// Records anchored to what is no vertex, to writes, to each other. `[spec: REPLICA-1]`
    #[test]
    fn differential_whatever_the_anchors(parts in states(4, 16, Anchors::Any), which in 0..3_usize) {
        let mut pair = Pair::new(1, dictionaries()[which].clone());
        for part in &parts {
            pair.apply(part);
        }
        pair.check_thoroughly(&parts[1]);
    }

    /// Dots used twice, for records of any kinds. `[spec: CRASH-3]` `[spec: JOIN-2]` `[spec: REPLICA-1]`
    #[test]
    fn differential_dots_used_twice(
        mine in states(2, 12, Anchors::Any),
        theirs in states(2, 12, Anchors::Any),
        which in 0..3_usize,
    ) {
        let mut pair = Pair::new(1, dictionaries()[which].clone());
        for part in [&mine[0], &theirs[0], &mine[1], &theirs[1]] {
            pair.apply(part);
        }
        pair.check_thoroughly(&mine[0]);
    }

    /// Few vertices and many claims of any rank between them, that come and go one by one or in groups: chains
    /// of claims that unseat each other, cycles, components that fall apart and are joined again.
    /// `[spec: REPLICA-1]` `[spec: VIEW-3]` `[spec: VIEW-5]`
    #[test]
    fn differential_claims_that_come_and_go(
        steps in vec((vec((0..7_u64, 0..6_u64, 1..12_u64, 0..4_usize, any::<bool>()), 1..4), any::<bool>()), 1..40),
        linked in 0..6_u64,
    ) {
        let agent = ReplicaId::agent;
        let vertex = |n: u64| if n == 0 { VertexId::ROOT } else { VertexId(Dot::new(agent(1), n)) };
        let vertices = (1..7).map(|n| {
            let (name, stamp) = (format!("v{n}").into(), 1);
            (vertex(n).0, Record::Vertex(Vertex { vertex_type: "t".into(), name, external_id: None, stamp }))
        });
        let links = (1..=linked).map(|n| {
            let edge = Edge { from: vertex(n), to: VertexId::ROOT, label: "near".into(), stamp: 1 };
            (Dot::new(agent(3), n), Record::Edge(edge))
        });
        let records: Vec<(Dot, Record)> = vertices.chain(links).collect();
        let context = records.iter().map(|(dot, _)| *dot).collect();
        let mut pair = Pair::of(9, &State::assemble(records, context), dictionary());
        let mut made: Vec<Dot> = (1..=linked).map(|n| Dot::new(agent(3), n)).collect();
        for (claims, waits) in steps {
            let mut delta = State::new();
            for (from, to, stamp, label, kills) in claims {
                if kills && !made.is_empty() {
                    let dead = made[usize::try_from(from * 7 + to + stamp).unwrap() % made.len()];
                    delta.join(&State::assemble([], [dead].into_iter().collect()));
                    continue;
                }
                let to = 1 + to;
                if from == to {
                    continue;
                }
                let dot = Dot::new(agent(2), 1 + u64::try_from(made.len()).unwrap());
                made.push(dot);
                let label = ["RT", "RT", "RT", "near"][label].into();
                let edge = Edge { from: vertex(from), to: vertex(to), label, stamp };
                delta.join(&State::assemble([(dot, Record::Edge(edge))], [dot].into_iter().collect()));
            }
            pair.apply(&delta);
            if waits {
                try_mutations(&pair, 4);
            }
        }
    }
}
