//! Mutations that name vertices by name. `[spec: SCEN-3]`

use super::cursor::{Cursor, Read};
use super::error::Fault;
use super::pattern::EdgePattern;
use super::scope::Scope;
use dsr_core::{
    AttributeMap, AttributeUpdates, EdgeKey, ElementId, Mutation, Name, NewVertex, RT, VertexId, VertexLink,
    View,
};
use std::fmt;

/// An edge key by names.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct NamedKey {
    /// The source.
    pub from: Name,
    /// The label.
    pub label: Name,
    /// The target.
    pub to: Name,
}

/// What has attributes, by name.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum NamedTarget {
    /// The vertex that the name finds.
    Vertex(Name),
    /// The one edge that matches.
    Edge(EdgePattern),
}

/// One of the six mutations, naming vertices by name. `[spec: SCEN-3]`
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum NamedMutation {
    /// A vertex with its link.
    AddVertex {
        /// The vertex.
        vertex: NewVertex,
        /// The other end of the link.
        other: Name,
        /// The link's label.
        label: Name,
        /// Whether the link leaves the new vertex.
        outgoing: bool,
        /// The link's attributes.
        attributes: AttributeMap,
    },
    /// An edge.
    AddEdge {
        /// Its key.
        key: NamedKey,
        /// Its attributes.
        attributes: AttributeMap,
    },
    /// Attributes.
    UpdateAttributes {
        /// Whose.
        target: NamedTarget,
        /// What becomes of them.
        updates: AttributeUpdates,
    },
    /// The removal of an edge.
    RemoveEdge {
        /// Which.
        edge: EdgePattern,
    },
    /// An edge to another key.
    MoveEdge {
        /// Which.
        old: EdgePattern,
        /// Where to.
        new: NamedKey,
        /// Its attributes there.
        attributes: AttributeMap,
    },
    /// The removal of a vertex.
    RemoveVertex {
        /// Which.
        vertex: Name,
    },
}

/// Why names do not find what a mutation needs.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Unresolved {
    /// A name finds nothing.
    #[error("no vertex is named {name:?}")]
    Vertex {
        /// The name.
        name: Name,
    },
    /// A pattern matches no edge, or several.
    #[error("{found} edges match {pattern}, not one")]
    Edge {
        /// The pattern.
        pattern: EdgePattern,
        /// How many match.
        found: usize,
    },
}

const KINDS: &[&str] =
    &["add_vertex", "add_edge", "update_attributes", "remove_edge", "move_edge", "remove_vertex"];

impl NamedKey {
    fn read(cursor: &Cursor<'_>, scope: &Scope, fields: &'static [&'static str]) -> Read<Self> {
        let object = cursor.object(fields)?;
        let from = scope.vertex(&object.need("from")?)?;
        let to = scope.vertex(&object.need("to")?)?;
        if from == to {
            return cursor.fault(Fault::Repeated { what: "end of this edge", name: from.to_string() });
        }
        Ok(Self { from, label: scope.label(&object.need("label")?)?, to })
    }

    fn resolve(&self, view: &View<'_>) -> Result<EdgeKey, Unresolved> {
        Ok(EdgeKey { from: find(view, &self.from)?, label: self.label.clone(), to: find(view, &self.to)? })
    }
}

fn find(view: &View<'_>, name: &Name) -> Result<VertexId, Unresolved> {
    view.vertex_by_name(name).ok_or_else(|| Unresolved::Vertex { name: name.clone() })
}

fn the_one(view: &View<'_>, pattern: &EdgePattern) -> Result<(ElementId, EdgeKey), Unresolved> {
    match pattern.the_one(view) {
        Ok(shown) => Ok((ElementId::Edge(shown.id), shown.edge.key())),
        Err(found) => Err(Unresolved::Edge { pattern: pattern.clone(), found }),
    }
}

impl NamedMutation {
    pub(super) fn read(cursor: &Cursor<'_>, scope: &Scope) -> Read<Self> {
        let (kind, body) = cursor.variant(KINDS)?;
        match kind {
            "add_vertex" => read_add_vertex(&body, scope),
            "add_edge" => {
                let key = NamedKey::read(&body, scope, &["from", "label", "to", "attributes"])?;
                let object = body.object(&["from", "label", "to", "attributes"])?;
                Ok(Self::AddEdge { key, attributes: scope.attributes(object.get("attributes").as_ref())? })
            }
            "update_attributes" => read_update(&body, scope),
            "remove_edge" => Ok(Self::RemoveEdge { edge: EdgePattern::read_one(&body, scope)? }),
            "move_edge" => {
                let object = body.object(&["old", "new", "attributes"])?;
                Ok(Self::MoveEdge {
                    old: EdgePattern::read_one(&object.need("old")?, scope)?,
                    new: NamedKey::read(&object.need("new")?, scope, &["from", "label", "to"])?,
                    attributes: scope.attributes(object.get("attributes").as_ref())?,
                })
            }
            _ => {
                let object = body.object(&["vertex"])?;
                Ok(Self::RemoveVertex { vertex: scope.vertex(&object.need("vertex")?)? })
            }
        }
    }

