//! Interned states with the answers on them, and memoised joins and moves: the production core runs inside
//! the search, each different thing once.

use super::Scenario;
use super::explore::Replicated;
use super::predicate::Answers;
use super::script::{Conduct, Otherwise, REPEAT_MAX, ScriptStep};
use crate::checked::{Act, Checked};
use crate::semantics::{Breach, Semantics, Step};
use dsr_core::{Delta, ReplicaId, State, view};
use rustc_hash::{FxHashMap, FxHasher};
use std::collections::BTreeSet;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

/// A state's number.
pub(super) type StateId = u32;
/// A delta's number.
pub(super) type DeltaId = u32;

/// One thing that a replica can do next.
#[derive(Clone, Debug)]
pub(super) struct Move {
    pub(super) kind: MoveKind,
    /// The mutations, as made.
    pub(super) acts: Arc<[Act]>,
    pub(super) delta: Option<DeltaId>,
    /// The replica's state after it.
    pub(super) after: StateId,
    pub(super) next: Next,
}

/// What a move is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum MoveKind {
    Mutates,
    /// A guard that was waited for holds.
    Passes,
    Skips,
    Stops,
}

/// What a replica does after a move.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) enum Next {
    At(Position),
    Done,
    Stopped,
}

/// The mutations of one step, as made, and their delta.
type Group = (Arc<[Act]>, Delta);

/// How far a replica is: step and repetition of a script, or mutations made of a budget.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) struct Position {
    pub(super) step: u16,
    pub(super) made: u16,
}

const _: () = assert!(REPEAT_MAX < u16::MAX as u64);

/// A state that equals another if their dots, stamps and contexts do and their records too: hashing the dots
/// alone is enough to tell most apart, and cheap.
fn fingerprint(state: &State) -> u64 {
    let mut hasher = FxHasher::default();
    let mut scene = 0_u64;
    for (dot, record) in state.records() {
        if dot.replica == ReplicaId::SCENE {
            scene = scene.wrapping_add(dot.sequence.wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(17) | 1);
        } else {
            (dot, record.stamp()).hash(&mut hasher);
        }
    }
    scene.hash(&mut hasher);
    for run in state.context().runs().filter(|run| run.replica != ReplicaId::SCENE) {
        (run.replica, run.first, run.last).hash(&mut hasher);
    }
    hasher.finish()
}

/// Everything that one exploration has computed of the semantics.
#[derive(Debug)]
pub(super) struct Memo<S> {
    pub(super) scenario: Arc<Scenario>,
    pub(super) semantics: Arc<S>,
    alphabets: Vec<Option<Checked>>,
    states: Vec<Arc<State>>,
    answers: Vec<Answers>,
    by_fingerprint: FxHashMap<u64, Vec<StateId>>,
    deltas: Vec<Arc<Delta>>,
    delta_ids: FxHashMap<Arc<Delta>, DeltaId>,
    joins: FxHashMap<(StateId, DeltaId), StateId>,
    moves: FxHashMap<(StateId, usize, Position), Arc<[Move]>>,
    /// Per property that is not of ends: whether a state decides it.
    pub(super) decided: Vec<bool>,
    /// Kinds of repair seen.
    pub(super) repairs: BTreeSet<&'static str>,
    /// Per replica and step: whether it was ever taken.
    pub(super) taken: Vec<Vec<bool>>,
    /// The first state that breaks a clause.
    pub(super) fault: Option<(Breach, StateId)>,
}

/// Numbers never reach 2³²: each state takes kilobytes.
fn number(len: usize) -> u32 {
    u32::try_from(len).unwrap_or(u32::MAX)
}

