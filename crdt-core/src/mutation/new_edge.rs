//! What every new edge must satisfy, and the claims that it supersedes: shared by the three mutations that
//! make one.

use super::error::NewEdgeError;
use super::{Draft, Ground};
use crate::dictionary::Dictionary;
use crate::dot::{Dot, VertexId};
use crate::limits;
use crate::record::{Edge, EdgeKey, Record};
use crate::state::State;
use crate::view::Placement;

/// Whether a label may stand on an edge. `[spec: MUT-2.2]`
pub(super) fn check_label(dictionary: &Dictionary, label: &str) -> Result<(), NewEdgeError> {
    let bytes = label.len();
    if bytes == 0 || bytes > limits::NAME_BYTES_MAX {
        return Err(NewEdgeError::LabelLength { bytes });
    }
    if dictionary.allows_label(label) {
        Ok(())
    } else {
        Err(NewEdgeError::UndeclaredLabel { label: label.into() })
    }
}

/// Whether an edge of this key can be added to the view. `[spec: MUT-2.1]` to `[spec: MUT-2.5]`
pub(crate) fn check(view: &impl Ground, key: &EdgeKey) -> Result<(), NewEdgeError> {
    check_label(view.dictionary(), &key.label)?;
    for vertex in [key.from, key.to] {
        if !view.has_vertex(vertex) {
            return Err(NewEdgeError::UnknownVertex { vertex });
        }
    }
    if key.from == key.to {
        return Err(NewEdgeError::SelfLoop { vertex: key.to });
    }
    if let Some(existing) = view.edge_at(key) {
        return Err(NewEdgeError::KeyPresent { key: key.clone(), existing });
    }
    if &*key.label == crate::RT {
        return check_kinematic(view, key);
    }
    if view.dictionary().is_functional(&key.label)
        && let Some(existing) = view.functional_edge(key.from, &key.label)
    {
        return Err(NewEdgeError::FunctionalTaken { label: key.label.clone(), existing });
    }
    Ok(())
}

fn check_kinematic(view: &impl Ground, key: &EdgeKey) -> Result<(), NewEdgeError> {
    let (parent, child) = (key.from, key.to);
    match view.placement(child) {
        Some(Placement::Root) => return Err(NewEdgeError::IntoRoot),
        Some(Placement::Child { parent, .. }) => return Err(NewEdgeError::HasParent { child, parent }),
        _ => {}
    }
    check_parent(view, parent)?;
    if view.is_above(child, parent) {
        return Err(NewEdgeError::Cycle { child, parent });
    }
    Ok(())
}

/// Whether a vertex can be a kinematic parent. `[spec: MUT-2.5]`
pub(super) fn check_parent(view: &impl Ground, parent: VertexId) -> Result<(), NewEdgeError> {
    if view.in_tree(parent) { Ok(()) } else { Err(NewEdgeError::ParentOutsideTree { parent }) }
}

/// Every claim held in `state` that competes with an edge of this key, shown, hidden or pending: the
/// instances of a key; the edges of a functional label of one source; the kinematic claims on one child.
/// `[spec: STAMP-4]` `[spec: MUT-2.6]`
pub(super) fn register_of<'s>(
    state: &'s State,
    dictionary: &'s Dictionary,
    key: &'s EdgeKey,
) -> impl Iterator<Item = Dot> + 's {
    let competes = move |edge: &Edge| {
        edge.label == key.label
            && if edge.is_rt() {
                edge.to == key.to
            } else {
                edge.from == key.from && (edge.to == key.to || dictionary.is_functional(&key.label))
            }
    };
    state.records().filter_map(move |(dot, record)| match record {
        Record::Edge(edge) if competes(edge) => Some(dot),
        _ => None,
    })
}

impl Draft {
    /// Supersedes every claim that competes with this key.
    pub(crate) fn kill_register(&mut self, view: &impl Ground, key: &EdgeKey) {
        for dot in view.register_dots(key) {
            self.delta.kill(dot);
        }
    }

    /// Files an edge with its attributes.
    pub(crate) fn edge(&mut self, key: &EdgeKey, attributes: &super::AttributeMap) {
        let stamp = self.stamp;
        let edge = Edge { from: key.from, to: key.to, label: key.label.clone(), stamp };
        let dot = self.add(Record::Edge(edge));
        self.write_all(dot, attributes);
    }
}
