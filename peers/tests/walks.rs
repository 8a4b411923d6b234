//! Where nothing is concurrent, every library shows what the core shows, and refuses what it refuses.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use dsr_conformance::adapter::{Adapter, Core};
use dsr_conformance::protocol::{
    AnswerFor, CaseBegin, Decline, Deliver, EdgeName, Link, Mutate, Mutation, ROOT, Read, Restart, Tagged,
    Unique, View,
};
use dsr_core::{Dictionary, Value, ValueType};
use dsr_peers::replica::Replica;
use dsr_peers::{AutomergeGraph, LoroGraph, Peer, YrsGraph};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

const REPLICAS: [&str; 2] = ["a", "b"];
const LABELS: [&str; 5] = ["RT", "RT", "in", "near", ""];
const SEEDS: u64 = 24;
const STEPS: usize = 60;

struct Dice(ChaCha8Rng);

impl Dice {
    fn below(&mut self, bound: usize) -> usize {
        usize::try_from(self.0.next_u32()).unwrap() % bound
    }

    fn pick<'i, T: ?Sized>(&mut self, items: &[&'i T]) -> &'i T {
        items[self.below(items.len())]
    }

    fn value(&mut self) -> Tagged {
        let float = self.pick(&[&0.0, &-0.0, &1.5, &f64::NAN, &f64::NEG_INFINITY, &f64::MIN_POSITIVE]);
        #[expect(clippy::cast_possible_truncation, reason = "any 32-bit float will do")]
        let short = *float as f32;
        let whole = *self.pick(&[&0, &u64::MAX, &(1 << 53), &((1 << 53) + 1)]);
        Tagged(
            match ValueType::ALL[self.below(ValueType::ALL.len())] {
                ValueType::String => Value::String("kitchen \u{0} \u{1F916}".into()),
                ValueType::Int => Value::Int(i32::MIN),
                ValueType::Float => Value::Float(short),
                ValueType::FloatVec => Value::FloatVec(vec![short; self.below(3)].into()),
                ValueType::Bool => Value::Bool(self.below(2) == 0),
                ValueType::ByteVec => Value::ByteVec(vec![0, 255].into()),
                ValueType::UInt => Value::UInt(u32::MAX),
                ValueType::UInt64 => Value::UInt64(whole),
                ValueType::Double => Value::Double(*float),
                ValueType::U64Vec => Value::U64Vec(vec![whole; 2].into()),
                ValueType::Vec2 => Value::Vec2([short; 2]),
                ValueType::Vec3 => Value::Vec3([short; 3]),
                ValueType::Vec4 => Value::Vec4([short; 4]),
                ValueType::Vec6 => Value::Vec6([short; 6]),
            }
            .with_canonical_nans(),
        )
    }

    fn attributes(&mut self) -> Unique<Tagged> {
        let names = ["level", "pose", "x/y", "attributes"];
        Unique((0..self.below(3)).map(|_| (self.pick(&names).to_owned(), self.value())).collect())
    }

    fn edge(&mut self, handles: &[&str], view: &View) -> EdgeName {
        if !view.edges.is_empty() && self.below(6) > 0 {
            let edge = &view.edges[self.below(view.edges.len())];
            return EdgeName { from: edge.from.clone(), label: edge.label.clone(), to: edge.to.clone() };
        }
        let label = self.pick(&LABELS).into();
        EdgeName { from: self.pick(handles).into(), label, to: self.pick(handles).into() }
    }

    /// Any mutation, of what is there or was once; many are refused.
    fn mutation(&mut self, handles: &[&str], view: &View, new: &str) -> Mutation {
        let label = self.pick(&LABELS).to_owned();
        let (one, other) = (self.pick(handles).to_owned(), self.pick(handles).to_owned());
        match self.below(8) {
            0 | 1 => {
                let (from, to) = if self.below(4) > 0 { (Some(one), None) } else { (None, Some(one)) };
                let name = if self.below(8) > 0 { new } else { self.pick(&["root", "v1", ""]) };
                let link = Link { from, label, to, attributes: self.attributes() };
                let attributes = self.attributes();
                Mutation::AddVertex {
                    r#as: new.into(),
                    r#type: "thing".into(),
                    name: name.into(),
                    attributes,
                    link,
                }
            }
            2 => Mutation::AddEdge { from: one, label, to: other, attributes: self.attributes() },
            3 | 4 => {
                let mut updates: Unique<Option<Tagged>> = Unique::default();
                for (name, value) in self.attributes().0 {
                    updates.0.insert(name, (self.below(3) > 0).then_some(value));
                }
                let (vertex, edge) = if self.below(2) == 0 {
                    (Some(one), None)
                } else {
                    (None, Some(self.edge(handles, view)))
                };
                Mutation::UpdateAttributes { vertex, edge, attributes: updates }
            }
            5 => {
                let EdgeName { from, label, to } = self.edge(handles, view);
                Mutation::RemoveEdge { from, label, to }
            }
            6 => {
                let old = self.edge(handles, view);
                let mut new = EdgeName { from: one, ..old.clone() };
                if self.below(3) == 0 {
                    new = EdgeName { from: new.from, label, to: other };
                }
                Mutation::MoveEdge { old, new, attributes: self.attributes() }
            }
            _ => Mutation::RemoveVertex { vertex: one },
        }
    }
}

