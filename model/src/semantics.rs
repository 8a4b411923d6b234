//! What the checker needs of a replicated graph: implement this and every layer judges it.
//!
//! The checker never looks inside a state: it asks for mutations, delivers deltas, compares states, and
//! lets the semantics itself judge what must hold of one state or one step.
//!
//! Six methods are needed; all others have defaults that forgo something.
//!
//! | for | methods |
//! |---|---|
//! | any layer | `name`, `initial`, `mutations`, `mutate`, `join`, `judge` |
//! | more that is judged | `judge_step`, `judge_delivery`, `judge_repair`, `repair`, `join_states`, `clauses`, `judges` |
//! | deltas that are no states | `delivery`, `author_state`, `differ`, `plain` |
//! | checks that are not vacuous | `kind`, `kinds`, `kinds_in_use`, `witnesses` |
//! | a faster search | `has_symmetry`, `rename_state`, `rename_delta`, `is_order_sensitive`; `stamp`, `restamped`, `next_stamp`, `compete`, `appearance` |
//! | shrinking | `allows`, `join_deltas`, `readdressed`, `simpler`, `simpler_together`, `simpler_initial` |
//! | traces that read well, and replay | `shows`, `mutation_text`, `delta_text`, `mutation_json`, `state_json`, `delta_json`; `setup_json`, `state_from_json`, `mutation_from_json` |
//! | explanations | `claims`, `claims_held`, `ends`, `standing` |

use crate::graph::{Element, Graph};
use crate::why::{Claim, Fate, Standing, Target};
use std::fmt::{Debug, Display};
use std::hash::Hash;

