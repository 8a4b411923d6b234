//! What is asked about.

use crate::graph::{Change, Element};
use crate::trace::Trace;
use std::collections::BTreeMap;

/// An element or an attribute, by the ids of the trace.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Target {
    /// A vertex.
    Vertex {
        /// Its id.
        id: String,
    },
    /// An edge, and what competes with it.
    Edge {
        /// Its id.
        id: String,
        /// Where it starts.
        from: String,
        /// Its label.
        label: String,
        /// Where it ends.
        to: String,
    },
    /// An attribute.
    Attribute {
        /// Of which element, by id.
        of: String,
        /// Its name.
        name: String,
    },
}

/// Why it is not known what is asked about.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum TargetError {
    /// Nothing has this id or name.
    #[error("nothing in the trace is called {element:?}; there are {known}")]
    Unknown {
        /// What was asked for.
        element: String,
        /// What there is.
        known: String,
    },
    /// Several have this name.
    #[error("{element:?} can be {ids}: ask by id")]
    Ambiguous {
        /// What was asked for.
        element: String,
        /// Their ids.
        ids: String,
    },
}

/// The most names that an error lists.
const KNOWN_MAX: usize = 20;

impl Target {
    /// Finds an element by id or name (`r1.2`, `bed`, `person -in-> bed`), or an attribute of one (`bed.level`).
    pub fn find(trace: &Trace, element: &str) -> Result<Self, TargetError> {
        let known = elements(trace);
        if let Some(target) = whole(trace, &known, element)? {
            return Ok(target);
        }
        if let Some((of, name)) = element.rsplit_once('.')
            && let Some(target) = whole(trace, &known, of)?
        {
            let of = match target {
                Self::Vertex { id } | Self::Edge { id, .. } | Self::Attribute { of: id, .. } => id,
            };
            return Ok(Self::Attribute { of, name: name.into() });
        }
        let names = trace.names();
        let mut known: Vec<&str> = known.keys().map(|id| names.get(id)).collect();
        known.truncate(KNOWN_MAX);
        Err(TargetError::Unknown { element: element.into(), known: known.join(", ") })
    }

    /// What it is called.
    pub fn name(&self, trace: &Trace) -> String {
        let names = trace.names();
        match self {
            Self::Vertex { id } | Self::Edge { id, .. } => names.get(id).to_owned(),
            Self::Attribute { of, name } => format!("{}.{name}", names.get(of)),
        }
    }
}

/// Everything that any replica ever shows, the latest of each id.
fn elements(trace: &Trace) -> BTreeMap<&String, &Element> {
    let starts = trace.replicas.iter().flat_map(|replica| &replica.starts.elements);
    let changes = trace.steps.iter().flat_map(|step| &step.changes);
    let later = changes.filter_map(|change| match change {
        Change::Element { element, after: Some(after), .. } => Some((element, after)),
        _ => None,
    });
    starts.chain(later).collect()
}

/// The element of an id or a name.
fn whole(
    trace: &Trace,
    known: &BTreeMap<&String, &Element>,
    element: &str,
) -> Result<Option<Target>, TargetError> {
    let names = trace.names();
    let bare = |found: &Element| match found {
        Element::Vertex { name, .. } => name == element,
        Element::Edge { .. } => false,
    };
    let by_id: Vec<(&&String, &&Element)> = known.iter().filter(|(id, _)| **id == element).collect();
    let by_name = known.iter().filter(|(id, found)| names.get(id) == element || bare(found));
    let fitting: Vec<_> = if by_id.is_empty() { by_name.collect() } else { by_id };
    match fitting[..] {
        [] => Ok(None),
        [(id, Element::Vertex { .. })] => Ok(Some(Target::Vertex { id: (*id).clone() })),
        [(id, Element::Edge { from, to, label, .. })] => Ok(Some(Target::Edge {
            id: (*id).clone(),
            from: from.clone(),
            label: label.clone(),
            to: to.clone(),
        })),
        _ => {
            let ids: Vec<&str> = fitting.iter().map(|(id, _)| id.as_str()).collect();
            Err(TargetError::Ambiguous { element: element.into(), ids: ids.join(" or ") })
        }
    }
}
