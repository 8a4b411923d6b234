//! What the conditions of the mutations ask of the graph before them.

use crate::dictionary::Dictionary;
use crate::dot::{Dot, EdgeId, ReplicaId, VertexId};
use crate::record::{EdgeKey, Name};
use crate::view::{Placement, View};
use alloc::vec::Vec;

/// A graph that can be mutated: the six mutations are written once, and asked of the readable [`View`] and of
/// the indexes of a [`Replica`](crate::Replica) alike.
pub(crate) trait Ground {
    /// The dictionary.
    fn dictionary(&self) -> &Dictionary;
    /// The dot of a replica's next event. `[spec: ID-3]`
    fn next_dot(&self, replica: ReplicaId) -> Option<Dot>;
    /// The greatest stamp held. `[spec: STAMP-1]`
    fn greatest_stamp(&self) -> u64;
    /// Whether a vertex is in the graph.
    fn has_vertex(&self, vertex: VertexId) -> bool;
    /// The vertex that a name finds.
    fn vertex_by_name(&self, name: &str) -> Option<VertexId>;
    /// The instance shown under a key.
    fn edge_at(&self, key: &EdgeKey) -> Option<EdgeId>;
    /// Whether this instance is shown.
    fn shows_edge(&self, edge: EdgeId) -> bool;
    /// The edge of a functional label that its source shows.
    fn functional_edge(&self, from: VertexId, label: &Name) -> Option<EdgeKey>;
    /// Where a vertex stands in the kinematic tree.
    fn placement(&self, vertex: VertexId) -> Option<Placement>;
    /// Whether an attribute is shown.
    fn shows_attribute(&self, target: Dot, name: &Name) -> bool;
    /// Every claim held that competes with an edge of this key, shown, hidden or pending. `[spec: STAMP-4]`
    fn register_dots(&self, key: &EdgeKey) -> Vec<Dot>;
    /// Every write held of one attribute.
    fn write_dots(&self, target: Dot, name: &Name) -> Vec<Dot>;

    /// Whether a vertex has a place in the tree, detached or not.
    fn in_tree(&self, vertex: VertexId) -> bool {
        !matches!(self.placement(vertex), None | Some(Placement::Outside))
    }

    /// Whether a vertex is another, or is above it in the tree.
    fn is_above(&self, above: VertexId, vertex: VertexId) -> bool {
        let mut at = vertex;
        loop {
            if at == above {
                return true;
            }
            match self.placement(at) {
                Some(Placement::Child { parent, .. }) => at = parent,
                _ => return false,
            }
        }
    }
}

impl Ground for View<'_> {
    fn dictionary(&self) -> &Dictionary {
        Self::dictionary(self)
    }

    fn next_dot(&self, replica: ReplicaId) -> Option<Dot> {
        self.state().next_dot(replica)
    }

    fn greatest_stamp(&self) -> u64 {
        self.state().greatest_stamp()
    }

    fn has_vertex(&self, vertex: VertexId) -> bool {
        Self::has_vertex(self, vertex)
    }

    fn vertex_by_name(&self, name: &str) -> Option<VertexId> {
        Self::vertex_by_name(self, name)
    }

    fn edge_at(&self, key: &EdgeKey) -> Option<EdgeId> {
        self.edge_by_key(key).map(|shown| shown.id)
    }

    fn shows_edge(&self, edge: EdgeId) -> bool {
        Self::shows_edge(self, edge)
    }

    fn functional_edge(&self, from: VertexId, label: &Name) -> Option<EdgeKey> {
        let held = self.edges_from(from).iter().find(|shown| shown.edge.label == *label);
        held.map(|shown| shown.edge.key())
    }

    fn placement(&self, vertex: VertexId) -> Option<Placement> {
        Self::placement(self, vertex)
    }

    fn shows_attribute(&self, target: Dot, name: &Name) -> bool {
        self.attribute(target, name).is_some()
    }

    fn register_dots(&self, key: &EdgeKey) -> Vec<Dot> {
        super::new_edge::register_of(self.state(), self.dictionary(), key).collect()
    }

    fn write_dots(&self, target: Dot, name: &Name) -> Vec<Dot> {
        super::update_attributes::writes_of(self.state(), target, name).collect()
    }
}