impl<S: Replicated> Memo<S> {
    pub(super) fn new(scenario: Arc<Scenario>, semantics: S) -> Self {
        let steps = |conduct: &Conduct| match conduct {
            Conduct::Script(steps) => steps.len(),
            Conduct::Free { .. } => 1,
        };
        Self {
            alphabets: scenario.replicas.iter().map(|replica| scenario.alphabet(replica)).collect(),
            taken: scenario.replicas.iter().map(|replica| vec![false; steps(&replica.conduct)]).collect(),
            decided: vec![false; scenario.properties.len()],
            scenario,
            semantics: Arc::new(semantics),
            states: Vec::new(),
            answers: Vec::new(),
            by_fingerprint: FxHashMap::default(),
            deltas: Vec::new(),
            delta_ids: FxHashMap::default(),
            joins: FxHashMap::default(),
            moves: FxHashMap::default(),
            repairs: BTreeSet::new(),
            fault: None,
        }
    }

    pub(super) fn states(&self) -> usize {
        self.states.len()
    }

    pub(super) fn joins(&self) -> usize {
        self.joins.len()
    }

    pub(super) fn state(&self, id: StateId) -> Arc<State> {
        self.states[id as usize].clone()
    }

    pub(super) fn delta(&self, id: DeltaId) -> Arc<Delta> {
        self.deltas[id as usize].clone()
    }

    pub(super) fn answers(&self, id: StateId) -> Answers {
        self.answers[id as usize]
    }

    /// The number of a state; a new one is judged and asked everything. `[spec: SCEN-11]`
    pub(super) fn intern(&mut self, state: State) -> StateId {
        let key = fingerprint(&state);
        if let Some(ids) = self.by_fingerprint.get(&key)
            && let Some(id) = ids.iter().find(|id| *self.states[**id as usize] == state)
        {
            return *id;
        }
        let id = number(self.states.len());
        if let Err(breach) = self.semantics.judge(&state) {
            self.fault.get_or_insert((breach, id));
        }
        let view = view(&state, &self.scenario.dictionary);
        let answers = self.scenario.atoms.answers(&view);
        self.repairs.extend(view.repairs().iter().map(dsr_core::Repair::kind));
        for (property, decided) in self.scenario.properties.iter().zip(&mut self.decided) {
            if !property.kind.is_of_ends() && property.is_decided_by(property.predicate.holds(answers, 0)) {
                *decided = true;
            }
        }
        self.by_fingerprint.entry(key).or_default().push(id);
        self.states.push(Arc::new(state));
        self.answers.push(answers);
        id
    }

    fn intern_delta(&mut self, delta: Delta) -> DeltaId {
        if let Some(&id) = self.delta_ids.get(&delta) {
            return id;
        }
        let (id, delta) = (number(self.deltas.len()), Arc::new(delta));
        self.deltas.push(delta.clone());
        self.delta_ids.insert(delta, id);
        id
    }

    /// The state after a delivery.
    pub(super) fn join(&mut self, state: StateId, delta: DeltaId) -> StateId {
        if let Some(&joined) = self.joins.get(&(state, delta)) {
            return joined;
        }
        let before = self.state(state);
        let after = self.semantics.join(&before, &self.delta(delta));
        if after == *before {
            self.joins.insert((state, delta), state);
            return state;
        }
        let delivery = self.semantics.judge_delivery(&before, &after);
        let joined = self.intern(after);
        if let Err(breach) = delivery {
            self.fault.get_or_insert((breach, joined));
        }
        self.joins.insert((state, delta), joined);
        joined
    }

    /// What a replica can do next in a state: nothing if it waits. `[spec: SCEN-4]` `[spec: SCEN-6]`
    pub(super) fn moves(
        &mut self,
        state: StateId,
        replica: usize,
        at: Position,
    ) -> Result<Arc<[Move]>, Breach> {
        if let Some(moves) = self.moves.get(&(state, replica, at)) {
            return Ok(moves.clone());
        }
        let scenario = self.scenario.clone();
        let moves = match &scenario.replicas[replica].conduct {
            Conduct::Script(steps) => self.script_move(state, replica, at, steps)?.into_iter().collect(),
            Conduct::Free { budget, .. } => self.free_moves(state, replica, at, *budget)?,
        };
        for known in &moves {
            if matches!(known.kind, MoveKind::Mutates | MoveKind::Passes) {
                self.taken[replica][at.step as usize] = true;
            }
        }
        let moves: Arc<[Move]> = moves.into();
        self.moves.insert((state, replica, at), moves.clone());
        Ok(moves)
    }

