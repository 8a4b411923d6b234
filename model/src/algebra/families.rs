//! The families of records over which states are enumerated.

use dsr_core::{Dot, Edge, RT, Record, ReplicaId, Value, Vertex, VertexId, Write};

/// The most records of a family.
pub(super) const RECORDS_MAX: usize = 5;

/// A record under its dot.
type Filed = (Dot, Record);

/// Each family's name and first `count` records.
pub(super) fn families(count: usize) -> Vec<(&'static str, Vec<Filed>)> {
    let all: [(&'static str, [Filed; RECORDS_MAX]); 8] = [
        ("a write on an edge on a vertex", depth_two()),
        ("competing kinematic parents", kinematic_parents()),
        ("a kinematic cycle", kinematic_cycle()),
        ("a functional label", functional_label()),
        ("two instances of one edge", one_key_twice()),
        ("gaps in the context", gaps()),
        ("one name twice", names()),
        ("competing writes", writes()),
    ];
    all.into_iter().map(|(name, records)| (name, records.into_iter().take(count).collect())).collect()
}

/// Dot `sequence` of agent 1 or 2.
fn dot(agent: u32, sequence: u64) -> Dot {
    Dot::new(ReplicaId::agent(agent), sequence)
}

const ROOT: Dot = VertexId::ROOT.0;

fn vertex(at: Dot, name: &str, stamp: u64) -> Filed {
    let (vertex_type, name) = ("object".into(), name.into());
    (at, Record::Vertex(Vertex { vertex_type, name, external_id: None, stamp }))
}

fn edge(at: Dot, from: Dot, label: &str, to: Dot, stamp: u64) -> Filed {
    let (from, to) = (VertexId(from), VertexId(to));
    (at, Record::Edge(Edge { from, to, label: label.into(), stamp }))
}

fn write(at: Dot, target: Dot, stamp: u64) -> Filed {
    let (name, value) = ("level".into(), Value::Int(1));
    (at, Record::Write(Write { target, name, value, timestamp_ns: 0, stamp }))
}

fn depth_two() -> [Filed; RECORDS_MAX] {
    let (a, e) = (dot(1, 1), dot(2, 1));
    [
        vertex(a, "a", 1),
        edge(e, a, "has", ROOT, 2),
        write(dot(1, 2), e, 3),
        write(dot(2, 2), a, 3),
        edge(dot(1, 3), ROOT, RT, a, 4),
    ]
}

fn kinematic_parents() -> [Filed; RECORDS_MAX] {
    let (a, p) = (dot(1, 1), dot(2, 2));
    [
        vertex(a, "a", 1),
        edge(dot(1, 2), ROOT, RT, a, 2),
        edge(dot(2, 1), ROOT, RT, a, 2),
        vertex(p, "p", 1),
        edge(dot(2, 3), p, RT, a, 3),
    ]
}

fn kinematic_cycle() -> [Filed; RECORDS_MAX] {
    let (a, b) = (dot(1, 1), dot(2, 1));
    [
        vertex(a, "a", 1),
        vertex(b, "b", 1),
        edge(dot(1, 2), a, RT, b, 2),
        edge(dot(2, 2), b, RT, a, 2),
        edge(dot(1, 3), ROOT, RT, a, 1),
    ]
}

fn functional_label() -> [Filed; RECORDS_MAX] {
    let (a, b, e) = (dot(1, 1), dot(2, 1), dot(2, 2));
    [
        vertex(a, "a", 1),
        edge(dot(1, 2), a, "in", ROOT, 2),
        vertex(b, "b", 1),
        edge(e, a, "in", b, 2),
        write(dot(1, 3), e, 3),
    ]
}

fn one_key_twice() -> [Filed; RECORDS_MAX] {
    let (a, e) = (dot(1, 1), dot(1, 2));
    [
        vertex(a, "a", 1),
        edge(e, ROOT, "has", a, 2),
        edge(dot(2, 1), ROOT, "has", a, 2),
        write(dot(2, 2), e, 3),
        write(dot(1, 3), a, 3),
    ]
}

/// Some dots below these belong to nobody, so the context always has a cloud.
fn gaps() -> [Filed; RECORDS_MAX] {
    let (a, e) = (dot(1, 2), dot(1, 4));
    [
        vertex(a, "a", 1),
        edge(e, ROOT, RT, a, 2),
        write(dot(1, 3), e, 3),
        write(dot(2, 3), a, 3),
        vertex(dot(2, 1), "b", 1),
    ]
}

fn names() -> [Filed; RECORDS_MAX] {
    let (a, b) = (dot(1, 1), dot(2, 1));
    [
        vertex(a, "twin", 1),
        vertex(b, "twin", 1),
        edge(dot(1, 2), ROOT, RT, a, 1),
        edge(dot(2, 2), a, RT, b, 2),
        write(dot(1, 3), b, 3),
    ]
}

fn writes() -> [Filed; RECORDS_MAX] {
    let a = dot(1, 2);
    [
        write(dot(1, 1), ROOT, 1),
        write(dot(2, 1), ROOT, 1),
        vertex(a, "a", 1),
        write(dot(2, 2), a, 2),
        write(dot(1, 3), a, 2),
    ]
}
