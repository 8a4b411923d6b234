//! The state: a causal set of dotted records, its join and its closure.
//!
//! Each dot is *unseen*, *held* (with its record) or *dead* (seen, not held), and only ever moves in that
//! direction. [`State::merge`] takes the pointwise maximum; [`State::close`] lets what is anchored to the
//! dead die with it; [`State::join`] is one after the other and the join of a semilattice.

use crate::context::{CausalContext, Run};
use crate::dot::{Dot, ReplicaId};
use crate::record::{Edge, Rank, Record, Vertex, Write};
use alloc::collections::BTreeMap;
use alloc::sync::Arc;
use alloc::vec::Vec;

/// A replica's state, and as well what is broadcast: a delta is a small state. `[spec: STATE-1]`
///
/// Invariants, enforced by every constructor and decoder (`[spec: WF-1]` and following): every held dot
/// has been seen; the state is closed. Records are shared, so cloning a state copies no payload.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct State {
    store: BTreeMap<Dot, Arc<Record>>,
    context: CausalContext,
}

/// So many new records, if they are a good part of all, are not inserted one by one.
const MANY: usize = 64;

/// What a mutation returns and a network carries. `[spec: STATE-5]`
pub type Delta = State;

impl State {
    /// The state that has seen nothing: only the root lives.
    pub const fn new() -> Self {
        Self { store: BTreeMap::new(), context: CausalContext::new() }
    }

    /// Assembles a state from its parts without judging them: whoever takes them from outside calls
    /// [`check_well_formed`](crate::check_well_formed) before anything else.
    pub fn assemble(records: impl IntoIterator<Item = (Dot, Record)>, context: CausalContext) -> Self {
        Self { store: records.into_iter().map(|(dot, record)| (dot, Arc::new(record))).collect(), context }
    }

    /// [`assemble`](Self::assemble), of records that are shared already.
    pub(crate) fn of_parts(records: Vec<(Dot, Arc<Record>)>, context: CausalContext) -> Self {
        Self { store: records.into_iter().collect(), context }
    }

    /// Files a record under a dot that nobody has used yet.
    pub(crate) fn insert(&mut self, dot: Dot, record: Record) {
        self.context.insert(dot);
        self.store.insert(dot, Arc::new(record));
    }

    /// Marks a dot as seen and not held: nothing else is kept of it. `[spec: STATE-6]`
    pub(crate) fn kill(&mut self, dot: Dot) {
        self.context.insert(dot);
        self.store.remove(&dot);
    }

    /// Marks a run of dots as seen, whether held or not.
    pub(crate) fn observe(&mut self, run: Run) {
        self.context.insert_run(run);
    }

    /// Takes over what `other` says of a run that it has seen: its records, shared, and its deaths.
    pub(crate) fn take_run(&mut self, other: &Self, run: Run) {
        self.observe(run);
        let held = other.store.range(run.bounds());
        self.store.extend(held.map(|(&dot, record)| (dot, Arc::clone(record))));
    }

