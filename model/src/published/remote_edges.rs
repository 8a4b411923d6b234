//! What a replica does with edges and their attributes that arrive.

use super::buffers::take;
use super::graph::{Attribute, Edge};
use super::message::EdgePart;
use super::register::Register;
use super::replica::Replica;
use super::variant::Workers;
use super::{Crash, Key, Kind, NodeId, Time};

/// Where an edge starts and ends, and its type.
type At = (NodeId, NodeId, Kind);

impl Replica {
    pub(super) fn join_edge(&mut self, at: At, delta: &Register<Edge>, time: Time) -> Result<(), Crash> {
        let (from, to, _) = at;
        if self.nodes.contains_key(&from) && self.nodes.contains_key(&to) {
            if self.apply_edge(at, delta)? {
                return self.consume_edge_attributes(at, time);
            }
            self.drop_held_edge(at);
            return Ok(());
        }
        if self.deleted.contains(&from) || self.deleted.contains(&to) {
            self.drop_held_edge(at);
            return Ok(());
        }
        self.buffers.hold_edge(at, delta, time, self.nodes.contains_key(&from))
    }

    /// Drops what waits for an edge; the fork drops every edge that waits for the same start.
    fn drop_held_edge(&mut self, at: At) {
        if self.variant.workers == Workers::One {
            self.buffers.edges_from.retain(|&(from, _, _), _| from != at.0);
        }
        self.buffers.drop_edge(at);
    }

    /// Joins a delta to an edge and says whether the edge is there. An empty delta removes it.
    fn apply_edge(&mut self, at: At, delta: &Register<Edge>) -> Result<bool, Crash> {
        let (from, to, kind) = at;
        let Some(node) = self.edit(from)? else { return Ok(false) };
        node.edges.entry((to, kind)).or_default().join(delta)?;
        if delta.is_empty() {
            node.edges.remove(&(to, kind));
            self.unindex_edge(from, to);
        } else {
            self.index_edge(at);
        }
        Ok(!delta.is_empty())
    }

    /// Takes in the edges that waited for a node. Those that start at it are taken in whether or not their
    /// end is known; those whose start has gone meanwhile are passed over.
    pub(super) fn consume_edges(&mut self, id: NodeId, time: Time) -> Result<(), Crash> {
        let outgoing = take(&mut self.buffers.edges_from, |&(from, _, _)| from == id);
        if self.variant.workers == Workers::One {
            for &((_, to, kind), _) in &outgoing {
                self.buffers.edges_from.retain(|&(_, end, of), _| (end, of) != (to, kind));
            }
        }
        let incoming = self.buffers.edges_to.remove(&id).unwrap_or_default();
        let incoming = incoming.into_iter().map(|(from, kind, held)| ((from, id, kind), held));
        for (at, held) in outgoing.into_iter().chain(incoming) {
            if time < held.time && self.apply_edge(at, &held.delta)? {
                self.consume_edge_attributes(at, time)?;
            }
        }
        Ok(())
    }

    /// Takes in the attributes that waited for an edge and were sent later than what brought the edge: its own
    /// message, or, for an edge that waited itself, that of the node.
    fn consume_edge_attributes(&mut self, at: At, time: Time) -> Result<(), Crash> {
        let waits = |&(from, to, kind, _): &(NodeId, NodeId, Kind, Key)| (from, to, kind) == at;
        for ((_, _, _, key), held) in take(&mut self.buffers.edge_attributes, waits) {
            if time < held.time {
                self.apply_edge_attribute(at, key, &held.delta)?;
            }
        }
        Ok(())
    }

    pub(super) fn join_edge_part(&mut self, part: &EdgePart, time: Time) -> Result<(), Crash> {
        let at = (part.from, part.to, part.kind);
        let held = (part.from, part.to, part.kind, part.key);
        let node = self.edit(part.from)?;
        if node.is_some_and(|node| node.edges.contains_key(&(part.to, part.kind))) {
            self.buffers.edge_attributes.remove(&held);
            self.apply_edge_attribute(at, part.key, &part.delta)
        } else if self.deleted.contains(&part.from) {
            self.drop_held_edge(at);
            Ok(())
        } else {
            self.buffers.hold_edge_attribute(held, &part.delta, time)
        }
    }

    fn apply_edge_attribute(&mut self, at: At, key: Key, delta: &Register<Attribute>) -> Result<(), Crash> {
        let (from, to, kind) = at;
        let Some(node) = self.edit(from)? else { return Ok(()) };
        let Some(register) = node.edges.get_mut(&(to, kind)) else { return Ok(()) };
        let attributes = &mut register.edit()?.attributes;
        attributes.entry(key).or_default().join(delta)?;
        if delta.is_empty() {
            attributes.remove(key);
        }
        Ok(())
    }
}