    fn script_move(
        &mut self,
        state: StateId,
        replica: usize,
        at: Position,
        steps: &[ScriptStep],
    ) -> Result<Option<Move>, Breach> {
        let step = &steps[at.step as usize];
        let is_last = at.step as usize + 1 == steps.len();
        let onward = if is_last { Next::Done } else { Next::At(Position { step: at.step + 1, made: 0 }) };
        let quiet = |kind, next| Move { kind, acts: Arc::new([]), delta: None, after: state, next };
        let instead = |otherwise| match otherwise {
            Otherwise::Wait => None,
            Otherwise::Skip => Some(quiet(MoveKind::Skips, onward)),
            Otherwise::Stop => Some(quiet(MoveKind::Stops, Next::Stopped)),
        };
        let allowed = step.when.as_ref().is_none_or(|guard| guard.holds(self.answers(state), 0));
        if !allowed {
            return Ok(instead(step.otherwise));
        }
        let again = u32::from(at.made) + 1 < step.repeat;
        let next = if again { Next::At(Position { made: at.made + 1, ..at }) } else { onward };
        if step.mutations.is_empty() {
            return Ok(Some(quiet(MoveKind::Passes, next)));
        }
        match self.group(state, replica, step)? {
            Some((acts, delta)) => Ok(Some(self.mutates(state, acts, delta, next))),
            None => Ok(instead(step.refused)),
        }
    }

    fn mutates(&mut self, state: StateId, acts: Arc<[Act]>, delta: Delta, next: Next) -> Move {
        let delta = self.intern_delta(delta);
        Move { kind: MoveKind::Mutates, acts, delta: Some(delta), after: self.join(state, delta), next }
    }

    /// The mutations of a step one after the other, as one delta; `None` if one is refused. `[spec: SCEN-5]`
    fn group(&mut self, state: StateId, replica: usize, step: &ScriptStep) -> Result<Option<Group>, Breach> {
        let start = self.state(state);
        let (mut now, mut whole, mut acts) = ((*start).clone(), Delta::new(), Vec::new());
        for named in &step.mutations {
            let Ok(mutation) = named.resolve(&view(&now, &self.scenario.dictionary)) else { return Ok(None) };
            let act = Act(mutation);
            let Some(Step { delta, after }) = self.judged_step(&now, replica, &act)? else { return Ok(None) };
            whole.join(&delta);
            now = after;
            acts.push(act);
        }
        if step.mutations.len() > 1 && self.semantics.join(&start, &whole) != now {
            return Err(Breach::new("MUT-0.4", "a group of mutations is not the join of its deltas"));
        }
        Ok(Some((acts.into(), whole)))
    }

    fn judged_step(&self, state: &State, replica: usize, act: &Act) -> Result<Option<Step<S>>, Breach> {
        let Some(step) = self.semantics.mutate(state, replica, act) else { return Ok(None) };
        self.semantics.judge_step(state, replica, act, &step)?;
        Ok(Some(step))
    }

    fn free_moves(
        &mut self,
        id: StateId,
        replica: usize,
        at: Position,
        budget: u32,
    ) -> Result<Vec<Move>, Breach> {
        let state = self.state(id);
        let mutations = match &self.alphabets[replica] {
            Some(alphabet) => alphabet.mutations(&state, replica),
            None => Vec::new(),
        };
        let exhausted = u32::from(at.made) + 1 == budget;
        let next = if exhausted { Next::Done } else { Next::At(Position { made: at.made + 1, ..at }) };
        let mut moves = Vec::new();
        for act in mutations {
            if let Some(Step { delta, .. }) = self.judged_step(&state, replica, &act)? {
                moves.push(self.mutates(id, Arc::new([act]), delta, next));
            }
        }
        Ok(moves)
    }
}
