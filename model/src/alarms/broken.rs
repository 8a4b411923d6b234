//! A semantics broken in one place: `dsr-core` with one [`Flaw`].

use super::shown::Shown;
use crate::algebra::{Algebra, Family, core_universe};
use crate::checked::{Act, Checked, judge_shown, replica_id};
use crate::graph::Graph;
use crate::semantics::{Breach, Clause, Competition, Judged, Semantics, Step};
use crate::why::{Claim, Standing, Target};
use dsr_core::{Author, Delta, Mutation, State, View, delta_for, digest, view};
use std::fmt::Debug;
use std::sync::Arc;

/// One thing done wrongly. Every method does it rightly unless a flaw overrides it.
pub trait Flaw: Send + Sync + Debug {
    /// What join is before closure.
    fn merge(&self, left: &State, right: &State) -> State {
        let mut merged = left.clone();
        merged.merge(right);
        merged
    }

    /// What dies with its anchor.
    fn close(&self, mut state: State) -> State {
        state.close();
        state
    }

    /// What a mutation broadcasts, or `None` when it is refused.
    fn delta(&self, before: &View<'_>, author: Author, mutation: &Mutation) -> Option<Delta> {
        mutation.delta(before, author).ok()
    }

    /// What the author itself makes of a mutation whose delta is `delta`.
    fn after(&self, before: &View<'_>, author: Author, mutation: &Mutation, delta: &Delta) -> State {
        let _ = (author, mutation);
        self.close(self.merge(before.state(), delta))
    }

    /// Under which index of the checker a replica mutates: the next incarnations of replica r are
    /// r + [`INCARNATION`](crate::checked::INCARNATION), and so on.
    fn identity(&self, replica: usize) -> usize {
        replica
    }

    /// What `theirs` gets when it resynchronises with `ours`.
    fn repair(&self, ours: &State, theirs: &State) -> Delta {
        delta_for(ours, &digest(theirs))
    }

    /// When the checker takes two deltas to compete.
    fn competition(&self, competition: Competition) -> Competition {
        competition
    }

    /// What the checker takes a sound state to be.
    fn judged(&self, judged: Judged) -> Judged {
        judged
    }

    /// What replica `here` shows.
    fn show<'s>(&self, view: &View<'s>, here: usize) -> Shown<'s> {
        let _ = here;
        Shown::of(view)
    }
}

/// The core as it ships: no flaw. No layer may raise an alarm.
#[derive(Debug)]
pub struct Sound;

impl Flaw for Sound {}

/// `dsr-core` with one flaw.
#[derive(Clone, Debug)]
pub struct Broken {
    name: &'static str,
    core: Checked,
    flaw: Arc<dyn Flaw>,
}

/// The replicas whose views of one state are compared.
const WATCHERS: [usize; 2] = [0, 1];

impl Broken {
    /// The core `core` with a flaw.
    pub fn new(name: &'static str, core: Checked, flaw: Arc<dyn Flaw>) -> Self {
        Self { name, core, flaw }
    }

    fn joined(&self, left: &State, right: &State) -> State {
        self.flaw.close(self.flaw.merge(left, right))
    }
}

impl Semantics for Broken {
    type State = State;
    type Delta = Delta;
    type Mutation = Act;

    fn name(&self) -> String {
        self.name.into()
    }

    fn initial(&self) -> State {
        self.core.initial()
    }

    fn mutations(&self, state: &State, replica: usize) -> Vec<Act> {
        self.core.mutations(state, self.flaw.identity(replica))
    }

    fn allows(&self, state: &State, replica: usize, mutation: &Act) -> bool {
        self.core.allows(state, self.flaw.identity(replica), mutation)
    }

    fn mutate(&self, state: &State, replica: usize, mutation: &Act) -> Option<Step<Self>> {
        let author = Author::new(replica_id(self.flaw.identity(replica)));
        let before = view(state, &self.core.dictionary);
        let delta = self.flaw.delta(&before, author, &mutation.0)?;
        let after = self.flaw.after(&before, author, &mutation.0, &delta);
        Some(Step { delta, after })
    }

    fn join(&self, state: &State, delta: &Delta) -> State {
        self.joined(state, delta)
    }

    fn repair(&self, ours: &State, theirs: &State) -> Option<Delta> {
        Some(self.flaw.repair(ours, theirs))
    }

    fn join_states(&self, left: &State, right: &State) -> Option<State> {
        Some(self.joined(left, right))
    }

    fn join_deltas(&self, left: &Delta, right: &Delta) -> Option<Delta> {
        Some(self.joined(left, right))
    }

    fn readdressed(&self, mutation: &Act, made: &[(Delta, Delta)]) -> Option<Act> {
        self.core.readdressed(mutation, made)
    }

    fn simpler(&self, mutation: &Act) -> Vec<Act> {
        self.core.simpler(mutation)
    }

