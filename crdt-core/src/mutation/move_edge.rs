//! Mutation 5. `[spec: MUT-5.1]` and following.

use super::{AttributeMap, Author, Draft, Ground, MoveEdgeError, attributes, new_edge, strand};
use crate::record::EdgeKey;
use crate::state::Delta;
use crate::view::{View, view};

/// Moves the edge shown under one key to another, in one delta: re-parenting, changing rooms, the next
/// step of an action. `[spec: MUT-5]`
///
/// The edge under the new key is a new instance and has exactly the given attributes. Old and new register
/// are superseded, and nothing is stranded. `[spec: MUT-5.2]` `[spec: MUT-5.4]` `[spec: MUT-5.5]`
pub fn move_edge(
    view_before: &View<'_>,
    author: Author,
    from: &EdgeKey,
    to: &EdgeKey,
    attributes: &AttributeMap,
) -> Result<Delta, MoveEdgeError> {
    let mut draft = departure(view_before, author, from, to, attributes)?;
    // The new edge must be possible where the old one is gone. [spec: MUT-5.3]
    let removed = view_before.state().joined(&draft.delta);
    new_edge::check(&view(&removed, view_before.dictionary()), to)?;
    draft.kill_register(view_before, to);
    draft.edge(to, attributes);
    strand::check(view_before, &draft.delta)?;
    Ok(draft.delta)
}

/// The removal of the old register, if all but the new edge and what it strands allows the move.
pub(crate) fn departure(
    view: &impl Ground,
    author: Author,
    from: &EdgeKey,
    to: &EdgeKey,
    attributes: &AttributeMap,
) -> Result<Draft, MoveEdgeError> {
    if view.edge_at(from).is_none() {
        return Err(MoveEdgeError::UnknownEdge { key: from.clone() });
    }
    if from == to {
        return Err(MoveEdgeError::SameKey { key: from.clone() });
    }
    attributes::check(view.dictionary(), attributes.iter())?;
    let mut draft = Draft::new(view, author, 1 + attributes.len())?;
    draft.kill_register(view, from);
    Ok(draft)
}
