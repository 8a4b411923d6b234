//! The checked semantics on the fast replica, alone or with the readable reference beside it. `[spec: CHECK-15]`
//!
//! Beside the reference, a state of the search is both, and whatever happens happens to both: what is made,
//! refused, held, shown, told and answered is compared, and a difference is a breach of `REPLICA-…` or `EVENT-…`.
//! All other clauses are then judged of the reference; what cannot be told from it keeps them too.
//! Alone, the replica is judged itself.
//!
//! | what | compared |
//! |---|---|
//! | state, view, repairs, look-ups, digest, answers | in every state that is judged, and after every mutation |
//! | delta or error, changes told | of every mutation tried in every state |
//! | state and changes told | of every delivery that is carried out |
//! | a snapshot | after its replica has gone on |

mod algebra;
mod compare;
mod core;
mod fast;
mod held;
mod step;

pub use core::{Core, OnCore};
pub use fast::Fast;
pub use held::Held;

use crate::checked::{Act, Checked, check_delivery, check_step, judge_state, looks};
use crate::graph::Graph;
use crate::semantics::{Breach, Clause, Competition, Judged, Semantics, Step, WHOLE};
use crate::why::{Claim, Standing, Target};
use dsr_core::{Delta, Replica, State, View, view};
use std::sync::Arc;

/// The name in reports and traces of the fast replica alone.
pub const ALONE: &str = "replica";
/// The name of the fast replica beside the reference.
pub const BESIDE: &str = "replica beside the reference";

/// What is judged besides.
const COMPARED: [Clause; 3] = [
    Clause { id: "REPLICA-1", claim: "L3", what: "the fast replica and the reference cannot be told apart" },
    Clause { id: "REPLICA-2", claim: "L3", what: "a snapshot stays as it is while its replica goes on" },
    Clause { id: "EVENT-1", claim: "V3", what: "the changes told are the difference of the views" },
];

/// See the [module](self).
#[derive(Clone, Debug)]
pub struct Twin<F = Replica> {
    name: &'static str,
    core: Checked,
    compares: bool,
    /// A replica that has seen nothing.
    blank: F,
    initial: Held<F>,
}

impl Twin {
    /// The fast replica alone.
    pub fn alone(core: Checked) -> Self {
        Self::new(ALONE, core, false)
    }

    /// The fast replica beside the reference.
    pub fn beside(core: Checked) -> Self {
        Self::new(BESIDE, core, true)
    }
}

impl<F: Fast> Twin<F> {
    /// A replica of some kind beside the reference.
    pub fn of(name: &'static str, core: Checked) -> Self {
        Self::new(name, core, true)
    }

    fn new(name: &'static str, core: Checked, compares: bool) -> Self {
        let blank = F::start(&core.dictionary);
        let twin = Self { name, core, compares, initial: Held::alone(blank.clone()), blank };
        Self { initial: twin.replica_of(&twin.core.initial), ..twin }
    }

    /// A replica that has joined a whole state.
    fn replica_of(&self, state: &State) -> Held<F> {
        self.join(&Held::alone(self.blank.clone()), state)
    }

    /// A state that no replica comes to, such as one that is not closed.
    fn without_replica(&self, state: State) -> Held<F> {
        Held { replica: self.blank.clone(), state, fault: None, told: None }
    }

    fn view<'s>(&'s self, held: &'s Held<F>) -> View<'s> {
        view(&held.state, &self.core.dictionary)
    }
}

impl<F: Fast> Semantics for Twin<F> {
    type State = Held<F>;
    type Delta = Delta;
    type Mutation = Act;

    fn name(&self) -> String {
        self.name.into()
    }

    fn initial(&self) -> Held<F> {
        self.initial.clone()
    }

    fn mutations(&self, held: &Held<F>, replica: usize) -> Vec<Act> {
        if self.compares {
            self.core.mutations(&held.state, replica)
        } else {
            self.core.mutations_in(&held.replica.graph().shown(&held.state), replica)
        }
    }

    fn allows(&self, held: &Held<F>, replica: usize, act: &Act) -> bool {
        self.core.allows(&held.state, replica, act)
    }

    fn mutate(&self, held: &Held<F>, replica: usize, act: &Act) -> Option<Step<Self>> {
        if self.compares {
            Self::step(held, &self.view(held), replica, act)
        } else {
            Self::step_alone(held, replica, act)
        }
    }

    fn steps(&self, held: &Held<F>, replica: usize) -> Vec<(Act, Step<Self>)> {
        let before = self.compares.then(|| self.view(held));
        let acts = match &before {
            Some(before) => self.core.mutations_in(before, replica),
            None => self.mutations(held, replica),
        };
        let step = |act: Act| {
            let step = match &before {
                Some(before) => Self::step(held, before, replica, &act),
                None => Self::step_alone(held, replica, &act),
            };
            Some((act, step?))
        };
        acts.into_iter().filter_map(step).collect()
    }

    /// `[property: REPLICA-1]` `[property: EVENT-1]`
    fn join(&self, held: &Held<F>, delta: &Delta) -> Held<F> {
        let mut replica = held.replica.clone();
        let told = replica.apply(delta);
        if !self.compares {
            return Held::alone(replica);
        }
        let state = held.state.joined(delta);
        let after = Held { replica, state, fault: held.fault.clone(), told: None };
        if after.fault.is_some() {
            return after;
        }
        let (old, new) = (self.view(held), self.view(&after));
        let differs =
            compare::held(&after.replica, &after.state).and_then(|()| compare::told(&told, &old, &new));
        let fault = differs.err().map(Arc::new);
        Held { fault, ..after }
    }

