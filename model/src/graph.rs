//! What a replica shows, the same for every semantics: for traces and drawings. `[spec: TRACE-2]`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// Names and values of attributes, as texts.
pub type Attributes = BTreeMap<String, String>;

/// A graph as a user of one replica sees it. `[spec: TRACE-2]`
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Graph {
    /// Vertices and edges by id.
    pub elements: BTreeMap<String, Element>,
    /// Lines about the whole: repairs, what is held back, faults.
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    pub remarks: BTreeSet<String>,
}

/// A vertex or an edge. `[spec: TRACE-2]`
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "is", rename_all = "snake_case", deny_unknown_fields)]
pub enum Element {
    /// A vertex.
    Vertex {
        /// Its name.
        name: String,
        /// Its type.
        #[serde(rename = "type")]
        vertex_type: String,
        /// Its attributes.
        #[serde(default, skip_serializing_if = "Attributes::is_empty")]
        attributes: Attributes,
    },
    /// An edge.
    Edge {
        /// The id of the vertex where it starts.
        from: String,
        /// The id of the vertex where it ends; there may be no such vertex.
        to: String,
        /// Its label: `RT` for a kinematic edge.
        label: String,
        /// Its attributes.
        #[serde(default, skip_serializing_if = "Attributes::is_empty")]
        attributes: Attributes,
    },
}

/// A difference between two graphs. `[spec: TRACE-2]`
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum Change {
    /// Of an element.
    Element {
        /// Its id.
        element: String,
        /// As it was, null if it is new.
        before: Option<Element>,
        /// As it is, null if it is gone.
        after: Option<Element>,
    },
    /// Of a remark.
    Remark {
        /// The remark.
        remark: String,
        /// Whether it holds now.
        holds: bool,
    },
}

/// A change that does not start from what a graph shows.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum ChangeError {
    /// The element is not as the change says it was.
    #[error("{element} is changed from something that it was not")]
    Element {
        /// The element.
        element: String,
    },
    /// The remark held already, or did not.
    #[error("the remark {remark:?} is changed from what it was not")]
    Remark {
        /// The remark.
        remark: String,
    },
}

impl Graph {
    /// The changes that make `after` of this graph: elements by id, then remarks.
    pub fn changes(&self, after: &Self) -> Vec<Change> {
        let ids: BTreeSet<&String> = self.elements.keys().chain(after.elements.keys()).collect();
        let elements = ids.into_iter().filter_map(|id| {
            let (before, after) = (self.elements.get(id), after.elements.get(id));
            let change =
                Change::Element { element: id.clone(), before: before.cloned(), after: after.cloned() };
            (before != after).then_some(change)
        });
        let remarks = self.remarks.symmetric_difference(&after.remarks);
        let remarks = remarks.map(|remark| Change::Remark {
            remark: remark.clone(),
            holds: after.remarks.contains(remark),
        });
        elements.chain(remarks).collect()
    }

    /// Makes a change.
    pub fn change(&mut self, change: &Change) -> Result<(), ChangeError> {
        match change {
            Change::Element { element, before, after } => {
                if self.elements.get(element) != before.as_ref() {
                    return Err(ChangeError::Element { element: element.clone() });
                }
                match after {
                    Some(after) => self.elements.insert(element.clone(), after.clone()),
                    None => self.elements.remove(element),
                };
            }
            Change::Remark { remark, holds } => {
                let is_new =
                    if *holds { self.remarks.insert(remark.clone()) } else { self.remarks.remove(remark) };
                if !is_new {
                    return Err(ChangeError::Remark { remark: remark.clone() });
                }
            }
        }
        Ok(())
    }
}

impl Element {
    /// Its attributes.
    pub const fn attributes(&self) -> &Attributes {
        match self {
            Self::Vertex { attributes, .. } | Self::Edge { attributes, .. } => attributes,
        }
    }
}

/// As in `vertex person (person)` and `edge r1.2 -in-> r1.5`.
impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Vertex { name, vertex_type, .. } => write!(f, "vertex {name} ({vertex_type})"),
            Self::Edge { from, to, label, .. } => write!(f, "edge {from} -{label}-> {to}"),
        }
    }
}

impl Change {
    /// In lines for people: `+` and `-` for what comes and goes, `attribute: old → new` for the rest.
    pub fn lines(&self) -> Vec<String> {
        match self {
            Self::Remark { remark, holds } => vec![format!("{} {remark}", if *holds { '+' } else { '-' })],
            Self::Element { element, before, after } => {
                let none = Attributes::new();
                let attributes = |of: &Option<Element>| of.as_ref().map_or(none.clone(), |of| of.attributes().clone());
                let (old, new) = (attributes(before), attributes(after));
                let mut lines = Vec::new();
                match (before, after) {
                    (Some(before), None) => return vec![format!("- {before} [{element}]")],
                    (None, Some(after)) => lines.push(format!("+ {after} [{element}]")),
                    (Some(before), Some(after)) if before.to_string() != after.to_string() => {
                        lines.extend([format!("- {before} [{element}]"), format!("+ {after} [{element}]")]);
                    }
                    _ => {}
                }
                let keys: BTreeSet<&String> = old.keys().chain(new.keys()).collect();
                for key in keys {
                    match (old.get(key), new.get(key)) {
                        (None, Some(new)) => lines.push(format!("+ {element}.{key} = {new}")),
                        (Some(old), None) => lines.push(format!("- {element}.{key} = {old}")),
                        (Some(old), Some(new)) if old != new => {
                            lines.push(format!("± {element}.{key} = {old} → {new}"));
                        }
                        _ => {}
                    }
                }
                lines
            }
        }
    }
}
