//! Universes: a set of records, each under its dot, of which states hold, have lost or have not seen each.
//!
//! States over one universe never use a dot twice, so the laws of join apply to any number of them. They
//! need not be reachable: records wait for anchors that never come, claims hide one another, kinematic
//! claims form cycles, children have two parents, names clash.

use crate::atoms;
use dsr_core::{
    CausalContext, Dot, Edge, Name, RT, Record, ReplicaId, State, Value, Vertex, VertexId, Write, encode,
};
use proptest::collection::{btree_map, vec};
use proptest::prelude::*;
use std::collections::BTreeMap;

/// What a state knows of a dot, in the order in which it may change.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Fate {
    /// Not seen.
    Unseen,
    /// Seen and held.
    Held,
    /// Seen and not held.
    Dead,
}

impl Fate {
    /// All three.
    pub const ALL: [Self; 3] = [Self::Unseen, Self::Held, Self::Dead];
}

/// What records of a universe may be anchored to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Anchors {
    /// Edges to vertices, writes to vertices and edges, both to dots that nobody ever holds: well-formed.
    Right,
    /// Any dot but their own: closed, but an anchor can be of the wrong kind.
    Any,
}

/// Records under their dots.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Universe {
    /// The records.
    pub records: BTreeMap<Dot, Record>,
}

impl Universe {
    /// The state in which the dots have these fates, in order; dots without one are unseen. What is held but
    /// anchored to the dead dies.
    pub fn state(&self, fates: &[Fate]) -> State {
        let mut state = self.unclosed(fates);
        state.close();
        state
    }

    /// The state in which the dots have just these fates, held records with dead anchors included: not
    /// well-formed in general.
    pub fn unclosed(&self, fates: &[Fate]) -> State {
        let known = || self.records.iter().zip(fates);
        let context: CausalContext =
            known().filter(|(_, fate)| **fate != Fate::Unseen).map(|((&dot, _), _)| dot).collect();
        let held = known().filter(|(_, fate)| **fate == Fate::Held);
        State::assemble(held.map(|((&dot, record), _)| (dot, record.clone())), context)
    }

    /// Every choice of fates: 3 to the number of records.
    pub fn all_fates(&self) -> impl Iterator<Item = Vec<Fate>> + '_ {
        let count = 3_usize.pow(u32::try_from(self.records.len()).unwrap_or(u32::MAX));
        (0..count).map(|code| {
            let digits = std::iter::successors(Some(code), |rest| Some(rest / 3));
            digits.take(self.records.len()).map(|rest| Fate::ALL[rest % 3]).collect()
        })
    }

    /// Every closed state over the universe, once.
    pub fn all_states(&self) -> Vec<State> {
        let mut states: Vec<State> = self.all_fates().map(|fates| self.state(&fates)).collect();
        states.sort();
        states.dedup();
        states
    }

    /// The universe of the records of a state.
    pub fn of(state: &State) -> Self {
        Self { records: state.records().map(|(dot, record)| (dot, record.clone())).collect() }
    }

    /// What a state knows of each dot, in order.
    pub fn fates_in(&self, state: &State) -> Vec<Fate> {
        let fate = |&dot: &Dot| match (state.holds(dot), state.context().contains(dot)) {
            (true, _) => Fate::Held,
            (false, true) => Fate::Dead,
            (false, false) => Fate::Unseen,
        };
        self.records.keys().map(fate).collect()
    }
}

/// What a record is made from once all dots are known.
#[derive(Clone, Debug)]
pub(crate) struct Seed {
    /// 0 a vertex, 1 an edge, else a write.
    pub(crate) kind: u8,
    /// What it hangs from, by [`pick`].
    pub(crate) ends: (u16, u16),
    pub(crate) label: Name,
    pub(crate) names: (Name, Name),
    pub(crate) value: Value,
    pub(crate) stamp: u64,
    pub(crate) external_id: Option<u64>,
    pub(crate) timestamp_ns: u64,
}

