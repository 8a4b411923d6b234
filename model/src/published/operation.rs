//! What an agent may call.

use super::{Key, Kind, NodeId};

/// One call of an agent on its own replica, or what agents usually do in one go. All of it is atomic, except
/// that [`Get`](Self::Get) and [`PutBack`](Self::PutBack) are two calls.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Operation {
    /// Inserts a node.
    InsertNode {
        /// The id that the generator gives it.
        id: NodeId,
        /// Its type.
        kind: Kind,
        /// The name asked for.
        name: &'static str,
        /// Its attributes.
        attributes: &'static [(Key, i64)],
    },
    /// Gets a node, sets one attribute, and updates the node.
    Set {
        /// Whose attribute.
        node: NodeId,
        /// Which.
        key: Key,
        /// Its new value.
        value: i64,
    },
    /// Gets a node, removes one attribute, and updates the node.
    Remove {
        /// Whose attribute.
        node: NodeId,
        /// Which.
        key: Key,
    },
    /// Gets a node and keeps the copy.
    Get {
        /// Which.
        node: NodeId,
    },
    /// Sets one attribute of the copy kept, and updates the node.
    PutBack {
        /// Which attribute.
        key: Key,
        /// Its new value.
        value: i64,
    },
    /// Deletes a node.
    DeleteNode {
        /// Which.
        node: NodeId,
    },
    /// Inserts an edge, or gives it exactly these attributes.
    AssignEdge {
        /// Where it starts.
        from: NodeId,
        /// Where it ends.
        to: NodeId,
        /// Its type.
        kind: Kind,
        /// Its attributes.
        attributes: &'static [(Key, i64)],
    },
    /// Deletes an edge.
    DeleteEdge {
        /// Where it starts.
        from: NodeId,
        /// Where it ends.
        to: NodeId,
        /// Its type.
        kind: Kind,
    },
    /// Inserts or updates a kinematic edge, and writes `parent` and `level` of its end.
    Place {
        /// The parent.
        from: NodeId,
        /// The child.
        to: NodeId,
        /// The pose, as one number.
        pose: i64,
    },
}
