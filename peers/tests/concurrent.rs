//! Three replicas mutate without waiting for each other; deltas come late, twice, in any order, or never.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

mod common;

use common::Dice;
use dsr_conformance::adapter::Adapter;
use dsr_conformance::protocol::{
    AnswerFor, CaseBegin, Decline, Deliver, EdgeName, ErrorCode, Group, Implementation, Link, Mutate,
    Mutation, ROOT, Read, Restart, Unique, View,
};
use dsr_conformance::run::broken;
use dsr_core::{Dictionary, RT};
use dsr_peers::edit::Edit;
use dsr_peers::graph::Graph;
use dsr_peers::replica::{Identity, Message, Replica};
use dsr_peers::yrs_graph::YrsGraphError;
use dsr_peers::{AutomergeGraph, LoroGraph, Peer, YrsGraph};
use std::collections::BTreeMap;

const REPLICAS: [&str; 3] = ["a", "b", "c"];
const SEEDS: u64 = 200;
const STEPS: usize = 40;

struct Walk<R: Replica> {
    peer: Peer<R>,
    dice: Dice,
    dictionary: Option<Dictionary>,
    handles: Vec<String>,
    deltas: Vec<String>,
    /// Whether moves in the tree are frequent.
    places: bool,
    /// How many views broke each invariant.
    broken: BTreeMap<&'static str, usize>,
}

impl<R: Replica> Walk<R> {
    fn new(seed: u64) -> Self {
        let dictionary = seed.is_multiple_of(2).then(|| Dictionary::open().with_functional("in"));
        let replicas = REPLICAS.iter().map(|&name| name.into()).collect();
        let mut peer = Peer::<R>::default();
        let case = CaseBegin { case: format!("walk/{seed}"), replicas, dictionary: dictionary.clone() };
        peer.begin(&case).unwrap();
        let handles = vec![ROOT.to_owned()];
        let mut walk = Self {
            peer,
            dice: Dice::new(seed),
            dictionary,
            handles,
            deltas: Vec::new(),
            places: seed % 4 < 2,
            broken: BTreeMap::new(),
        };
        walk.begin();
        walk
    }

    /// A few vertices that everybody has.
    fn begin(&mut self) {
        let mutations: Vec<Mutation> =
            (0..5).map(|number| part_of_the_scene(&format!("s{number}"))).collect();
        self.handles.extend((0..5).map(|number| format!("s{number}")));
        let delta = self.peer.mutate(&Mutate { replica: REPLICAS[0].into(), mutations }).unwrap().delta;
        for replica in REPLICAS {
            self.deliver(replica, delta.clone());
        }
        self.deltas.push(delta);
    }

    fn view(&mut self, replica: &str) -> View {
        let view = self.peer.read(&Read { replica: replica.into() }).unwrap().view.canonical();
        if let Some(broken) = broken(&view, self.dictionary.as_ref()) {
            *self.broken.entry(broken.clause()).or_default() += 1;
        }
        view
    }

    fn deliver(&mut self, replica: &str, delta: String) {
        self.peer.deliver(&Deliver { replica: replica.into(), delta }).unwrap();
    }

    fn answer(&mut self, from: &str, to: &str) {
        let made = self.peer.resynchronise(&AnswerFor { from: from.into(), to: to.into() }).unwrap();
        self.deliver(to, made.delta);
    }

    fn step(&mut self, step: usize) {
        let author = self.dice.pick(&REPLICAS).to_owned();
        match self.dice.below(12) {
            0 if self.deltas.len() > 2 => {
                let deltas = (0..2).map(|_| self.deltas[self.dice.below(self.deltas.len())].clone());
                let made = self.peer.group(&Group { deltas: deltas.collect() }).unwrap();
                self.deltas.push(made.delta);
            }
            1 => {
                let keeps = self.dice.below(2) == 0;
                self.peer.restart(&Restart { replica: author, keeps }).unwrap();
            }
            2..6 if !self.deltas.is_empty() => {
                let delta = self.deltas[self.dice.below(self.deltas.len())].clone();
                self.deliver(&author, delta);
            }
            6 => {
                let other = self.dice.pick(&REPLICAS).to_owned();
                self.answer(&other, &author);
            }
            _ => self.mutate(&author, step),
        }
        for replica in REPLICAS {
            self.view(replica);
        }
    }

