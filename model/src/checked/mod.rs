//! The checked semantics: `dsr-core` itself, as it ships, behind the checker's trait.

pub mod alphabet;
mod explain;
mod intent;
mod readdress;
mod renaming;
mod sight;
mod simpler;
mod timeless;
mod words;

use crate::graph::Graph;
use crate::semantics::{Breach, Clause, Competition, Judged, Semantics, Step, WHOLE, Witnesses};
use crate::why::{Claim, Standing, Target};
use alphabet::Alphabet;
use dsr_core::invariant::{Violation, check_repairs, check_view};
use dsr_core::{
    Author, Delta, Dictionary, Mutation, MutationKind, Repair, ReplicaId, Rule, Shows, State, View,
    check_well_formed, delta_for, digest, view,
};
pub(crate) use intent::{check_delivery, check_step};
pub(crate) use sight::Sight;
use std::fmt;
pub(crate) use timeless::appearance as looks;

/// `dsr-core` from an initial graph, with an alphabet of concrete mutations.
#[derive(Clone, Debug)]
pub struct Checked {
    /// The dictionary of all replicas.
    pub dictionary: Dictionary,
    /// What every replica starts from.
    pub initial: State,
    /// What replicas may do.
    pub alphabet: Alphabet,
}

/// A mutation that prints for people.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Act(pub Mutation);

/// With ids; [`Semantics::mutation_text`] has names.
impl fmt::Display for Act {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&words::with(&self.0, &|vertex| vertex.to_string(), &|edge| edge.to_string()))
    }
}

/// Index `r + INCARNATION` of the checker is the next incarnation of replica `r`. `[spec: CRASH-2]`
pub const INCARNATION: usize = 8;

/// The replica that index `replica` of the checker stands for; the scene's author is agent 0.
pub fn replica_id(replica: usize) -> ReplicaId {
    let number = |count| u32::try_from(count).unwrap_or(u32::MAX);
    let agent = number(replica % INCARNATION).saturating_add(1);
    ReplicaId { agent, incarnation: number(replica / INCARNATION) }
}

/// The kinds of repair, by bit.
const REPAIRS: [&str; 8] = [
    "repair: same-key",
    "repair: functional",
    "repair: rt-parent",
    "repair: cycle-broken",
    "repair: detached",
    "repair: reattached",
    "repair: name-clash",
    "repair: undeclared",
];
const CONCURRENT_WRITES: usize = REPAIRS.len();
const PENDING: usize = CONCURRENT_WRITES + 1;
const CLOUD: usize = PENDING + 1;

fn repair_bit(repair: &Repair) -> usize {
    match repair {
        Repair::Superseded { rule: Rule::SameKey, .. } => 0,
        Repair::Superseded { rule: Rule::Functional, .. } => 1,
        Repair::Superseded { rule: Rule::RtParent, .. } => 2,
        Repair::CycleBroken { .. } => 3,
        Repair::Detached { .. } => 4,
        Repair::Reattached { .. } => 5,
        Repair::NameClash { .. } => 6,
        Repair::Undeclared { .. } => 7,
    }
}

/// The clause that a violation names.
fn breach(violation: &Violation) -> Breach {
    let clause = match violation {
        Violation::NoPath { .. } => "INV-1",
        Violation::Dangling { .. } | Violation::DanglingWrite { .. } => "INV-2",
        Violation::TwoParents { .. } | Violation::NotRooted { .. } | Violation::Misplaced { .. } => "INV-3",
        Violation::SelfLoop { .. } => "INV-4",
        Violation::Undeclared { .. } => "INV-5",
        Violation::TwoShown { .. } => "INV-6",
        Violation::Misnamed { .. } => "VIEW-7",
        Violation::Outranked { .. } => "VIEW-8",
        Violation::Needless { .. } => "VIEW-10",
        Violation::Silent { .. } => "VIEW-9",
        _ => "INV",
    };
    Breach::new(clause, violation)
}

/// Judges what anybody shows of a state by the core's own judges.
pub fn judge_shown(shown: &impl Shows) -> Result<(), Breach> {
    check_view(shown).map_err(|violation| breach(&violation))?;
    check_repairs(shown).map_err(|violation| breach(&violation))
}

/// Judges a view by every clause that holds of one state. `[property: INV-1]` `[property: INV-2]`
/// `[property: INV-3]` `[property: INV-4]` `[property: INV-5]` `[property: INV-6]` `[property: VIEW-9]`
/// `[property: VIEW-10]` `[property: INTENT-2]`
pub fn judge_view(view: &View<'_>) -> Result<(), Breach> {
    judge_sight(view)
}

