//! The whole graph, as a server sends it to one who joins.

use super::graph::Node;
use super::message::Message;
use super::register::Register;
use super::replica::Replica;
use super::{Crash, NodeId, Time};
use std::collections::BTreeMap;

impl Replica {
    /// The whole graph at a time, in nanoseconds of the server's clock. What was removed is not in it.
    pub fn snapshot(&self, time: Time) -> Message {
        let nodes = self.nodes.iter().map(|(&id, node)| (id, node.map(Node::wire))).collect();
        Message::Graph { time, nodes }
    }

    /// Takes a whole graph in. A register is made for every node of it, and stays, empty, for one that is
    /// deleted here. A node that is known here is kept as it is: its dot is that of the one that arrives.
    /// Nodes that are not in it stay.
    pub(super) fn join_graph(
        &mut self,
        nodes: &BTreeMap<NodeId, Register<Node>>,
        time: Time,
    ) -> Result<(), Crash> {
        for (&id, delta) in nodes {
            let register = self.nodes.entry(id).or_default();
            if self.deleted.contains(&id) {
                continue;
            }
            register.join(delta)?;
            self.settle_node(id, delta, time)?;
        }
        Ok(())
    }
}
