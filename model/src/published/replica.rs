//! One replica: its graph, the indices beside it, and what it holds back.

use super::buffers::Buffers;
use super::graph::{Attribute, AttributeRegisters, Edge, Node, NodeName};
use super::register::Register;
use super::variant::{Stamps, Variant};
use super::{AgentId, Crash, Key, Kind, NodeId};
use std::collections::{BTreeMap, BTreeSet};

/// A node as a user holds it: a copy, which does not follow later changes.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct NodeCopy {
    /// Which node.
    pub id: NodeId,
    /// Its name.
    pub name: NodeName,
    /// Its attributes.
    pub attributes: BTreeMap<Key, Attribute>,
}

/// A replica. The indices are derived, and kept as badly as the published ones are.
///
/// The published index of edges by end is left out: nothing that is modelled reads it.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Replica {
    /// Its agent.
    pub agent: AgentId,
    /// Which implementation it runs.
    pub variant: Variant,
    /// The nodes. A register is present and empty only after a snapshot brought a node that is deleted here.
    pub nodes: BTreeMap<NodeId, Register<Node>>,
    /// The nodes known to be removed; never forgotten and never sent.
    pub deleted: BTreeSet<NodeId>,
    /// The types of edges between two nodes.
    pub edges: BTreeMap<(NodeId, NodeId), BTreeSet<Kind>>,
    /// Ids by name.
    pub ids: BTreeMap<NodeName, NodeId>,
    /// Names by id.
    pub names: BTreeMap<NodeId, NodeName>,
    /// What waits.
    pub buffers: Buffers,
    /// Attributes that this agent has asked to ignore.
    pub ignored: BTreeSet<Key>,
    /// The copy that the user holds.
    pub copy: Option<NodeCopy>,
    /// Why it no longer runs.
    pub crash: Option<Crash>,
}

/// An edge as users see it. `None` stands for a register that is present and empty.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct ShownEdge {
    /// Its own start, end and type.
    pub says: (NodeId, NodeId, Kind),
    /// Its attributes.
    pub attributes: BTreeMap<Key, Option<Attribute>>,
}

/// A node as users see it. `None` stands for a register that is present and empty.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct ShownNode {
    /// Its name.
    pub name: NodeName,
    /// Its type.
    pub kind: Kind,
    /// Its attributes.
    pub attributes: BTreeMap<Key, Option<Attribute>>,
    /// The edges that start at it.
    pub edges: BTreeMap<(NodeId, Kind), Option<ShownEdge>>,
}

/// A graph as users see it.
pub type Shown = BTreeMap<NodeId, Option<ShownNode>>;

impl Replica {
    /// A replica that knows nothing.
    pub fn new(agent: AgentId, variant: Variant, ignored: BTreeSet<Key>) -> Self {
        Self {
            agent,
            variant,
            nodes: BTreeMap::new(),
            deleted: BTreeSet::new(),
            edges: BTreeMap::new(),
            ids: BTreeMap::new(),
            names: BTreeMap::new(),
            buffers: Buffers::default(),
            ignored,
            copy: None,
            crash: None,
        }
    }

    /// What new things of this agent say they are from.
    pub const fn stamp(&self) -> AgentId {
        match self.variant.stamps {
            Stamps::Zero => 0,
            Stamps::Author => self.agent,
        }
    }

    /// The value of a node's register, if there is one.
    pub fn node(&self, id: NodeId) -> Option<&Node> {
        self.nodes.get(&id)?.value()
    }

    /// The value of an attribute, if there is one.
    pub fn attribute(&self, id: NodeId, key: Key) -> Option<Attribute> {
        self.node(id)?.attributes.get(key)?.value().copied()
    }

    /// The value of an edge's register, if there is one.
    pub fn edge(&self, (from, to, kind): (NodeId, NodeId, Kind)) -> Option<&Edge> {
        self.node(from)?.edges.get(&(to, kind))?.value()
    }

    /// A copy of a node for the user; reads every register of it. `None` if there is no such node.
    pub fn copy_of(&self, id: NodeId) -> Result<Option<NodeCopy>, Crash> {
        let Some(register) = self.nodes.get(&id) else { return Ok(None) };
        let node = register.read()?;
        for edge in node.edges.values() {
            read_all(&edge.read()?.attributes)?;
        }
        let attributes = read_all(&node.attributes)?;
        Ok(Some(NodeCopy { id, name: node.name, attributes }))
    }

    /// The graph as users see it, with nothing derived.
    ///
    /// Attributes are compared by value alone, so the agent is left out.
    pub fn shown(&self) -> Shown {
        self.nodes.iter().map(|(&id, register)| (id, register.value().map(shown_node))).collect()
    }

    /// Enters a node and its edges in the indices; a name that is taken is taken over.
    pub(super) fn index_node(&mut self, id: NodeId) {
        let Some(node) = self.nodes.get(&id).and_then(Register::value) else { return };
        self.ids.insert(node.name, id);
        self.names.insert(id, node.name);
        for &(to, kind) in node.edges.keys() {
            self.edges.entry((id, to)).or_default().insert(kind);
        }
    }

    /// Takes a node out of the store and the indices, and remembers that it is gone.
    ///
    /// Edges that end at it stay in the nodes that they start at.
    pub(super) fn remove_node(&mut self, id: NodeId) {
        if let Some(name) = self.names.remove(&id) {
            self.ids.remove(&name);
        }
        self.edges.retain(|&(from, _), _| from != id);
        self.nodes.remove(&id);
        self.deleted.insert(id);
    }

    /// Enters an edge in the index.
    pub(super) fn index_edge(&mut self, (from, to, kind): (NodeId, NodeId, Kind)) {
        self.edges.entry((from, to)).or_default().insert(kind);
    }

    /// Takes an edge out of the index, and with it, as published, every other edge between the two nodes.
    pub(super) fn unindex_edge(&mut self, from: NodeId, to: NodeId) {
        self.edges.remove(&(from, to));
    }

    /// A node's value, to be edited in place.
    pub(super) fn edit(&mut self, id: NodeId) -> Result<Option<&mut Node>, Crash> {
        self.nodes.get_mut(&id).map(Register::edit).transpose()
    }
}

fn read_all(registers: &AttributeRegisters) -> Result<BTreeMap<Key, Attribute>, Crash> {
    registers.iter().map(|(&key, register)| Ok((key, *register.read()?))).collect()
}

fn shown_attributes(registers: &AttributeRegisters) -> BTreeMap<Key, Option<Attribute>> {
    let bare = |attribute: &Attribute| Attribute { agent: 0, ..*attribute };
    registers.iter().map(|(&key, register)| (key, register.value().map(bare))).collect()
}

fn shown_edge(edge: &Edge) -> ShownEdge {
    ShownEdge { says: (edge.from, edge.to, edge.kind), attributes: shown_attributes(&edge.attributes) }
}

fn shown_node(node: &Node) -> ShownNode {
    ShownNode {
        name: node.name,
        kind: node.kind,
        attributes: shown_attributes(&node.attributes),
        edges: node.edges.iter().map(|(&key, edge)| (key, edge.value().map(shown_edge))).collect(),
    }
}
