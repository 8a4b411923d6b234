//! Which edges a vertex is linked by: its kinematic parent, and the beginning of its way to the root.

use super::graph::Graph;
use super::held::{HeldVertex, Link, NONE};
use crate::dot::Dot;

impl Graph {
    /// The shown edge that begins a vertex's way to the root, or [`NONE`].
    pub(super) fn up_of(&self, vertex: Dot) -> Dot {
        let Some(held) = self.vertex_held(vertex) else { return NONE };
        match held.link {
            Link::None | Link::Parent => NONE,
            Link::Up | Link::ParentUp => held.linked_by,
            Link::ParentAndWay => self.ways.get(&vertex).copied().unwrap_or(NONE),
        }
    }

    pub(super) fn set_up(&mut self, vertex: Dot, up: Dot) {
        if let Some(parent) = self.vertex_held(vertex).map(HeldVertex::parent) {
            self.set_link(vertex, parent, up);
        }
    }

    pub(super) fn set_parent(&mut self, vertex: Dot, parent: Dot) {
        let up = self.up_of(vertex);
        self.set_link(vertex, parent, up);
    }

    pub(super) fn set_link(&mut self, vertex: Dot, parent: Dot, up: Dot) {
        let link = match (parent, up) {
            (NONE, NONE) => Link::None,
            (NONE, _) => Link::Up,
            (_, NONE) => Link::Parent,
            _ if parent == up => Link::ParentUp,
            _ => Link::ParentAndWay,
        };
        let Some(held) = self.vertex_mut(vertex) else { return };
        let had_way = held.link == Link::ParentAndWay;
        held.link = link;
        held.linked_by = if link == Link::Up { up } else { parent };
        if link == Link::ParentAndWay {
            self.ways.insert(vertex, up);
        } else if had_way {
            self.ways.remove(&vertex);
        }
    }
}
