//! What vertices are called on the screen.

use crate::output::plain;
use dsr_core::scene::{RootNaming, Scene};
use dsr_core::{Value, VertexId, View};

/// A graph with the names of its scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Named<'n> {
    pub(super) view: &'n View<'n>,
    root: &'n RootNaming,
}

impl<'n> Named<'n> {
    pub(super) fn new(scene: &'n Scene, view: &'n View<'n>) -> Self {
        Self { view, root: &scene.root }
    }

    /// The name as it is in the file.
    pub(super) fn raw_name(&self, vertex: VertexId) -> &'n str {
        self.view.vertex(vertex).map_or(&self.root.name, |record| &record.name)
    }

    /// The name for the screen; with its dot where the name finds another vertex.
    pub(super) fn name(&self, vertex: VertexId) -> String {
        let name = self.raw_name(vertex);
        let unique = vertex.is_root() || self.view.vertex_by_name(name) == Some(vertex);
        if unique { plain(name) } else { format!("{}[{vertex}]", plain(name)) }
    }

    pub(super) fn vertex_type(&self, vertex: VertexId) -> &'n str {
        self.view.vertex(vertex).map_or(&self.root.vertex_type, |record| &record.vertex_type)
    }

    pub(super) fn external_id(&self, vertex: VertexId) -> Option<u64> {
        self.view.vertex(vertex).map_or(self.root.external_id, |record| record.external_id)
    }

    /// The vertex of a name, or of the root's own.
    pub(super) fn find(&self, name: &str) -> Option<VertexId> {
        if *self.root.name == *name { Some(VertexId::ROOT) } else { self.view.vertex_by_name(name) }
    }

    /// Every vertex in the order of external ids, those without one last.
    pub(super) fn vertices(&self) -> Vec<VertexId> {
        let mut vertices = self.view.vertices().to_vec();
        vertices
            .sort_by_key(|&vertex| (self.external_id(vertex).is_none(), self.external_id(vertex), vertex));
        vertices
    }
}

/// The items of a pose attribute, such as `(2, 6, 0)`.
pub(super) fn tuple(value: &Value) -> String {
    let items: Vec<String> = value.floats().unwrap_or_default().iter().map(ToString::to_string).collect();
    format!("({})", items.join(", "))
}
