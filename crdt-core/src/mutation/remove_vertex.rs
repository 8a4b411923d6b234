//! Mutation 6. `[spec: MUT-6.1]` and following.

use super::{Ground, RemoveVertexError, strand};
use crate::dot::VertexId;
use crate::state::Delta;
use crate::view::View;

/// Removes a vertex. The delta is one dead dot: closure takes the edges and the attributes. `[spec: MUT-6]`
///
/// Refused for the root and where it strands others. `[spec: MUT-6.2]` `[spec: MUT-6.3]`
pub fn remove_vertex(view: &View<'_>, vertex: VertexId) -> Result<Delta, RemoveVertexError> {
    let delta = removal_of_vertex(view, vertex)?;
    strand::check(view, &delta)?;
    Ok(delta)
}

/// The removal, stranding or not.
pub(crate) fn removal_of_vertex(view: &impl Ground, vertex: VertexId) -> Result<Delta, RemoveVertexError> {
    if vertex.is_root() {
        return Err(RemoveVertexError::Root);
    }
    if !view.has_vertex(vertex) {
        return Err(RemoveVertexError::UnknownVertex { vertex });
    }
    let mut delta = Delta::new();
    delta.kill(vertex.0);
    Ok(delta)
}
