//! The initial graph, and what careful users may call in a graph.

use super::{Held, Published};
use crate::published::graph::{NodeName, Value};
use crate::published::local::RT;
use crate::published::{AgentId, Key, Kind, NOBODY, NodeId, Operation, Replica, Variant};
use std::collections::BTreeSet;

/// The kinds of calls.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum CallKind {
    /// Inserts a node.
    InsertNode,
    /// Deletes a node, and the edges that end at it.
    DeleteNode,
    /// Inserts a symbolic edge.
    InsertEdge,
    /// Deletes an edge, symbolic or kinematic.
    DeleteEdge,
    /// Sets an attribute of a node or of an edge.
    SetAttribute,
    /// Removes an attribute of a node.
    RemoveAttribute,
    /// Inserts a kinematic edge, with `parent` and `level` of its end.
    Place,
}

impl CallKind {
    /// All.
    pub const ALL: [Self; 7] = [
        Self::InsertNode,
        Self::DeleteNode,
        Self::InsertEdge,
        Self::DeleteEdge,
        Self::SetAttribute,
        Self::RemoveAttribute,
        Self::Place,
    ];

    /// Its name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::InsertNode => "insert_node",
            Self::DeleteNode => "delete_node",
            Self::InsertEdge => "insert_edge",
            Self::DeleteEdge => "delete_edge",
            Self::SetAttribute => "set_attribute",
            Self::RemoveAttribute => "remove_attribute",
            Self::Place => "place",
        }
    }

    /// The kind of a call. Symbolic edges are inserted without attributes, and updated with some.
    pub const fn of(operation: &Operation) -> Self {
        match operation {
            Operation::InsertNode { .. } => Self::InsertNode,
            Operation::DeleteNode { .. } => Self::DeleteNode,
            Operation::AssignEdge { attributes: [], .. } => Self::InsertEdge,
            Operation::DeleteEdge { .. } => Self::DeleteEdge,
            Operation::AssignEdge { .. }
            | Operation::Set { .. }
            | Operation::Get { .. }
            | Operation::PutBack { .. } => Self::SetAttribute,
            Operation::Remove { .. } => Self::RemoveAttribute,
            Operation::Place { .. } => Self::Place,
        }
    }
}

/// The root, a room, a table in it, and a cup on the table that has no place yet.
const ROOT: NodeId = 1;
const ROOM: NodeId = 2;
const TABLE: NodeId = 3;
const CUP: NodeId = 4;
/// The agent that loaded the initial graph, and has left.
const LOADER: AgentId = 9;
/// The attribute of nodes that is set and removed.
const ATTRIBUTE: Key = "x";
/// The type of the edges that are inserted.
const SYMBOLIC: Kind = "in";
/// The name that new nodes ask for, so that names clash.
const SHARED_NAME: &str = "twin";

/// The symbolic edges' attribute, with the two values of each of four agents.
const WEIGHTS: [[&[(Key, i64)]; 2]; 4] = [
    [&[("w", 11)], &[("w", 12)]],
    [&[("w", 21)], &[("w", 22)]],
    [&[("w", 31)], &[("w", 32)]],
    [&[("w", 41)], &[("w", 42)]],
];

const BEFORE: [Operation; 7] = [
    Operation::InsertNode { id: ROOT, kind: "root", name: "world", attributes: &[("level", 0)] },
    Operation::InsertNode { id: ROOM, kind: "room", name: "room", attributes: &[(ATTRIBUTE, 0)] },
    Operation::InsertNode { id: TABLE, kind: "thing", name: "table", attributes: &[(ATTRIBUTE, 0)] },
    Operation::InsertNode { id: CUP, kind: "thing", name: "cup", attributes: &[(ATTRIBUTE, 0)] },
    Operation::Place { from: ROOT, to: ROOM, pose: 0 },
    Operation::Place { from: ROOM, to: TABLE, pose: 0 },
    Operation::AssignEdge { from: CUP, to: TABLE, kind: "on", attributes: &[("w", 0)] },
];

/// What every replica starts from: a root, a room below it, a table below that, and a cup on the table by a
/// symbolic edge, which nobody has placed yet. An agent that has left loaded it.
pub fn initial(variant: Variant) -> Held {
    let nobody = Held { replica: Replica::new(NOBODY, variant, BTreeSet::new()), clock: 0 };
    let loaded = BEFORE.iter().fold(nobody, |held, operation| {
        held.called(LOADER, operation).map_or(held.clone(), |(_, after)| after)
    });
    loaded.of_nobody()
}

