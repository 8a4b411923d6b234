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
mod known;
mod run;
mod shapes;
mod symmetry;
mod trace;

pub use judge::Fault;
pub use run::HistoryRun;
pub use symmetry::Permutations;

use crate::search::{Space, hash_numbers};
use crate::semantics::{Breach, Delivery, Semantics};
use crate::tables::{DeltaId, Move, NONE, StateId, StepFault, Tables};
use judge::Judge;
use rustc_hash::FxHashMap;
use shapes::{Grain, Shape, Shapes};
use std::hash::{Hash, Hasher};
use std::sync::Arc;

/// The most replicas of a run.
pub const REPLICAS_MAX: usize = 4;
/// The most mutations of one replica.
pub const MUTATIONS_MAX: usize = 4;

/// What is concluded from shapes is tried all the same, each time until this often, and then on a sample.
const TRIED_FIRST: u64 = 2048;
/// Of so many shapes one is in the sample: a power of two.
const SAMPLE: u64 = 256;

/// How far a run goes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Bound {
    /// Replicas, at most [`REPLICAS_MAX`].
    pub replicas: usize,
    /// Mutations of each replica, at most [`MUTATIONS_MAX`].
    pub mutations: usize,
}

/// A history, by what can still matter.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct History {
    /// Per replica, the deltas that it broadcast, in order.
    pub deltas: [[DeltaId; MUTATIONS_MAX]; REPLICAS_MAX],
    /// Per replica that may still mutate, its state after its last mutation.
    pub last: [StateId; REPLICAS_MAX],
    /// Whether it stands for itself alone, not for its images under renaming replicas.
    pub concrete: bool,
}

