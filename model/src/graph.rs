//! What a replica shows, the same for every semantics: for traces and drawings. `[spec: TRACE-2]`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

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
        let remarks = remarks
            .map(|remark| Change::Remark { remark: remark.clone(), holds: after.remarks.contains(remark) });
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

impl FromIterator<(String, Element)> for Graph {
    fn from_iter<I: IntoIterator<Item = (String, Element)>>(elements: I) -> Self {
        Self { elements: elements.into_iter().collect(), remarks: BTreeSet::new() }
    }
}

impl Element {
    /// A vertex without attributes.
    pub fn vertex(name: &str, vertex_type: &str) -> Self {
        Self::Vertex { name: name.into(), vertex_type: vertex_type.into(), attributes: Attributes::new() }
    }

    /// An edge without attributes.
    pub fn edge(from: &str, label: &str, to: &str) -> Self {
        Self::Edge { from: from.into(), to: to.into(), label: label.into(), attributes: Attributes::new() }
    }

    /// The same with an attribute more.
    #[must_use]
    pub fn with(mut self, name: &str, value: impl std::fmt::Display) -> Self {
        let (Self::Vertex { attributes, .. } | Self::Edge { attributes, .. }) = &mut self;
        attributes.insert(name.into(), value.to_string());
        self
    }

    /// Its attributes.
    pub const fn attributes(&self) -> &Attributes {
        match self {
            Self::Vertex { attributes, .. } | Self::Edge { attributes, .. } => attributes,
        }
    }
}

/// What elements are called in lines for people.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Names(BTreeMap<String, String>);

impl Names {
    /// Names of all that some graphs and changes speak of: a vertex has its own, with its id where another has
    /// the same; an edge that of its ends.
    pub fn of<'g>(elements: impl Iterator<Item = (&'g String, &'g Element)>) -> Self {
        let elements: BTreeMap<&String, &Element> = elements.collect();
        let name = |element: &Element| match element {
            Element::Vertex { name, .. } => Some(name.clone()),
            Element::Edge { .. } => None,
        };
        let mut owners: BTreeMap<String, usize> = BTreeMap::new();
        for name in elements.values().filter_map(|element| name(element)) {
            *owners.entry(name).or_default() += 1;
        }
        let unique = |id: &String, name: String| {
            if owners.get(&name).is_some_and(|&owners| owners > 1) { format!("{name} ({id})") } else { name }
        };
        let vertices =
            elements.iter().filter_map(|(&id, element)| Some((id.clone(), unique(id, name(element)?))));
        let mut names = Self(vertices.collect());
        for (&id, element) in &elements {
            if let Element::Edge { from, to, label, .. } = element {
                names.0.insert(id.clone(), format!("{} -{label}-> {}", names.get(from), names.get(to)));
            }
        }
        names
    }

    /// What an element is called: by its id if nothing better is known.
    pub fn get<'n>(&'n self, id: &'n str) -> &'n str {
        self.0.get(id).map_or(id, String::as_str)
    }
}

impl Change {
    /// In lines for people: `+` and `-` for what comes and goes, `±` for an attribute's new value.
    pub fn lines(&self, names: &Names) -> Vec<String> {
        match self {
            Self::Remark { remark, holds } => vec![format!("{} {remark}", if *holds { '+' } else { '-' })],
            Self::Element { element, before, after } => {
                element_lines(names, element, before.as_ref(), after.as_ref())
            }
        }
    }
}

fn element_lines(names: &Names, id: &str, before: Option<&Element>, after: Option<&Element>) -> Vec<String> {
    let told = |element: &Element| match element {
        Element::Vertex { name, vertex_type, .. } => format!("vertex {name} ({vertex_type})"),
        Element::Edge { from, to, label, .. } => {
            format!("edge {} -{label}-> {}", names.get(from), names.get(to))
        }
    };
    let (was, is) = (before.map(told), after.map(told));
    let mut lines = Vec::new();
    if was != is {
        lines.extend(was.map(|was| format!("- {was} [{id}]")));
        lines.extend(is.map(|is| format!("+ {is} [{id}]")));
    }
    let Some(after) = after else { return lines };
    let none = Attributes::new();
    let (old, new) = (before.map_or(&none, Element::attributes), after.attributes());
    let keys: BTreeSet<&String> = old.keys().chain(new.keys()).collect();
    let of = names.get(id);
    lines.extend(keys.into_iter().filter_map(|key| match (old.get(key), new.get(key)) {
        (None, Some(new)) => Some(format!("+ {of}.{key} = {new}")),
        (Some(old), None) => Some(format!("- {of}.{key} = {old}")),
        (Some(old), Some(new)) if old != new => Some(format!("± {of}.{key} = {old} → {new}")),
        _ => None,
    }));
    lines
}