impl Published {
    /// What an agent may call, in a fixed order.
    pub(super) fn calls(&self, graph: &Replica, agent: AgentId) -> Vec<Operation> {
        let nodes: Vec<NodeId> = graph.nodes.keys().copied().filter(|&id| graph.node(id).is_some()).collect();
        let edges: Vec<(NodeId, NodeId, Kind)> = shown_edges(graph);
        let mut calls = Vec::new();
        for kind in &self.kinds {
            match kind {
                CallKind::InsertNode => calls.extend(insert_node(graph, agent)),
                CallKind::DeleteNode => {
                    let carries = |node| edges.iter().any(|&(from, _, kind)| (from, kind) == (node, RT));
                    let free =
                        nodes.iter().filter(|&&node| node != ROOT && self.touches(node) && !carries(node));
                    calls.extend(free.map(|&node| Operation::DeleteNode { node }));
                }
                CallKind::InsertEdge => calls.extend(self.insert_edges(&nodes, &edges)),
                CallKind::DeleteEdge => {
                    let touched = edges.iter().filter(|&&edge| self.touches(owner(edge)));
                    calls.extend(touched.map(|&(from, to, kind)| Operation::DeleteEdge { from, to, kind }));
                }
                CallKind::SetAttribute => self.set_attributes(graph, agent, &nodes, &edges, &mut calls),
                CallKind::RemoveAttribute => {
                    let has = |node| graph.attribute(node, ATTRIBUTE).is_some();
                    let with = nodes.iter().filter(|&&node| self.touches(node) && has(node));
                    calls.extend(with.map(|&node| Operation::Remove { node, key: ATTRIBUTE }));
                }
                CallKind::Place => calls.extend(self.places(agent, &nodes, &edges)),
            }
        }
        calls
    }

    fn touches(&self, node: NodeId) -> bool {
        self.focus.is_none_or(|focus| focus == node)
    }

    /// Between each two nodes but the root, where there is no such edge yet.
    fn insert_edges(&self, nodes: &[NodeId], edges: &[(NodeId, NodeId, Kind)]) -> Vec<Operation> {
        let ends = || nodes.iter().copied().filter(|&node| node != ROOT);
        let pairs = ends().flat_map(|from| ends().map(move |to| (from, to, SYMBOLIC)));
        let new = pairs.filter(|edge| edge.0 != edge.1 && self.touches(edge.0) && !edges.contains(edge));
        new.map(|(from, to, kind)| Operation::AssignEdge { from, to, kind, attributes: &[] }).collect()
    }

    /// Each agent writes values of its own, and none that is there already.
    fn set_attributes(
        &self,
        graph: &Replica,
        agent: AgentId,
        nodes: &[NodeId],
        edges: &[(NodeId, NodeId, Kind)],
        calls: &mut Vec<Operation>,
    ) {
        for &node in nodes.iter().filter(|&&node| node != ROOT && self.touches(node)) {
            let held = graph.attribute(node, ATTRIBUTE).map(|held| held.value);
            let first = i64::from(agent) * 10 + 1;
            let value = if held == Some(Value::Number(first)) { first + 1 } else { first };
            calls.push(Operation::Set { node, key: ATTRIBUTE, value });
        }
        let Some(weights) = WEIGHTS.get(agent.saturating_sub(1) as usize) else { return };
        for &(from, to, kind) in edges.iter().filter(|&&edge| edge.2 != RT && self.touches(edge.0)) {
            let held = graph.edge((from, to, kind)).and_then(|edge| edge.attributes.get("w")?.value());
            let [(_, first)] = weights[0] else { continue };
            let has_first = held.is_some_and(|held| held.value == Value::Number(*first));
            let attributes = weights[usize::from(has_first)];
            calls.push(Operation::AssignEdge { from, to, kind, attributes });
        }
    }

    /// A node without a kinematic parent below each node that is not below it.
    fn places(&self, agent: AgentId, nodes: &[NodeId], edges: &[(NodeId, NodeId, Kind)]) -> Vec<Operation> {
        let parents_of = |child| edges.iter().filter(move |edge| (edge.1, edge.2) == (child, RT));
        let is_below = |node: NodeId, above: NodeId| {
            let mut below = BTreeSet::from([above]);
            for _ in nodes {
                below.extend(
                    edges
                        .iter()
                        .filter(|edge| edge.2 == RT && below.contains(&edge.0))
                        .map(|edge| edge.1)
                        .collect::<Vec<_>>(),
                );
            }
            below.contains(&node)
        };
        let mut calls = Vec::new();
        for &to in nodes.iter().filter(|&&to| to != ROOT && self.touches(to)) {
            if parents_of(to).next().is_some() {
                continue;
            }
            let parents = nodes.iter().filter(|&&from| !is_below(from, to));
            calls.extend(parents.map(|&from| Operation::Place { from, to, pose: i64::from(agent) }));
        }
        calls
    }
}

/// A node that is new to everybody, with the shared name as long as it is free.
fn insert_node(graph: &Replica, agent: AgentId) -> Option<Operation> {
    let mut ids = (1..10).map(|count| agent * 10 + count);
    let id = ids.find(|id| !graph.nodes.contains_key(id) && !graph.deleted.contains(id))?;
    let taken = graph.ids.contains_key(&NodeName::Given(SHARED_NAME));
    let name = if taken { "" } else { SHARED_NAME };
    Some(Operation::InsertNode { id, kind: "thing", name, attributes: &[(ATTRIBUTE, 0)] })
}

/// The edges that users see between nodes that they see.
fn shown_edges(graph: &Replica) -> Vec<(NodeId, NodeId, Kind)> {
    let shown = graph.nodes.keys().filter_map(|&id| graph.node(id));
    shown
        .flat_map(|node| node.edges.keys().map(|&(to, kind)| (node.id, to, kind)))
        .filter(|&edge| graph.edge(edge).is_some() && graph.node(edge.1).is_some())
        .collect()
}

/// Whose edge it is: the child's for a kinematic one, else the source's.
const fn owner((from, to, kind): (NodeId, NodeId, Kind)) -> NodeId {
    if matches!(kind.as_bytes(), b"RT") { to } else { from }
}
