//! The fast replica: the same states, views, deltas and errors as [`State`](crate::State) and
//! [`view`](crate::view()), kept up to date instead of made anew. `[spec: REPLICA-1]`
//!
//! | room | what it keeps or does |
//! |---|---|
//! | [`map`], [`node`] | an ordered map whose clone shares everything: all that follows is made of it |
//! | [`names`], [`held`], [`graph`] | records by dot, writes and claims by register, vertices by name and type |
//! | [`filing`], [`links`] | records into all indexes and out of them; the edges that a vertex is linked by |
//! | [`plan`] | what joining a delta removes and adds: merge and closure by the indexes of anchors |
//! | [`rewrite`] | the commonest delta, carried out at once |
//! | [`settle`] | carries out every other, and brings each part of the view up to date where it is touched |
//! | [`flips`] | the edge claims that come into sight or go out of it |
//! | [`registers`], [`tree`], [`detached`], [`paths`], [`vertices`], [`attributes`] | the parts |
//! | [`read`], [`ground`], [`shown`] | the faces for readers, for mutations, for judges |
//!
//! With n records, and k edits (records that come or go by a delta and by closure):
//!
//! | operation | usual | worst |
//! |---|---|---|
//! | `apply` of a write | O(log n) | and the live writes of its register |
//! | of a vertex, an edge | O(log n) | and all that waited for it, its namesakes, the claims of its register |
//! | of a symbolic edge's end | O(log n) | and what reached the root only by it, or the band that it was in |
//! | of a kinematic claim | O(depth · log n) | and the lesser claims in conflict; what hangs below, if paths need it |
//! | of k edits | the sum | the sum: O(k · depth · log n), and what they strand |
//! | `mutate` | as `apply` of its delta | twice that, if it is refused since it strands |
//! | look-ups | O(log n) | and the claims of the register, the vertices of the name |
//! | `snapshot` | O(1) | then the writer copies each node of the maps that it touches, and the context, once |
//! | `state`, `encode`, `digest` | O(n) | |
//!
//! *Depth* is that of the kinematic tree and of the ways to the root.

mod attributes;
#[cfg(test)]
mod check;
mod detached;
mod filing;
mod flips;
mod graph;
mod ground;
mod held;
mod links;
mod map;
mod names;
mod node;
mod paths;
mod plan;
mod read;
mod registers;
mod rewrite;
mod settle;
mod shown;
mod tree;
mod vertices;

pub use graph::Graph;
pub use shown::Shown;

use crate::changes::Changes;
use crate::dictionary::Dictionary;
use crate::dot::{Dot, ReplicaId};
use crate::mutation::{
    self, Author, MoveEdgeError, Mutation, MutationError, RemoveEdgeError, RemoveVertexError, StrandError,
    new_edge,
};
use crate::record::{EdgeKey, Record};
use crate::state::Delta;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::ops::Deref;
use ground::Without;
use settle::Came;

/// One replica of a graph: mutates it, joins deltas, and says what each has changed. Reads as a [`Graph`].
/// `[spec: REPLICA-1]`
///
/// ```
/// use dsr_core::{Change, Dictionary, Mutation, NewVertex, Replica, ReplicaId, VertexId, VertexLink};
///
/// let mut here = Replica::new(ReplicaId::agent(1), Dictionary::open());
/// let mut there = Replica::new(ReplicaId::agent(2), Dictionary::open());
/// let mutation = Mutation::AddVertex {
///     vertex: NewVertex::new("room", "kitchen"),
///     link: VertexLink::child_of(VertexId::ROOT),
/// };
/// let made = here.mutate(&mutation, 0)?;
/// let before = there.snapshot();
/// let changes = there.apply(&made.delta);
/// assert_eq!(changes, made.changes);
/// assert!(matches!(changes.iter().next(), Some(Change::VertexAdded { .. })));
/// assert!(there.apply(&made.delta).is_empty(), "twice is once");
/// assert!(before.vertex_by_name("kitchen").is_none() && there.vertex_by_name("kitchen").is_some());
/// # Ok::<(), dsr_core::MutationError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Replica {
    id: ReplicaId,
    graph: Graph,
}

/// What a mutation has made.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Mutated {
    /// To be sent to the others.
    pub delta: Delta,
    /// What has changed here.
    pub changes: Changes,
}

impl Deref for Replica {
    type Target = Graph;

    fn deref(&self) -> &Graph {
        &self.graph
    }
}

impl Replica {
    /// A replica that has seen nothing. One that goes on from a state applies it: a delta is a state.
    /// `[spec: STATE-5]`
    pub fn new(id: ReplicaId, dictionary: Dictionary) -> Self {
        Self { id, graph: Graph::new(dictionary) }
    }

