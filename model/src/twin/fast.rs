//! A fast replica, as the checker asks it.

use dsr_core::{
    Changes, Delta, Dictionary, Digest, Dot, EdgeId, Graph, Mutated, Mutation, MutationError, Placement,
    Repair, Replica, ReplicaId, VertexId, Write,
};
use std::fmt::Debug;

/// [`Replica`] as it ships, or one that is broken on purpose: whoever breaks one overrides what is broken.
pub trait Fast: Clone + Debug + Send + Sync + 'static {
    /// A replica that has seen nothing.
    fn start(dictionary: &Dictionary) -> Self;

    /// The same graph, whose mutations are those of another author.
    #[must_use]
    fn for_author(&self, id: ReplicaId) -> Self;

    /// What it holds and shows.
    fn graph(&self) -> &Graph;

    /// Joins a delta; what it tells of that.
    fn apply(&mut self, delta: &Delta) -> Changes;

    /// Mutates; what it makes and tells.
    fn mutate(&mut self, mutation: &Mutation) -> Result<Mutated, MutationError>;

    /// What it answers to a digest.
    fn delta_for(&self, theirs: &Digest) -> Delta {
        self.graph().delta_for(theirs)
    }

    /// Where a vertex stands.
    fn placement(&self, vertex: VertexId) -> Option<Placement> {
        self.graph().placement(vertex)
    }

    /// Which vertex a name finds.
    fn vertex_by_name(&self, name: &str) -> Option<VertexId> {
        self.graph().vertex_by_name(name)
    }

    /// The edges shown at a vertex, in order.
    fn edges_at_vertex(&self, vertex: VertexId) -> Vec<EdgeId> {
        let mut edges: Vec<EdgeId> = self.graph().edges_at_vertex(vertex).map(|(edge, _)| edge).collect();
        edges.sort_unstable();
        edges
    }

    /// The writes shown of an attribute, the winner first.
    fn attribute_writes(&self, target: Dot, name: &str) -> Vec<(Dot, Write)> {
        self.graph().attribute_writes(target, name)
    }

    /// What it reports as repaired, in order.
    fn repairs(&self) -> Vec<Repair> {
        self.graph().repairs().cloned().collect()
    }
}

impl Fast for Replica {
    fn start(dictionary: &Dictionary) -> Self {
        Self::new(ReplicaId::SCENE, dictionary.clone())
    }

    fn for_author(&self, id: ReplicaId) -> Self {
        Self::on(id, self.snapshot())
    }

    fn graph(&self) -> &Graph {
        self
    }

    fn apply(&mut self, delta: &Delta) -> Changes {
        Self::apply(self, delta)
    }

    fn mutate(&mut self, mutation: &Mutation) -> Result<Mutated, MutationError> {
        Self::mutate(self, mutation, 0)
    }
}
