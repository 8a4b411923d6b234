//! Attributes, edges and nodes, as registers hold them.

use super::register::{Payload, Register};
use super::{AgentId, Key, Kind, NodeId};
use std::collections::BTreeMap;
use std::fmt;

/// An attribute's value. Of the fourteen published types two are enough: no rule looks into a value.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Value {
    /// A number.
    Number(i64),
    /// A node, as `parent` names one.
    Node(NodeId),
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Node(node) => write!(f, "#{node}"),
        }
    }
}

/// An attribute. Its published timestamp is left out: no rule reads it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Attribute {
    /// The value.
    pub value: Value,
    /// Who it says it is from.
    pub agent: AgentId,
}

impl Payload for Attribute {
    fn agent(&self) -> AgentId {
        self.agent
    }

    fn same_value(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

/// The attributes of a node or of an edge.
pub type AttributeRegisters = BTreeMap<Key, Register<Attribute>>;

/// Registers are compared by dots and values. The description leaves open whether contexts count; they can
/// differ only where a write was made on a gap.
fn same_attributes(mine: &AttributeRegisters, theirs: &AttributeRegisters) -> bool {
    mine.len() == theirs.len()
        && mine.iter().zip(theirs).all(|(mine, theirs)| mine.0 == theirs.0 && mine.1.same_values(theirs.1))
}

/// An edge, stored inside its source node.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Edge {
    /// Where it starts, as it says itself.
    pub from: NodeId,
    /// Where it ends, as it says itself.
    pub to: NodeId,
    /// Its type, as it says itself.
    pub kind: Kind,
    /// Who it says it is from.
    pub agent: AgentId,
    /// Its attributes.
    pub attributes: AttributeRegisters,
}

impl Payload for Edge {
    fn agent(&self) -> AgentId {
        self.agent
    }

    fn same_value(&self, other: &Self) -> bool {
        (self.from, self.to, self.kind) == (other.from, other.to, other.kind)
            && same_attributes(&self.attributes, &other.attributes)
    }
}

impl Edge {
    /// As it travels.
    #[must_use]
    pub fn wire(&self) -> Self {
        Self { attributes: wire_attributes(&self.attributes), ..self.clone() }
    }
}

/// A node's name.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum NodeName {
    /// As given.
    Given(&'static str),
    /// Made of type and id, because none was given or the given one was taken.
    Made(Kind, NodeId),
}

impl fmt::Display for NodeName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Given(name) => f.write_str(name),
            Self::Made(kind, id) => write!(f, "{kind}_{id:x}"),
        }
    }
}

/// A node, with the edges that start at it.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Node {
    /// Its identity.
    pub id: NodeId,
    /// Its type.
    pub kind: Kind,
    /// Its name, unique if nobody takes it at the same time.
    pub name: NodeName,
    /// Who it says it is from.
    pub agent: AgentId,
    /// Its attributes.
    pub attributes: AttributeRegisters,
    /// The edges that start at it, by end and type.
    pub edges: BTreeMap<(NodeId, Kind), Register<Edge>>,
}

impl Payload for Node {
    fn agent(&self) -> AgentId {
        self.agent
    }

    fn same_value(&self, other: &Self) -> bool {
        let same_edges = self.edges.len() == other.edges.len()
            && self
                .edges
                .iter()
                .zip(&other.edges)
                .all(|(mine, theirs)| mine.0 == theirs.0 && mine.1.same_values(theirs.1));
        (self.id, self.kind) == (other.id, other.kind)
            && same_edges
            && same_attributes(&self.attributes, &other.attributes)
    }
}

impl Node {
    /// As it travels.
    #[must_use]
    pub fn wire(&self) -> Self {
        let edges = self.edges.iter().map(|(&key, edge)| (key, edge.nested(Edge::wire))).collect();
        Self { attributes: wire_attributes(&self.attributes), edges, ..self.clone() }
    }
}

fn wire_attributes(attributes: &AttributeRegisters) -> AttributeRegisters {
    attributes.iter().map(|(&key, register)| (key, register.nested(|attribute| *attribute))).collect()
}