/// A semantics of replicas that mutate locally and exchange deltas.
pub trait Semantics: Debug + Send + Sync + 'static {
    /// A replica's state. Equality must be that of canonical bytes.
    type State: Clone + Eq + Hash + Ord + Debug + Send + Sync;
    /// What one mutation broadcasts.
    type Delta: Clone + Eq + Hash + Ord + Debug + Send + Sync;
    /// A concrete mutation.
    type Mutation: Clone + Eq + Ord + Hash + Debug + Display + Send + Sync;

    /// Its name in reports.
    fn name(&self) -> String;

    /// The state that every replica starts from.
    fn initial(&self) -> Self::State;

    /// Every concrete mutation that replica `replica` may try in `state`, in a fixed order; those that
    /// [`mutate`](Self::mutate) refuses count as not enabled.
    fn mutations(&self, state: &Self::State, replica: usize) -> Vec<Self::Mutation>;

    /// Whether a replica may try a mutation in a state, listed by [`mutations`](Self::mutations) or not: asked of
    /// courses that nobody searched for. A semantics whose [`mutate`](Self::mutate) refuses whatever must not be
    /// tried allows everything.
    fn allows(&self, state: &Self::State, replica: usize, mutation: &Self::Mutation) -> bool {
        self.mutations(state, replica).contains(mutation)
    }

    /// What a mutation broadcasts and leaves behind, or `None` when it is refused.
    fn mutate(&self, state: &Self::State, replica: usize, mutation: &Self::Mutation) -> Option<Step<Self>>;

    /// Every enabled mutation with its step, in the order of [`mutations`](Self::mutations).
    fn steps(&self, state: &Self::State, replica: usize) -> Vec<(Self::Mutation, Step<Self>)> {
        let mutations = self.mutations(state, replica).into_iter();
        mutations
            .filter_map(|mutation| {
                let step = self.mutate(state, replica, &mutation)?;
                Some((mutation, step))
            })
            .collect()
    }

    /// A mutation that broadcasts this delta in a state.
    fn mutation_of(
        &self,
        state: &Self::State,
        replica: usize,
        delta: &Self::Delta,
    ) -> Option<Self::Mutation> {
        let steps = self.steps(state, replica).into_iter();
        steps.filter(|(_, step)| step.delta == *delta).map(|(mutation, _)| mutation).next()
    }

    /// The state after a delta is delivered. `[spec: JOIN-3]`
    fn join(&self, state: &Self::State, delta: &Self::Delta) -> Self::State;

    /// The state after several deliveries, in order.
    fn join_all(&self, state: &Self::State, deltas: &[&Self::Delta]) -> Self::State {
        deltas.iter().fold(state.clone(), |state, delta| self.join(&state, delta))
    }

    /// What `theirs` gets when it resynchronises with `ours`, or `None` if there is no such means.
    /// `[spec: SYNC-3]`
    fn repair(&self, ours: &Self::State, theirs: &Self::State) -> Option<Self::Delta> {
        let _ = (ours, theirs);
        None
    }

    /// The join of two whole states, as the order of the semilattice defines it; `None` if there is none.
    fn join_states(&self, left: &Self::State, right: &Self::State) -> Option<Self::State> {
        let _ = (left, right);
        None
    }

    /// Two deltas as one message: what [`join`](Self::join) makes of both, one after the other. `None` if there
    /// is no such delta; then a group of mutations carries its deltas one by one.
    fn join_deltas(&self, left: &Self::Delta, right: &Self::Delta) -> Option<Self::Delta> {
        let _ = (left, right);
        None
    }

    /// The same mutation where what it names has other ids: of each pair in `made`, an earlier mutation that
    /// made the first delta now makes the second. `None` if it names what nobody has made. `[spec: CHECK-14]`
    ///
    /// The default serves a semantics whose mutations name nothing that mutations make.
    fn readdressed(
        &self,
        mutation: &Self::Mutation,
        made: &[(Self::Delta, Self::Delta)],
    ) -> Option<Self::Mutation> {
        let _ = made;
        Some(mutation.clone())
    }

    /// Mutations of the same kind that say less, the least first; each must be smaller in some measure of the
    /// semantics' own, or a search for the least has no end. `[spec: CHECK-14]`
    fn simpler(&self, mutation: &Self::Mutation) -> Vec<Self::Mutation> {
        let _ = mutation;
        Vec::new()
    }

    /// The mutations of one course, all of them changed in one way that makes some say less and that none could
    /// undergo alone: such as that all name what was there before instead of what one of them makes.
    /// `[spec: CHECK-14]`
    fn simpler_together(&self, mutations: &[Self::Mutation]) -> Vec<Vec<Self::Mutation>> {
        let _ = mutations;
        Vec::new()
    }

    /// The same semantics on smaller initial states, the smallest first. `[spec: CHECK-14]`
    fn simpler_initial(&self) -> Vec<Self>
    where
        Self: Sized,
    {
        Vec::new()
    }

    /// A delta's stamp, if it makes claims. `[spec: CHECK-11]`
    ///
    /// The default keeps every delta as it is, so nothing is judged for another.
    fn stamp(&self, delta: &Self::Delta) -> Option<u64> {
        let _ = delta;
        None
    }

    /// The same delta with another stamp.
    fn restamped(&self, delta: &Self::Delta, stamp: u64) -> Self::Delta {
        let _ = stamp;
        delta.clone()
    }

    /// The stamp of the next delta with claims, whoever makes it in `state`.
    fn next_stamp(&self, state: &Self::State) -> u64 {
        let _ = state;
        0
    }

    /// When what is shown can depend on which of two deltas has the greater stamp; it is asked of deltas out
    /// of time. `[spec: CHECK-11]`
    fn compete(&self, left: &Self::Delta, right: &Self::Delta) -> Competition {
        let _ = (left, right);
        Competition::Always
    }

    /// A digest of all that is shown of a state but stamps: equal where [`compete`](Self::compete) says that
    /// nothing else can differ.
    fn appearance(&self, state: &Self::State) -> u64 {
        let _ = state;
        0
    }

    /// How deltas reach replicas. `[spec: CHECK-12]`
    fn delivery(&self) -> Delivery {
        Delivery::Any
    }

    /// The author's state after a step.
    fn author_state(&self, before: &Self::State, step: &Step<Self>) -> Self::State {
        match self.delivery() {
            Delivery::Any => self.join(before, &step.delta),
            Delivery::Once => step.after.clone(),
        }
    }

    /// How two states differ that ought to be equal, in words if there is something to say; `None` if they
    /// count as equal. Whoever lets different states count as equal forgoes what L1 concludes from equality.
    fn differ(&self, left: &Self::State, right: &Self::State) -> Option<String> {
        (left != right).then(String::new)
    }

    /// The same semantics with fewer differences counted, those that people see: a counterexample is sought by
    /// that first.
    fn plain(&self) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// Judges one state by itself: every clause that must always hold of it.
    fn judge(&self, state: &Self::State) -> Result<Judged, Breach>;

    /// Judges a local step: what must hold between a state, a mutation and the state after it. In states
    /// that look alike it is asked once.
    fn judge_step(
        &self,
        before: &Self::State,
        replica: usize,
        mutation: &Self::Mutation,
        step: &Step<Self>,
    ) -> Result<(), Breach> {
        let _ = (before, replica, mutation, step);
        Ok(())
    }

    /// Judges a delivery: what must hold between a state and the state after more was delivered.
    fn judge_delivery(&self, before: &Self::State, after: &Self::State) -> Result<(), Breach> {
        let _ = (before, after);
        Ok(())
    }

    /// Judges an answer to a digest: what must hold between who answers, who is answered, and the delta.
    fn judge_repair(
        &self,
        ours: &Self::State,
        theirs: &Self::State,
        delta: &Self::Delta,
    ) -> Result<(), Breach> {
        let _ = (ours, theirs, delta);
        Ok(())
    }

    /// Which of the kinds of mutation this is, as an index below [`kinds`](Self::kinds).
    fn kind(&self, mutation: &Self::Mutation) -> usize {
        let _ = mutation;
        0
    }

    /// The names of the kinds of mutation, at most 11. A run must see each done, and each beside each.
    fn kinds(&self) -> Vec<&'static str> {
        vec!["a mutation"]
    }

    /// The kinds that a run must see done, as indices: those that its mutations are of.
    fn kinds_in_use(&self) -> Vec<usize> {
        (0..self.kinds().len()).collect()
    }

    /// The names of the witnesses that [`judge`](Self::judge) can report, by bit.
    fn witnesses(&self) -> Vec<&'static str> {
        Vec::new()
    }

    /// Whether replicas can be renamed, so that histories that differ by that alone are one. The default
    /// forgoes it.
    fn has_symmetry(&self) -> bool {
        false
    }

    /// Whether what a replica may do in `state` depends on how replicas are ordered (who wins a tie).
    /// `true` is always safe: it only forgoes symmetry.
    fn is_order_sensitive(&self, state: &Self::State) -> bool {
        let _ = state;
        true
    }

    /// The state with every replica `r` renamed to `to[r]`; asked only of a semantics that
    /// [has symmetry](Self::has_symmetry).
    fn rename_state(&self, state: &Self::State, to: &[usize]) -> Self::State {
        let _ = to;
        state.clone()
    }

    /// The delta with every replica `r` renamed to `to[r]`.
    fn rename_delta(&self, delta: &Self::Delta, to: &[usize]) -> Self::Delta {
        let _ = to;
        delta.clone()
    }

    /// What a replica in a state shows, for traces: by default one vertex that holds the whole state as text.
    /// `[spec: TRACE-2]`
    fn shows(&self, state: &Self::State) -> Graph {
        let attributes = [("state".into(), format!("{state:?}"))].into();
        let whole = Element::Vertex { name: "the replica".into(), vertex_type: "replica".into(), attributes };
        Graph { elements: [("replica".into(), whole)].into(), ..Graph::default() }
    }

    /// A mutation made in a state, for people.
    fn mutation_text(&self, state: &Self::State, mutation: &Self::Mutation) -> String {
        let _ = state;
        mutation.to_string()
    }

    /// What a delta says, for people; may be empty.
    fn delta_text(&self, delta: &Self::Delta) -> String {
        let _ = delta;
        String::new()
    }

    /// What it takes to make this semantics again, for traces: its dictionary, what replicas start from.
    fn setup_json(&self) -> serde_json::Value {
        serde_json::Value::Null
    }

    /// What a delta says about a target, for those who ask why. `[spec: TRACE-7]`
    fn claims(&self, delta: &Self::Delta, target: &Target) -> Vec<Claim> {
        let _ = (delta, target);
        Vec::new()
    }

    /// What a state holds about a target.
    fn claims_held(&self, state: &Self::State, target: &Target) -> Vec<Claim> {
        let _ = (state, target);
        Vec::new()
    }

    /// Whether a delta says that a claim is gone.
    fn ends(&self, delta: &Self::Delta, target: &Target, claim: &Claim) -> bool {
        let _ = (delta, target, claim);
        false
    }

    /// How a claim stands in a state.
    fn standing(&self, state: &Self::State, target: &Target, claim: &Claim) -> Standing {
        let _ = (state, target, claim);
        Standing { fate: Fate::Unseen, why: "this semantics does not tell".into(), clause: "" }
    }

    /// The state of a JSON form, if the semantics can read it.
    fn state_from_json(&self, json: &serde_json::Value) -> Option<Self::State> {
        let _ = json;
        None
    }

    /// The mutation of a JSON form, whether or not it can be made; by default one that
    /// [`mutations`](Self::mutations) lists for the state.
    fn mutation_from_json(
        &self,
        state: &Self::State,
        replica: usize,
        json: &serde_json::Value,
    ) -> Option<Self::Mutation> {
        let mut listed = self.mutations(state, replica).into_iter();
        listed.find(|mutation| self.mutation_json(mutation) == *json)
    }

    /// A mutation as JSON, for traces.
    fn mutation_json(&self, mutation: &Self::Mutation) -> serde_json::Value {
        format!("{mutation:?}").into()
    }

    /// A state as JSON, for traces.
    fn state_json(&self, state: &Self::State) -> serde_json::Value {
        format!("{state:?}").into()
    }

    /// A delta as JSON, for traces.
    fn delta_json(&self, delta: &Self::Delta) -> serde_json::Value {
        format!("{delta:?}").into()
    }

    /// The clauses that [`judge`](Self::judge), [`judge_step`](Self::judge_step) and
    /// [`judge_delivery`](Self::judge_delivery) judge. That deltas commute, the layers judge of every
    /// semantics.
    fn clauses(&self) -> Vec<Clause> {
        COMMUTES.to_vec()
    }

    /// Whether a clause that a layer judges by itself is judged of this semantics.
    fn judges(&self, clause: &str) -> bool {
        let _ = clause;
        true
    }
}

