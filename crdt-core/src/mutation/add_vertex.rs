//! Mutation 1. `[spec: MUT-1.1]` and following.

use super::{AddVertexError, AttributeMap, Author, Draft, Ground, attributes, new_edge};
use crate::dot::VertexId;
use crate::limits;
use crate::record::{EdgeKey, Name, RT, Record, Vertex};
use crate::state::Delta;
use crate::view::View;

/// A vertex to add.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct NewVertex {
    /// Its type.
    pub vertex_type: Name,
    /// Its name; no vertex of the view may have it.
    pub name: Name,
    /// Its id in the file that it comes from, if any.
    pub external_id: Option<u64>,
    /// Its attributes.
    pub attributes: AttributeMap,
}

impl NewVertex {
    /// A vertex without attributes.
    pub fn new(vertex_type: &str, name: &str) -> Self {
        Self {
            vertex_type: vertex_type.into(),
            name: name.into(),
            external_id: None,
            attributes: AttributeMap::new(),
        }
    }
}

/// The edge that links a new vertex to the graph. `[spec: MUT-1.1]`
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct VertexLink {
    /// The vertex of the graph.
    pub other: VertexId,
    /// The label.
    pub label: Name,
    /// Whether the edge leaves the new vertex (`robot -in-> room`) or enters it (`room -RT-> robot`).
    /// A kinematic link must enter it: the new vertex is the child.
    pub outgoing: bool,
    /// The edge's attributes.
    pub attributes: AttributeMap,
}

impl VertexLink {
    /// `other -RT-> new`.
    pub fn child_of(other: VertexId) -> Self {
        Self { other, label: RT.into(), outgoing: false, attributes: AttributeMap::new() }
    }

    /// `new -label-> other`.
    pub fn to(label: &str, other: VertexId) -> Self {
        Self { other, label: label.into(), outgoing: true, attributes: AttributeMap::new() }
    }
}

/// Whether a name finds the root, whoever asks. `[spec: STATE-4]`
pub fn is_root_name(name: &str) -> bool {
    name == "root" || name == "world"
}

/// Adds a vertex together with the edge that links it to a live one. `[spec: MUT-1]`
///
/// The vertex is `view.state().next_dot(author.replica)`; its edge is the dot after that.
/// `[spec: MUT-1.4]` `[spec: MUT-1.5]`
pub fn add_vertex(
    view: &View<'_>,
    author: Author,
    vertex: &NewVertex,
    link: &VertexLink,
) -> Result<Delta, AddVertexError> {
    add_vertex_to(view, author, vertex, link)
}

pub(crate) fn add_vertex_to(
    view: &impl Ground,
    author: Author,
    vertex: &NewVertex,
    link: &VertexLink,
) -> Result<Delta, AddVertexError> {
    check_vertex(view, vertex)?;
    attributes::check(view.dictionary(), vertex.attributes.iter())?;
    attributes::check(view.dictionary(), link.attributes.iter())?;
    check_link(view, link)?;

    let records = 2 + link.attributes.len() + vertex.attributes.len();
    let mut draft = Draft::new(view, author, records)?;
    let record = Vertex {
        vertex_type: vertex.vertex_type.clone(),
        name: vertex.name.clone(),
        external_id: vertex.external_id,
        stamp: draft.stamp,
    };
    let dot = draft.add(Record::Vertex(record));
    let new = VertexId(dot);
    let (from, to) = if link.outgoing { (new, link.other) } else { (link.other, new) };
    let key = EdgeKey { from, to, label: link.label.clone() };
    // Only a functional label of a live source can have competitors, and then only pending ones.
    // [spec: MUT-1.6]
    draft.kill_register(view, &key);
    draft.edge(&key, &link.attributes);
    draft.write_all(dot, &vertex.attributes);
    Ok(draft.delta)
}

/// Whether type and name may be used, and the name is free. `[spec: MUT-1.2]` `[spec: MUT-1.3]`
fn check_vertex(view: &impl Ground, vertex: &NewVertex) -> Result<(), AddVertexError> {
    for text in [&vertex.vertex_type, &vertex.name] {
        let bytes = text.len();
        if bytes == 0 || bytes > limits::NAME_BYTES_MAX {
            return Err(AddVertexError::NameLength { bytes });
        }
    }
    if !view.dictionary().allows_type(&vertex.vertex_type) {
        return Err(AddVertexError::UndeclaredType { vertex_type: vertex.vertex_type.clone() });
    }
    if is_root_name(&vertex.name) {
        return Err(AddVertexError::ReservedName { name: vertex.name.clone() });
    }
    match view.vertex_by_name(&vertex.name) {
        Some(existing) => Err(AddVertexError::NameTaken { name: vertex.name.clone(), existing }),
        None => Ok(()),
    }
}

/// Whether the link can be made. Its other end may be stranded. `[spec: MUT-1.1]` `[spec: MUT-1.7]`
fn check_link(view: &impl Ground, link: &VertexLink) -> Result<(), super::NewEdgeError> {
    use super::NewEdgeError as E;
    new_edge::check_label(view.dictionary(), &link.label)?;
    if !view.has_vertex(link.other) {
        return Err(E::UnknownVertex { vertex: link.other });
    }
    if &*link.label == RT {
        if link.outgoing {
            let child = link.other;
            return Err(if child.is_root() { E::IntoRoot } else { E::NewVertexAsParent { child } });
        }
        return new_edge::check_parent(view, link.other);
    }
    if !link.outgoing
        && view.dictionary().is_functional(&link.label)
        && let Some(existing) = view.functional_edge(link.other, &link.label)
    {
        return Err(E::FunctionalTaken { label: link.label.clone(), existing });
    }
    Ok(())
}
