//! What is written into a document: a mutation whose conditions hold.

use crate::graph::Attributes;
use dsr_conformance::protocol::{EdgeName, Tagged};
use std::collections::BTreeMap;

/// What has attributes.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Target {
    /// The root or a vertex, by its handle.
    Vertex(String),
    /// An edge.
    Edge(EdgeName),
}

/// One of the six mutations, checked.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Edit {
    /// A vertex and its link.
    AddVertex {
        /// The vertex's handle.
        handle: String,
        /// Its type.
        vertex_type: String,
        /// Its name.
        name: String,
        /// Its attributes.
        attributes: Attributes,
        /// The link.
        link: EdgeName,
        /// The link's attributes.
        link_attributes: Attributes,
    },
    /// An edge.
    AddEdge {
        /// Its name.
        edge: EdgeName,
        /// Its attributes.
        attributes: Attributes,
    },
    /// Attributes to set, or with `None` to unset.
    Update {
        /// Of what.
        target: Target,
        /// The attributes.
        updates: BTreeMap<String, Option<Tagged>>,
    },
    /// An edge goes.
    RemoveEdge {
        /// Its name.
        edge: EdgeName,
    },
    /// An edge moves.
    MoveEdge {
        /// Its name.
        old: EdgeName,
        /// Its name from now on.
        new: EdgeName,
        /// The attributes that it then has.
        attributes: Attributes,
    },
    /// A vertex goes.
    RemoveVertex {
        /// Its handle.
        handle: String,
    },
}
