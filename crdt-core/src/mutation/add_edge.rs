//! Mutation 2. `[spec: MUT-2.1]` and following.

use super::{AddEdgeError, AttributeMap, Author, Draft, Ground, attributes, new_edge};
use crate::record::EdgeKey;
use crate::state::Delta;
use crate::view::View;

/// Adds an edge between two live vertices. `[spec: MUT-2]` `[spec: MUT-2.7]`
///
/// Supersedes every claim on its register that the state holds unseen by the view. An `RT` edge needs a
/// child without a kinematic parent and a parent that has a place in the tree and is not below the child.
pub fn add_edge(
    view: &View<'_>,
    author: Author,
    key: &EdgeKey,
    attributes: &AttributeMap,
) -> Result<Delta, AddEdgeError> {
    add_edge_to(view, author, key, attributes)
}

pub(crate) fn add_edge_to(
    view: &impl Ground,
    author: Author,
    key: &EdgeKey,
    attributes: &AttributeMap,
) -> Result<Delta, AddEdgeError> {
    new_edge::check(view, key)?;
    attributes::check(view.dictionary(), attributes.iter())?;
    let mut draft = Draft::new(view, author, 1 + attributes.len())?;
    draft.kill_register(view, key);
    draft.edge(key, attributes);
    Ok(draft.delta)
}
