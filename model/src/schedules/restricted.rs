//! A semantics with a few concrete mutations only.

use crate::semantics::{Breach, Clause, Competition, Delivery, Judged, Semantics, Step};
use std::sync::Arc;

/// Another semantics in which replicas try only the given mutations.
#[derive(Clone, Debug)]
pub struct Restricted<S: Semantics> {
    /// The other.
    pub whole: Arc<S>,
    /// What replicas may try, each of them in every state.
    pub mutations: Vec<S::Mutation>,
}

impl<S: Semantics> Semantics for Restricted<S> {
    type State = S::State;
    type Delta = S::Delta;
    type Mutation = S::Mutation;

    fn stamp(&self, delta: &S::Delta) -> Option<u64> {
        self.whole.stamp(delta)
    }

    fn restamped(&self, delta: &S::Delta, stamp: u64) -> S::Delta {
        self.whole.restamped(delta, stamp)
    }

    fn next_stamp(&self, state: &S::State) -> u64 {
        self.whole.next_stamp(state)
    }

    fn compete(&self, left: &S::Delta, right: &S::Delta) -> Competition {
        self.whole.compete(left, right)
    }

    fn appearance(&self, state: &S::State) -> u64 {
        self.whole.appearance(state)
    }

    fn name(&self) -> String {
        self.whole.name()
    }

    fn initial(&self) -> S::State {
        self.whole.initial()
    }

    fn mutations(&self, _state: &S::State, _replica: usize) -> Vec<S::Mutation> {
        self.mutations.clone()
    }

    fn mutate(&self, state: &S::State, replica: usize, mutation: &S::Mutation) -> Option<Step<Self>> {
        let Step { delta, after } = self.whole.mutate(state, replica, mutation)?;
        Some(Step { delta, after })
    }

    fn join(&self, state: &S::State, delta: &S::Delta) -> S::State {
        self.whole.join(state, delta)
    }

    fn join_all(&self, state: &S::State, deltas: &[&S::Delta]) -> S::State {
        self.whole.join_all(state, deltas)
    }

    fn repair(&self, ours: &S::State, theirs: &S::State) -> Option<S::Delta> {
        self.whole.repair(ours, theirs)
    }

    fn join_states(&self, left: &S::State, right: &S::State) -> Option<S::State> {
        self.whole.join_states(left, right)
    }

    fn delivery(&self) -> Delivery {
        self.whole.delivery()
    }

    fn differ(&self, left: &S::State, right: &S::State) -> Option<String> {
        self.whole.differ(left, right)
    }

    fn judges(&self, clause: &str) -> bool {
        self.whole.judges(clause)
    }

    fn judge(&self, state: &S::State) -> Result<Judged, Breach> {
        self.whole.judge(state)
    }

    fn judge_step(
        &self,
        before: &S::State,
        replica: usize,
        mutation: &S::Mutation,
        step: &Step<Self>,
    ) -> Result<(), Breach> {
        let step = Step { delta: step.delta.clone(), after: step.after.clone() };
        self.whole.judge_step(before, replica, mutation, &step)
    }

    fn judge_delivery(&self, before: &S::State, after: &S::State) -> Result<(), Breach> {
        self.whole.judge_delivery(before, after)
    }

    fn kind(&self, mutation: &S::Mutation) -> usize {
        self.whole.kind(mutation)
    }

    fn kinds(&self) -> Vec<&'static str> {
        self.whole.kinds()
    }

    fn kinds_in_use(&self) -> Vec<usize> {
        let mut kinds: Vec<usize> = self.mutations.iter().map(|mutation| self.whole.kind(mutation)).collect();
        kinds.sort_unstable();
        kinds.dedup();
        kinds
    }

    fn witnesses(&self) -> Vec<&'static str> {
        self.whole.witnesses()
    }

    fn has_symmetry(&self) -> bool {
        self.whole.has_symmetry()
    }

    fn is_order_sensitive(&self, state: &S::State) -> bool {
        self.whole.is_order_sensitive(state)
    }

    fn rename_state(&self, state: &S::State, to: &[usize]) -> S::State {
        self.whole.rename_state(state, to)
    }

    fn rename_delta(&self, delta: &S::Delta, to: &[usize]) -> S::Delta {
        self.whole.rename_delta(delta, to)
    }

    fn changes(&self, before: &S::State, after: &S::State) -> Vec<String> {
        self.whole.changes(before, after)
    }

    fn mutation_json(&self, mutation: &S::Mutation) -> serde_json::Value {
        self.whole.mutation_json(mutation)
    }

    fn state_json(&self, state: &S::State) -> serde_json::Value {
        self.whole.state_json(state)
    }

    fn delta_json(&self, delta: &S::Delta) -> serde_json::Value {
        self.whole.delta_json(delta)
    }

    fn clauses(&self) -> Vec<Clause> {
        self.whole.clauses()
    }
}