    /// The name of the vertex that a mutation of this form would add, before names are known.
    pub(super) fn name_added(cursor: &Cursor<'_>) -> Option<Name> {
        let name = cursor.value.get("add_vertex")?.get("name")?;
        name.as_str().map(Into::into)
    }

    /// The mutation in a view.
    pub fn resolve(&self, view: &View<'_>) -> Result<Mutation, Unresolved> {
        Ok(match self {
            Self::AddVertex { vertex, other, label, outgoing, attributes } => {
                let (other, label) = (find(view, other)?, label.clone());
                let link = VertexLink { other, label, outgoing: *outgoing, attributes: attributes.clone() };
                Mutation::AddVertex { vertex: vertex.clone(), link }
            }
            Self::AddEdge { key, attributes } => {
                Mutation::AddEdge { key: key.resolve(view)?, attributes: attributes.clone() }
            }
            Self::UpdateAttributes { target, updates } => {
                let target = match target {
                    NamedTarget::Vertex(name) => ElementId::Vertex(find(view, name)?),
                    NamedTarget::Edge(pattern) => the_one(view, pattern)?.0,
                };
                Mutation::UpdateAttributes { target, updates: updates.clone() }
            }
            Self::RemoveEdge { edge } => Mutation::RemoveEdge { key: the_one(view, edge)?.1 },
            Self::MoveEdge { old, new, attributes } => Mutation::MoveEdge {
                from: the_one(view, old)?.1,
                to: new.resolve(view)?,
                attributes: attributes.clone(),
            },
            Self::RemoveVertex { vertex } => Mutation::RemoveVertex { vertex: find(view, vertex)? },
        })
    }
}

fn read_add_vertex(body: &Cursor<'_>, scope: &Scope) -> Read<NamedMutation> {
    let object = body.object(&["type", "name", "attributes", "link"])?;
    let vertex = NewVertex {
        vertex_type: scope.vertex_type(&object.need("type")?)?,
        name: Scope::new_vertex(&object.need("name")?)?,
        external_id: None,
        attributes: scope.attributes(object.get("attributes").as_ref())?,
    };
    let cursor = object.need("link")?;
    let link = cursor.object(&["from", "label", "to", "attributes"])?;
    let (outgoing, other) = match (link.get("from"), link.get("to")) {
        (Some(from), None) => (false, scope.vertex(&from)?),
        (None, Some(to)) => (true, scope.vertex(&to)?),
        (from, _) => {
            let found = if from.is_some() { 2 } else { 0 };
            return cursor.fault(Fault::NotOneOf { allowed: &["from", "to"], found });
        }
    };
    let label = scope.label(&link.need("label")?)?;
    if &*label == RT && outgoing {
        return cursor.fault(Fault::Needs {
            field: "label",
            needed: "`from`, its parent, for a kinematic link: `to`",
        });
    }
    let attributes = scope.attributes(link.get("attributes").as_ref())?;
    Ok(NamedMutation::AddVertex { vertex, other, label, outgoing, attributes })
}

fn read_update(body: &Cursor<'_>, scope: &Scope) -> Read<NamedMutation> {
    let object = body.object(&["vertex", "edge", "attributes"])?;
    let target = match (object.get("vertex"), object.get("edge")) {
        (Some(vertex), None) => NamedTarget::Vertex(scope.vertex(&vertex)?),
        (None, Some(edge)) => NamedTarget::Edge(EdgePattern::read_one(&edge, scope)?),
        (vertex, _) => {
            let found = if vertex.is_some() { 2 } else { 0 };
            return body.fault(Fault::NotOneOf { allowed: &["vertex", "edge"], found });
        }
    };
    Ok(NamedMutation::UpdateAttributes { target, updates: scope.updates(&object.need("attributes")?)? })
}

/// As in `add_edge person -in-> bed`.
impl fmt::Display for NamedMutation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AddVertex { vertex, other, label, outgoing: true, .. } => {
                write!(f, "add_vertex {} -{label}-> {other}", vertex.name)
            }
            Self::AddVertex { vertex, other, label, .. } => {
                write!(f, "add_vertex {other} -{label}-> {}", vertex.name)
            }
            Self::AddEdge { key, .. } => write!(f, "add_edge {} -{}-> {}", key.from, key.label, key.to),
            Self::UpdateAttributes { target, updates } => {
                match target {
                    NamedTarget::Vertex(name) => write!(f, "update_attributes {name}")?,
                    NamedTarget::Edge(pattern) => write!(f, "update_attributes {pattern}")?,
                }
                updates.iter().try_for_each(|(name, value)| match value {
                    Some(value) => write!(f, " {name}={value}"),
                    None => write!(f, " unset {name}"),
                })
            }
            Self::RemoveEdge { edge } => write!(f, "remove_edge {edge}"),
            Self::MoveEdge { old, new, .. } => {
                write!(f, "move_edge {old} to {} -{}-> {}", new.from, new.label, new.to)
            }
            Self::RemoveVertex { vertex } => write!(f, "remove_vertex {vertex}"),
        }
    }
}
