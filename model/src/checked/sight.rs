//! What is asked of a view beyond its lists, whoever shows it: the readable view, or a replica.

use dsr_core::{Dot, EdgeId, EdgeKey, Placement, Shown, ShownEdge, Shows, Vertex, VertexId, View, Write};

/// A view that mutations and their judges can look at.
pub(crate) trait Sight: Shows {
    /// Vertices that only a repair holds. `[spec: MUT-4.2]`
    fn stranded(&self) -> Vec<VertexId>;

    fn has_vertex(&self, vertex: VertexId) -> bool {
        self.vertices().binary_search(&vertex).is_ok()
    }

    fn vertex(&self, vertex: VertexId) -> Option<&Vertex> {
        self.state().vertex(vertex.0)
    }

    fn edge_by_key(&self, key: &EdgeKey) -> Option<ShownEdge<'_>> {
        let place = |shown: &ShownEdge<'_>| {
            (shown.edge.from, shown.edge.to)
                .cmp(&(key.from, key.to))
                .then_with(|| shown.edge.label.cmp(&key.label))
        };
        self.edges().binary_search_by(place).ok().map(|at| self.edges()[at])
    }

    fn shows_edge(&self, id: EdgeId) -> bool {
        self.edges().iter().any(|shown| shown.id == id)
    }

    fn edges_from(&self, from: VertexId) -> &[ShownEdge<'_>] {
        let edges = self.edges();
        let start = edges.partition_point(|shown| shown.edge.from < from);
        let end = edges.partition_point(|shown| shown.edge.from <= from);
        &edges[start..end]
    }

    fn attribute_writes(&self, target: impl Into<Dot>, name: &str) -> &[(Dot, &Write)] {
        let (target, writes) = (target.into(), self.writes());
        let place = |write: &Write| write.target.cmp(&target).then_with(|| (*write.name).cmp(name));
        let start = writes.partition_point(|(_, write)| place(write).is_lt());
        let end = writes.partition_point(|(_, write)| place(write).is_le());
        &writes[start..end]
    }

    /// From a vertex of the tree upwards, itself included.
    fn ancestors(&self, vertex: VertexId) -> impl Iterator<Item = VertexId> {
        let outside = matches!(self.placement(vertex), None | Some(Placement::Outside));
        core::iter::successors((!outside).then_some(vertex), |&at| match self.placement(at) {
            Some(Placement::Child { parent, .. }) => Some(parent),
            _ => None,
        })
    }
}

impl Sight for View<'_> {
    fn stranded(&self) -> Vec<VertexId> {
        View::stranded(self).to_vec()
    }
}

impl Sight for Shown<'_> {
    fn stranded(&self) -> Vec<VertexId> {
        Shown::stranded(self)
    }
}
