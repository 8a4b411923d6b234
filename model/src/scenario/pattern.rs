//! Patterns of vertices and edges, by name. `[spec: SCEN-7]`

use super::cursor::{Cursor, Read};
use super::error::Fault;
use super::scope::Scope;
use dsr_core::{Name, ShownEdge, VertexId, View, is_root_name};
use std::fmt;

/// Vertices by name and type; what is left out matches any.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct VertexPattern {
    /// The name.
    pub name: Option<Name>,
    /// The type.
    pub vertex_type: Option<Name>,
}

/// Edges by the names of their ends and by label; what is left out matches any.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct EdgePattern {
    /// The source's name.
    pub from: Option<Name>,
    /// The label.
    pub label: Option<Name>,
    /// The target's name.
    pub to: Option<Name>,
}

fn is_named(view: &View<'_>, vertex: VertexId, name: &str) -> bool {
    if vertex.is_root() {
        is_root_name(name)
    } else {
        view.vertex(vertex).is_some_and(|it| *it.name == *name)
    }
}

impl VertexPattern {
    pub(super) fn read(cursor: &Cursor<'_>, scope: &Scope) -> Read<Self> {
        let object = cursor.object(&["name", "type"])?;
        let name = object.get("name").map(|name| scope.vertex(&name)).transpose()?;
        let vertex_type = object.get("type").map(|kind| scope.vertex_type(&kind)).transpose()?;
        Ok(Self { name, vertex_type })
    }

    pub(super) fn count(&self, view: &View<'_>) -> usize {
        let matches = |vertex: &&VertexId| {
            self.name.as_ref().is_none_or(|name| is_named(view, **vertex, name))
                && self.vertex_type.as_ref().is_none_or(|wanted| {
                    view.vertex(**vertex).is_some_and(|vertex| vertex.vertex_type == *wanted)
                })
        };
        view.vertices().iter().filter(matches).count()
    }
}

impl EdgePattern {
    pub(super) fn read(cursor: &Cursor<'_>, scope: &Scope) -> Read<Self> {
        let object = cursor.object(&["from", "label", "to"])?;
        let from = object.get("from").map(|name| scope.vertex(&name)).transpose()?;
        let label = object.get("label").map(|label| scope.label(&label)).transpose()?;
        let to = object.get("to").map(|name| scope.vertex(&name)).transpose()?;
        Ok(Self { from, label, to })
    }

    /// A pattern that is to match one edge: with a label, and an end at least. `[spec: SCEN-3]`
    pub(super) fn read_one(cursor: &Cursor<'_>, scope: &Scope) -> Read<Self> {
        let pattern = Self::read(cursor, scope)?;
        if pattern.label.is_none() {
            return cursor.fault(Fault::MissingField { field: "label".into() });
        }
        if pattern.from.is_none() && pattern.to.is_none() {
            return cursor.fault(Fault::Needs { field: "label", needed: "`from`, `to` or both" });
        }
        Ok(pattern)
    }

    /// The shown edges that match.
    pub(super) fn matches<'v, 's>(&'v self, view: &'v View<'s>) -> impl Iterator<Item = ShownEdge<'s>> + 'v {
        let named =
            |name: &Option<Name>, vertex| name.as_ref().is_none_or(|name| is_named(view, vertex, name));
        view.edges().iter().copied().filter(move |shown| {
            self.label.as_ref().is_none_or(|label| *label == shown.edge.label)
                && named(&self.from, shown.edge.from)
                && named(&self.to, shown.edge.to)
        })
    }

    /// The one edge that matches, or how many do.
    pub(super) fn the_one<'s>(&self, view: &View<'s>) -> Result<ShownEdge<'s>, usize> {
        let mut matches = self.matches(view);
        match (matches.next(), matches.next()) {
            (Some(edge), None) => Ok(edge),
            (None, _) => Err(0),
            (Some(_), Some(_)) => Err(2 + matches.count()),
        }
    }
}

/// As in `person -in-> *`.
impl fmt::Display for EdgePattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let part = |name: &Option<Name>| name.as_deref().unwrap_or("*").to_owned();
        write!(f, "{} -{}-> {}", part(&self.from), part(&self.label), part(&self.to))
    }
}
