//! The graph as the mutations ask for it.

use super::graph::Graph;
use super::held::{Exposure, RegisterKey, Status};
use super::names::RT_ID;
use crate::dictionary::Dictionary;
use crate::dot::{Dot, EdgeId, ReplicaId, VertexId};
use crate::mutation::Ground;
use crate::record::{EdgeKey, Name};
use crate::view::Placement;
use alloc::vec::Vec;

impl Ground for Graph {
    fn dictionary(&self) -> &Dictionary {
        Self::dictionary(self)
    }

    fn next_dot(&self, replica: ReplicaId) -> Option<Dot> {
        Some(Dot::new(replica, self.context.greatest(replica).checked_add(1)?))
    }

    fn greatest_stamp(&self) -> u64 {
        self.stamps.last().map_or(0, |(&stamp, _)| stamp)
    }

    fn has_vertex(&self, vertex: VertexId) -> bool {
        Self::has_vertex(self, vertex)
    }

    fn vertex_by_name(&self, name: &str) -> Option<VertexId> {
        Self::vertex_by_name(self, name)
    }

    fn edge_at(&self, key: &EdgeKey) -> Option<EdgeId> {
        self.edge_by_key(key)
    }

    fn shows_edge(&self, edge: EdgeId) -> bool {
        self.edge_held(edge.0).is_some_and(|edge| edge.status == Status::Shown)
    }

    fn functional_edge(&self, from: VertexId, label: &Name) -> Option<EdgeKey> {
        let label = self.names.find(label)?;
        let claims = self.claims_on(self.register_at(from.0, label, from.0));
        let mut shown = claims.filter_map(|dot| self.edge_held(dot));
        shown.find(|edge| edge.status == Status::Shown).map(|edge| self.key_of(edge))
    }

    fn placement(&self, vertex: VertexId) -> Option<Placement> {
        Self::placement(self, vertex)
    }

    fn shows_attribute(&self, target: Dot, name: &Name) -> bool {
        let Some(name) = self.names.find(name) else { return false };
        self.writes_of(target, name).any(|(_, write)| write.exposure == Exposure::Shown)
    }

    fn register_dots(&self, key: &EdgeKey) -> Vec<Dot> {
        let Some(label) = self.names.find(&key.label) else { return Vec::new() };
        self.claims_on(self.register_at(key.from.0, label, key.to.0)).collect()
    }

    fn write_dots(&self, target: Dot, name: &Name) -> Vec<Dot> {
        let Some(name) = self.names.find(name) else { return Vec::new() };
        self.writes_of(target, name).map(|(dot, _)| dot).collect()
    }
}

/// A graph in which one shown edge and its whole register are dead, where nothing else changes by that.
pub(super) struct Without<'g> {
    graph: &'g Graph,
    register: RegisterKey,
    parent: VertexId,
}

impl<'g> Without<'g> {
    /// `None` if the removal could let another kinematic claim in: then it must be carried out to be judged.
    pub(super) fn new(graph: &'g Graph, key: &EdgeKey) -> Option<Self> {
        let label = graph.names.find(&key.label)?;
        let register = graph.register_at(key.from.0, label, key.to.0);
        (label != RT_ID || graph.broken.is_empty()).then_some(Self { graph, register, parent: key.from })
    }

    fn removes(&self, from: VertexId, label: &str, to: VertexId) -> bool {
        let label = self.graph.names.find(label);
        label.is_some_and(|label| self.graph.register_at(from.0, label, to.0) == self.register)
    }
}

impl Ground for Without<'_> {
    fn dictionary(&self) -> &Dictionary {
        self.graph.dictionary()
    }

    fn next_dot(&self, replica: ReplicaId) -> Option<Dot> {
        self.graph.next_dot(replica)
    }

    fn greatest_stamp(&self) -> u64 {
        self.graph.greatest_stamp()
    }

    fn has_vertex(&self, vertex: VertexId) -> bool {
        self.graph.has_vertex(vertex)
    }

    fn vertex_by_name(&self, name: &str) -> Option<VertexId> {
        self.graph.vertex_by_name(name)
    }

    fn edge_at(&self, key: &EdgeKey) -> Option<EdgeId> {
        if self.removes(key.from, &key.label, key.to) { None } else { self.graph.edge_by_key(key) }
    }

    fn shows_edge(&self, edge: EdgeId) -> bool {
        let held = self.graph.edge_held(edge.0);
        held.is_some_and(|held| held.status == Status::Shown && self.graph.register_of(held) != self.register)
    }

    fn functional_edge(&self, from: VertexId, label: &Name) -> Option<EdgeKey> {
        if self.removes(from, label, from) { None } else { self.graph.functional_edge(from, label) }
    }

    fn placement(&self, vertex: VertexId) -> Option<Placement> {
        if self.register.1 != RT_ID || vertex.is_root() {
            return self.graph.placement(vertex);
        }
        let children = self.graph.vertex_held(vertex.0)?.children - u32::from(vertex == self.parent);
        Some(match self.graph.placement(vertex)? {
            Placement::Child { .. } if vertex.0 != self.register.0 => return self.graph.placement(vertex),
            _ if children > 0 => Placement::Detached,
            _ => Placement::Outside,
        })
    }

    fn shows_attribute(&self, target: Dot, name: &Name) -> bool {
        self.graph.shows_attribute(target, name)
    }

    fn register_dots(&self, key: &EdgeKey) -> Vec<Dot> {
        if self.removes(key.from, &key.label, key.to) { Vec::new() } else { self.graph.register_dots(key) }
    }

    fn write_dots(&self, target: Dot, name: &Name) -> Vec<Dot> {
        self.graph.write_dots(target, name)
    }
}
