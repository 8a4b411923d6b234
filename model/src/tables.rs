//! Interned states and deltas, and memoised joins: so that the production core runs inside the search at
//! the speed of integers. Replica states recur far more often than histories do.

use crate::semantics::{Breach, Delivery, Judged, Semantics, Step, Witnesses};
use rustc_hash::FxHashMap;
use std::hash::Hash;
use std::sync::Arc;

/// A state's number in its [`Tables`].
pub type StateId = u32;
/// A delta's number in its [`Tables`].
pub type DeltaId = u32;
/// No state, no delta.
pub const NONE: u32 = u32::MAX;

/// Numbers for equal values.
#[derive(Debug)]
struct Interner<T> {
    values: Vec<Arc<T>>,
    ids: FxHashMap<Arc<T>, u32>,
}

impl<T: Eq + Hash> Interner<T> {
    fn new() -> Self {
        Self { values: Vec::new(), ids: FxHashMap::default() }
    }

    fn intern(&mut self, value: T) -> u32 {
        if let Some(&id) = self.ids.get(&value) {
            return id;
        }
        // A search that reaches `NONE` entries is far beyond any memory.
        let id = u32::try_from(self.values.len()).unwrap_or(NONE);
        let value = Arc::new(value);
        self.values.push(value.clone());
        self.ids.insert(value, id);
        id
    }

    fn get(&self, id: u32) -> Arc<T> {
        self.values[id as usize].clone()
    }
}

/// One thing that a replica can do in a state.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Move {
    /// The delta that it broadcasts.
    pub delta: DeltaId,
    /// Its kind.
    pub kind: usize,
    /// The author's state after it; [`NONE`] where that is the old one joined with the delta.
    pub after: StateId,
}

/// Everything that one run has computed of the semantics.
#[derive(Debug)]
pub struct Tables<S: Semantics> {
    states: Interner<S::State>,
    deltas: Interner<S::Delta>,
    kinds: Vec<u32>,
    joins: FxHashMap<(StateId, DeltaId), StateId>,
    moves: FxHashMap<(StateId, usize), Arc<[Move]>>,
    sensitive: FxHashMap<StateId, bool>,
    restamped: FxHashMap<(DeltaId, u64), DeltaId>,
    renamed_states: Renamed,
    renamed_deltas: Renamed,
    /// What was seen.
    pub witnesses: Witnesses,
    /// States judged by the semantics, each once.
    pub judged: u64,
}

impl<S: Semantics> Default for Tables<S> {
    fn default() -> Self {
        Self {
            states: Interner::new(),
            deltas: Interner::new(),
            kinds: Vec::new(),
            joins: FxHashMap::default(),
            moves: FxHashMap::default(),
            sensitive: FxHashMap::default(),
            restamped: FxHashMap::default(),
            renamed_states: Renamed::default(),
            renamed_deltas: Renamed::default(),
            witnesses: Witnesses::default(),
            judged: 0,
        }
    }
}

impl<S: Semantics> Tables<S> {
    /// The number of a state.
    pub fn intern(&mut self, state: S::State) -> StateId {
        self.states.intern(state)
    }

    /// The number of a delta that a mutation of this kind broadcast.
    pub fn intern_delta(&mut self, delta: S::Delta, kinds: u32) -> DeltaId {
        let id = self.deltas.intern(delta);
        let at = id as usize;
        if at == self.kinds.len() {
            self.kinds.push(0);
        }
        self.kinds[at] |= kinds;
        id
    }

    /// A state by its number.
    pub fn state(&self, id: StateId) -> Arc<S::State> {
        self.states.get(id)
    }

    /// A delta by its number.
    pub fn delta(&self, id: DeltaId) -> Arc<S::Delta> {
        self.deltas.get(id)
    }

    /// The kinds of mutation that broadcast this delta, by bit.
    pub fn delta_kinds(&self, id: DeltaId) -> u32 {
        self.kinds[id as usize]
    }

    /// The kinds of all deltas, by bit.
    pub fn all_kinds(&self) -> u32 {
        self.kinds.iter().fold(0, |all, kinds| all | kinds)
    }

    /// How many different states and deltas were met.
    pub fn sizes(&self) -> (usize, usize) {
        (self.states.values.len(), self.deltas.values.len())
    }

    /// The state after a delivery.
    pub fn join(&mut self, semantics: &S, state: StateId, delta: DeltaId) -> StateId {
        if let Some(&joined) = self.joins.get(&(state, delta)) {
            return joined;
        }
        let joined = semantics.join(&self.state(state), &self.delta(delta));
        let joined = self.intern(joined);
        self.joins.insert((state, delta), joined);
        joined
    }

