//! What every view must keep, judged by the view alone. `[spec: CONF-7.1]`

use crate::protocol::{EdgeView, ROOT, Tagged, Unique, View};
use dsr_core::{Dictionary, RT};
use std::collections::{BTreeMap, BTreeSet};

/// How a view breaks an invariant.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Broken {
    /// I1.
    #[error("{vertex} has no path to root")]
    NoPath {
        /// The vertex.
        vertex: String,
    },
    /// I2.
    #[error("the edge {edge} joins {end}, which is not in the graph")]
    Dangling {
        /// The edge.
        edge: String,
        /// The missing end.
        end: String,
    },
    /// I2.
    #[error("{vertex} hangs from root, and is not in the graph")]
    HungAbsent {
        /// The vertex.
        vertex: String,
    },
    /// I3.
    #[error("the kinematic tree is none: {0}")]
    NoTree(Tree),
    /// I4.
    #[error("the edge {edge} joins a vertex to itself")]
    SelfLoop {
        /// The edge.
        edge: String,
    },
    /// I5.
    #[error("the attribute {attribute:?} of {element} is not what the dictionary allows")]
    Undeclared {
        /// The attribute.
        attribute: String,
        /// What it is of.
        element: String,
    },
    /// Two edges in one register.
    #[error("{first} and {second} are both shown")]
    TwoShown {
        /// One.
        first: String,
        /// The other.
        second: String,
    },
}

/// How `RT` edges are no tree.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Tree {
    /// Two parents.
    #[error("{vertex} has the parents {first} and {second}")]
    TwoParents {
        /// The child.
        vertex: String,
        /// A parent.
        first: String,
        /// The other.
        second: String,
    },
    /// An edge into the root.
    #[error("{from} is a parent of root")]
    IntoRoot {
        /// Its source.
        from: String,
    },
    /// A cycle.
    #[error("{vertex} is above itself")]
    Cycle {
        /// A vertex on it.
        vertex: String,
    },
    /// A vertex that hangs and has a parent.
    #[error("{vertex} hangs from root and has a parent")]
    HungChild {
        /// The vertex.
        vertex: String,
    },
}

impl Broken {
    /// The invariant.
    pub const fn clause(&self) -> &'static str {
        match self {
            Self::NoPath { .. } => "INV-1",
            Self::Dangling { .. } | Self::HungAbsent { .. } => "INV-2",
            Self::NoTree(_) => "INV-3",
            Self::SelfLoop { .. } => "INV-4",
            Self::Undeclared { .. } => "INV-5",
            Self::TwoShown { .. } => "INV-6",
        }
    }
}

/// The first invariant that a view breaks; edges and their ends first, paths last. O(view · log view).
/// `[property: INV-1]` to `[property: INV-6]`
pub fn broken(view: &View, dictionary: Option<&Dictionary>) -> Option<Broken> {
    ends(view)
        .or_else(|| registers(view, dictionary))
        .or_else(|| tree(view).map(Broken::NoTree))
        .or_else(|| paths(view))
        .or_else(|| attributes(view, dictionary?))
}

fn text(edge: &EdgeView) -> String {
    format!("{} -{}-> {}", edge.from, edge.label, edge.to)
}

fn ends(view: &View) -> Option<Broken> {
    let is_there = |handle: &str| handle == ROOT || view.vertices.0.contains_key(handle);
    if let Some(vertex) = view.hung.iter().find(|handle| !is_there(handle)) {
        return Some(Broken::HungAbsent { vertex: vertex.clone() });
    }
    view.edges.iter().find_map(|edge| {
        if edge.from == edge.to {
            return Some(Broken::SelfLoop { edge: text(edge) });
        }
        let end = [&edge.from, &edge.to].into_iter().find(|end| !is_there(end))?;
        Some(Broken::Dangling { edge: text(edge), end: end.clone() })
    })
}

fn registers(view: &View, dictionary: Option<&Dictionary>) -> Option<Broken> {
    let is_functional = |label: &str| dictionary.is_some_and(|dictionary| dictionary.is_functional(label));
    let mut shown = BTreeMap::new();
    view.edges.iter().find_map(|edge| {
        let target = if is_functional(&edge.label) { None } else { Some(&edge.to) };
        let first = shown.insert((&edge.from, &edge.label, target), edge)?;
        Some(Broken::TwoShown { first: text(first), second: text(edge) })
    })
}

fn tree(view: &View) -> Option<Tree> {
    let mut parents: BTreeMap<&str, &str> = BTreeMap::new();
    for edge in view.edges.iter().filter(|edge| edge.label == RT) {
        if edge.to == ROOT {
            return Some(Tree::IntoRoot { from: edge.from.clone() });
        }
        if let Some(first) = parents.insert(&edge.to, &edge.from) {
            let (first, second) = (first.to_owned(), edge.from.clone());
            return Some(Tree::TwoParents { vertex: edge.to.clone(), first, second });
        }
    }
    if let Some(vertex) = view.hung.iter().find(|handle| parents.contains_key(handle.as_str())) {
        return Some(Tree::HungChild { vertex: vertex.clone() });
    }
    let mut sound: BTreeSet<&str> = BTreeSet::new();
    for &start in parents.keys() {
        let mut way = BTreeSet::new();
        let mut at = start;
        while !sound.contains(at) {
            if !way.insert(at) {
                return Some(Tree::Cycle { vertex: at.to_owned() });
            }
            match parents.get(at) {
                Some(parent) => at = parent,
                None => break,
            }
        }
        sound.append(&mut way);
    }
    None
}

fn paths(view: &View) -> Option<Broken> {
    let mut neighbours: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    let hung = view.hung.iter().map(|handle| (ROOT, handle.as_str()));
    let edges = view.edges.iter().map(|edge| (edge.from.as_str(), edge.to.as_str()));
    for (one, other) in edges.chain(hung) {
        neighbours.entry(one).or_default().push(other);
        neighbours.entry(other).or_default().push(one);
    }
    let (mut reached, mut ahead) = (BTreeSet::from([ROOT]), vec![ROOT]);
    while let Some(at) = ahead.pop() {
        for &next in neighbours.get(at).into_iter().flatten() {
            if reached.insert(next) {
                ahead.push(next);
            }
        }
    }
    let vertex = view.vertices.0.keys().find(|handle| !reached.contains(handle.as_str()))?;
    Some(Broken::NoPath { vertex: vertex.clone() })
}

fn attributes(view: &View, dictionary: &Dictionary) -> Option<Broken> {
    let wrong = |attributes: &Unique<Tagged>, element: &dyn Fn() -> String| {
        let allowed =
            |(name, value): (&String, &Tagged)| dictionary.allows_attribute(name, value.0.value_type());
        let (attribute, _) = attributes.0.iter().find(|&pair| !allowed(pair))?;
        Some(Broken::Undeclared { attribute: attribute.clone(), element: element() })
    };
    let vertices = view.vertices.0.iter();
    wrong(&view.root.attributes, &|| ROOT.into())
        .or_else(|| {
            vertices.into_iter().find_map(|(handle, vertex)| wrong(&vertex.attributes, &|| handle.clone()))
        })
        .or_else(|| view.edges.iter().find_map(|edge| wrong(&edge.attributes, &|| text(edge))))
}