    fn repair(&self, ours: &Held<F>, theirs: &Held<F>) -> Option<Delta> {
        Some(ours.replica.delta_for(&theirs.replica.graph().digest()))
    }

    fn join_states(&self, left: &Held<F>, right: &Held<F>) -> Option<Held<F>> {
        Some(self.join(left, &right.state))
    }

    fn join_deltas(&self, left: &Delta, right: &Delta) -> Option<Delta> {
        Some(left.joined(right))
    }

    fn readdressed(&self, act: &Act, made: &[(Delta, Delta)]) -> Option<Act> {
        self.core.readdressed(act, made)
    }

    fn simpler(&self, act: &Act) -> Vec<Act> {
        self.core.simpler(act)
    }

    fn simpler_together(&self, acts: &[Act]) -> Vec<Vec<Act>> {
        self.core.simpler_together(acts)
    }

    fn simpler_initial(&self) -> Vec<Self> {
        let cores = self.core.simpler_initial().into_iter();
        cores.map(|core| Self::new(self.name, core, self.compares)).collect()
    }

    fn stamp(&self, delta: &Delta) -> Option<u64> {
        self.core.stamp(delta)
    }

    fn restamped(&self, delta: &Delta, stamp: u64) -> Delta {
        self.core.restamped(delta, stamp)
    }

    fn next_stamp(&self, held: &Held<F>) -> u64 {
        self.core.next_stamp(&held.state)
    }

    fn compete(&self, left: &Delta, right: &Delta) -> Competition {
        self.core.compete(left, right)
    }

    fn appearance(&self, held: &Held<F>) -> u64 {
        if self.compares {
            self.core.appearance(&held.state)
        } else {
            looks(&held.replica.graph().shown(&held.state))
        }
    }

    /// `[property: REPLICA-1]`
    fn judge(&self, held: &Held<F>) -> Result<Judged, Breach> {
        held.check()?;
        if !self.compares {
            return judge_state(&held.replica.graph().shown(&held.state));
        }
        let seen = self.view(held);
        compare::shown("REPLICA-1", &held.replica, &seen)?;
        compare::answers(&held.replica, &held.state, &self.core.initial)?;
        judge_state(&seen)
    }

    /// `[property: REPLICA-1]` `[property: REPLICA-2]` `[property: EVENT-1]`
    fn judge_step(&self, before: &Held<F>, _: usize, act: &Act, step: &Step<Self>) -> Result<(), Breach> {
        let after = &step.after;
        after.check()?;
        if !self.compares {
            let old = before.replica.graph().shown(&before.state);
            return check_step(&old, &act.0, &step.delta, &after.replica.graph().shown(&after.state));
        }
        let (old, new) = (self.view(before), self.view(after));
        compare::shown("REPLICA-1", &after.replica, &new)?;
        compare::found(&after.replica, &old, &new)?;
        if let Some(told) = &after.told {
            compare::told(told, &old, &new)?;
        }
        compare::shown("REPLICA-2", &before.replica, &old)?;
        check_step(&old, &act.0, &step.delta, &new)
    }

    fn judge_delivery(&self, before: &Held<F>, after: &Held<F>) -> Result<(), Breach> {
        after.check()?;
        check_delivery(&before.state, &after.state)
    }

    fn kind(&self, act: &Act) -> usize {
        self.core.kind(act)
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
        let compared = COMPARED.iter().filter(|_| self.compares);
        WHOLE.iter().chain(compared).copied().collect()
    }

    fn has_symmetry(&self) -> bool {
        true
    }

    fn is_order_sensitive(&self, held: &Held<F>) -> bool {
        self.core.is_order_sensitive(&held.state)
    }

    fn rename_state(&self, held: &Held<F>, to: &[usize]) -> Held<F> {
        self.replica_of(&self.core.rename_state(&held.state, to))
    }

    fn rename_delta(&self, delta: &Delta, to: &[usize]) -> Delta {
        self.core.rename_delta(delta, to)
    }

    fn shows(&self, held: &Held<F>) -> Graph {
        self.core.shows(&held.state)
    }

    fn mutation_text(&self, held: &Held<F>, act: &Act) -> String {
        self.core.mutation_text(&held.state, act)
    }

    fn delta_text(&self, delta: &Delta) -> String {
        self.core.delta_text(delta)
    }

    fn claims(&self, delta: &Delta, target: &Target) -> Vec<Claim> {
        self.core.claims(delta, target)
    }

    fn claims_held(&self, held: &Held<F>, target: &Target) -> Vec<Claim> {
        self.core.claims_held(&held.state, target)
    }

    fn ends(&self, delta: &Delta, target: &Target, claim: &Claim) -> bool {
        self.core.ends(delta, target, claim)
    }

    fn standing(&self, held: &Held<F>, target: &Target, claim: &Claim) -> Standing {
        self.core.standing(&held.state, target, claim)
    }

    fn setup_json(&self) -> serde_json::Value {
        self.core.setup_json()
    }

    fn state_from_json(&self, json: &serde_json::Value) -> Option<Held<F>> {
        Some(self.replica_of(&self.core.state_from_json(json)?))
    }

    fn mutation_from_json(&self, held: &Held<F>, replica: usize, json: &serde_json::Value) -> Option<Act> {
        self.core.mutation_from_json(&held.state, replica, json)
    }

    fn mutation_json(&self, act: &Act) -> serde_json::Value {
        self.core.mutation_json(act)
    }

    fn state_json(&self, held: &Held<F>) -> serde_json::Value {
        self.core.state_json(&held.state)
    }

    fn delta_json(&self, delta: &Delta) -> serde_json::Value {
        self.core.delta_json(delta)
    }
}
