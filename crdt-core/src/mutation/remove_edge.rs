//! Mutation 4. `[spec: MUT-4.1]` and following.

use super::{RemoveEdgeError, new_edge, strand};
use crate::record::EdgeKey;
use crate::state::Delta;
use crate::view::View;

/// Removes the edge shown under a key, and every claim on its register that the state holds, so that no
/// loser comes back because its winner was removed by hand. `[spec: MUT-4]`
pub fn remove_edge(view: &View<'_>, key: &EdgeKey) -> Result<Delta, RemoveEdgeError> {
    if view.edge_by_key(key).is_none() {
        return Err(RemoveEdgeError::UnknownEdge { key: key.clone() });
    }
    let mut delta = Delta::new();
    for dot in new_edge::register_of(view.state(), view.dictionary(), key) {
        delta.kill(dot);
    }
    strand::check(view, &delta)?;
    Ok(delta)
}
