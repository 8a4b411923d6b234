//! A fast replica broken in one place: [`Replica`] with one [`ReplicaFlaw`].

use crate::twin::Fast;
use dsr_core::{
    Changes, Delta, Dictionary, Digest, Dot, Graph, Mutated, Mutation, MutationError, Placement, Replica,
    ReplicaId, VertexId, Write,
};
use std::fmt::Debug;

/// One thing done wrongly. Every method does it rightly unless a flaw overrides it; what a flaw keeps beside the
/// replica is cloned with it.
pub trait ReplicaFlaw: Clone + Default + Debug + Send + Sync + 'static {
    /// What it makes of a change: `changes` are told rightly, and `graph` is what is held after them.
    fn see(&mut self, graph: &Graph, changes: &Changes) {
        let _ = (graph, changes);
    }

    /// What is told of a change.
    fn tell(&self, changes: Changes) -> Changes {
        changes
    }

    /// What a refused mutation leaves behind.
    fn refuse(&self, replica: &mut Replica, mutation: &Mutation) {
        let _ = (replica, mutation);
    }

    /// What is answered to a digest.
    fn answer(&self, answer: Delta) -> Delta {
        answer
    }

    /// Where a vertex stands.
    fn placement(&self, graph: &Graph, vertex: VertexId) -> Option<Placement> {
        graph.placement(vertex)
    }

    /// Which vertex a name finds.
    fn vertex_by_name(&self, graph: &Graph, name: &str) -> Option<VertexId> {
        graph.vertex_by_name(name)
    }

    /// The writes shown of an attribute, the winner first.
    fn attribute_writes(&self, graph: &Graph, target: Dot, name: &str) -> Vec<(Dot, Write)> {
        graph.attribute_writes(target, name)
    }
}

/// A replica with a flaw.
#[derive(Clone, Debug)]
pub struct Flawed<X> {
    replica: Replica,
    flaw: X,
}

impl<X: ReplicaFlaw> Fast for Flawed<X> {
    fn start(dictionary: &Dictionary) -> Self {
        Self { replica: Fast::start(dictionary), flaw: X::default() }
    }

    fn for_author(&self, id: ReplicaId) -> Self {
        Self { replica: self.replica.for_author(id), flaw: self.flaw.clone() }
    }

    fn graph(&self) -> &Graph {
        &self.replica
    }

    fn apply(&mut self, delta: &Delta) -> Changes {
        let changes = self.replica.apply(delta);
        self.flaw.see(&self.replica, &changes);
        self.flaw.tell(changes)
    }

    fn mutate(&mut self, mutation: &Mutation) -> Result<Mutated, MutationError> {
        let made = Fast::mutate(&mut self.replica, mutation);
        match made {
            Ok(Mutated { delta, changes }) => {
                self.flaw.see(&self.replica, &changes);
                Ok(Mutated { delta, changes: self.flaw.tell(changes) })
            }
            Err(error) => {
                self.flaw.refuse(&mut self.replica, mutation);
                Err(error)
            }
        }
    }

    fn delta_for(&self, theirs: &Digest) -> Delta {
        self.flaw.answer(self.replica.delta_for(theirs))
    }

    fn placement(&self, vertex: VertexId) -> Option<Placement> {
        self.flaw.placement(&self.replica, vertex)
    }

    fn vertex_by_name(&self, name: &str) -> Option<VertexId> {
        self.flaw.vertex_by_name(&self.replica, name)
    }

    fn attribute_writes(&self, target: Dot, name: &str) -> Vec<(Dot, Write)> {
        self.flaw.attribute_writes(&self.replica, target, name)
    }
}