fn judge_sight(view: &impl Sight) -> Result<(), Breach> {
    judge_shown(view)?;
    intent::check_hidden_are_outranked(view)
}

/// Judges a state by what is shown of it. `[property: STATE-6]`
pub(crate) fn judge_state(view: &impl Sight) -> Result<Judged, Breach> {
    check_well_formed(view.state()).map_err(|fault| Breach::new("STATE-6", fault))?;
    judge_sight(view)?;
    Ok(Judged {
        witnesses: witnesses_of(view),
        order_sensitive: is_order_sensitive(view),
        entangled: timeless::is_entangled(view),
    })
}

/// What a view bears witness of.
fn witnesses_of(view: &impl Sight) -> Witnesses {
    let mut seen = Witnesses::default();
    for repair in view.repairs() {
        seen.insert(Witnesses::bit(repair_bit(repair)));
    }
    if has_concurrent_writes(view) {
        seen.insert(Witnesses::bit(CONCURRENT_WRITES));
    }
    let state = view.state();
    if state.context().cloud_runs().next().is_some() {
        seen.insert(Witnesses::bit(CLOUD));
    }
    let unseen = |dot: dsr_core::Dot| dot.sequence != 0 && !state.context().contains(dot);
    if state.records().any(|(_, record)| record.anchors().any(unseen)) {
        seen.insert(Witnesses::bit(PENDING));
    }
    seen
}

fn has_concurrent_writes(view: &impl Sight) -> bool {
    view.writes()
        .windows(2)
        .any(|pair| pair[0].1.target == pair[1].1.target && pair[0].1.name == pair[1].1.name)
}

/// A view without repairs and without two live writes of one attribute does not depend on the order of
/// dots. `[spec: VIEW-11]`
fn is_order_sensitive(view: &impl Sight) -> bool {
    !view.repairs().is_empty() || has_concurrent_writes(view)
}

impl Checked {
    /// What a replica may try in what it sees.
    pub(crate) fn mutations_in(&self, view: &impl Sight, replica: usize) -> Vec<Act> {
        self.alphabet.enabled(view, replica).into_iter().map(Act).collect()
    }
}

impl Semantics for Checked {
    type State = State;
    type Delta = Delta;
    type Mutation = Act;

    fn name(&self) -> String {
        "checked".into()
    }

    fn initial(&self) -> State {
        self.initial.clone()
    }

    fn mutations(&self, state: &State, replica: usize) -> Vec<Act> {
        self.mutations_in(&view(state, &self.dictionary), replica)
    }

    /// The alphabet is a sample; the core refuses what must not be done.
    fn allows(&self, _: &State, _: usize, _: &Act) -> bool {
        true
    }

    fn mutate(&self, state: &State, replica: usize, mutation: &Act) -> Option<Step<Self>> {
        let author = Author::new(replica_id(replica));
        let delta = mutation.0.delta(&view(state, &self.dictionary), author).ok()?;
        let after = state.joined(&delta);
        Some(Step { delta, after })
    }

    fn steps(&self, state: &State, replica: usize) -> Vec<(Act, Step<Self>)> {
        let view = view(state, &self.dictionary);
        let author = Author::new(replica_id(replica));
        let mutations = self.alphabet.enabled(&view, replica).into_iter();
        mutations
            .filter_map(|mutation| {
                let delta = mutation.delta(&view, author).ok()?;
                let after = state.joined(&delta);
                Some((Act(mutation), Step { delta, after }))
            })
            .collect()
    }

    fn join(&self, state: &State, delta: &Delta) -> State {
        state.joined(delta)
    }

    fn join_all(&self, state: &State, deltas: &[&Delta]) -> State {
        let mut state = state.clone();
        for delta in deltas {
            state.join(delta);
        }
        state
    }

    fn repair(&self, ours: &State, theirs: &State) -> Option<Delta> {
        Some(delta_for(ours, &digest(theirs)))
    }

    fn join_states(&self, left: &State, right: &State) -> Option<State> {
        Some(left.joined(right))
    }

    fn join_deltas(&self, left: &Delta, right: &Delta) -> Option<Delta> {
        Some(left.joined(right))
    }

    fn readdressed(&self, mutation: &Act, made: &[(Delta, Delta)]) -> Option<Act> {
        readdress::mutation(&mutation.0, &self.initial, made).map(Act)
    }

    fn simpler(&self, mutation: &Act) -> Vec<Act> {
        simpler::mutations(&mutation.0, &self.alphabet.focus).into_iter().map(Act).collect()
    }

