//! The graph that the broken cores start from, small enough to search exhaustively.

use crate::checked::Checked;
use crate::checked::alphabet::{ATTRIBUTE, Alphabet, FUNCTIONAL};
use dsr_core::{
    Dictionary, Dot, Edge, MutationKind, RT, Record, ReplicaId, State, Value, Vertex, VertexId, Write,
};

/// The dot of the scene's event `sequence`.
const fn dot(sequence: u64) -> Dot {
    Dot::new(ReplicaId::SCENE, sequence)
}

/// A vertex below the root.
pub const A: VertexId = VertexId(dot(1));
/// Another one, which is `in` the first, and has the attribute `level`.
pub const B: VertexId = VertexId(dot(3));

/// Two vertices below the root, the second `in` the first, with some kinds of mutation on some of them.
pub fn subject(kinds: &[MutationKind], focus: &[VertexId]) -> Checked {
    let vertex = |name: &str, stamp| {
        Record::Vertex(Vertex { vertex_type: "object".into(), name: name.into(), external_id: None, stamp })
    };
    let edge = |from, label: &str, to, stamp| Record::Edge(Edge { from, to, label: label.into(), stamp });
    let records = [
        (A.0, vertex("a", 1)),
        (dot(2), edge(VertexId::ROOT, RT, A, 1)),
        (B.0, vertex("b", 2)),
        (dot(4), edge(VertexId::ROOT, RT, B, 2)),
        (dot(5), edge(B, FUNCTIONAL, A, 3)),
        (dot(6), write(B, 4)),
    ];
    let context = records.iter().map(|(dot, _)| *dot).collect();
    Checked {
        dictionary: Dictionary::open().with_functional(FUNCTIONAL),
        initial: State::assemble(records, context),
        alphabet: Alphabet::of(kinds, focus.to_vec()),
    }
}

fn write(target: VertexId, stamp: u64) -> Record {
    let (name, value) = (ATTRIBUTE.into(), Value::Int(1));
    Record::Write(Write { target: target.0, name, value, timestamp_ns: 0, stamp })
}
