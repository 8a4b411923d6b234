//! From a graph of symbols to a state: which dot each gets. `[spec: SCENE-14]`

use super::graph::Graph;
use super::symbols::Attributes;
use crate::dot::{Dot, ReplicaId, VertexId};
use crate::record::{Edge, Record, Vertex, Write};
use crate::state::State;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;

/// The stamp of every record of a scene: nothing in it was said before anything else.
const STAMP: u64 = 1;

/// A state, and where its records come from.
pub(super) struct Assembled {
    pub(super) state: State,
    /// Beside the graph's symbols.
    pub(super) vertices: Vec<VertexId>,
    /// Which symbol a vertex comes from.
    pub(super) symbols: BTreeMap<VertexId, usize>,
    /// Which symbol, and which of its links, an edge comes from.
    pub(super) links: BTreeMap<Dot, (usize, usize)>,
}

/// Dots of [`ReplicaId::SCENE`]: first all vertices, then all links, then the attributes of all vertices,
/// then those of all links; each in the order of the graph. `[spec: SCENE-14]`
pub(super) fn assemble(graph: &Graph) -> Assembled {
    let mut maker = Maker { state: State::new(), sequence: 0 };
    let mut vertices = Vec::with_capacity(graph.symbols.len());
    let mut by_id = BTreeMap::new();
    for (at, symbol) in graph.symbols.iter().enumerate() {
        let id = if at == graph.root {
            VertexId::ROOT
        } else {
            let (vertex_type, name) = (symbol.vertex_type.clone(), symbol.name.clone());
            let vertex = Vertex { vertex_type, name, external_id: Some(symbol.id), stamp: STAMP };
            VertexId(maker.add(Record::Vertex(vertex)))
        };
        vertices.push(id);
        by_id.insert(symbol.id, id);
    }
    let mut links = BTreeMap::new();
    for (at, (symbol, &from)) in graph.symbols.iter().zip(&vertices).enumerate() {
        for (index, link) in symbol.links.iter().enumerate() {
            // Every target was looked up when the graph was resolved.
            let Some(&to) = by_id.get(&link.target) else { continue };
            let edge = Edge { from, to, label: link.label.clone(), stamp: STAMP };
            links.insert(maker.add(Record::Edge(edge)), (at, index));
        }
    }
    for (symbol, vertex) in graph.symbols.iter().zip(&vertices) {
        maker.add_writes(vertex.0, &symbol.attributes);
    }
    for (&dot, &(at, index)) in &links {
        let link = graph.symbols.get(at).and_then(|symbol| symbol.links.get(index));
        if let Some(link) = link {
            maker.add_writes(dot, &link.attributes);
        }
    }
    let symbols = vertices.iter().enumerate().map(|(at, &vertex)| (vertex, at)).collect();
    Assembled { state: maker.state, vertices, symbols, links }
}

struct Maker {
    state: State,
    sequence: u64,
}

impl Maker {
    fn add(&mut self, record: Record) -> Dot {
        self.sequence += 1;
        let dot = Dot::new(ReplicaId::SCENE, self.sequence);
        self.state.insert(dot, record);
        dot
    }

    fn add_writes(&mut self, target: Dot, attributes: &Attributes) {
        for (name, (value, timestamp_ns)) in attributes {
            let (name, value, timestamp_ns) = (name.clone(), value.clone(), *timestamp_ns);
            self.add(Record::Write(Write { target, name, value, timestamp_ns, stamp: STAMP }));
        }
    }
}
