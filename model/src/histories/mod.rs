//! L1: histories instead of schedules. `[spec: CHECK-3]`
//!
//! If deltas commute, a replica's state is a function of the *set* of deltas delivered to it. So deliveries
//! are fused into the mutation that first observes them: a step is (replica, any set of delivered deltas,
//! mutation). That deltas commute is not assumed but checked, in every delivered subset of every history
//! (the *diamonds*): if they did not, that is a violation, never silence.
//!
//! A history is kept as what can still matter: the deltas broadcast so far, by author, and the state of
//! each replica that may still mutate.

mod judge;
mod model;
mod run;
mod symmetry;

pub use judge::Fault;
pub use model::{FoundFault, HistoryModel};
pub use run::HistoryRun;
pub use symmetry::Permutations;

use crate::semantics::Semantics;
use crate::tables::{DeltaId, NONE, StateId, StepFault, Tables};
use judge::Judge;
use std::sync::Arc;

/// The most replicas of a run.
pub const REPLICAS_MAX: usize = 4;
/// The most mutations of one replica.
pub const MUTATIONS_MAX: usize = 4;

/// Duplicates and resynchronisation are judged in every set of at most this many deltas; of larger sets L0 and
/// L2 judge them.
const REPLAY_MAX: usize = 2;

/// How far a run goes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Bound {
    /// Replicas, at most [`REPLICAS_MAX`].
    pub replicas: usize,
    /// Mutations of each replica, at most [`MUTATIONS_MAX`].
    pub mutations: usize,
}

/// A history, by what can still matter.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct History {
    /// Per replica, the deltas that it broadcast, in order.
    pub deltas: [[DeltaId; MUTATIONS_MAX]; REPLICAS_MAX],
    /// Per replica that may still mutate, its state after its last mutation.
    pub last: [StateId; REPLICAS_MAX],
    /// Whether it stands for itself alone, not for its images under renaming replicas.
    pub concrete: bool,
}

impl History {
    /// How many mutations it has.
    pub fn depth(&self) -> usize {
        self.deltas.iter().flatten().filter(|&&delta| delta != NONE).count()
    }

    /// How many mutations one replica has made.
    fn made(&self, replica: usize) -> usize {
        self.deltas[replica].iter().take_while(|&&delta| delta != NONE).count()
    }

    /// Every delta broadcast.
    fn pool(&self) -> impl Iterator<Item = DeltaId> + '_ {
        self.deltas.iter().flatten().copied().filter(|&delta| delta != NONE)
    }
}

/// One step: a replica receives some deltas and mutates.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Choice {
    /// Who.
    pub replica: usize,
    /// Its state after the deliveries and before the mutation.
    pub before: StateId,
    /// Which of its mutations in that state.
    pub index: u32,
    /// The delta broadcast.
    pub delta: DeltaId,
}

/// The search space of L1 over one semantics: successors and judgement, whatever the engine.
#[derive(Debug)]
pub struct Histories<S: Semantics> {
    semantics: Arc<S>,
    bound: Bound,
    permutations: Permutations,
    tables: Tables<S>,
    judge: Judge,
    /// The largest sets in which deltas are delivered twice and parts resynchronised.
    replay_max: usize,
    /// Which pairs of kinds were concurrent, by `kind * kinds + kind`.
    concurrent: u64,
    kinds: usize,
    initial: StateId,
}

impl<S: Semantics> Histories<S> {
    /// The space of `bound`; with `symmetry`, histories that differ by renaming replicas are one, where
    /// that is sound.
    pub fn new(semantics: Arc<S>, bound: Bound, symmetry: bool) -> Self {
        let mut tables = Tables::default();
        let initial = tables.intern(semantics.initial());
        let kinds = semantics.kinds().len();
        Self {
            semantics,
            bound,
            permutations: Permutations::of(if symmetry { bound.replicas } else { 1 }),
            tables,
            judge: Judge::default(),
            replay_max: REPLAY_MAX,
            concurrent: 0,
            kinds,
            initial,
        }
    }

    /// The history in which nothing has happened.
    pub fn start(&self) -> History {
        let mut last = [NONE; REPLICAS_MAX];
        if self.bound.mutations > 0 {
            last[..self.bound.replicas].fill(self.initial);
        }
        History {
            deltas: [[NONE; MUTATIONS_MAX]; REPLICAS_MAX],
            last,
            concrete: self.permutations.len() == 1,
        }
    }

    /// The state that every replica starts from.
    pub fn initial(&self) -> StateId {
        self.initial
    }

    /// The state after a delivery.
    pub fn join(&mut self, state: StateId, delta: DeltaId) -> StateId {
        self.tables.join(&self.semantics, state, delta)
    }