    fn mutate(&mut self, author: &str, step: usize) {
        let view = self.view(author);
        let there = view.vertices.0.keys().map(String::as_str).chain([ROOT]);
        let names: Vec<&str> = if self.dice.below(4) > 0 {
            there.collect()
        } else {
            self.handles.iter().map(String::as_str).collect()
        };
        let dice = &mut self.dice;
        let mutations: Vec<Mutation> = (0..=dice.below(2))
            .map(|part| {
                let placed = self.places.then(|| placed(dice, &names, &view)).flatten();
                placed.unwrap_or_else(|| dice.mutation(&names, &view, &format!("v{step}-{part}")))
            })
            .collect();
        let mutate = Mutate { replica: author.into(), mutations };
        match self.peer.mutate(&mutate) {
            Ok(made) => {
                self.deltas.push(made.delta);
                self.handles.extend(mutate.mutations.into_iter().filter_map(|mutation| match mutation {
                    Mutation::AddVertex { r#as, .. } => Some(r#as),
                    _ => None,
                }));
            }
            Err(decline) => {
                let is_refusal = matches!(&decline, Decline::Error(error)
                    if matches!(error.code, ErrorCode::Refused | ErrorCode::Unknown));
                assert!(is_refusal, "{mutate:?}: {decline:?}");
                assert_eq!(self.view(author), view, "a refused mutation changes something: {mutate:?}");
            }
        }
    }

    /// Everybody gets everything; then all must show the same. Says who does not.
    fn settle(&mut self) -> Result<(), &'static str> {
        for replica in REPLICAS {
            for delta in self.deltas.clone() {
                self.deliver(replica, delta);
            }
        }
        let first = self.view(REPLICAS[0]);
        REPLICAS.into_iter().try_for_each(
            |replica| {
                if self.view(replica) == first { Ok(()) } else { Err(replica) }
            },
        )
    }
}

/// A whole walk, up to where everybody has everything.
fn walked<R: Replica>(seed: u64) -> (Walk<R>, Result<(), &'static str>) {
    let mut walk = Walk::<R>::new(seed);
    for step in 0..STEPS {
        walk.step(step);
    }
    let settled = walk.settle();
    (walk, settled)
}

/// Every other time, a vertex for another parent.
fn placed(dice: &mut Dice, names: &[&str], view: &View) -> Option<Mutation> {
    let kinematic: Vec<_> = view.edges.iter().filter(|edge| edge.label == RT).collect();
    if kinematic.is_empty() || dice.below(2) == 0 {
        return None;
    }
    let edge = kinematic[dice.below(kinematic.len())];
    let old = EdgeName { from: edge.from.clone(), label: RT.into(), to: edge.to.clone() };
    let new = EdgeName { from: dice.pick(names).into(), ..old.clone() };
    Some(Mutation::MoveEdge { old, new, attributes: Unique::default() })
}

fn part_of_the_scene(handle: &str) -> Mutation {
    let from = Some(ROOT.to_owned());
    let link = Link { from, label: RT.into(), to: None, attributes: Unique::default() };
    Mutation::AddVertex {
        r#as: handle.into(),
        r#type: "thing".into(),
        name: handle.into(),
        attributes: Unique::default(),
        link,
    }
}

/// Nothing goes wrong but refusals, all replicas come to show the same, and these invariants are what concurrency breaks.
fn walks<R: Replica>(breaks: &[&str]) {
    let mut all = BTreeMap::new();
    for seed in 0..SEEDS {
        println!("seed {seed}");
        let (walk, settled) = walked::<R>(seed);
        assert_eq!(settled, Ok(()), "after every delta");
        for (clause, count) in walk.broken {
            *all.entry(clause).or_insert(0) += count;
        }
    }
    println!("{}: broken {all:?}", R::implementation().name);
    assert_eq!(all.into_keys().collect::<Vec<_>>(), breaks);
}

#[test]
fn law_automerge_converges() {
    walks::<AutomergeGraph>(&["INV-1", "INV-3"]);
}

#[test]
fn law_loro_converges() {
    walks::<LoroGraph>(&["INV-1"]);
}

#[test]
fn law_yrs_converges() {
    walks::<YrsGraph>(&["INV-1", "INV-3"]);
}

/// yrs, but the third replica misses its third message.
struct Deaf {
    inner: YrsGraph,
    identity: Identity,
    heard: usize,
}

impl Replica for Deaf {
    type Error = YrsGraphError;
    type Update = Vec<u8>;

    fn implementation() -> Implementation {
        YrsGraph::implementation()
    }

    fn new(identity: Identity, dictionary: &Dictionary) -> Result<Self, YrsGraphError> {
        Ok(Self { inner: YrsGraph::new(identity, dictionary)?, identity, heard: 0 })
    }

    fn graph(&self) -> Result<Graph, YrsGraphError> {
        self.inner.graph()
    }

    fn trial(&self) -> Result<Self, YrsGraphError> {
        Ok(Self { inner: self.inner.trial()?, ..*self })
    }

    fn write(&mut self, edits: &[Edit]) -> Result<Message, YrsGraphError> {
        self.inner.write(edits)
    }

    fn deliver(&mut self, message: &Message) -> Result<(), YrsGraphError> {
        self.heard += 1;
        if self.identity.position == 3 && self.heard == 3 { Ok(()) } else { self.inner.deliver(message) }
    }

    fn missing(&self, other: &Self) -> Result<Message, YrsGraphError> {
        self.inner.missing(&other.inner)
    }

    fn restart(&mut self, identity: Identity, keeps: bool) -> Result<(), YrsGraphError> {
        self.inner.restart(identity, keeps)
    }
}

#[test]
fn canary_a_replica_that_misses_a_message_is_found() {
    assert!((0..SEEDS).any(|seed| walked::<Deaf>(seed).1 == Err("c")));
}