    /// The records held under dots of `run`, in order.
    pub(crate) fn records_within(&self, run: Run) -> impl Iterator<Item = (Dot, &Record)> + '_ {
        self.store.range(run.bounds()).map(|(&dot, record)| (dot, &**record))
    }

    /// The dead dots of `run`, as ascending runs. O(log n + the records and runs in it).
    pub(crate) fn dead_within(&self, run: Run) -> impl Iterator<Item = Run> + '_ {
        self.context.runs_within(run).flat_map(|seen| {
            let held = self.store.range(seen.bounds());
            seen.without(held.map(|(dot, _)| (dot.sequence, dot.sequence)))
        })
    }

    /// Every dot that has been seen.
    pub fn context(&self) -> &CausalContext {
        &self.context
    }

    /// The records held, in the order of their dots.
    pub fn records(&self) -> impl ExactSizeIterator<Item = (Dot, &Record)> + Clone + '_ {
        self.store.iter().map(|(&dot, record)| (dot, &**record))
    }

    /// How many records are held, pending ones included.
    pub fn len(&self) -> usize {
        self.store.len()
    }

    /// Whether no record is held.
    pub fn is_empty(&self) -> bool {
        self.store.is_empty()
    }

    /// The record held under `dot`.
    pub fn get(&self, dot: Dot) -> Option<&Record> {
        self.store.get(&dot).map(|record| &**record)
    }

    /// The vertex held under `dot`; the root has no record.
    pub fn vertex(&self, dot: Dot) -> Option<&Vertex> {
        if let Some(Record::Vertex(vertex)) = self.get(dot) { Some(vertex) } else { None }
    }

    /// The edge held under `dot`.
    pub fn edge(&self, dot: Dot) -> Option<&Edge> {
        if let Some(Record::Edge(edge)) = self.get(dot) { Some(edge) } else { None }
    }

    /// The write held under `dot`.
    pub fn write(&self, dot: Dot) -> Option<&Write> {
        if let Some(Record::Write(write)) = self.get(dot) { Some(write) } else { None }
    }

    /// Whether a record is held under `dot`.
    pub fn holds(&self, dot: Dot) -> bool {
        self.store.contains_key(&dot)
    }

    /// Seen but not held: removed or superseded, for ever. The root never is. `[spec: STATE-3]`
    pub fn is_dead(&self, dot: Dot) -> bool {
        // In this order: most that is asked for is held.
        !self.holds(dot) && self.context.contains(dot)
    }

    /// The rank of the claim held under `dot`: the greater of two competing claims wins. `[spec: STAMP-2]`
    pub fn rank(&self, dot: Dot) -> Option<Rank> {
        self.get(dot).map(|record| (record.stamp(), dot))
    }

    /// The greatest stamp held, 0 when no record is. `[spec: STAMP-1]`
    pub fn greatest_stamp(&self) -> u64 {
        self.store.values().map(|record| record.stamp()).max().unwrap_or(0)
    }

    /// The dot of `replica`'s next event, or `None` when its sequences are used up. `[spec: ID-3]`
    pub fn next_dot(&self, replica: ReplicaId) -> Option<Dot> {
        Some(Dot::new(replica, self.context.greatest(replica).checked_add(1)?))
    }

    /// Joins `other` into this state: [`merge`](Self::merge), then [`close`](Self::close). `[spec: JOIN-3]`
    ///
    /// Associative, commutative and idempotent on well-formed states in which no dot was used twice.
    /// Not promised: telling a reused dot; see [`reused_dot`](Self::reused_dot).
    pub fn join(&mut self, other: &Self) {
        if self.merge(other) {
            self.close();
        }
    }

    /// [`join`](Self::join), leaving this state as it is.
    #[must_use]
    pub fn joined(&self, other: &Self) -> Self {
        let mut state = self.clone();
        state.join(other);
        state
    }

    /// The pointwise maximum of unseen < held < dead, per dot; contexts unite. `[spec: JOIN-1]`
    ///
    /// If a dot was used twice, the greater record is kept, so that the outcome does not depend on who
    /// merges into whom (`[spec: JOIN-2]`). Returns whether the result may need [`close`](Self::close).
    pub fn merge(&mut self, other: &Self) -> bool {
        let mut disturbed = self.drop_dead_in(other);
        let context = &self.context;
        let mut fresh = Vec::new();
        for (&dot, theirs) in &other.store {
            if !context.contains(dot) {
                disturbed |= theirs.anchors().any(|anchor| context.contains(anchor));
                fresh.push((dot, Arc::clone(theirs)));
            } else if let Some(ours) = self.store.get_mut(&dot).filter(|ours| **ours < *theirs) {
                ours.clone_from(theirs);
                disturbed = true;
            }
        }
        if fresh.len() > MANY.max(self.store.len() / 8) {
            // In order already: one pass makes a tree of them, another one of both.
            self.store.append(&mut fresh.into_iter().collect());
        } else {
            self.store.extend(fresh);
        }
        // A dot that arrives dead can be the anchor of a record that waits here.
        disturbed |=
            other.context.unseen_runs_by(&self.context).any(|run| other.dead_within(run).next().is_some());
        self.context.join(&other.context);
        disturbed
    }

    /// Drops the records held here that `other` has seen and does not hold; whether there were any. Visits only records that `other` has seen.
    fn drop_dead_in(&mut self, other: &Self) -> bool {
        let seen = other.context.runs().flat_map(|run| self.store.range(run.bounds()));
        let dead: Vec<Dot> = seen.map(|(&dot, _)| dot).filter(|&dot| !other.holds(dot)).collect();
        for dot in &dead {
            self.store.remove(dot);
        }
        // A write is no anchor, but a hostile record may wait for one: see the regression of that name.
        !dead.is_empty()
    }

    /// Drops every record anchored to a dead dot, until none is left: a closure operator.
    /// `[spec: CLOSE-1]` `[spec: CLOSE-2]`
    ///
    /// Reaches its fixed point in two passes: a vertex takes its edges, an edge its writes
    /// (`[spec: CLOSE-3]`). What is anchored to a dot not yet *seen* stays, pending (`[spec: CLOSE-4]`).
    pub fn close(&mut self) {
        loop {
            let stranded: Vec<Dot> = self
                .store
                .iter()
                .filter(|(_, record)| record.anchors().any(|anchor| self.is_dead(anchor)))
                .map(|(&dot, _)| dot)
                .collect();
            if stranded.is_empty() {
                return;
            }
            for dot in stranded {
                self.store.remove(&dot);
            }
        }
    }

    /// Whether joining this into `other` would change nothing: the order of the semilattice. `[spec: JOIN-4]`
    pub fn is_below(&self, other: &Self) -> bool {
        other.joined(self) == *other
    }

    /// A dot that this state and `other` hold with different records: a replica used it twice, against
    /// `[spec: ID-3]`. What arrives from outside can be tested before it is joined. `[spec: CRASH-3]`
    pub fn reused_dot(&self, other: &Self) -> Option<Dot> {
        let (small, large) = if self.len() <= other.len() { (self, other) } else { (other, self) };
        small
            .store
            .iter()
            .find(|(dot, record)| large.store.get(dot).is_some_and(|r| r != *record))
            .map(|(&dot, _)| dot)
    }
}