    /// The number of a state from outside the search, for its trace.
    pub(crate) fn intern(&mut self, state: S::State) -> StateId {
        self.tables.intern(state)
    }

    /// The number of a delta from outside the search, for its trace.
    pub(crate) fn intern_delta(&mut self, delta: S::Delta) -> DeltaId {
        self.tables.intern_delta(delta, 0)
    }

    /// What was computed.
    pub fn tables(&self) -> &Tables<S> {
        &self.tables
    }

    /// The kinds of mutation that were done, by bit.
    pub fn kinds_done(&self) -> u32 {
        self.tables.all_kinds()
    }

    /// Pairs of kinds that were concurrent, with their indices.
    pub fn concurrent(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let pairs = (0..self.kinds).flat_map(move |left| (left..self.kinds).map(move |right| (left, right)));
        pairs.filter(move |&(left, right)| self.concurrent >> (left * self.kinds + right) & 1 == 1)
    }

    /// The bound.
    pub fn bound(&self) -> Bound {
        self.bound
    }

    /// Every history one mutation longer.
    pub fn successors(
        &mut self,
        history: &History,
        out: &mut Vec<(Choice, History)>,
    ) -> Result<(), StepFault<S>> {
        for replica in 0..self.bound.replicas {
            if history.last[replica] == NONE {
                continue;
            }
            for before in self.reachable(history, replica) {
                if !history.concrete && self.tables.is_order_sensitive(&self.semantics, before) {
                    self.successors_of_images(history, replica, before, out)?;
                } else {
                    self.successors_at(history, replica, before, out)?;
                }
            }
        }
        Ok(())
    }

    /// The states that a replica can reach before its next mutation: its last one, joined with any subset
    /// of what the others broadcast.
    fn reachable(&mut self, history: &History, replica: usize) -> Vec<StateId> {
        let others = (0..self.bound.replicas).filter(|&other| other != replica);
        let foreign: Vec<DeltaId> =
            others.flat_map(|other| history.deltas[other]).filter(|&delta| delta != NONE).collect();
        let mut states = vec![history.last[replica]];
        for delta in foreign {
            for at in 0..states.len() {
                let joined = self.tables.join(&self.semantics, states[at], delta);
                states.push(joined);
            }
            states.sort_unstable();
            states.dedup();
        }
        states
    }

    fn successors_at(
        &mut self,
        history: &History,
        replica: usize,
        before: StateId,
        out: &mut Vec<(Choice, History)>,
    ) -> Result<(), StepFault<S>> {
        let moves = self.tables.moves(&self.semantics, before, replica)?;
        let unseen = self.kinds_unseen(history, replica, before);
        let made = history.made(replica);
        for step in moves.iter() {
            let mut next = *history;
            next.deltas[replica][made] = step.delta;
            next.last[replica] = if made + 1 < self.bound.mutations {
                self.tables.join(&self.semantics, before, step.delta)
            } else {
                NONE
            };
            self.note_concurrent(step.kind, unseen);
            let next = if history.concrete { next } else { self.canonical(&next) };
            out.push((Choice { replica, before, index: step.index, delta: step.delta }, next));
        }
        Ok(())
    }

    /// Where the order of replicas matters, each image of the history goes its own way.
    fn successors_of_images(
        &mut self,
        history: &History,
        replica: usize,
        before: StateId,
        out: &mut Vec<(Choice, History)>,
    ) -> Result<(), StepFault<S>> {
        for permutation in 0..self.permutations.len() {
            let mut image = self.image(history, permutation);
            image.concrete = true;
            let to = self.permutations.get(permutation);
            let (replica, to) = (to[replica], to.to_vec());
            let before = self.tables.rename_state(&self.semantics, before, permutation, &to);
            self.successors_at(&image, replica, before, out)?;
        }
        Ok(())
    }

    /// The kinds of the mutations that a replica in this state has not seen.
    fn kinds_unseen(&mut self, history: &History, replica: usize, before: StateId) -> u32 {
        let mut kinds = 0;
        for (other, deltas) in history.deltas.iter().enumerate() {
            for &delta in deltas.iter().filter(|&&delta| delta != NONE && other != replica) {
                if self.tables.join(&self.semantics, before, delta) != before {
                    kinds |= self.tables.delta_kinds(delta);
                }
            }
        }
        kinds
    }

    fn note_concurrent(&mut self, kind: usize, unseen: u32) {
        for other in (0..self.kinds).filter(|other| unseen >> other & 1 == 1) {
            self.concurrent |= 1 << (kind.min(other) * self.kinds + kind.max(other));
        }
    }
}
