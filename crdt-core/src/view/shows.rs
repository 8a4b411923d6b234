//! The face of a view: what its judges look at.

use super::{Placement, Repair, ShownEdge, View};
use crate::dictionary::Dictionary;
use crate::dot::{Dot, VertexId};
use crate::record::Write;
use crate::state::State;

/// What somebody shows of a state. [`View`] is what this implementation shows; the judges of
/// [`invariant`](crate::invariant) accept whatever anybody else shows as well, and believe nothing of it.
pub trait Shows {
    /// The state that is shown.
    fn state(&self) -> &State;
    /// The dictionary that it is shown under.
    fn dictionary(&self) -> &Dictionary;
    /// Every vertex shown, the root first, then by dot.
    fn vertices(&self) -> &[VertexId];
    /// Every edge shown.
    fn edges(&self) -> &[ShownEdge<'_>];
    /// Where a vertex stands in the kinematic tree.
    fn placement(&self, vertex: VertexId) -> Option<Placement>;
    /// The vertex that a name finds.
    fn vertex_by_name(&self, name: &str) -> Option<VertexId>;
    /// Every write shown, by target and name, the winner of each first.
    fn writes(&self) -> &[(Dot, &Write)];
    /// What is reported as repaired.
    fn repairs(&self) -> &[Repair];
}

impl Shows for View<'_> {
    fn state(&self) -> &State {
        Self::state(self)
    }

    fn dictionary(&self) -> &Dictionary {
        Self::dictionary(self)
    }

    fn vertices(&self) -> &[VertexId] {
        Self::vertices(self)
    }

    fn edges(&self) -> &[ShownEdge<'_>] {
        Self::edges(self)
    }

    fn placement(&self, vertex: VertexId) -> Option<Placement> {
        Self::placement(self, vertex)
    }

    fn vertex_by_name(&self, name: &str) -> Option<VertexId> {
        Self::vertex_by_name(self, name)
    }

    fn writes(&self) -> &[(Dot, &Write)] {
        Self::writes(self)
    }

    fn repairs(&self) -> &[Repair] {
        Self::repairs(self)
    }
}
