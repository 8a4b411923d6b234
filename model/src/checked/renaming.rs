//! Renaming replicas: the symmetry of a system whose replicas all start alike.

use super::replica_id;
use dsr_core::{CausalContext, Dot, Edge, Name, Record, Run, State, Vertex, VertexId, Write};

/// The state in which every dot of replica `r` belongs to replica `to[r]`.
///
/// Names that the alphabet made from a vertex's dot follow it.
pub(super) fn rename(state: &State, to: &[usize]) -> State {
    let dot_of = |dot: Dot| {
        let index = (0..to.len()).find(|&r| replica_id(r) == dot.replica);
        index.map_or(dot, |r| Dot::new(replica_id(to[r]), dot.sequence))
    };
    let records = state.records().map(|(dot, record)| (dot_of(dot), rename_record(dot, record, &dot_of)));
    let mut context = CausalContext::new();
    for run in state.context().runs() {
        let moved = dot_of(Dot::new(run.replica, run.first));
        context.insert_run(Run { replica: moved.replica, ..run });
    }
    State::assemble(records, context)
}

fn rename_record(dot: Dot, record: &Record, dot_of: &impl Fn(Dot) -> Dot) -> Record {
    match record {
        Record::Vertex(vertex) => {
            let name =
                if *vertex.name == *fresh_name(dot) { fresh_name(dot_of(dot)) } else { vertex.name.clone() };
            Record::Vertex(Vertex { name, ..vertex.clone() })
        }
        Record::Edge(edge) => {
            let (from, to) = (VertexId(dot_of(edge.from.0)), VertexId(dot_of(edge.to.0)));
            Record::Edge(Edge { from, to, ..edge.clone() })
        }
        Record::Write(write) => Record::Write(Write { target: dot_of(write.target), ..write.clone() }),
    }
}

/// The name that only the vertex of this dot has.
pub(super) fn fresh_name(dot: Dot) -> Name {
    format!("@{dot}").into()
}
