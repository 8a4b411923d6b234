//! Handles of vertices, and mutations with dots in their place. `[spec: CONF-5]`

use super::refused;
use crate::protocol::{Decline, EdgeName, ErrorCode, Link, Mutation, ROOT, Tagged, Unique};
use dsr_core::{
    AttributeMap, EdgeKey, ElementId, Mutation as Resolved, NewVertex, ReplicaId, VertexId, VertexLink, View,
};
use std::collections::BTreeMap;

/// The handles of one case, shared by its replicas.
#[derive(Clone, Debug, Default)]
pub(crate) struct Handles {
    ids: BTreeMap<String, VertexId>,
    names: BTreeMap<VertexId, String>,
}

impl Handles {
    /// The handle of a vertex, or its dot if the harness has not named it.
    pub(super) fn name(&self, id: VertexId) -> String {
        if id.is_root() {
            ROOT.into()
        } else {
            self.names.get(&id).cloned().unwrap_or_else(|| id.to_string())
        }
    }

    /// The handle of a vertex, if it has one.
    pub(crate) fn given(&self, id: VertexId) -> Option<String> {
        if id.is_root() { Some(ROOT.into()) } else { self.names.get(&id).cloned() }
    }

    /// Gives a vertex a handle after its name, with a number where that is taken.
    pub(crate) fn name_after(&mut self, name: &str, id: VertexId) {
        let taken = name == ROOT || self.ids.contains_key(name);
        let handle = if taken { format!("{name}-{}", self.ids.len()) } else { name.into() };
        self.ids.insert(handle.clone(), id);
        self.names.insert(id, handle);
    }

    fn id(&self, handle: &str) -> Result<VertexId, Decline> {
        if handle == ROOT {
            return Ok(VertexId::ROOT);
        }
        let unknown = || Decline::error(ErrorCode::Unknown, format!("no vertex has the handle {handle:?}"));
        self.ids.get(handle).copied().ok_or_else(unknown)
    }

    fn key(&self, from: &str, label: &str, to: &str) -> Result<EdgeKey, Decline> {
        Ok(EdgeKey::new(self.id(from)?, label, self.id(to)?))
    }

    fn key_of(&self, name: &EdgeName) -> Result<EdgeKey, Decline> {
        self.key(&name.from, &name.label, &name.to)
    }

    /// The mutation as the core has it. A new vertex gets the author's next dot (MUT-1.5), and its handle.
    pub(super) fn resolve(
        &mut self,
        mutation: &Mutation,
        view: &View<'_>,
        author: ReplicaId,
    ) -> Result<Resolved, Decline> {
        Ok(match mutation {
            Mutation::AddVertex { r#as, r#type, name, attributes, link } => {
                let mut vertex = NewVertex::new(r#type, name);
                vertex.attributes = of(attributes);
                let link = self.link(link)?;
                self.bind(r#as, view.state().next_dot(author).map(VertexId))?;
                Resolved::AddVertex { vertex, link }
            }
            Mutation::AddEdge { from, label, to, attributes } => {
                Resolved::AddEdge { key: self.key(from, label, to)?, attributes: of(attributes) }
            }
            Mutation::UpdateAttributes { vertex, edge, attributes } => {
                let target = self.target(vertex.as_deref(), edge.as_ref(), view)?;
                let updates = attributes.0.iter();
                let value = |value: &Option<Tagged>| value.as_ref().map(|value| value.0.clone());
                let updates = updates.map(|(name, given)| (name.as_str().into(), value(given))).collect();
                Resolved::UpdateAttributes { target, updates }
            }
            Mutation::RemoveEdge { from, label, to } => {
                Resolved::RemoveEdge { key: self.key(from, label, to)? }
            }
            Mutation::MoveEdge { old, new, attributes } => Resolved::MoveEdge {
                from: self.key_of(old)?,
                to: self.key_of(new)?,
                attributes: of(attributes),
            },
            Mutation::RemoveVertex { vertex } => Resolved::RemoveVertex { vertex: self.id(vertex)? },
        })
    }

    fn link(&self, link: &Link) -> Result<VertexLink, Decline> {
        let (other, outgoing) = match (&link.from, &link.to) {
            (Some(from), None) => (from, false),
            (None, Some(to)) => (to, true),
            _ => return Err(rejected("a link has either `from` or `to`")),
        };
        let other = self.id(other)?;
        Ok(VertexLink {
            other,
            label: link.label.as_str().into(),
            outgoing,
            attributes: of(&link.attributes),
        })
    }

    fn target(
        &self,
        vertex: Option<&str>,
        edge: Option<&EdgeName>,
        view: &View<'_>,
    ) -> Result<ElementId, Decline> {
        match (vertex, edge) {
            (Some(vertex), None) => Ok(ElementId::Vertex(self.id(vertex)?)),
            (None, Some(edge)) => {
                let key = self.key_of(edge)?;
                let shown = view.edge_by_key(&key).map(|shown| ElementId::Edge(shown.id));
                shown.ok_or_else(|| refused(format!("no edge {key} is shown"), Some("UnknownTarget".into())))
            }
            _ => Err(rejected("update_attributes has either `vertex` or `edge`")),
        }
    }

    fn bind(&mut self, handle: &str, id: Option<VertexId>) -> Result<(), Decline> {
        if handle == ROOT || self.ids.contains_key(handle) {
            return Err(rejected(&format!("the handle {handle:?} names a vertex already")));
        }
        // Without a next dot the core refuses the mutation.
        if let Some(id) = id {
            self.ids.insert(handle.into(), id);
            self.names.insert(id, handle.into());
        }
        Ok(())
    }
}

fn rejected(message: &str) -> Decline {
    Decline::error(ErrorCode::RejectedInput, message)
}

fn of(attributes: &Unique<Tagged>) -> AttributeMap {
    attributes.0.iter().map(|(name, value)| (name.as_str().into(), value.0.clone())).collect()
}
