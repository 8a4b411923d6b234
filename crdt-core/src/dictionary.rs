//! The dictionary: the names that all agents share, as data. `[spec: DICT-1]`

use crate::record::{Name, RT};
use crate::value::ValueType;
use alloc::collections::{BTreeMap, BTreeSet};

/// Vertex types, edge labels, attribute names with their value types, and which labels are functional.
///
/// All replicas of one graph use the same dictionary: the view depends on it. `[spec: DICT-1]`
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Dictionary {
    /// Closed: a name that is not listed is refused. Open: it is accepted with any value type.
    pub closed: bool,
    /// Vertex types.
    pub vertex_types: BTreeSet<Name>,
    /// Edge labels.
    pub edge_labels: BTreeSet<Name>,
    /// Labels of which a source shows at most one edge, such as `in`. `RT` is never one: it is unique per
    /// child instead. `[spec: DICT-3]`
    pub functional_labels: BTreeSet<Name>,
    /// Attribute names and the type of their values.
    pub attributes: BTreeMap<Name, ValueType>,
}

impl Dictionary {
    /// The open dictionary that declares nothing.
    pub fn open() -> Self {
        Self::default()
    }

    /// Declares a functional label. `[spec: DICT-3]`
    #[must_use]
    pub fn with_functional(mut self, label: &str) -> Self {
        self.edge_labels.insert(label.into());
        if label != RT {
            self.functional_labels.insert(label.into());
        }
        self
    }

    /// Whether a vertex may have this type. `[spec: DICT-2]`
    pub fn allows_type(&self, vertex_type: &str) -> bool {
        !self.closed || self.vertex_types.contains(vertex_type)
    }

    /// Whether an edge may have this label. `[spec: DICT-2]`
    pub fn allows_label(&self, label: &str) -> bool {
        !self.closed || label == RT || self.edge_labels.contains(label)
    }

    /// Whether a source shows at most one edge of this label. `[spec: DICT-3]`
    pub fn is_functional(&self, label: &str) -> bool {
        self.functional_labels.contains(label) && label != RT
    }

    /// The declared type of an attribute.
    pub fn attribute_type(&self, name: &str) -> Option<ValueType> {
        self.attributes.get(name).copied()
    }

    /// Whether an attribute may hold a value of this type. `[spec: INV-5]`
    pub fn allows_attribute(&self, name: &str, value_type: ValueType) -> bool {
        self.attribute_type(name).map_or(!self.closed, |declared| declared == value_type)
    }
}