    fn simpler_together(&self, mutations: &[Act]) -> Vec<Vec<Act>> {
        let mutations: Vec<&Mutation> = mutations.iter().map(|act| &act.0).collect();
        let together = simpler::about_older(&mutations, &self.alphabet.focus).into_iter();
        together.map(|mutations| mutations.into_iter().map(Act).collect()).collect()
    }

    fn simpler_initial(&self) -> Vec<Self> {
        let smaller = simpler::initial(&self.initial, &self.dictionary).into_iter();
        smaller.map(|initial| Self { initial, ..self.clone() }).collect()
    }

    fn stamp(&self, delta: &Delta) -> Option<u64> {
        (!delta.is_empty()).then(|| delta.greatest_stamp())
    }

    fn restamped(&self, delta: &Delta, stamp: u64) -> Delta {
        timeless::restamped(delta, stamp)
    }

    fn next_stamp(&self, state: &State) -> u64 {
        state.greatest_stamp().saturating_add(1)
    }

    fn compete(&self, left: &Delta, right: &Delta) -> Competition {
        timeless::compete(left, right, &self.dictionary)
    }

    fn appearance(&self, state: &State) -> u64 {
        timeless::appearance(&view(state, &self.dictionary))
    }

    fn judge(&self, state: &State) -> Result<Judged, Breach> {
        judge_state(&view(state, &self.dictionary))
    }

    fn judge_step(
        &self,
        before: &State,
        _replica: usize,
        mutation: &Act,
        step: &Step<Self>,
    ) -> Result<(), Breach> {
        let after = view(&step.after, &self.dictionary);
        intent::check_step(&view(before, &self.dictionary), &mutation.0, &step.delta, &after)
    }

    fn judge_delivery(&self, before: &State, after: &State) -> Result<(), Breach> {
        intent::check_delivery(before, after)
    }

    fn kind(&self, mutation: &Act) -> usize {
        mutation.0.kind() as usize
    }

    fn kinds(&self) -> Vec<&'static str> {
        MutationKind::ALL.map(MutationKind::name).to_vec()
    }

    fn kinds_in_use(&self) -> Vec<usize> {
        self.alphabet.kinds.iter().map(|&kind| kind as usize).collect()
    }

    fn witnesses(&self) -> Vec<&'static str> {
        let mut names = REPAIRS.to_vec();
        names.extend(["two live writes of one attribute", "a pending record", "a gap in a context"]);
        names
    }

    fn clauses(&self) -> Vec<Clause> {
        WHOLE.to_vec()
    }

    fn has_symmetry(&self) -> bool {
        true
    }

    fn is_order_sensitive(&self, state: &State) -> bool {
        is_order_sensitive(&view(state, &self.dictionary))
    }

    fn rename_state(&self, state: &State, to: &[usize]) -> State {
        renaming::rename(state, to)
    }

    fn rename_delta(&self, delta: &Delta, to: &[usize]) -> Delta {
        renaming::rename(delta, to)
    }

    fn shows(&self, state: &State) -> Graph {
        words::graph(&view(state, &self.dictionary))
    }

    fn mutation_text(&self, state: &State, mutation: &Act) -> String {
        words::mutation(&view(state, &self.dictionary), &mutation.0)
    }

    fn delta_text(&self, delta: &Delta) -> String {
        words::delta(delta)
    }

    fn claims(&self, delta: &Delta, target: &Target) -> Vec<Claim> {
        explain::claims(delta, target, &self.dictionary)
    }

    fn claims_held(&self, state: &State, target: &Target) -> Vec<Claim> {
        explain::claims(state, target, &self.dictionary)
    }

    fn ends(&self, delta: &Delta, _: &Target, claim: &Claim) -> bool {
        explain::ends(delta, claim)
    }

    fn standing(&self, state: &State, _: &Target, claim: &Claim) -> Standing {
        explain::standing(state, claim, &self.dictionary)
    }

    fn setup_json(&self) -> serde_json::Value {
        serde_json::json!({ "dictionary": self.dictionary, "initial": self.initial })
    }

    fn state_from_json(&self, json: &serde_json::Value) -> Option<State> {
        serde_json::from_value(json.clone()).ok()
    }

    fn mutation_from_json(&self, _: &State, _: usize, json: &serde_json::Value) -> Option<Act> {
        serde_json::from_value(json.clone()).ok().map(Act)
    }

    fn mutation_json(&self, mutation: &Act) -> serde_json::Value {
        serde_json::to_value(&mutation.0).unwrap_or_default()
    }

    fn state_json(&self, state: &State) -> serde_json::Value {
        serde_json::to_value(state).unwrap_or_default()
    }

    fn delta_json(&self, delta: &Delta) -> serde_json::Value {
        self.state_json(delta)
    }
}
