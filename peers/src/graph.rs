//! What a replica shows, whichever library holds it.

use dsr_conformance::protocol::{EdgeName, EdgeView, ROOT, RootView, Tagged, Unique, VertexView, View};
use dsr_core::RT;
use std::collections::{BTreeMap, BTreeSet};

/// Attributes by name.
pub type Attributes = BTreeMap<String, Tagged>;

/// A vertex.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Vertex {
    /// Its type.
    pub vertex_type: String,
    /// Its name.
    pub name: String,
    /// What readers get of each attribute.
    pub attributes: Attributes,
}

/// The graph that a document shows. Vertices are named by the harness's handles, which are unique in a case and serve
/// the documents as ids. `[spec: CONF-5]`
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Graph {
    /// Every vertex but the root.
    pub vertices: BTreeMap<String, Vertex>,
    /// The edges, both of whose ends are there.
    pub edges: BTreeMap<EdgeName, Attributes>,
    /// The root's attributes.
    pub root: Attributes,
}

impl Graph {
    /// Whether a handle names the root or a vertex that is there.
    pub fn has(&self, handle: &str) -> bool {
        handle == ROOT || self.vertices.contains_key(handle)
    }

    /// Adds an edge if both its ends are there; what dangles is not shown (INV-2).
    pub fn show(&mut self, edge: EdgeName, attributes: Attributes) {
        if self.has(&edge.from) && self.has(&edge.to) {
            self.edges.insert(edge, attributes);
        }
    }

    fn kinematic(&self) -> impl Iterator<Item = &EdgeName> {
        self.edges.keys().filter(|edge| edge.label == RT)
    }

    /// The kinematic parent of a vertex.
    pub fn parent(&self, vertex: &str) -> Option<&str> {
        self.kinematic().find(|edge| edge.to == vertex).map(|edge| edge.from.as_str())
    }

    fn has_child(&self, vertex: &str) -> bool {
        self.kinematic().any(|edge| edge.from == vertex)
    }

    /// Whether a vertex has a place in the kinematic tree (VIEW-4).
    pub fn in_tree(&self, vertex: &str) -> bool {
        vertex == ROOT || self.parent(vertex).is_some() || self.has_child(vertex)
    }

    /// Whether `above` is a vertex or one of its kinematic ancestors.
    pub fn is_at_or_above(&self, above: &str, vertex: &str) -> bool {
        let mut seen = BTreeSet::new();
        let mut at = Some(vertex);
        while let Some(vertex) = at {
            if vertex == above {
                return true;
            }
            at = if seen.insert(vertex) { self.parent(vertex) } else { None };
        }
        false
    }

    /// The vertices with children and without a kinematic parent (VIEW-4).
    fn detached(&self) -> impl Iterator<Item = &str> {
        let vertices = self.vertices.keys().map(String::as_str);
        vertices.filter(|vertex| self.parent(vertex).is_none() && self.has_child(vertex))
    }

    /// The vertices that are detached, or have no path to the root (VIEW-5).
    pub fn stranded(&self) -> BTreeSet<&str> {
        let mut reached = BTreeSet::from([ROOT]);
        let mut found = true;
        while found {
            found = false;
            for edge in self.edges.keys() {
                let (from, to) = (reached.contains(&*edge.from), reached.contains(&*edge.to));
                if from != to {
                    found |= reached.insert(if from { &edge.to } else { &edge.from });
                }
            }
        }
        let cut_off = self.vertices.keys().map(String::as_str).filter(|vertex| !reached.contains(vertex));
        cut_off.chain(self.detached()).collect()
    }

    /// The graph in the form of the protocol. Two rules say which vertices hang from the root without an edge, and each
    /// looks at one vertex alone: it has children and no kinematic parent, or it has no edge at all. Whatever else is
    /// not connected is not mended here. `[spec: CONF-7]`
    pub fn view(&self) -> View {
        let lonely = self.vertices.keys().map(String::as_str);
        let lonely =
            lonely.filter(|vertex| !self.edges.keys().any(|edge| edge.from == *vertex || edge.to == *vertex));
        let edges = self.edges.iter().map(|(edge, attributes)| EdgeView {
            from: edge.from.clone(),
            label: edge.label.clone(),
            to: edge.to.clone(),
            attributes: Unique(attributes.clone()),
        });
        let vertices = self.vertices.iter().map(|(handle, vertex)| {
            let shown = VertexView {
                r#type: vertex.vertex_type.clone(),
                name: vertex.name.clone(),
                attributes: Unique(vertex.attributes.clone()),
            };
            (handle.clone(), shown)
        });
        View {
            vertices: Unique(vertices.collect()),
            edges: edges.collect(),
            root: RootView { attributes: Unique(self.root.clone()) },
            hung: self.detached().chain(lonely).map(String::from).collect(),
            repairs: None,
        }
    }
}
