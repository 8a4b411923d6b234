//! The part of a graph that a search starts from: some vertices of a scene, and what holds them.

use dsr_core::{Dictionary, Dot, Placement, Record, State, VertexId, View, view};
use std::collections::{BTreeMap, BTreeSet};

/// A graph cut down to a focus.
#[derive(Clone, Debug)]
pub struct Focus {
    /// The vertices in focus, with everything among them.
    pub state: State,
    /// The vertices in focus, in the order they were named.
    pub vertices: Vec<VertexId>,
}

/// Why a graph cannot be cut down so.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FocusError {
    /// No vertex has this name.
    #[error("the graph has no vertex {name:?}; it has: {known}")]
    UnknownName {
        /// The name.
        name: String,
        /// Those that there are.
        known: String,
    },
    /// A vertex was named twice.
    #[error("{name:?} is named twice")]
    Twice {
        /// The name.
        name: String,
    },
}

/// The vertices named, those that hold them, and the edges among them; of the attributes only one called
/// `attribute` on the last vertex named, so that there is something to unset.
///
/// What holds a vertex (its ancestors in the tree) is part of the graph, not of the focus. A search over the
/// whole scene would do the same work in every state for elements that nobody touches.
pub fn cut(
    state: &State,
    dictionary: &Dictionary,
    names: &[&str],
    attribute: &str,
) -> Result<Focus, FocusError> {
    let graph = view(state, dictionary);
    let mut vertices = Vec::new();
    for &name in names {
        let vertex = graph.vertex_by_name(name).filter(|vertex| !vertex.is_root());
        let vertex = vertex.ok_or_else(|| unknown(name, &graph))?;
        if vertices.contains(&vertex) {
            return Err(FocusError::Twice { name: name.into() });
        }
        vertices.push(vertex);
    }
    let kept: BTreeSet<VertexId> = vertices.iter().flat_map(|&vertex| way_to_root(&graph, vertex)).collect();
    let target = vertices.last().map(|vertex| vertex.0);
    let keeps = |dot: Dot, record: &Record| match record {
        Record::Vertex(_) => kept.contains(&VertexId(dot)),
        Record::Edge(edge) => kept.contains(&edge.from) && kept.contains(&edge.to),
        Record::Write(write) => Some(write.target) == target && &*write.name == attribute,
    };
    let records: Vec<(Dot, Record)> = state
        .records()
        .filter(|(dot, record)| keeps(*dot, record))
        .map(|(dot, record)| (dot, record.clone()))
        .collect();
    // What was cut away counts as removed: seen, and held no more.
    Ok(Focus { state: State::assemble(records, state.context().clone()), vertices })
}

/// The vertices that hold `vertex`: up the kinematic tree, or where it has no place there along the
/// shortest path of edges, to the root.
fn way_to_root(graph: &View<'_>, vertex: VertexId) -> Vec<VertexId> {
    let mut toward: BTreeMap<VertexId, VertexId> = BTreeMap::new();
    let mut frontier = vec![VertexId::ROOT];
    while let Some(&at) = frontier.first() {
        frontier.remove(0);
        for shown in graph.edges() {
            let (from, to) = (shown.edge.from, shown.edge.to);
            let next = if from == at {
                to
            } else if to == at {
                from
            } else {
                continue;
            };
            if !next.is_root() && !toward.contains_key(&next) {
                toward.insert(next, at);
                frontier.push(next);
            }
        }
    }
    let up = |&at: &VertexId| match graph.placement(at) {
        Some(Placement::Child { parent, .. }) => Some(parent),
        Some(Placement::Outside) => toward.get(&at).copied(),
        _ => None,
    };
    core::iter::successors(Some(vertex), up).chain([VertexId::ROOT]).collect()
}

fn unknown(name: &str, graph: &View<'_>) -> FocusError {
    const SHOWN_MAX: usize = 40;
    let names =
        || graph.vertices().iter().filter_map(|&vertex| graph.vertex(vertex).map(|vertex| &*vertex.name));
    let shown = names().take(SHOWN_MAX).collect::<Vec<_>>().join(", ");
    let more = names().count().saturating_sub(SHOWN_MAX);
    let known = if more > 0 { format!("{shown} and {more} more") } else { shown };
    FocusError::UnknownName { name: name.into(), known }
}
