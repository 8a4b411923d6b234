//! What a replica does with nodes and their attributes that arrive.

use super::buffers::take;
use super::graph::{Attribute, Node};
use super::message::{Message, NodePart};
use super::register::Register;
use super::replica::Replica;
use super::variant::Workers;
use super::{Crash, Key, NodeId, Time};

impl Replica {
    /// Takes a message in. Its own messages are passed over: of a list, only the first entry is looked at.
    pub fn receive(&mut self, message: &Message) -> Result<(), Crash> {
        match message {
            Message::Node { sender, time, id, delta } if *sender != self.agent => {
                self.join_node(*id, delta, *time)
            }
            Message::Edge { sender, time, from, to, kind, delta } if *sender != self.agent => {
                self.join_edge((*from, *to, kind), delta, *time)
            }
            Message::NodeAttributes { time, parts }
                if parts.first().is_some_and(|part| part.sender != self.agent) =>
            {
                parts.iter().try_for_each(|part| self.join_node_part(part, *time))
            }
            Message::EdgeAttributes { time, parts }
                if parts.first().is_some_and(|part| part.sender != self.agent) =>
            {
                parts.iter().try_for_each(|part| self.join_edge_part(part, *time))
            }
            Message::Graph { time, nodes } => self.join_graph(nodes, *time),
            _ => Ok(()),
        }
    }

    fn join_node(&mut self, id: NodeId, delta: &Register<Node>, time: Time) -> Result<(), Crash> {
        if self.deleted.contains(&id) {
            self.drop_held(id);
            return Ok(());
        }
        self.nodes.entry(id).or_default().join(delta)?;
        self.settle_node(id, delta, time)
    }

    /// After a node was joined: removes it if it is gone, else indexes it and takes in what waited for it.
    pub(super) fn settle_node(
        &mut self,
        id: NodeId,
        delta: &Register<Node>,
        time: Time,
    ) -> Result<(), Crash> {
        if delta.is_empty() || self.node(id).is_none() {
            self.remove_node(id);
            self.drop_held(id);
            return Ok(());
        }
        self.index_node(id);
        self.consume(id, time)
    }

    fn drop_held(&mut self, id: NodeId) {
        self.buffers.drop_node(id, self.variant.workers == Workers::Several);
    }

    /// Takes in what waited for a node, if it was sent later than the node, by the clocks of two machines.
    /// What was not is dropped.
    fn consume(&mut self, id: NodeId, time: Time) -> Result<(), Crash> {
        for ((_, key), held) in take(&mut self.buffers.node_attributes, |&(node, _)| node == id) {
            if time < held.time {
                self.apply_node_attribute(id, key, &held.delta)?;
            }
        }
        self.consume_edges(id, time)
    }

    fn join_node_part(&mut self, part: &NodePart, time: Time) -> Result<(), Crash> {
        let at = (part.node, part.key);
        if self.nodes.contains_key(&part.node) {
            self.buffers.node_attributes.remove(&at);
            self.apply_node_attribute(part.node, part.key, &part.delta)
        } else if self.deleted.contains(&part.node) {
            self.drop_held(part.node);
            Ok(())
        } else {
            self.buffers.hold_node_attribute(at, &part.delta, time)
        }
    }

    /// Joins a delta to an attribute. An empty delta removes it, even if the join kept a newer value.
    fn apply_node_attribute(
        &mut self,
        id: NodeId,
        key: Key,
        delta: &Register<Attribute>,
    ) -> Result<(), Crash> {
        let Some(node) = self.edit(id)? else { return Ok(()) };
        node.attributes.entry(key).or_default().join(delta)?;
        if delta.is_empty() {
            node.attributes.remove(key);
        }
        Ok(())
    }
}
