//! The checked semantics, beside the program. `[spec: ORACLE-4]`

use crate::desk::{Desk, Stop, Thing};
use dsr_core::{Author, Delta, State};
use dsr_model::checked::{Act, Checked, replica_id};
use dsr_model::graph::Graph;
use dsr_model::semantics::{Breach, Clause, Competition, Judged, Semantics, Step};
use dsr_model::why::{Claim, Standing, Target};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// The clause that a disagreement breaks.
const DISAGREES: &str = "ORACLE-5";
/// The clause of a program that cannot be asked.
const TROUBLE: &str = "ORACLE-6";

/// `dsr-core` as the checker has it; whatever is computed is put on a desk, to be asked of the program.
#[derive(Clone, Debug)]
pub struct Beside {
    checked: Checked,
    desk: Arc<Desk>,
    replicas: usize,
    /// Of states that come of a join on which the program disagrees, what is wrong: a join has nobody to tell it.
    wrong: Arc<Mutex<BTreeMap<State, Breach>>>,
}

impl Beside {
    /// The semantics beside a desk, of so many replicas.
    pub fn new(checked: Checked, desk: Arc<Desk>, replicas: usize) -> Self {
        Self { checked, desk, replicas, wrong: Arc::default() }
    }

    fn put(&self, thing: Thing) -> Result<(), Breach> {
        self.desk.put(thing).map_err(|stop| match stop {
            Stop::Disagreement(found) => {
                Breach::new(DISAGREES, format!("the program says otherwise\n{found}"))
            }
            Stop::Trouble(trouble) => Breach::new(TROUBLE, trouble),
        })
    }

    fn put_join(&self, state: &State, deltas: &[&Delta], joined: &State) {
        if deltas.is_empty() {
            return;
        }
        let deltas = deltas.iter().map(|&delta| delta.clone()).collect();
        if let Err(breach) = self.put(Thing::Join(state.clone(), deltas)) {
            self.wrong.lock().unwrap_or_else(PoisonError::into_inner).insert(joined.clone(), breach);
        }
    }

    fn is_joined_right(&self, state: &State) -> Result<(), Breach> {
        let wrong = self.wrong.lock().unwrap_or_else(PoisonError::into_inner);
        wrong.get(state).map_or(Ok(()), |breach| Err(breach.clone()))
    }

    fn put_mutations(&self, state: &State, replica: usize, mutations: &[Act]) -> Result<(), Breach> {
        if mutations.is_empty() {
            return Ok(());
        }
        let mutations = mutations.iter().map(|act| act.0.clone()).collect();
        self.put(Thing::Mutations(state.clone(), Author::new(replica_id(replica)), mutations))
    }
}

/// The same step of this semantics.
fn own(Step { delta, after }: Step<Checked>) -> Step<Beside> {
    Step { delta, after }
}

/// All is as in [`Checked`], but what it computes is put down.
impl Semantics for Beside {
    type State = State;
    type Delta = Delta;
    type Mutation = Act;

    fn name(&self) -> String {
        "checked, beside the program".into()
    }

    fn initial(&self) -> State {
        self.checked.initial()
    }

    fn mutations(&self, state: &State, replica: usize) -> Vec<Act> {
        self.checked.mutations(state, replica)
    }

    fn allows(&self, state: &State, replica: usize, mutation: &Act) -> bool {
        self.checked.allows(state, replica, mutation)
    }

    fn mutate(&self, state: &State, replica: usize, mutation: &Act) -> Option<Step<Self>> {
        self.checked.mutate(state, replica, mutation).map(own)
    }

    /// All that the alphabet has is asked, what is refused as well.
    fn steps(&self, state: &State, replica: usize) -> Vec<(Act, Step<Self>)> {
        // Whoever judges the state tells what is wrong.
        let _ = self.put_mutations(state, replica, &self.checked.mutations(state, replica));
        let steps = self.checked.steps(state, replica).into_iter();
        steps.map(|(act, step)| (act, own(step))).collect()
    }

    fn join(&self, state: &State, delta: &Delta) -> State {
        let joined = self.checked.join(state, delta);
        self.put_join(state, &[delta], &joined);
        joined
    }

    fn join_all(&self, state: &State, deltas: &[&Delta]) -> State {
        let joined = self.checked.join_all(state, deltas);
        self.put_join(state, deltas, &joined);
        joined
    }

    fn repair(&self, ours: &State, theirs: &State) -> Option<Delta> {
        self.checked.repair(ours, theirs)
    }

    fn join_states(&self, left: &State, right: &State) -> Option<State> {
        let joined = self.checked.join_states(left, right)?;
        self.put_join(left, &[right], &joined);
        Some(joined)
    }

    fn join_deltas(&self, left: &Delta, right: &Delta) -> Option<Delta> {
        self.checked.join_deltas(left, right)
    }

