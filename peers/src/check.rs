//! The conditions of the six mutations, judged over what the author's document shows.

use crate::edit::{Edit, Target};
use crate::graph::{Attributes, Graph};
use crate::refusal::{AttributeRefusal, EdgeRefusal, Refusal};
use dsr_conformance::protocol::{EdgeName, Link, Mutation, ROOT, Tagged};
use dsr_core::{Dictionary, RT, is_root_name, limits};

/// Why a request cannot be carried out.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum CheckError {
    /// A condition does not hold.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// A link has both ends, or none.
    #[error("a link has either `from` or `to`: give exactly one")]
    Link,
    /// Both a vertex and an edge are to be updated, or nothing.
    #[error("update_attributes has either `vertex` or `edge`: give exactly one")]
    Target,
}

const fn fits(bytes: usize) -> bool {
    bytes > 0 && bytes <= limits::NAME_BYTES_MAX
}

/// The mutation, if all conditions hold that can be judged before it; see [`strands`] for the other.
pub fn check(graph: &Graph, dictionary: &Dictionary, mutation: &Mutation) -> Result<Edit, CheckError> {
    Ok(match mutation.clone() {
        Mutation::AddVertex { r#as: handle, r#type: vertex_type, name, attributes, link } => {
            let (attributes, link_attributes) = (attributes.0, link.attributes.0.clone());
            let link = link_edge(&link, &handle)?;
            new_vertex(graph, dictionary, &vertex_type, &name)?;
            attributes_fit(dictionary, &attributes).map_err(Refusal::Attribute)?;
            attributes_fit(dictionary, &link_attributes).map_err(Refusal::Attribute)?;
            new_link(graph, dictionary, &link, &handle).map_err(Refusal::Link)?;
            Edit::AddVertex { handle, vertex_type, name, attributes, link, link_attributes }
        }
        Mutation::AddEdge { from, label, to, attributes } => {
            let (edge, attributes) = (EdgeName { from, label, to }, attributes.0);
            new_edge(graph, dictionary, &edge).map_err(Refusal::NewEdge)?;
            attributes_fit(dictionary, &attributes).map_err(Refusal::Attribute)?;
            Edit::AddEdge { edge, attributes }
        }
        Mutation::UpdateAttributes { vertex, edge, attributes } => {
            let updates = attributes.0;
            let (target, held) = match (vertex, edge) {
                (Some(vertex), None) if vertex == ROOT => (Target::Vertex(vertex), Some(&graph.root)),
                (Some(vertex), None) => {
                    let held = graph.vertices.get(&vertex).map(|shown| &shown.attributes);
                    (Target::Vertex(vertex), held)
                }
                (None, Some(edge)) => {
                    let held = graph.edges.get(&edge);
                    (Target::Edge(edge), held)
                }
                _ => return Err(CheckError::Target),
            };
            updates_fit(dictionary, held.ok_or(Refusal::UnknownTarget)?, &updates)?;
            Edit::Update { target, updates }
        }
        Mutation::RemoveEdge { from, label, to } => {
            let edge = EdgeName { from, label, to };
            if !graph.edges.contains_key(&edge) {
                return Err(Refusal::UnknownEdge.into());
            }
            Edit::RemoveEdge { edge }
        }
        Mutation::MoveEdge { old, new, attributes } => {
            moved_edge(graph, dictionary, &old, &new, &attributes.0)?;
            Edit::MoveEdge { old, new, attributes: attributes.0 }
        }
        Mutation::RemoveVertex { vertex } if vertex == ROOT => return Err(Refusal::Root.into()),
        Mutation::RemoveVertex { vertex } if !graph.has(&vertex) => {
            return Err(Refusal::UnknownVertex(vertex).into());
        }
        Mutation::RemoveVertex { vertex } => Edit::RemoveVertex { handle: vertex },
    })
}

/// Whether an edit strands a vertex: what is shown before and after it. Those that add never do (MUT-4.2).
pub fn strands(before: &Graph, after: &Graph) -> Result<(), Refusal> {
    let was = before.stranded();
    let is = after.stranded();
    let stranded: Vec<String> = is.difference(&was).map(|vertex| (*vertex).into()).collect();
    if stranded.is_empty() { Ok(()) } else { Err(Refusal::Strands(stranded)) }
}

fn link_edge(link: &Link, new: &str) -> Result<EdgeName, CheckError> {
    let (from, to) = match (&link.from, &link.to) {
        (Some(from), None) => (from.clone(), new.into()),
        (None, Some(to)) => (new.into(), to.clone()),
        _ => return Err(CheckError::Link),
    };
    Ok(EdgeName { from, label: link.label.clone(), to })
}

/// Whether a vertex of this type and name may be made (MUT-1.2, MUT-1.3).
fn new_vertex(graph: &Graph, dictionary: &Dictionary, vertex_type: &str, name: &str) -> Result<(), Refusal> {
    if let Some(text) = [vertex_type, name].into_iter().find(|text| !fits(text.len())) {
        return Err(Refusal::NameLength(text.len()));
    }
    if !dictionary.allows_type(vertex_type) {
        return Err(Refusal::UndeclaredType(vertex_type.into()));
    }
    if is_root_name(name) {
        return Err(Refusal::ReservedName(name.into()));
    }
    match graph.vertices.iter().find(|(_, vertex)| vertex.name == name) {
        Some((existing, _)) => Err(Refusal::NameTaken { name: name.into(), existing: existing.clone() }),
        None => Ok(()),
    }
}