/// How deltas reach replicas. `[spec: CHECK-12]`
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Delivery {
    /// However often and in whatever order: a delta that arrives again, or at its author, changes nothing. So
    /// the author's state is the old one joined with the delta, and what was lost can be delivered later.
    Any,
    /// To each other replica once; in L2 those of one author in their order. The author's state is what the
    /// step leaves.
    Once,
}

/// A clause that is judged.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Clause {
    /// Its id.
    pub id: &'static str,
    /// The claim that it belongs to.
    pub claim: &'static str,
    /// In words.
    pub what: &'static str,
}

/// What the layers judge of every semantics.
const COMMUTES: [Clause; 1] =
    [clause("JOIN-3", "L3", "the same deltas in any order, once or twice, lead to the same state")];

const fn clause(id: &'static str, claim: &'static str, what: &'static str) -> Clause {
    Clause { id, claim, what }
}

/// What is judged of a semantics that is to keep the whole specification.
pub const WHOLE: [Clause; 23] = [
    clause("JOIN-3", "L3", "the same deltas in any order, once or twice, lead to the same state"),
    clause("JOIN-4", "L2", "deliveries and mutations only add to what was seen"),
    clause("MUT-0", "L2", "a mutation's state is the old one joined with its delta"),
    clause("MUT-0.1", "L2", "a delta speaks only of what it makes and of what its author held"),
    clause("ID-3", "L3", "no dot is used twice"),
    clause("STAMP-1", "V3", "a new claim outranks all that its author held"),
    clause("SYNC-3", "L3", "resynchronisation by digest leads to the join of both"),
    clause("STATE-3", "R1", "what is removed stays removed"),
    clause("STATE-6", "S1", "only live and pending records are held"),
    clause("INV-1", "V1", "every vertex has a path to the root"),
    clause("INV-2", "V1", "no edge and no attribute dangles"),
    clause("INV-3", "V1", "the RT edges form one tree rooted at the root"),
    clause("INV-4", "V1", "no edge joins a vertex to itself"),
    clause("INV-5", "V1", "shown attributes are declared and typed"),
    clause("INV-6", "V1", "one edge per key and per functional label"),
    clause("VIEW-7", "V1", "a name finds the oldest vertex that has it"),
    clause("VIEW-8", "V1", "the greatest write of an attribute is shown"),
    clause("VIEW-9", "V1", "what is broken is repaired and reported"),
    clause("VIEW-10", "V2", "what is not broken is shown as it is"),
    clause("VIEW-12", "V2", "no local mutation makes a repair where there was none"),
    clause("INTENT-1", "V3", "a mutation shows its effect to its author"),
    clause("INTENT-2", "V3", "a claim is hidden only by greater ones"),
    clause("MUT-4.2", "V2", "no mutation strands a vertex that its author sees"),
];