    fn simpler_together(&self, mutations: &[Act]) -> Vec<Vec<Act>> {
        self.core.simpler_together(mutations)
    }

    fn simpler_initial(&self) -> Vec<Self> {
        let cores = self.core.simpler_initial().into_iter();
        cores.map(|core| Self { core, ..self.clone() }).collect()
    }

    /// The predicates of the core on the state, and on what is shown of it, by each of two replicas; equal
    /// states must have equal views on both. `[property: VIEW-1]`
    fn judge(&self, state: &State) -> Result<Judged, Breach> {
        let judged = self.core.judge(state)?;
        let core_view = view(state, &self.core.dictionary);
        let shown = WATCHERS.map(|here| self.flaw.show(&core_view, here));
        if shown[0] != shown[1] {
            return Err(Breach::new("VIEW-1", "two replicas show one state differently"));
        }
        judge_shown(&shown[0])?;
        Ok(self.flaw.judged(judged))
    }

    fn stamp(&self, delta: &Delta) -> Option<u64> {
        self.core.stamp(delta)
    }

    fn restamped(&self, delta: &Delta, stamp: u64) -> Delta {
        self.core.restamped(delta, stamp)
    }

    fn next_stamp(&self, state: &State) -> u64 {
        self.core.next_stamp(state)
    }

    fn compete(&self, left: &Delta, right: &Delta) -> Competition {
        self.flaw.competition(self.core.compete(left, right))
    }

    fn appearance(&self, state: &State) -> u64 {
        self.core.appearance(state)
    }

    fn judge_step(
        &self,
        before: &State,
        replica: usize,
        mutation: &Act,
        step: &Step<Self>,
    ) -> Result<(), Breach> {
        if self.joined(before, &step.delta) != step.after {
            return Err(Breach::new(
                "MUT-0",
                "the author's state is not its old state joined with the delta",
            ));
        }
        if self.joined(before, &step.after) != step.after {
            return Err(Breach::new("JOIN-4", "the author's new state does not include its old one"));
        }
        if before.joined(&step.delta) != step.after {
            // The join itself is broken: the core's judgement of the step would compare with the right one.
            return Ok(());
        }
        let same = Step { delta: step.delta.clone(), after: step.after.clone() };
        self.core.judge_step(before, replica, mutation, &same)
    }

    fn judge_delivery(&self, before: &State, after: &State) -> Result<(), Breach> {
        self.core.judge_delivery(before, after)
    }

    fn kind(&self, mutation: &Act) -> usize {
        self.core.kind(mutation)
    }

    fn kinds(&self) -> Vec<&'static str> {
        self.core.kinds()
    }

    fn kinds_in_use(&self) -> Vec<usize> {
        self.core.kinds_in_use()
    }

    fn witnesses(&self) -> Vec<&'static str> {
        self.core.witnesses()
    }

    fn clauses(&self) -> Vec<Clause> {
        self.core.clauses()
    }

    fn rename_state(&self, state: &State, to: &[usize]) -> State {
        self.core.rename_state(state, to)
    }

    fn rename_delta(&self, delta: &Delta, to: &[usize]) -> Delta {
        self.core.rename_delta(delta, to)
    }

    fn shows(&self, state: &State) -> Graph {
        self.core.shows(state)
    }

    fn mutation_text(&self, state: &State, mutation: &Act) -> String {
        self.core.mutation_text(state, mutation)
    }

    fn delta_text(&self, delta: &Delta) -> String {
        self.core.delta_text(delta)
    }

    fn claims(&self, delta: &Delta, target: &Target) -> Vec<Claim> {
        self.core.claims(delta, target)
    }

    fn claims_held(&self, state: &State, target: &Target) -> Vec<Claim> {
        self.core.claims_held(state, target)
    }

    fn ends(&self, delta: &Delta, target: &Target, claim: &Claim) -> bool {
        self.core.ends(delta, target, claim)
    }

    fn standing(&self, state: &State, target: &Target, claim: &Claim) -> Standing {
        self.core.standing(state, target, claim)
    }

    fn setup_json(&self) -> serde_json::Value {
        self.core.setup_json()
    }

    fn state_from_json(&self, json: &serde_json::Value) -> Option<State> {
        self.core.state_from_json(json)
    }

    fn mutation_from_json(&self, state: &State, replica: usize, json: &serde_json::Value) -> Option<Act> {
        self.core.mutation_from_json(state, replica, json)
    }

    fn mutation_json(&self, mutation: &Act) -> serde_json::Value {
        self.core.mutation_json(mutation)
    }

    fn state_json(&self, state: &State) -> serde_json::Value {
        self.core.state_json(state)
    }

    fn delta_json(&self, delta: &Delta) -> serde_json::Value {
        self.core.delta_json(delta)
    }
}

impl Algebra for Broken {
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
        Some(self.flaw.merge(left, right))
    }

    fn close(&self, state: &State) -> Option<State> {
        Some(self.flaw.close(state.clone()))
    }
}