/// Whether a new vertex may be linked so (MUT-1.1).
fn new_link(graph: &Graph, dictionary: &Dictionary, link: &EdgeName, new: &str) -> Result<(), EdgeRefusal> {
    let leaves = link.from == new;
    let other = if leaves { &link.to } else { &link.from };
    label_fits(dictionary, &link.label)?;
    if !graph.has(other) {
        return Err(EdgeRefusal::UnknownVertex(other.clone()));
    }
    if link.label == RT {
        return match (leaves, other.as_str()) {
            (true, ROOT) => Err(EdgeRefusal::IntoRoot),
            (true, _) => Err(EdgeRefusal::NewVertexAsParent(other.clone())),
            (false, _) => parent_fits(graph, other),
        };
    }
    if leaves { Ok(()) } else { register_is_free(graph, dictionary, link) }
}

fn label_fits(dictionary: &Dictionary, label: &str) -> Result<(), EdgeRefusal> {
    if !fits(label.len()) {
        return Err(EdgeRefusal::LabelLength(label.len()));
    }
    if dictionary.allows_label(label) { Ok(()) } else { Err(EdgeRefusal::UndeclaredLabel(label.into())) }
}

fn parent_fits(graph: &Graph, parent: &str) -> Result<(), EdgeRefusal> {
    if graph.in_tree(parent) { Ok(()) } else { Err(EdgeRefusal::ParentOutsideTree(parent.into())) }
}

/// Whether no edge of the same functional label is shown (MUT-2.4).
fn register_is_free(graph: &Graph, dictionary: &Dictionary, edge: &EdgeName) -> Result<(), EdgeRefusal> {
    let is_taken = dictionary.is_functional(&edge.label)
        && graph.edges.keys().any(|held| held.from == edge.from && held.label == edge.label);
    if is_taken { Err(EdgeRefusal::FunctionalTaken(edge.label.clone())) } else { Ok(()) }
}

/// Whether an edge may be made (MUT-2.1 to MUT-2.5).
fn new_edge(graph: &Graph, dictionary: &Dictionary, edge: &EdgeName) -> Result<(), EdgeRefusal> {
    label_fits(dictionary, &edge.label)?;
    if let Some(end) = [&edge.from, &edge.to].into_iter().find(|end| !graph.has(end)) {
        return Err(EdgeRefusal::UnknownVertex(end.clone()));
    }
    if edge.from == edge.to {
        return Err(EdgeRefusal::SelfLoop(edge.from.clone()));
    }
    if graph.edges.contains_key(edge) {
        return Err(EdgeRefusal::KeyPresent);
    }
    if edge.label != RT {
        return register_is_free(graph, dictionary, edge);
    }
    let (parent, child) = (&edge.from, &edge.to);
    if child == ROOT {
        return Err(EdgeRefusal::IntoRoot);
    }
    if let Some(held) = graph.parent(child) {
        return Err(EdgeRefusal::HasParent { child: child.clone(), parent: held.into() });
    }
    parent_fits(graph, parent)?;
    if graph.is_at_or_above(child, parent) {
        return Err(EdgeRefusal::Cycle { child: child.clone(), parent: parent.clone() });
    }
    Ok(())
}

/// Whether an edge may be moved (MUT-5.1 to MUT-5.3).
fn moved_edge(
    graph: &Graph,
    dictionary: &Dictionary,
    old: &EdgeName,
    new: &EdgeName,
    attributes: &Attributes,
) -> Result<(), Refusal> {
    if !graph.edges.contains_key(old) {
        return Err(Refusal::UnknownEdge);
    }
    if old == new {
        return Err(Refusal::SameKey);
    }
    attributes_fit(dictionary, attributes).map_err(Refusal::Attribute)?;
    let mut without = graph.clone();
    without.edges.remove(old);
    new_edge(&without, dictionary, new).map_err(Refusal::Edge)
}

/// Whether attributes may be given (MUT-3.2).
fn attributes_fit(dictionary: &Dictionary, attributes: &Attributes) -> Result<(), AttributeRefusal> {
    if attributes.len() > limits::ATTRIBUTES_MAX {
        return Err(AttributeRefusal::TooMany(attributes.len()));
    }
    attributes.iter().try_for_each(|(name, value)| attribute_fits(dictionary, name, value))
}

fn attribute_fits(dictionary: &Dictionary, name: &str, value: &Tagged) -> Result<(), AttributeRefusal> {
    if !fits(name.len()) {
        return Err(AttributeRefusal::NameLength(name.len()));
    }
    if dictionary.closed && dictionary.attribute_type(name).is_none() {
        return Err(AttributeRefusal::Undeclared(name.into()));
    }
    if !dictionary.allows_attribute(name, value.0.value_type()) {
        return Err(AttributeRefusal::WrongType(name.into()));
    }
    let bytes = value.0.payload_bytes();
    if bytes > limits::VALUE_BYTES_MAX {
        return Err(AttributeRefusal::ValueSize { name: name.into(), bytes });
    }
    Ok(())
}

/// Whether attributes may be updated (MUT-3.2 to MUT-3.4).
fn updates_fit(
    dictionary: &Dictionary,
    held: &Attributes,
    updates: &std::collections::BTreeMap<String, Option<Tagged>>,
) -> Result<(), Refusal> {
    if updates.is_empty() {
        return Err(Refusal::Empty);
    }
    if updates.len() > limits::ATTRIBUTES_MAX {
        return Err(Refusal::Update(AttributeRefusal::TooMany(updates.len())));
    }
    updates.iter().try_for_each(|(name, value)| match value {
        Some(value) => attribute_fits(dictionary, name, value).map_err(Refusal::Update),
        None if !held.contains_key(name) => Err(Refusal::NotSet(name.clone())),
        None => Ok(()),
    })
}