    /// What replica `replica` can do in a state. Each step is judged when it is first computed.
    pub fn moves(
        &mut self,
        semantics: &S,
        state: StateId,
        replica: usize,
    ) -> Result<Arc<[Move]>, StepFault<S>> {
        if let Some(moves) = self.known_moves(state, replica) {
            return Ok(moves);
        }
        let before = self.state(state);
        let mut moves = Vec::new();
        for (mutation, step) in semantics.steps(&before, replica) {
            if let Err(breach) = semantics.judge_step(&before, replica, &mutation, &step) {
                return Err(StepFault { breach, before: state, replica, mutation, step });
            }
            let kind = semantics.kind(&mutation);
            let delta = self.intern_delta(step.delta, 1 << kind);
            let after = match semantics.delivery() {
                Delivery::Any => NONE,
                Delivery::Once => self.intern(step.after),
            };
            moves.push(Move { delta, kind, after });
        }
        let moves: Arc<[Move]> = moves.into();
        self.moves.insert((state, replica), moves.clone());
        Ok(moves)
    }

    /// What replica `replica` can do in a state, if that was asked before.
    pub fn known_moves(&self, state: StateId, replica: usize) -> Option<Arc<[Move]>> {
        self.moves.get(&(state, replica)).cloned()
    }

    /// The author's state after a mutation that broadcast a delta in a state.
    pub fn author_state(&mut self, semantics: &S, before: StateId, author: usize, delta: DeltaId) -> StateId {
        if semantics.delivery() == Delivery::Once {
            let (state, sent) = (self.state(before), self.delta(delta));
            let step = semantics.steps(&state, author).into_iter().find(|(_, step)| step.delta == *sent);
            if let Some((_, step)) = step {
                return self.intern(step.after);
            }
        }
        self.join(semantics, before, delta)
    }

    /// Whether what replicas may do in a state depends on their order.
    pub fn is_order_sensitive(&mut self, semantics: &S, state: StateId) -> bool {
        if let Some(&sensitive) = self.sensitive.get(&state) {
            return sensitive;
        }
        let sensitive = semantics.is_order_sensitive(&self.state(state));
        self.sensitive.insert(state, sensitive);
        sensitive
    }

    /// A state with its replicas renamed by the permutation `to`, whose number is `permutation`.
    pub fn rename_state(
        &mut self,
        semantics: &S,
        state: StateId,
        permutation: usize,
        to: &[usize],
    ) -> StateId {
        if permutation == 0 || state == NONE {
            return state;
        }
        if let Some(renamed) = self.renamed_states.get(state, permutation) {
            return renamed;
        }
        let renamed = self.intern(semantics.rename_state(&self.state(state), to));
        self.renamed_states.insert(state, permutation, renamed);
        renamed
    }

    /// A delta with its replicas renamed.
    pub fn rename_delta(
        &mut self,
        semantics: &S,
        delta: DeltaId,
        permutation: usize,
        to: &[usize],
    ) -> DeltaId {
        if permutation == 0 || delta == NONE {
            return delta;
        }
        if let Some(renamed) = self.renamed_deltas.get(delta, permutation) {
            return renamed;
        }
        let kinds = self.delta_kinds(delta);
        let renamed = self.intern_delta(semantics.rename_delta(&self.delta(delta), to), kinds);
        self.renamed_deltas.insert(delta, permutation, renamed);
        renamed
    }

    /// A delta with another stamp.
    pub fn restamp(&mut self, semantics: &S, delta: DeltaId, stamp: u64) -> DeltaId {
        if let Some(&restamped) = self.restamped.get(&(delta, stamp)) {
            return restamped;
        }
        let restamped = semantics.restamped(&self.delta(delta), stamp);
        let restamped = self.intern_delta(restamped, self.delta_kinds(delta));
        self.restamped.insert((delta, stamp), restamped);
        restamped
    }

    /// Records what replica `replica` can do in a state.
    pub fn set_moves(&mut self, state: StateId, replica: usize, moves: Arc<[Move]>) {
        self.moves.insert((state, replica), moves);
    }

    /// Judges a state and collects what it bears witness of.
    pub fn judge(&mut self, semantics: &S, state: &S::State) -> Result<Judged, Breach> {
        self.judged += 1;
        let judged = semantics.judge(state)?;
        self.witnesses.insert(judged.witnesses);
        Ok(judged)
    }
}

/// What numbers become by each permutation, as far as it was asked.
#[derive(Debug, Default)]
struct Renamed(Vec<Vec<u32>>);

impl Renamed {
    fn get(&self, id: u32, permutation: usize) -> Option<u32> {
        self.0.get(permutation)?.get(id as usize).copied().filter(|&renamed| renamed != NONE)
    }

    fn insert(&mut self, id: u32, permutation: usize, renamed: u32) {
        if self.0.len() <= permutation {
            self.0.resize_with(permutation + 1, Vec::new);
        }
        let row = &mut self.0[permutation];
        if row.len() <= id as usize {
            row.resize(id as usize + 1, NONE);
        }
        row[id as usize] = renamed;
    }
}

/// A local step that breaks a clause.
#[derive(Debug)]
pub struct StepFault<S: Semantics> {
    /// The clause.
    pub breach: Breach,
    /// The state before it.
    pub before: StateId,
    /// Who.
    pub replica: usize,
    /// The mutation.
    pub mutation: S::Mutation,
    /// What it did.
    pub step: Step<S>,
}
