//! No mutation strands a vertex, as far as its author can see. `[spec: MUT-4.2]`

use super::error::StrandError;
use crate::dot::VertexId;
use crate::state::Delta;
use crate::view::{View, view};

/// Refuses a delta after which a vertex would be stranded that is not so before: left without a path to
/// the root, or at the top of a kinematic tree that is not the root's.
pub(super) fn check(before: &View<'_>, delta: &Delta) -> Result<(), StrandError> {
    let state = before.state().joined(delta);
    let after = view(&state, before.dictionary());
    let was = before.stranded();
    let vertices: alloc::vec::Vec<VertexId> =
        after.stranded().iter().filter(|vertex| was.binary_search(vertex).is_err()).copied().collect();
    if vertices.is_empty() { Ok(()) } else { Err(StrandError { vertices }) }
}
