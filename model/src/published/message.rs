//! What is broadcast.

use super::graph::{Attribute, Edge, Node};
use super::register::Register;
use super::{AgentId, Key, Kind, NodeId, Time};
use std::collections::BTreeMap;

/// What a message travels on. Nothing orders one topic against another.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Topic {
    /// Whole nodes, and their removal.
    Nodes,
    /// Attributes of nodes.
    NodeAttributes,
    /// Whole edges, and their removal.
    Edges,
    /// Attributes of edges.
    EdgeAttributes,
    /// A whole graph, for one who joins.
    Graph,
}

/// A delta to one attribute of a node.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct NodePart {
    /// Who it says sent it.
    pub sender: AgentId,
    /// Whose attribute.
    pub node: NodeId,
    /// Which.
    pub key: Key,
    /// The delta.
    pub delta: Register<Attribute>,
}

/// A delta to one attribute of an edge.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct EdgePart {
    /// Who it says sent it.
    pub sender: AgentId,
    /// Where the edge starts.
    pub from: NodeId,
    /// Where it ends.
    pub to: NodeId,
    /// Its type.
    pub kind: Kind,
    /// Which attribute.
    pub key: Key,
    /// The delta.
    pub delta: Register<Attribute>,
}

/// A message. Times are the sender's wall clock at sending, in nanoseconds.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Message {
    /// A node is new, or gone.
    Node {
        /// Who it says sent it.
        sender: AgentId,
        /// When.
        time: Time,
        /// Which node.
        id: NodeId,
        /// The delta.
        delta: Register<Node>,
    },
    /// Attributes of nodes changed. May be empty.
    NodeAttributes {
        /// When.
        time: Time,
        /// The changes, in order.
        parts: Vec<NodePart>,
    },
    /// An edge is new, or gone.
    Edge {
        /// Who it says sent it.
        sender: AgentId,
        /// When.
        time: Time,
        /// Where it starts.
        from: NodeId,
        /// Where it ends.
        to: NodeId,
        /// Its type.
        kind: Kind,
        /// The delta.
        delta: Register<Edge>,
    },
    /// Attributes of edges changed. May be empty.
    EdgeAttributes {
        /// When.
        time: Time,
        /// The changes, in order.
        parts: Vec<EdgePart>,
    },
    /// All nodes of a server.
    Graph {
        /// When the server encoded it.
        time: Time,
        /// The nodes; an empty register stands for a removed one.
        nodes: BTreeMap<NodeId, Register<Node>>,
    },
}

impl Message {
    /// What it travels on.
    pub const fn topic(&self) -> Topic {
        match self {
            Self::Node { .. } => Topic::Nodes,
            Self::NodeAttributes { .. } => Topic::NodeAttributes,
            Self::Edge { .. } => Topic::Edges,
            Self::EdgeAttributes { .. } => Topic::EdgeAttributes,
            Self::Graph { .. } => Topic::Graph,
        }
    }

    /// The sender's clock at sending.
    pub const fn time(&self) -> Time {
        match self {
            Self::Node { time, .. }
            | Self::NodeAttributes { time, .. }
            | Self::Edge { time, .. }
            | Self::EdgeAttributes { time, .. }
            | Self::Graph { time, .. } => *time,
        }
    }

    /// Whether it is a list of nothing: such a message is sent, and changes nothing.
    pub fn is_empty_list(&self) -> bool {
        match self {
            Self::NodeAttributes { parts, .. } => parts.is_empty(),
            Self::EdgeAttributes { parts, .. } => parts.is_empty(),
            _ => false,
        }
    }
}
