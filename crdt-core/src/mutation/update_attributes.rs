//! Mutation 3. `[spec: MUT-3.1]` and following.

use super::{AttributeError, AttributeUpdates, Author, Draft, Ground, UpdateAttributesError, attributes};
use crate::dot::{Dot, EdgeId, VertexId};
use crate::limits;
use crate::record::{Name, Record};
use crate::state::{Delta, State};
use crate::view::View;
use core::fmt;

/// A vertex, the root, or an edge instance: what has attributes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum ElementId {
    /// A vertex or the root.
    Vertex(VertexId),
    /// An edge.
    Edge(EdgeId),
}

impl ElementId {
    /// The dot that names it.
    pub fn dot(self) -> Dot {
        match self {
            Self::Vertex(vertex) => vertex.0,
            Self::Edge(edge) => edge.0,
        }
    }
}

impl From<ElementId> for Dot {
    fn from(element: ElementId) -> Self {
        element.dot()
    }
}

impl fmt::Display for ElementId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Vertex(vertex) => write!(f, "vertex {vertex}"),
            Self::Edge(edge) => write!(f, "edge {edge}"),
        }
    }
}

/// Sets and unsets attributes of a vertex in the graph or of an edge that is shown. `[spec: MUT-3]`
///
/// Kills every write of each given attribute that the state holds; *unset* adds none, so that a concurrent
/// write survives it. The register of an edge is left alone. `[spec: MUT-3.5]` `[spec: MUT-3.6]`
pub fn update_attributes(
    view: &View<'_>,
    author: Author,
    target: ElementId,
    updates: &AttributeUpdates,
) -> Result<Delta, UpdateAttributesError> {
    update_attributes_of(view, author, target, updates)
}

pub(crate) fn update_attributes_of(
    view: &impl Ground,
    author: Author,
    target: ElementId,
    updates: &AttributeUpdates,
) -> Result<Delta, UpdateAttributesError> {
    let present = match target {
        ElementId::Vertex(vertex) => view.has_vertex(vertex),
        ElementId::Edge(edge) => view.shows_edge(edge),
    };
    if !present {
        return Err(UpdateAttributesError::UnknownTarget { target });
    }
    check(view, target, updates)?;
    let mut delta = Delta::new();
    for name in updates.keys() {
        for dot in view.write_dots(target.dot(), name) {
            delta.kill(dot);
        }
    }
    let sets = updates.iter().filter_map(|(name, value)| Some((name, value.as_ref()?)));
    let records = sets.clone().count();
    if records == 0 {
        // An unset makes no record, so it needs neither a dot nor a stamp. [spec: MUT-0.3]
        return Ok(delta);
    }
    let mut draft = Draft { delta, ..Draft::new(view, author, records)? };
    sets.for_each(|(name, value)| draft.write(target.dot(), name, value));
    Ok(draft.delta)
}

/// Whether there is something to do, and it can be done. `[spec: MUT-3.3]` `[spec: MUT-3.4]`
fn check(
    view: &impl Ground,
    target: ElementId,
    updates: &AttributeUpdates,
) -> Result<(), UpdateAttributesError> {
    if updates.is_empty() {
        return Err(UpdateAttributesError::Empty);
    }
    if updates.len() > limits::ATTRIBUTES_MAX {
        return Err(AttributeError::TooMany { count: updates.len() }.into());
    }
    for (name, value) in updates {
        match value {
            Some(value) => attributes::check_one(view.dictionary(), name, value)?,
            None if !view.shows_attribute(target.dot(), name) => {
                return Err(UpdateAttributesError::NotSet { target, name: name.clone() });
            }
            None => {}
        }
    }
    Ok(())
}

/// Every write of one attribute that the state holds.
pub(super) fn writes_of<'s>(state: &'s State, target: Dot, name: &'s Name) -> impl Iterator<Item = Dot> + 's {
    state.records().filter_map(move |(dot, record)| match record {
        Record::Write(write) if write.target == target && write.name == *name => Some(dot),
        _ => None,
    })
}
