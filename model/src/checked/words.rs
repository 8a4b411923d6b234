//! Views, mutations and deltas for people.

use crate::graph::{Attributes, Element, Graph};
use dsr_core::{Delta, Dot, EdgeId, EdgeKey, ElementId, Mutation, Record, VertexId, View};
use std::fmt::Write;

/// What a view shows; its repairs are the remarks.
pub(super) fn graph(view: &View<'_>) -> Graph {
    let attributes = |of: Dot| -> Attributes {
        view.attributes_of(of).map(|(_, write)| (write.name.to_string(), write.value.to_string())).collect()
    };
    let vertices = view.vertices().iter().map(|&id| {
        let (name, vertex_type) = match view.vertex(id) {
            Some(vertex) => (vertex.name.to_string(), vertex.vertex_type.to_string()),
            None => ("root".into(), "root".into()),
        };
        (id.to_string(), Element::Vertex { name, vertex_type, attributes: attributes(id.0) })
    });
    let edges = view.edges().iter().map(|shown| {
        let EdgeKey { from, label, to } = shown.edge.key();
        let (from, to, label) = (from.to_string(), to.to_string(), label.to_string());
        (shown.id.to_string(), Element::Edge { from, to, label, attributes: attributes(shown.id.0) })
    });
    Graph {
        elements: vertices.chain(edges).collect(),
        remarks: view.repairs().iter().map(|repair| format!("repair: {repair}")).collect(),
    }
}

/// A mutation with the names that its author sees.
pub(super) fn mutation(view: &View<'_>, mutation: &Mutation) -> String {
    let vertex = |id: VertexId| match view.vertex(id) {
        Some(vertex) if view.vertex_by_name(&vertex.name) == Some(id) => vertex.name.to_string(),
        Some(vertex) => format!("{} ({id})", vertex.name),
        None => id.to_string(),
    };
    let edge = |id: EdgeId| match view.state().edge(id.0) {
        Some(edge) => format!("{} -{}-> {}", vertex(edge.from), edge.label, vertex(edge.to)),
        None => id.to_string(),
    };
    with(mutation, &vertex, &edge)
}

/// A mutation in words, with these names.
pub(super) fn with(
    mutation: &Mutation,
    vertex: &dyn Fn(VertexId) -> String,
    edge: &dyn Fn(EdgeId) -> String,
) -> String {
    let key = |key: &EdgeKey| format!("{} -{}-> {}", vertex(key.from), key.label, vertex(key.to));
    let what = match mutation {
        Mutation::AddVertex { vertex: new, link } if link.outgoing => {
            format!("{:?} -{}-> {}", new.name, link.label, vertex(link.other))
        }
        Mutation::AddVertex { vertex: new, link } => {
            format!("{} -{}-> {:?}", vertex(link.other), link.label, new.name)
        }
        Mutation::AddEdge { key: edge, .. } | Mutation::RemoveEdge { key: edge } => key(edge),
        Mutation::MoveEdge { from, to, .. } => format!("{} to {}", key(from), key(to)),
        Mutation::RemoveVertex { vertex: gone } => vertex(*gone),
        Mutation::UpdateAttributes { target, updates } => {
            let target = match *target {
                ElementId::Vertex(id) => vertex(id),
                ElementId::Edge(id) => edge(id),
            };
            updates.iter().fold(target, |mut text, (name, value)| {
                let _ = match value {
                    Some(value) => write!(text, " {name}={value}"),
                    None => write!(text, " unset {name}"),
                };
                text
            })
        }
    };
    format!("{} {what}", mutation.kind().name())
}

/// What a delta brings and what it has seen die.
pub(super) fn delta(delta: &Delta) -> String {
    let brings = delta.records().map(|(dot, record)| match record {
        Record::Vertex(vertex) => format!("+ vertex {} [{dot}]", vertex.name),
        Record::Edge(edge) => format!("+ edge {} [{dot}]", edge.key()),
        Record::Write(write) => format!("+ {}.{} = {} [{dot}]", write.target, write.name, write.value),
    });
    let held = |dot: Dot| delta.records().any(|(held, _)| held == dot);
    let kills = delta.context().runs().flat_map(|run| {
        let dots = (run.first..=run.last).map(move |sequence| Dot::new(run.replica, sequence));
        dots.filter(|&dot| !held(dot)).map(|dot| format!("− [{dot}]")).collect::<Vec<_>>()
    });
    brings.chain(kills).collect::<Vec<_>>().join(", ")
}
