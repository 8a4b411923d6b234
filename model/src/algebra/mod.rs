//! L0, the algebra: every law, on every well-formed state over a few dots, on every pair and triple of them.
//! `[spec: CHECK-2]`
//!
//! A state over n given records is an assignment of *unseen*, *held* or *dead* to each of their dots: 3ⁿ of
//! them, whether any run reaches them or not. The records come in families, so that between them all kinds
//! of record, anchors at depth two, gaps in the context, two replicas and competing claims occur. Joins are
//! computed once for each pair by the semantics under test; triples are then look-ups.
//!
//! Laws are compared with an oracle that knows nothing of stores, version vectors or clouds: see
//! [`conditions`].

pub mod conditions;
mod families;
mod laws;
mod report;
mod space;

pub use report::{Example, LawReport, Quantifier, Report};

use crate::checked::Checked;
use crate::semantics::{Clause, Semantics};
use dsr_core::{Delta, Dot, Record, State};
use laws::laws;
use report::Tally;
use space::Space;

/// A semantics whose states can be enumerated.
///
/// What has a [`body`](Self::body) is compared with the set-theoretic oracle as well; what has none is held
/// to the laws that only need joins.
pub trait Algebra: Semantics {
    /// Every state over `records` records, for several families of records.
    fn universe(&self, records: usize) -> Vec<Family<Self::State>>;

    /// The state as one of `dsr-core`, if it is one.
    fn body<'s>(&self, state: &'s Self::State) -> Option<&'s State>;

    /// The delta as a state of `dsr-core`, if it is one.
    fn delta_body<'d>(&self, delta: &'d Self::Delta) -> Option<&'d State>;

    /// The merge of two states: what join is before closure. `[spec: JOIN-1]`
    fn merge(&self, left: &Self::State, right: &Self::State) -> Option<Self::State>;

    /// The closure of a state. `[spec: CLOSE-1]`
    fn close(&self, state: &Self::State) -> Option<Self::State>;
}

/// Every state over some records.
#[derive(Clone, Debug)]
pub struct Family<T> {
    /// What it is about.
    pub name: &'static str,
    /// The records, each under its dot.
    pub records: Vec<(Dot, Record)>,
    /// All assignments of conditions, closed or not, in the order of [`conditions::assignments`].
    pub all: Vec<T>,
    /// Which of them are closed, by the oracle.
    pub closed: Vec<usize>,
}

/// The families of `records` records as states of `dsr-core`: what most implementations of
/// [`Algebra::universe`] return.
pub fn core_universe(records: usize) -> Vec<Family<State>> {
    families::families(records)
        .into_iter()
        .map(|(name, records)| {
            let assignments = conditions::assignments(records.len());
            let is_closed = |&at: &usize| conditions::closure(&records, &assignments[at]) == assignments[at];
            let closed = (0..assignments.len()).filter(is_closed).collect();
            let all =
                assignments.iter().map(|assignment| conditions::state_of(&records, assignment)).collect();
            Family { name, records, all, closed }
        })
        .collect()
}

/// The laws, by the clauses that state them: [`run`] checks each.
pub fn clauses<S: Algebra>() -> Vec<Clause> {
    let laws = laws::<S>().into_iter();
    laws.map(|(law, _)| Clause { id: law.clause, claim: "", what: law.says }).collect()
}

/// Checks every law on every family of `records` records. `[spec: CHECK-2]`
pub fn run<S: Algebra>(semantics: &S, records: usize) -> Report {
    let mut tallies: Vec<Tally> = laws::<S>().iter().map(|(law, _)| Tally::new(*law)).collect();
    let mut states = 0;
    let families = semantics.universe(records);
    let count = families.len();
    for family in families {
        states += family.all.len();
        let mut space = Space::new(semantics, family);
        for ((_, check), tally) in laws::<S>().into_iter().zip(&mut tallies) {
            check(&mut space, tally);
        }
    }
    Report {
        semantics: semantics.name(),
        records,
        families: count,
        states,
        laws: tallies.into_iter().map(Tally::finish).collect(),
    }
}

impl Algebra for Checked {
    fn universe(&self, records: usize) -> Vec<Family<State>> {
        core_universe(records)
    }

    fn body<'s>(&self, state: &'s State) -> Option<&'s State> {
        Some(state)
    }

    fn delta_body<'d>(&self, delta: &'d Delta) -> Option<&'d State> {
        Some(delta)
    }

    fn merge(&self, left: &State, right: &State) -> Option<State> {
        let mut merged = left.clone();
        merged.merge(right);
        Some(merged)
    }

    fn close(&self, state: &State) -> Option<State> {
        let mut closed = state.clone();
        closed.close();
        Some(closed)
    }
}
