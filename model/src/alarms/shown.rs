//! What a replica shows its users, so that a flaw can show something else. It is judged by the core's own
//! judges, as the core's view is.

use dsr_core::{
    Dictionary, Dot, EdgeId, Name, Placement, Record, Repair, ShownEdge, Shows, State, VertexId, View, Write,
    is_root_name,
};
use std::collections::BTreeMap;

/// A graph as users see it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Shown<'s> {
    state: &'s State,
    dictionary: &'s Dictionary,
    vertices: Vec<VertexId>,
    placements: BTreeMap<VertexId, Placement>,
    /// The edges shown.
    pub edges: Vec<ShownEdge<'s>>,
    /// The vertex that each name finds.
    pub names: BTreeMap<Name, VertexId>,
    /// The writes shown, by target and name, the winner of each first.
    pub writes: Vec<(Dot, &'s Write)>,
    /// What is reported.
    pub repairs: Vec<Repair>,
}

impl<'s> Shown<'s> {
    /// What the core shows.
    pub fn of(view: &View<'s>) -> Self {
        let vertices = view.vertices().to_vec();
        let records = vertices.iter().filter_map(|&vertex| view.vertex(vertex));
        let names = records
            .filter_map(|vertex| Some((vertex.name.clone(), view.vertex_by_name(&vertex.name)?)))
            .collect();
        let placed = vertices.iter().filter_map(|&vertex| Some((vertex, view.placement(vertex)?)));
        Self {
            state: view.state(),
            dictionary: view.dictionary(),
            placements: placed.collect(),
            vertices,
            edges: view.edges().to_vec(),
            names,
            writes: view.writes().to_vec(),
            repairs: view.repairs().to_vec(),
        }
    }

    /// Shows an edge that was hidden.
    pub fn unhide(&mut self, edge: EdgeId) {
        if let Some(Record::Edge(record)) = self.state.get(edge.0) {
            self.edges.push(ShownEdge { id: edge, edge: record });
        }
    }

    /// Hides an edge that was shown.
    pub fn hide(&mut self, edge: EdgeId) {
        self.edges.retain(|shown| shown.id != edge);
    }
}

impl Shows for Shown<'_> {
    fn state(&self) -> &State {
        self.state
    }

    fn dictionary(&self) -> &Dictionary {
        self.dictionary
    }

    fn vertices(&self) -> &[VertexId] {
        &self.vertices
    }

    fn edges(&self) -> &[ShownEdge<'_>] {
        &self.edges
    }

    fn placement(&self, vertex: VertexId) -> Option<Placement> {
        self.placements.get(&vertex).copied()
    }

    fn vertex_by_name(&self, name: &str) -> Option<VertexId> {
        self.names.get(name).copied().or_else(|| is_root_name(name).then_some(VertexId::ROOT))
    }

    fn writes(&self) -> &[(Dot, &Write)] {
        &self.writes
    }

    fn repairs(&self) -> &[Repair] {
        &self.repairs
    }
}
