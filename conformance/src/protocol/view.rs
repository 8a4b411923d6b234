//! What a replica shows. `[spec: CONF-7]`

use super::{Tagged, Unique};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The graph that a replica shows. The order of lists means nothing.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct View {
    /// Every vertex but the root, by its handle.
    pub vertices: Unique<VertexView>,
    /// Every edge.
    pub edges: Vec<EdgeView>,
    /// The root.
    pub root: RootView,
    /// The vertices that hang from ROOT by repair, without an edge (VIEW-4, VIEW-5), by handle.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub hung: Vec<String>,
    /// The kind of each repair (JSON-14), as often as it was made. Feature `repairs`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub repairs: Option<Vec<String>>,
}

/// A vertex.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VertexView {
    /// Its type.
    pub r#type: String,
    /// Its name.
    pub name: String,
    /// What readers get of each attribute.
    #[serde(default, skip_serializing_if = "Unique::is_empty")]
    pub attributes: Unique<Tagged>,
}

/// An edge.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EdgeView {
    /// The source's handle.
    pub from: String,
    /// The label.
    pub label: String,
    /// The target's handle.
    pub to: String,
    /// What readers get of each attribute.
    #[serde(default, skip_serializing_if = "Unique::is_empty")]
    pub attributes: Unique<Tagged>,
}

/// The root.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RootView {
    /// What readers get of each attribute.
    #[serde(default, skip_serializing_if = "Unique::is_empty")]
    pub attributes: Unique<Tagged>,
}

impl View {
    /// The same view with its lists in order: two views are equal if these are. `[spec: CONF-7]`
    #[must_use]
    pub fn canonical(mut self) -> Self {
        self.edges.sort_unstable();
        self.hung.sort_unstable();
        if let Some(repairs) = &mut self.repairs {
            repairs.sort_unstable();
        }
        self
    }
}