impl Hash for History {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        hash_numbers(self.deltas.as_flattened(), hasher);
        hash_numbers(&self.last, hasher);
        hasher.write_u8(u8::from(self.concrete));
    }
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
    shapes: Shapes,
    judge: Judge<S>,
    /// By state, deltas that lead to it from the initial one.
    origins: Vec<Arc<[DeltaId]>>,
    /// What replicas can do in the first state of each shape.
    stepped: FxHashMap<(Shape, usize), Arc<[Move]>>,
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
        let permutations =
            Permutations::of(if symmetry && semantics.has_symmetry() { bound.replicas } else { 1 });
        Self {
            semantics,
            bound,
            shapes: Shapes::new(permutations.clone()),
            permutations,
            tables,
            judge: Judge::default(),
            origins: vec![Arc::default()],
            stepped: FxHashMap::default(),
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

    /// Whether sets of one shape are judged once, and of how many shapes that is tried on one all the same:
    /// a power of two.
    pub fn set_shapes(&mut self, shapes: bool, tried_of: u64) {
        self.shapes.set_in_use(shapes);
        self.judge.sample = tried_of;
    }

    /// The state after a delivery.
    pub fn join(&mut self, state: StateId, delta: DeltaId) -> StateId {
        let joined = self.tables.join(&self.semantics, state, delta);
        self.note_origin(joined, state, delta);
        joined
    }

    /// A state with its replicas renamed.
    fn rename_state(&mut self, state: StateId, permutation: usize) -> StateId {
        let to = self.permutations.get(permutation);
        let renamed = self.tables.rename_state(&self.semantics, state, permutation, to);
        if renamed as usize == self.origins.len() {
            let origin = self.origins[state as usize].clone();
            let origin = self.rename_set(&origin, permutation);
            self.origins.push(origin.into());
        }
        renamed
    }

    /// Deltas with their replicas renamed.
    fn rename_set(&mut self, set: &[DeltaId], permutation: usize) -> Vec<DeltaId> {
        let to = self.permutations.get(permutation);
        let rename = |&delta| self.tables.rename_delta(&self.semantics, delta, permutation, to);
        set.iter().map(rename).collect()
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

    /// Replica states judged, of how many delivered subsets, by how many diamonds, and how many of the sample
    /// that shapes saved were judged all the same.
    pub fn judged(&self) -> JudgedCounts {
        JudgedCounts {
            states: self.tables.judged,
            subsets: self.judge.subsets,
            diamonds: self.judge.diamonds,
            sampled: self.judge.sampled,
        }
    }

    /// Every history one mutation longer.
    pub fn successors(
        &mut self,
        history: &History,
        out: &mut Vec<(Choice, History)>,
    ) -> Result<(), FoundFault<S>> {
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
        let mut foreign: Vec<DeltaId> =
            others.flat_map(|other| history.deltas[other]).filter(|&delta| delta != NONE).collect();
        if self.semantics.delivery() == Delivery::Once {
            let received = &self.origins[history.last[replica] as usize];
            foreign.retain(|delta| !received.contains(delta));
        }
        let mut states = vec![history.last[replica]];
        for delta in foreign {
            for at in 0..states.len() {
                let joined = self.join(states[at], delta);
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
    ) -> Result<(), FoundFault<S>> {
        let moves = self.moves(before, replica)?;
        let unseen = self.kinds_unseen(history, replica, before);
        let made = history.made(replica);
        for step in moves.iter() {
            let mut next = *history;
            next.deltas[replica][made] = step.delta;
            next.last[replica] = match step.after {
                _ if made + 1 == self.bound.mutations => NONE,
                NONE => self.join(before, step.delta),
                after => after,
            };
            self.note_concurrent(step.kind, unseen);
            let next = if history.concrete { next } else { self.canonical(&next) };
            out.push((Choice { replica, before, delta: step.delta }, next));
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
    ) -> Result<(), FoundFault<S>> {
        for permutation in 0..self.permutations.len() {
            let mut image = self.image(history, permutation);
            image.concrete = true;
            let replica = self.permutations.image(replica, permutation);
            let before = self.rename_state(before, permutation);
            self.successors_at(&image, replica, before, out)?;
        }
        Ok(())
    }

    /// What a replica can do in a state. In states of one shape that is the same but for stamps, and where no
    /// rank decides anything but for names of replicas; so it is tried and judged once for all of them, and
    /// on a sample each time. `[spec: CHECK-11]`
    fn moves(&mut self, before: StateId, replica: usize) -> Result<Arc<[Move]>, FoundFault<S>> {
        if let Some(moves) = self.tables.known_moves(before, replica) {
            return Ok(moves);
        }
        if self.semantics.delivery() == Delivery::Once {
            return self.own_moves(before, replica);
        }
        let origin = self.origins[before as usize].clone();
        let sensitive = self.tables.is_order_sensitive(&self.semantics, before);
        let grain = if sensitive { Grain::Fine } else { Grain::Outline };
        let shape = Shape::from(self.shapes.of(&*self.semantics, &mut self.tables, &origin, grain));
        let by = self.shapes.by();
        let is_tried = self.judge.is_tried(&shape);
        let key = (shape, self.permutations.image(replica, by));
        let Some(alike) = self.stepped.get(&key).cloned() else {
            let moves = self.tables.moves(&self.semantics, before, replica).map_err(FoundFault::Step)?;
            let image = moves.iter().map(|step| self.rename_move(*step, by)).collect();
            self.stepped.insert(key, image);
            return Ok(moves);
        };
        let moves = self.moves_alike(before, by, &alike);
        if is_tried {
            let own = self.tables.moves(&self.semantics, before, replica).map_err(FoundFault::Step)?;
            let sorted = |moves: &[Move]| -> Vec<DeltaId> {
                let mut deltas: Vec<DeltaId> = moves.iter().map(|step| step.delta).collect();
                deltas.sort_unstable();
                deltas
            };
            if sorted(&own) != sorted(&moves) {
                return Err(FoundFault::Delivered(Fault::new(judge::unlike(), &origin, None)));
            }
        }
        self.tables.set_moves(before, replica, moves.clone());
        Ok(moves)
    }

    /// The moves of a state where authors do not join their own deltas.
    fn own_moves(&mut self, before: StateId, replica: usize) -> Result<Arc<[Move]>, FoundFault<S>> {
        let moves = self.tables.moves(&self.semantics, before, replica).map_err(FoundFault::Step)?;
        for step in moves.iter() {
            self.note_origin(step.after, before, step.delta);
        }
        Ok(moves)
    }

    /// The author's state after a mutation.
    pub(crate) fn author_state(&mut self, before: StateId, author: usize, delta: DeltaId) -> StateId {
        if self.semantics.delivery() == Delivery::Any {
            return self.join(before, delta);
        }
        let after = self.tables.author_state(&self.semantics, before, author, delta);
        self.note_origin(after, before, delta);
        after
    }

    /// Remembers by which deltas a new state is reached.
    fn note_origin(&mut self, after: StateId, before: StateId, delta: DeltaId) {
        if after as usize == self.origins.len() {
            let origin = self.origins[before as usize].iter().copied().chain([delta]);
            self.origins.push(origin.collect());
        }
    }

    /// The moves of a state from those of one that looks like it does after renaming replicas `by` a
    /// permutation, but for stamps.
    fn moves_alike(&mut self, before: StateId, by: usize, alike: &[Move]) -> Arc<[Move]> {
        let back = self.permutations.inverse(by);
        let stamp = self.semantics.next_stamp(&self.tables.state(before));
        let own = |step: &Move| {
            let step = self.rename_move(*step, back);
            let has_stamp = self.semantics.stamp(&self.tables.delta(step.delta)).is_some();
            let restamped = has_stamp.then(|| self.tables.restamp(&self.semantics, step.delta, stamp));
            Move { delta: restamped.unwrap_or(step.delta), ..step }
        };
        alike.iter().map(own).collect()
    }

    fn rename_move(&mut self, step: Move, permutation: usize) -> Move {
        let to = self.permutations.get(permutation);
        let delta = self.tables.rename_delta(&self.semantics, step.delta, permutation, to);
        Move { delta, ..step }
    }

    /// Whether a longer history exists: what is delivered here is then judged as part of that one.
    fn is_extended(&mut self, history: &History) -> bool {
        (0..self.bound.replicas).any(|replica| {
            let last = history.last[replica];
            // A faulty step is a fault, not an end: the search is about to meet it.
            last != NONE && self.moves(last, replica).map_or(true, |moves| !moves.is_empty())
        })
    }

    /// The kinds of the mutations that a replica in this state has not seen.
    fn kinds_unseen(&mut self, history: &History, replica: usize, before: StateId) -> u32 {
        let mut kinds = 0;
        for (other, deltas) in history.deltas.iter().enumerate() {
            for &delta in deltas.iter().filter(|&&delta| delta != NONE && other != replica) {
                if self.join(before, delta) != before {
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

/// How much a search has judged.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct JudgedCounts {
    /// Replica states, one of each shape.
    pub states: u64,
    /// Delivered subsets of histories that they stand for.
    pub subsets: u64,
    /// Deliveries compared in another order.
    pub diamonds: u64,
    /// Of the sets that shapes saved, those judged all the same.
    pub sampled: u64,
}

/// What broke.
#[derive(Debug)]
pub enum FoundFault<S: Semantics> {
    /// A delivered set.
    Delivered(Fault),
    /// A local step.
    Step(StepFault<S>),
}

impl<S: Semantics> FoundFault<S> {
    /// The clause.
    pub fn breach(&self) -> &Breach {
        match self {
            Self::Delivered(fault) => &fault.breach,
            Self::Step(fault) => &fault.breach,
        }
    }
}

impl<S: Semantics> Space for Histories<S> {
    type Node = History;
    type Event = Choice;
    type Fault = FoundFault<S>;

    fn start(&self) -> History {
        Self::start(self)
    }

    fn successors(&mut self, at: &History, out: &mut Vec<(Choice, History)>) -> Result<(), FoundFault<S>> {
        Self::successors(self, at, out)
    }

    fn judge(&mut self, at: &History) -> Result<(), FoundFault<S>> {
        Self::judge(self, at).map_err(FoundFault::Delivered)
    }

    fn is_covered(&mut self, at: &History) -> bool {
        self.is_extended(at)
    }

    fn depth(&self, at: &History) -> usize {
        at.depth()
    }

    fn states_judged(&self) -> u64 {
        self.tables.judged
    }

    fn witnessed(&self) -> usize {
        self.tables.witnesses.count() + self.kinds_done().count_ones() as usize
    }
}
