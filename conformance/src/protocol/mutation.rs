//! The six mutations, with handles in the place of dots. `[spec: CONF-6]`

use super::{Tagged, Unique};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An edge's name: which vertices it joins, by handles, and its label. `[spec: CONF-5]`
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EdgeName {
    /// The source's handle.
    pub from: String,
    /// The label.
    pub label: String,
    /// The target's handle.
    pub to: String,
}

/// How a new vertex is linked to the graph: exactly one of `from` and `to` is given.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Link {
    /// The vertex that the edge leaves for the new one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<String>,
    /// The label.
    pub label: String,
    /// The vertex that the edge enters from the new one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<String>,
    /// The link's attributes.
    #[serde(default, skip_serializing_if = "Unique::is_empty")]
    pub attributes: Unique<Tagged>,
}

/// One of the six mutations.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Mutation {
    /// Adds a vertex with its link.
    AddVertex {
        /// The handle that names the vertex from now on, in this case.
        r#as: String,
        /// Its type.
        r#type: String,
        /// Its name.
        name: String,
        /// Its attributes.
        #[serde(default, skip_serializing_if = "Unique::is_empty")]
        attributes: Unique<Tagged>,
        /// How it is linked.
        link: Link,
    },
    /// Adds an edge.
    AddEdge {
        /// The source's handle.
        from: String,
        /// The label.
        label: String,
        /// The target's handle.
        to: String,
        /// Its attributes.
        #[serde(default, skip_serializing_if = "Unique::is_empty")]
        attributes: Unique<Tagged>,
    },
    /// Sets and unsets attributes of exactly one of `vertex` and `edge`.
    UpdateAttributes {
        /// A vertex, by its handle.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        vertex: Option<String>,
        /// An edge: the one that the replica shows under this name.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        edge: Option<EdgeName>,
        /// What to set; null unsets.
        attributes: Unique<Option<Tagged>>,
    },
    /// Removes an edge.
    RemoveEdge {
        /// The source's handle.
        from: String,
        /// The label.
        label: String,
        /// The target's handle.
        to: String,
    },
    /// Moves an edge.
    MoveEdge {
        /// Its name.
        old: EdgeName,
        /// Its name from now on.
        new: EdgeName,
        /// The attributes that it then has.
        #[serde(default, skip_serializing_if = "Unique::is_empty")]
        attributes: Unique<Tagged>,
    },
    /// Removes a vertex.
    RemoveVertex {
        /// Its handle.
        vertex: String,
    },
}
