//! What a replica shows its users, as plain data, so that a flaw can show something else.

use dsr_core::{Dot, Edge, EdgeId, Name, Record, Repair, State, VertexId, View};
use std::collections::{BTreeMap, BTreeSet};

/// A graph as users see it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Shown {
    /// The vertices, the root included.
    pub vertices: BTreeSet<VertexId>,
    /// The edges shown.
    pub edges: BTreeMap<EdgeId, Edge>,
    /// The edges reported as hidden.
    pub hidden: BTreeSet<EdgeId>,
    /// The vertices reported as detached or reattached: they hang from the root by repair.
    pub hung: BTreeSet<VertexId>,
    /// The vertex that each name finds.
    pub names: BTreeMap<Name, VertexId>,
    /// The winning write of each attribute.
    pub attributes: BTreeMap<(Dot, Name), Dot>,
}

impl Shown {
    /// What the core shows.
    pub fn of(view: &View<'_>) -> Self {
        let mut hidden = BTreeSet::new();
        let mut hung = BTreeSet::new();
        for repair in view.repairs() {
            match repair {
                Repair::Superseded { hidden: edge, .. } | Repair::CycleBroken { hidden: edge } => {
                    hidden.insert(*edge);
                }
                Repair::Detached { vertex } | Repair::Reattached { vertex } => {
                    hung.insert(*vertex);
                }
                Repair::NameClash { .. } | Repair::Undeclared { .. } => {}
            }
        }
        let vertices: BTreeSet<VertexId> = view.vertices().iter().copied().collect();
        let records = vertices.iter().filter_map(|&vertex| view.vertex(vertex));
        let names = records
            .filter_map(|vertex| Some((vertex.name.clone(), view.vertex_by_name(&vertex.name)?)))
            .collect();
        let registers = view.writes().iter().map(|(_, write)| (write.target, write.name.clone()));
        let attributes = registers
            .filter_map(|(target, name)| Some(((target, name.clone()), view.attribute(target, &name)?.0)))
            .collect();
        let edges = view.edges().iter().map(|shown| (shown.id, shown.edge.clone())).collect();
        Self { vertices, edges, hidden, hung, names, attributes }
    }

    /// Shows an edge that was hidden.
    pub fn unhide(&mut self, state: &State, edge: EdgeId) {
        if let Some(Record::Edge(record)) = state.get(edge.0) {
            self.hidden.remove(&edge);
            self.edges.insert(edge, record.clone());
        }
    }

    /// Hides an edge that was shown.
    pub fn hide(&mut self, edge: EdgeId) {
        if self.edges.remove(&edge).is_some() {
            self.hidden.insert(edge);
        }
    }
}
