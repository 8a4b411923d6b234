//! States taken apart, for flaws that put them together wrongly.

use dsr_core::{CausalContext, Dictionary, Dot, Record, State, VertexId};
use std::collections::BTreeMap;

/// The parts of a state.
#[derive(Clone, Debug)]
pub(super) struct Parts {
    pub(super) records: BTreeMap<Dot, Record>,
    pub(super) context: CausalContext,
}

impl Parts {
    pub(super) fn of(state: &State) -> Self {
        let records = state.records().map(|(dot, record)| (dot, record.clone())).collect();
        Self { records, context: state.context().clone() }
    }

    pub(super) fn build(self) -> State {
        State::assemble(self.records, self.context)
    }
}

/// What core and alarms agree on: `in` is functional.
pub(super) fn dictionary() -> Dictionary {
    Dictionary::open().with_functional(crate::checked::alphabet::FUNCTIONAL)
}

/// Whether two records claim one register. `[spec: STAMP-4]`
pub(super) fn compete(left: &Record, right: &Record) -> bool {
    match (left, right) {
        (Record::Write(left), Record::Write(right)) => left.target == right.target && left.name == right.name,
        (Record::Edge(left), Record::Edge(right)) if left.label != right.label => false,
        (Record::Edge(left), Record::Edge(right)) if left.is_rt() => left.to == right.to,
        (Record::Edge(left), Record::Edge(right)) => {
            left.from == right.from && (left.to == right.to || dictionary().is_functional(&left.label))
        }
        _ => false,
    }
}

/// The record with another stamp.
pub(super) fn with_stamp(mut record: Record, stamp: u64) -> Record {
    match &mut record {
        Record::Vertex(vertex) => vertex.stamp = stamp,
        Record::Edge(edge) => edge.stamp = stamp,
        Record::Write(write) => write.stamp = stamp,
    }
    record
}

/// Whether the kinematic edges of `records` lead from `below` up to `above`.
pub(super) fn is_below(records: &BTreeMap<Dot, Record>, below: VertexId, above: VertexId) -> bool {
    let mut at = vec![below];
    let mut seen = Vec::new();
    while let Some(vertex) = at.pop() {
        if vertex == above {
            return true;
        }
        if seen.contains(&vertex) {
            continue;
        }
        seen.push(vertex);
        at.extend(records.values().filter_map(|record| match record {
            Record::Edge(edge) if edge.is_rt() && edge.to == vertex => Some(edge.from),
            _ => None,
        }));
    }
    false
}