    /// `[property: ORACLE-5]`
    fn judge(&self, state: &State) -> Result<Judged, Breach> {
        let judged = self.checked.judge(state)?;
        self.is_joined_right(state)?;
        self.put(Thing::State(state.clone()))?;
        if self.desk.is_strict() {
            // What a step makes is asked with the state that it is made in, so that refusals are judged too.
            for replica in 0..self.replicas {
                self.put_mutations(state, replica, &self.checked.mutations(state, replica))?;
            }
        }
        Ok(judged)
    }

    fn judge_step(&self, before: &State, replica: usize, act: &Act, step: &Step<Self>) -> Result<(), Breach> {
        let same = Step { delta: step.delta.clone(), after: step.after.clone() };
        self.checked.judge_step(before, replica, act, &same)
    }

    fn judge_delivery(&self, before: &State, after: &State) -> Result<(), Breach> {
        self.is_joined_right(after)?;
        self.checked.judge_delivery(before, after)
    }

    fn judge_repair(&self, ours: &State, theirs: &State, delta: &Delta) -> Result<(), Breach> {
        self.is_joined_right(&theirs.joined(delta))?;
        self.put(Thing::Answer(ours.clone(), theirs.clone()))
    }

    fn readdressed(&self, mutation: &Act, made: &[(Delta, Delta)]) -> Option<Act> {
        self.checked.readdressed(mutation, made)
    }

    fn simpler(&self, mutation: &Act) -> Vec<Act> {
        self.checked.simpler(mutation)
    }

    fn simpler_together(&self, mutations: &[Act]) -> Vec<Vec<Act>> {
        self.checked.simpler_together(mutations)
    }

    fn simpler_initial(&self) -> Vec<Self> {
        let smaller = self.checked.simpler_initial().into_iter();
        smaller.map(|checked| Self { checked, ..self.clone() }).collect()
    }

    fn stamp(&self, delta: &Delta) -> Option<u64> {
        self.checked.stamp(delta)
    }

    fn restamped(&self, delta: &Delta, stamp: u64) -> Delta {
        self.checked.restamped(delta, stamp)
    }

    fn next_stamp(&self, state: &State) -> u64 {
        self.checked.next_stamp(state)
    }

    fn compete(&self, left: &Delta, right: &Delta) -> Competition {
        self.checked.compete(left, right)
    }

    fn appearance(&self, state: &State) -> u64 {
        self.checked.appearance(state)
    }

    fn kind(&self, mutation: &Act) -> usize {
        self.checked.kind(mutation)
    }

    fn kinds(&self) -> Vec<&'static str> {
        self.checked.kinds()
    }

    fn kinds_in_use(&self) -> Vec<usize> {
        self.checked.kinds_in_use()
    }

    fn witnesses(&self) -> Vec<&'static str> {
        self.checked.witnesses()
    }

    fn clauses(&self) -> Vec<Clause> {
        let own = Clause {
            id: DISAGREES,
            claim: "",
            what: "the program from the model answers what the core does",
        };
        self.checked.clauses().into_iter().chain([own]).collect()
    }

    fn has_symmetry(&self) -> bool {
        self.checked.has_symmetry()
    }

    fn is_order_sensitive(&self, state: &State) -> bool {
        self.checked.is_order_sensitive(state)
    }

    fn rename_state(&self, state: &State, to: &[usize]) -> State {
        self.checked.rename_state(state, to)
    }

    fn rename_delta(&self, delta: &Delta, to: &[usize]) -> Delta {
        self.checked.rename_delta(delta, to)
    }

    fn shows(&self, state: &State) -> Graph {
        self.checked.shows(state)
    }

    fn mutation_text(&self, state: &State, mutation: &Act) -> String {
        self.checked.mutation_text(state, mutation)
    }

    fn delta_text(&self, delta: &Delta) -> String {
        self.checked.delta_text(delta)
    }

    fn claims(&self, delta: &Delta, target: &Target) -> Vec<Claim> {
        self.checked.claims(delta, target)
    }

    fn claims_held(&self, state: &State, target: &Target) -> Vec<Claim> {
        self.checked.claims_held(state, target)
    }

    fn ends(&self, delta: &Delta, target: &Target, claim: &Claim) -> bool {
        self.checked.ends(delta, target, claim)
    }

    fn standing(&self, state: &State, target: &Target, claim: &Claim) -> Standing {
        self.checked.standing(state, target, claim)
    }

    fn setup_json(&self) -> serde_json::Value {
        self.checked.setup_json()
    }

    fn state_from_json(&self, json: &serde_json::Value) -> Option<State> {
        self.checked.state_from_json(json)
    }

    fn mutation_from_json(&self, state: &State, replica: usize, json: &serde_json::Value) -> Option<Act> {
        self.checked.mutation_from_json(state, replica, json)
    }

    fn mutation_json(&self, mutation: &Act) -> serde_json::Value {
        self.checked.mutation_json(mutation)
    }

    fn state_json(&self, state: &State) -> serde_json::Value {
        self.checked.state_json(state)
    }

    fn delta_json(&self, delta: &Delta) -> serde_json::Value {
        self.checked.delta_json(delta)
    }
}
