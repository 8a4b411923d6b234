//! Records: what a replica says under a dot. `[spec: STATE-1]`

use crate::dot::{Dot, VertexId};
use crate::value::Value;
use alloc::sync::Arc;

/// A shared name: a vertex type or name, an edge label, an attribute name.
pub type Name = Arc<str>;

/// The label of kinematic edges, parent to child. `[spec: VIEW-3]`
pub const RT: &str = "RT";

/// What is filed under one dot. `[spec: STATE-1]`
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Record {
    /// A vertex exists; its dot is its identity.
    Vertex(Vertex),
    /// An edge exists; anchored to both ends.
    Edge(Edge),
    /// An attribute has a value; anchored to its target.
    Write(Write),
}

/// A vertex's record.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Vertex {
    /// Its type, such as `room`.
    pub vertex_type: Name,
    /// Its name, unique as far as its author knew.
    pub name: Name,
    /// The id in the file that it was imported from, if any.
    pub external_id: Option<u64>,
    /// Its claim's stamp. `[spec: STAMP-1]`
    pub stamp: u64,
}

/// An edge's record.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Edge {
    /// The source; the parent for `RT`.
    pub from: VertexId,
    /// The target; the child for `RT`.
    pub to: VertexId,
    /// The label, such as `in` or `RT`.
    pub label: Name,
    /// Its claim's stamp. `[spec: STAMP-1]`
    pub stamp: u64,
}

/// An attribute write's record.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Write {
    /// The vertex or edge written to: its dot, or the root's.
    pub target: Dot,
    /// The attribute's name.
    pub name: Name,
    /// The value.
    pub value: Value,
    /// The caller's time in nanoseconds, for readers; it never orders anything. `[spec: STAMP-3]`
    pub timestamp_ns: u64,
    /// Its claim's stamp. `[spec: STAMP-1]`
    pub stamp: u64,
}

impl Record {
    /// The stamp of the record's claim.
    pub fn stamp(&self) -> u64 {
        match self {
            Self::Vertex(vertex) => vertex.stamp,
            Self::Edge(edge) => edge.stamp,
            Self::Write(write) => write.stamp,
        }
    }

    /// The dots without which this record cannot be: none, both ends, or the target. The root, which
    /// cannot die, is included. `[spec: STATE-2]`
    pub fn anchors(&self) -> impl Iterator<Item = Dot> + use<> {
        let (first, second) = match self {
            Self::Vertex(_) => (None, None),
            Self::Edge(edge) => (Some(edge.from.0), Some(edge.to.0)),
            Self::Write(write) => (Some(write.target), None),
        };
        first.into_iter().chain(second)
    }
}

impl Edge {
    /// The edge's key: at most one instance of a key is shown.
    pub fn key(&self) -> EdgeKey {
        EdgeKey { from: self.from, to: self.to, label: self.label.clone() }
    }

    /// Whether this is a claim in the kinematic tree.
    pub fn is_rt(&self) -> bool {
        &*self.label == RT
    }
}

/// What identifies an edge to its users: source, target and label.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct EdgeKey {
    /// The source.
    pub from: VertexId,
    /// The target.
    pub to: VertexId,
    /// The label.
    pub label: Name,
}

impl EdgeKey {
    /// The key of the edge `from -label-> to`.
    pub fn new(from: VertexId, label: &str, to: VertexId) -> Self {
        Self { from, to, label: label.into() }
    }
}

/// Prints `r1.1 -in-> r1.2`.
impl core::fmt::Display for EdgeKey {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{} -{}-> {}", self.from, self.label, self.to)
    }
}

/// Where a claim stands among its competitors: greatest first wins. `[spec: STAMP-2]`
pub type Rank = (u64, Dot);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dot::ReplicaId;
    use alloc::string::ToString;

    /// Errors and reports name edges so.
    #[test]
    fn law_a_key_reads_from_source_to_target() {
        let room = VertexId(Dot::new(ReplicaId::agent(1), 2));
        assert_eq!(EdgeKey::new(VertexId::ROOT, "in", room).to_string(), "root -in-> r1.2");
    }
}
