//! A semantics with a few concrete mutations only.

use crate::graph::Graph;
use crate::semantics::{Breach, Clause, Competition, Delivery, Judged, Semantics, Step};
use crate::why::{Claim, Standing, Target};
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

    fn join_deltas(&self, left: &S::Delta, right: &S::Delta) -> Option<S::Delta> {
        self.whole.join_deltas(left, right)
    }

    fn readdressed(&self, mutation: &S::Mutation, made: &[(S::Delta, S::Delta)]) -> Option<S::Mutation> {
        self.whole.readdressed(mutation, made)
    }

    fn simpler(&self, mutation: &S::Mutation) -> Vec<S::Mutation> {
        self.whole.simpler(mutation)
    }

    fn simpler_together(&self, mutations: &[S::Mutation]) -> Vec<Vec<S::Mutation>> {
        self.whole.simpler_together(mutations)
    }

    fn simpler_initial(&self) -> Vec<Self> {
        let wholes = self.whole.simpler_initial().into_iter();
        wholes.map(|whole| Self { whole: Arc::new(whole), mutations: self.mutations.clone() }).collect()
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

    fn shows(&self, state: &S::State) -> Graph {
        self.whole.shows(state)
    }

    fn mutation_text(&self, state: &S::State, mutation: &S::Mutation) -> String {
        self.whole.mutation_text(state, mutation)
    }

    fn delta_text(&self, delta: &S::Delta) -> String {
        self.whole.delta_text(delta)
    }

    fn claims(&self, delta: &S::Delta, target: &Target) -> Vec<Claim> {
        self.whole.claims(delta, target)
    }

    fn claims_held(&self, state: &S::State, target: &Target) -> Vec<Claim> {
        self.whole.claims_held(state, target)
    }

    fn ends(&self, delta: &S::Delta, target: &Target, claim: &Claim) -> bool {
        self.whole.ends(delta, target, claim)
    }

    fn standing(&self, state: &S::State, target: &Target, claim: &Claim) -> Standing {
        self.whole.standing(state, target, claim)
    }

    fn setup_json(&self) -> serde_json::Value {
        self.whole.setup_json()
    }

    fn state_from_json(&self, json: &serde_json::Value) -> Option<S::State> {
        self.whole.state_from_json(json)
    }

    fn mutation_from_json(
        &self,
        state: &S::State,
        replica: usize,
        json: &serde_json::Value,
    ) -> Option<S::Mutation> {
        self.whole.mutation_from_json(state, replica, json)
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