fn kind(decline: Decline) -> (String, Option<String>) {
    match decline {
        Decline::Error(error) => (format!("{:?}", error.code), error.kind),
        Decline::Skip(skip) => (skip.reason, None),
    }
}

fn shown(adapter: &mut dyn Adapter, replica: &str) -> View {
    let view = adapter.read(&Read { replica: replica.into() }).unwrap().view;
    View { repairs: None, ..view.canonical() }
}

/// One walk: each mutation reaches the other replica before the next one is made. Returns how many were made, and how
/// many refused.
fn walk(peer: &mut dyn Adapter, seed: u64) -> (usize, usize) {
    let mut core = Core::default();
    let mut dice = Dice(ChaCha8Rng::seed_from_u64(seed));
    let dictionary = (seed % 2 == 0).then(|| Dictionary::open().with_functional("in"));
    let replicas = REPLICAS.iter().map(|&name| name.into()).collect();
    let case = CaseBegin { case: format!("walk/{seed}"), replicas, dictionary };
    core.begin(&case).unwrap();
    peer.begin(&case).unwrap();
    let mut handles = vec![ROOT.to_owned()];
    let (mut made, mut refused) = (0, 0);
    for step in 0..STEPS {
        let at = dice.below(2);
        let (author, other) = (REPLICAS[at], REPLICAS[1 - at]);
        if dice.below(12) == 0 {
            let restart = Restart { replica: author.into(), keeps: dice.below(2) == 0 };
            let answer = AnswerFor { from: other.into(), to: author.into() };
            for adapter in [&mut core as &mut dyn Adapter, &mut *peer] {
                adapter.restart(&restart).unwrap();
                let delta = adapter.resynchronise(&answer).unwrap().delta;
                adapter.deliver(&Deliver { replica: author.into(), delta }).unwrap();
            }
        }
        let view = shown(&mut core, author);
        let names: Vec<&str> = handles.iter().map(String::as_str).collect();
        let mutations: Vec<Mutation> = (0..=dice.below(2))
            .map(|part| dice.mutation(&names, &view, &format!("v{step}-{part}")))
            .collect();
        let mutate = Mutate { replica: author.into(), mutations };
        let place = format!("seed {seed}, step {step}: {mutate:?}");
        match (core.mutate(&mutate), peer.mutate(&mutate)) {
            (Ok(by_core), Ok(by_peer)) => {
                made += 1;
                core.deliver(&Deliver { replica: other.into(), delta: by_core.delta }).unwrap();
                peer.deliver(&Deliver { replica: other.into(), delta: by_peer.delta }).unwrap();
                handles.extend(mutate.mutations.into_iter().filter_map(|mutation| match mutation {
                    Mutation::AddVertex { r#as, .. } => Some(r#as),
                    _ => None,
                }));
            }
            (Err(by_core), Err(by_peer)) => {
                refused += 1;
                assert_eq!(kind(by_peer), kind(by_core), "{place}");
            }
            (by_core, by_peer) => panic!("{place}: the core says {by_core:?}, the peer {by_peer:?}"),
        }
        for replica in REPLICAS {
            assert_eq!(shown(peer, replica), shown(&mut core, replica), "{place}, {replica} after it");
        }
    }
    (made, refused)
}

fn walks<R: Replica>() {
    let (mut made, mut refused) = (0, 0);
    for seed in 0..SEEDS {
        println!("seed {seed}");
        let counts = walk(&mut Peer::<R>::default(), seed);
        (made, refused) = (made + counts.0, refused + counts.1);
    }
    println!("{made} made, {refused} refused");
    assert!(made > 200 && refused > 200);
}

/// `[spec: VIEW-12]`
#[test]
fn differential_automerge_shows_what_the_core_shows_in_sequence() {
    walks::<AutomergeGraph>();
}

/// `[spec: VIEW-12]`
#[test]
fn differential_loro_shows_what_the_core_shows_in_sequence() {
    walks::<LoroGraph>();
}

/// `[spec: VIEW-12]`
#[test]
fn differential_yrs_shows_what_the_core_shows_in_sequence() {
    walks::<YrsGraph>();
}
