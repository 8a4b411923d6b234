//! Mutation 4. `[spec: MUT-4.1]` and following.

use super::{Ground, RemoveEdgeError, strand};
use crate::record::EdgeKey;
use crate::state::Delta;
use crate::view::View;

/// Removes the edge shown under a key, and every claim on its register that the state holds, so that no
/// loser comes back because its winner was removed by hand. `[spec: MUT-4]`
pub fn remove_edge(view: &View<'_>, key: &EdgeKey) -> Result<Delta, RemoveEdgeError> {
    let delta = removal_of_edge(view, key)?;
    strand::check(view, &delta)?;
    Ok(delta)
}

/// The removal, stranding or not.
pub(crate) fn removal_of_edge(view: &impl Ground, key: &EdgeKey) -> Result<Delta, RemoveEdgeError> {
    if view.edge_at(key).is_none() {
        return Err(RemoveEdgeError::UnknownEdge { key: key.clone() });
    }
    let mut delta = Delta::new();
    for dot in view.register_dots(key) {
        delta.kill(dot);
    }
    Ok(delta)
}