/// What is judged where mutations are grouped.
pub(crate) const GROUPS: Clause = clause("MUT-0.4", "L2", "a group of mutations is the join of its deltas");

/// When what is shown can depend on which of two deltas has the greater stamp.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Competition {
    /// Never.
    Never,
    /// In states whose judgement says that they are [entangled](Judged::entangled).
    Entangled,
    /// In every state.
    Always,
}

/// What judging a sound state brings to light.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Judged {
    /// What was seen in it.
    pub witnesses: Witnesses,
    /// See [`Semantics::is_order_sensitive`].
    pub order_sensitive: bool,
    /// Whether claims on different registers decide about each other. This must be the same in all sets of
    /// deltas in which those that [always](Competition::Always) compete compare alike; and no such state may
    /// be without order-sensitivity.
    pub entangled: bool,
}

/// What a mutation broadcasts and leaves behind.
#[derive(Debug)]
pub struct Step<S: Semantics + ?Sized> {
    /// What is broadcast.
    pub delta: S::Delta,
    /// The author's own state after it.
    pub after: S::State,
}

/// A clause that does not hold, and with what values.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Breach {
    /// The clause's id.
    pub clause: &'static str,
    /// What is wrong, with the values.
    pub detail: String,
}

impl Breach {
    /// A breach of `clause`.
    pub fn new(clause: &'static str, detail: impl Display) -> Self {
        Self { clause, detail: detail.to_string() }
    }
}

/// A set of things that were really seen, by bit: the proof that a check was not vacuous.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Witnesses(pub u128);

impl Witnesses {
    /// The witness of one bit.
    pub const fn bit(at: usize) -> Self {
        Self(1 << at)
    }

    /// Adds the witnesses of `other`.
    pub const fn insert(&mut self, other: Self) {
        self.0 |= other.0;
    }

    /// How many.
    pub const fn count(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Whether bit `at` was seen.
    pub const fn has(self, at: usize) -> bool {
        self.0 >> at & 1 == 1
    }
}