fn seed() -> impl Strategy<Value = Seed> {
    (
        prop_oneof![3 => Just(0_u8), 5 => Just(1), 2 => Just(2)],
        any::<(u16, u16)>(),
        atoms::label(),
        (atoms::name(), atoms::name()),
        prop_oneof![3 => (0..3_i32).prop_map(Value::Int), 1 => atoms::value()],
        1..=4_u64,
        prop::option::weighted(0.2, any::<u64>()),
        prop_oneof![Just(0), any::<u64>()],
    )
        .prop_map(|(kind, ends, label, names, value, stamp, external_id, timestamp_ns)| Seed {
            kind,
            ends,
            label,
            names,
            value,
            stamp,
            external_id,
            timestamp_ns,
        })
}

/// A universe of at most `records_max` records.
pub fn universes(records_max: usize, anchors: Anchors) -> impl Strategy<Value = Universe> {
    btree_map(atoms::dot(), seed(), 0..=records_max).prop_map(move |seeds| grow(&seeds, anchors))
}

/// Some states over one universe.
pub fn states(count: usize, records_max: usize, anchors: Anchors) -> impl Strategy<Value = Vec<State>> {
    fates(count, records_max, anchors)
        .prop_map(|(universe, fates)| fates.iter().map(|fates| universe.state(fates)).collect())
}

/// Some well-formed states over one universe as bytes, for tests inside the core: its own types are not those
/// of the crate that is linked here.
pub fn encoded_states(count: usize, records_max: usize) -> impl Strategy<Value = Vec<Vec<u8>>> {
    states(count, records_max, Anchors::Right).prop_map(|states| states.iter().map(encode).collect())
}

/// A universe and the fates that some states give to its dots, not closed.
pub fn fates(
    count: usize,
    records_max: usize,
    anchors: Anchors,
) -> impl Strategy<Value = (Universe, Vec<Vec<Fate>>)> {
    (universes(records_max, anchors), vec(vec(fate(), records_max), count))
}

fn fate() -> impl Strategy<Value = Fate> {
    prop_oneof![1 => Just(Fate::Unseen), 6 => Just(Fate::Held), 1 => Just(Fate::Dead)]
}

/// A dot that no state over any universe has seen.
const NOWHERE: Dot = Dot::new(ReplicaId::agent(4), 1);

pub(crate) fn grow(seeds: &BTreeMap<Dot, Seed>, anchors: Anchors) -> Universe {
    let of_kind = |fits: fn(u8) -> bool| -> Vec<Dot> {
        let fitting = seeds.iter().filter(|(_, seed)| anchors == Anchors::Any || fits(seed.kind));
        fitting.map(|(&dot, _)| dot).collect()
    };
    let (vertices, elements) = (of_kind(|kind| kind == 0), of_kind(|kind| kind < 2));
    let records = seeds.iter().map(|(&dot, seed)| (dot, record(dot, seed, &vertices, &elements)));
    Universe { records: records.collect() }
}

/// One of the dots, often one of the first two so that claims compete; the root; or rarely a dot that never
/// comes; never `own`.
fn pick(choice: u16, dots: &[Dot], own: Dot) -> Dot {
    let others: Vec<Dot> = dots.iter().copied().filter(|&dot| dot != own).collect();
    let choice = usize::from(choice);
    match choice % 16 {
        0 => NOWHERE,
        1..=3 => VertexId::ROOT.0,
        _ if others.is_empty() => VertexId::ROOT.0,
        4..=10 => others[choice / 16 % others.len().min(2)],
        _ => others[choice / 16 % others.len()],
    }
}

fn record(dot: Dot, seed: &Seed, vertices: &[Dot], elements: &[Dot]) -> Record {
    let seed = seed.clone();
    let stamp = seed.stamp;
    match seed.kind {
        0 => Record::Vertex(Vertex {
            vertex_type: seed.names.0,
            name: seed.names.1,
            external_id: seed.external_id,
            stamp,
        }),
        1 => {
            let from = pick(seed.ends.0, vertices, dot);
            let mut to = pick(seed.ends.1, vertices, dot);
            if from == to {
                to = if from == VertexId::ROOT.0 { NOWHERE } else { VertexId::ROOT.0 };
            }
            let label = if to == VertexId::ROOT.0 && &*seed.label == RT { "in".into() } else { seed.label };
            Record::Edge(Edge { from: VertexId(from), to: VertexId(to), label, stamp })
        }
        _ => Record::Write(Write {
            target: pick(seed.ends.0, elements, dot),
            name: seed.names.0,
            value: seed.value,
            timestamp_ns: seed.timestamp_ns,
            stamp,
        }),
    }
}