    /// A replica that goes on from what another one, or an earlier moment, has shown. O(1).
    ///
    /// Whoever takes the id of the replica that the snapshot is of must be that replica, and have made nothing
    /// since. `[spec: ID-3]` `[spec: CRASH-2]`
    pub fn on(id: ReplicaId, snapshot: Graph) -> Self {
        Self { id, graph: snapshot }
    }

    /// Whose dots its mutations use.
    pub fn id(&self) -> ReplicaId {
        self.id
    }

    /// The graph as it is now, for readers: it stays so, whatever is applied later, and blocks nobody. O(1).
    /// `[spec: REPLICA-2]`
    pub fn snapshot(&self) -> Graph {
        self.graph.clone()
    }

    /// Joins a well-formed delta; what has changed. `[spec: JOIN-3]` `[spec: EVENT-1]`
    ///
    /// Decoders accept nothing that is not well-formed; who assembles a delta calls
    /// [`check_well_formed`](crate::check_well_formed).
    pub fn apply(&mut self, delta: &Delta) -> Changes {
        if let Some(changes) = self.graph.rewrite(delta) {
            return changes;
        }
        let plan = self.graph.plan(delta);
        let outcome = self.graph.commit(plan.removed, plan.added, false);
        self.see(delta);
        outcome.changes
    }

    /// Carries out one of the six mutations here. The delta, or the error, is that of [`Mutation::delta`];
    /// where it is an error, nothing changes. `[spec: MUT-0]`
    pub fn mutate(&mut self, mutation: &Mutation, timestamp_ns: u64) -> Result<Mutated, MutationError> {
        let author = Author { replica: self.id, timestamp_ns };
        let graph = &self.graph;
        match mutation {
            Mutation::AddVertex { vertex, link } => {
                let delta = mutation::add_vertex_to(graph, author, vertex, link)?;
                Ok(self.made(delta))
            }
            Mutation::AddEdge { key, attributes } => {
                let delta = mutation::add_edge_to(graph, author, key, attributes)?;
                Ok(self.made(delta))
            }
            Mutation::UpdateAttributes { target, updates } => {
                let delta = mutation::update_attributes_of(graph, author, *target, updates)?;
                Ok(self.made(delta))
            }
            Mutation::RemoveEdge { key } => {
                let delta = mutation::removal_of_edge(graph, key)?;
                Ok(self.made_unless_it_strands(delta).map_err(RemoveEdgeError::from)?)
            }
            Mutation::RemoveVertex { vertex } => {
                let delta = mutation::removal_of_vertex(graph, *vertex)?;
                Ok(self.made_unless_it_strands(delta).map_err(RemoveVertexError::from)?)
            }
            Mutation::MoveEdge { from, to, attributes } => {
                let delta = self.movement(author, from, to, attributes)?;
                Ok(self.made_unless_it_strands(delta).map_err(MoveEdgeError::from)?)
            }
        }
    }

    /// The delta of a move, stranding or not. `[spec: MUT-5.3]`
    fn movement(
        &mut self,
        author: Author,
        from: &EdgeKey,
        to: &EdgeKey,
        attributes: &mutation::AttributeMap,
    ) -> Result<Delta, MoveEdgeError> {
        let mut draft = mutation::departure(&self.graph, author, from, to, attributes)?;
        if let Some(without) = Without::new(&self.graph, from) {
            new_edge::check(&without, to)?;
        } else {
            let plan = self.graph.plan(&draft.delta);
            let done = self.graph.commit(plan.removed, plan.added, true);
            let judged = new_edge::check(&self.graph, to);
            self.undo(&done.gone, done.came);
            judged?;
        }
        draft.kill_register(&self.graph, to);
        draft.edge(to, attributes);
        Ok(draft.delta)
    }

    fn made(&mut self, delta: Delta) -> Mutated {
        let changes = self.apply(&delta);
        Mutated { delta, changes }
    }

    /// Joins a delta, or, if a vertex is stranded by it that was not before, leaves all as it is.
    /// `[spec: MUT-4.2]`
    fn made_unless_it_strands(&mut self, delta: Delta) -> Result<Mutated, StrandError> {
        let plan = self.graph.plan(&delta);
        let done = self.graph.commit(plan.removed, plan.added, true);
        if done.stranded.is_empty() {
            self.see(&delta);
            return Ok(Mutated { delta, changes: done.changes });
        }
        self.undo(&done.gone, done.came);
        Err(StrandError { vertices: done.stranded })
    }

    /// Edits in reverse: what is shown depends on what is held, not on how it came about. `[spec: VIEW-1]`
    fn undo(&mut self, gone: &[(Dot, Record)], came: Vec<(Dot, Came)>) {
        let came = came.into_iter().map(|(dot, _)| dot);
        self.graph.commit(came, gone.iter().map(|(dot, record)| (*dot, record)), false);
    }

    fn see(&mut self, delta: &Delta) {
        Arc::make_mut(&mut self.graph.context).join(delta.context());
    }
}
