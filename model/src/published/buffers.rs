//! What arrived before what it belongs to.

use super::graph::{Attribute, Edge};
use super::register::{Payload, Register};
use super::{Crash, Key, Kind, NodeId, Time};
use std::collections::BTreeMap;

/// A delta held back.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Held<T> {
    /// The delta, or several joined.
    pub delta: Register<T>,
    /// When the first of them was sent.
    pub time: Time,
}

/// An edge held back under its end: where it starts, its type, the delta.
pub type HeldIncoming = (NodeId, Kind, Held<Edge>);

/// The four buffers.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Buffers {
    /// Attributes of unknown nodes.
    pub node_attributes: BTreeMap<(NodeId, Key), Held<Attribute>>,
    /// Edges whose start is unknown, by start, end and type.
    pub edges_from: BTreeMap<(NodeId, NodeId, Kind), Held<Edge>>,
    /// Edges whose end alone is unknown, by end. Entries are never joined, so there may be several of one edge.
    pub edges_to: BTreeMap<NodeId, Vec<HeldIncoming>>,
    /// Attributes of unknown edges, by start, end, type and name.
    pub edge_attributes: BTreeMap<(NodeId, NodeId, Kind, Key), Held<Attribute>>,
}

/// Holds a delta back; what is held already is joined into, and keeps its time.
fn hold<K: Ord, T: Payload>(
    held: &mut BTreeMap<K, Held<T>>,
    key: K,
    delta: &Register<T>,
    time: Time,
) -> Result<(), Crash> {
    held.entry(key).or_insert_with(|| Held { delta: Register::default(), time }).delta.join(delta)
}

/// Takes out the entries whose key fits.
pub(super) fn take<K: Ord + Copy, T>(
    held: &mut BTreeMap<K, Held<T>>,
    fits: impl Fn(&K) -> bool,
) -> Vec<(K, Held<T>)> {
    let keys: Vec<K> = held.keys().copied().filter(fits).collect();
    keys.into_iter().filter_map(|key| held.remove(&key).map(|entry| (key, entry))).collect()
}

impl Buffers {
    /// Holds back an attribute of an unknown node.
    pub fn hold_node_attribute(
        &mut self,
        at: (NodeId, Key),
        delta: &Register<Attribute>,
        time: Time,
    ) -> Result<(), Crash> {
        hold(&mut self.node_attributes, at, delta, time)
    }

    /// Holds back an attribute of an unknown edge.
    pub fn hold_edge_attribute(
        &mut self,
        at: (NodeId, NodeId, Kind, Key),
        delta: &Register<Attribute>,
        time: Time,
    ) -> Result<(), Crash> {
        hold(&mut self.edge_attributes, at, delta, time)
    }

    /// Holds back an edge, one or both of whose ends are unknown.
    ///
    /// As published it joins into an edge of the same start, end and type that waits for its start, and then
    /// also into one of the opposite direction. Only if there was neither, the edge gets an entry of its own.
    pub fn hold_edge(
        &mut self,
        (from, to, kind): (NodeId, NodeId, Kind),
        delta: &Register<Edge>,
        time: Time,
        start_is_known: bool,
    ) -> Result<(), Crash> {
        let mut found = false;
        for key in [(from, to, kind), (to, from, kind)] {
            if let Some(held) = self.edges_from.get_mut(&key) {
                held.delta.join(delta)?;
                found = true;
            }
        }
        if !found && start_is_known {
            let held = Held { delta: delta.clone(), time };
            self.edges_to.entry(to).or_default().push((from, kind, held));
        } else if !found {
            self.edges_from.insert((from, to, kind), Held { delta: delta.clone(), time });
        }
        Ok(())
    }

    /// Drops what is held back for a node that is gone. Edges that wait for another start stay, even if they
    /// end at the node; the fork leaves attributes of edges as well.
    pub fn drop_node(&mut self, id: NodeId, edge_attributes_too: bool) {
        self.node_attributes.retain(|&(node, _), _| node != id);
        self.edges_from.retain(|&(from, _, _), _| from != id);
        self.edges_to.remove(&id);
        if edge_attributes_too {
            self.edge_attributes.retain(|&(from, to, _, _), _| from != id && to != id);
        }
    }

    /// Drops what is held back for an edge that is gone or cannot be.
    ///
    /// What exactly is dropped upstream is not described: here all that is held of this edge, no more.
    pub fn drop_edge(&mut self, (from, to, kind): (NodeId, NodeId, Kind)) {
        self.edges_from.remove(&(from, to, kind));
        if let Some(held) = self.edges_to.get_mut(&to) {
            held.retain(|&(start, of, _)| (start, of) != (from, kind));
        }
        self.edges_to.retain(|_, held| !held.is_empty());
        self.edge_attributes.retain(|&(start, end, of, _), _| (start, end, of) != (from, to, kind));
    }
}
