//! Mutations of the graph as it is: rooms and robots, poses, moves, removals, images.

use dsr_core::{
    AttributeUpdates, Dictionary, EdgeKey, ElementId, Graph, Mutation, NewVertex, Value, ValueType, VertexId,
    VertexLink,
};

/// The dictionary of simulations: `in` is functional.
pub(super) fn dictionary() -> Dictionary {
    let mut dictionary = Dictionary::open().with_functional("in");
    dictionary.attributes.insert("pose".into(), ValueType::Vec6);
    dictionary.attributes.insert("image".into(), ValueType::ByteVec);
    dictionary
}

/// A mutation by a number: many are allowed, some are not.
pub(super) fn mutation(graph: &Graph, choice: u64) -> Mutation {
    let vertices: Vec<VertexId> = graph.vertices().take(200).collect();
    let edges: Vec<_> = graph.edges().take(200).collect();
    let part =
        |shift: u32, count: usize| usize::try_from(choice >> shift & 0xfff).unwrap_or(0) % count.max(1);
    let vertex = |shift: u32| vertices.get(part(shift, vertices.len())).copied().unwrap_or(VertexId::ROOT);
    let edge = |shift: u32| edges.get(part(shift, edges.len())).map(|(id, edge)| (*id, edge.key()));
    let add = || {
        // Few names, so that replicas choose the same ones.
        let vertex_of = NewVertex::new("thing", &format!("t{}", choice >> 40 & 0x3f));
        let link =
            if choice & 1 == 0 { VertexLink::child_of(vertex(8)) } else { VertexLink::to("in", vertex(8)) };
        Mutation::AddVertex { vertex: vertex_of, link }
    };
    let pose = Value::Vec6([0.5, 1.5, f32::from(u8::try_from(choice >> 56).unwrap_or(0)), 0.0, 0.0, 1.0]);
    match (choice >> 4 & 0xf, edge(20)) {
        (0..=3, _) | (_, None) => add(),
        (4..=8, Some((id, _))) => Mutation::UpdateAttributes {
            target: ElementId::Edge(id),
            updates: AttributeUpdates::from([("pose".into(), Some(pose))]),
        },
        (9, Some(_)) => Mutation::UpdateAttributes {
            target: ElementId::Vertex(vertex(8)),
            updates: AttributeUpdates::from([("pose".into(), (choice & 2 == 0).then_some(pose))]),
        },
        (10..=11, Some(_)) => Mutation::AddEdge {
            key: EdgeKey::new(vertex(8), if choice & 1 == 0 { "near" } else { "in" }, vertex(32)),
            attributes: [].into(),
        },
        (12..=13, Some((_, from))) => {
            let to = if &*from.label == "RT" {
                EdgeKey { from: vertex(8), ..from.clone() }
            } else {
                EdgeKey { to: vertex(8), ..from.clone() }
            };
            Mutation::MoveEdge { from, to, attributes: [].into() }
        }
        (14, Some((_, key))) => Mutation::RemoveEdge { key },
        (_, Some(_)) => Mutation::RemoveVertex { vertex: vertex(8) },
    }
}

/// One of many mutations at once: some are small images.
pub(super) fn of_burst(graph: &Graph, choice: u64) -> Mutation {
    let bytes = usize::try_from(choice >> 16 & 0xffff).unwrap_or(0);
    if choice.is_multiple_of(4) { image(1000 + bytes) } else { mutation(graph, choice) }
}

/// An image on the root: one of four, so that images replace each other.
pub(super) fn image(bytes: usize) -> Mutation {
    let name = format!("camera{}", bytes % 4);
    let pixels: Vec<u8> = (0..bytes).map(|at| at.wrapping_mul(bytes | 1).to_le_bytes()[1]).collect();
    Mutation::UpdateAttributes {
        target: ElementId::Vertex(VertexId::ROOT),
        updates: AttributeUpdates::from([(name.into(), Some(Value::ByteVec(pixels.into())))]),
    }
}
