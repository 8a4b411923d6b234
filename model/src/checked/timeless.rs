//! Deltas out of time: what the view can tell of two deltas but for when they were made. `[spec: CHECK-11]`
//!
//! The view compares ranks in four places: among the claims of one register of symbolic edges, among the
//! writes of one attribute, among all kinematic claims, and among vertices, of which a name or a lost
//! component takes the oldest. Nowhere else does it look at a stamp.

use super::Sight;
use crate::semantics::Competition;
use dsr_core::{Delta, Dictionary, Edge, Record, Repair, State, Vertex, Write};
use rustc_hash::FxHasher;
use std::hash::{Hash, Hasher};

/// The delta with another stamp: all its records have one. `[spec: MUT-0.2]`
pub(super) fn restamped(delta: &Delta, stamp: u64) -> Delta {
    let records = delta.records().map(|(dot, record)| (dot, with_stamp(record.clone(), stamp)));
    State::assemble(records, delta.context().clone())
}

/// The record with another stamp.
pub(crate) fn with_stamp(record: Record, stamp: u64) -> Record {
    match record {
        Record::Vertex(vertex) => Record::Vertex(Vertex { stamp, ..vertex }),
        Record::Edge(edge) => Record::Edge(Edge { stamp, ..edge }),
        Record::Write(write) => Record::Write(Write { stamp, ..write }),
    }
}

/// When the view compares the stamps of two deltas.
pub(super) fn compete(left: &Delta, right: &Delta, dictionary: &Dictionary) -> Competition {
    let pairs = left.records().flat_map(|(_, left)| right.records().map(move |(_, right)| (left, right)));
    pairs.map(|(left, right)| compared(left, right, dictionary)).max().unwrap_or(Competition::Never)
}

/// Claims on one register are compared always. Kinematic claims on different children are compared, in effect,
/// only where the greatest claims on each child close a cycle: else all of these are accepted in any order, and
/// no others. The ages of vertices of different names are compared only where a component has no way to the
/// root.
fn compared(left: &Record, right: &Record, dictionary: &Dictionary) -> Competition {
    let on_one_register = match (left, right) {
        (Record::Vertex(left), Record::Vertex(right)) => left.name == right.name,
        (Record::Edge(left), Record::Edge(right)) => {
            left.label == right.label
                && if left.is_rt() {
                    left.to == right.to
                } else {
                    left.from == right.from && (left.to == right.to || dictionary.is_functional(&left.label))
                }
        }
        (Record::Write(left), Record::Write(right)) => left.target == right.target && left.name == right.name,
        _ => return Competition::Never,
    };
    match (on_one_register, left) {
        (true, _) => Competition::Always,
        (false, Record::Vertex(_)) => Competition::Entangled,
        (false, Record::Edge(left)) if left.is_rt() && is_rt(right) => Competition::Entangled,
        _ => Competition::Never,
    }
}

fn is_rt(record: &Record) -> bool {
    matches!(record, Record::Edge(edge) if edge.is_rt())
}

/// Whether claims on different registers decide about each other in this view: see [`compared`].
pub(super) fn is_entangled(view: &impl Sight) -> bool {
    view.repairs()
        .iter()
        .any(|repair| matches!(repair, Repair::CycleBroken { .. } | Repair::Reattached { .. }))
}

/// A digest of everything that a view shows, but for stamps.
pub(crate) fn appearance(view: &impl Sight) -> u64 {
    let mut hasher = FxHasher::default();
    for &vertex in view.vertices() {
        vertex.hash(&mut hasher);
        let placement = view.placement(vertex);
        std::mem::discriminant(&placement).hash(&mut hasher);
        if let Some(dsr_core::Placement::Child { parent, edge }) = placement {
            (parent, edge).hash(&mut hasher);
        }
        let name = view.vertex(vertex).map(|vertex| &vertex.name);
        name.and_then(|name| view.vertex_by_name(name)).hash(&mut hasher);
    }
    for shown in view.edges() {
        (shown.id, shown.edge.from, shown.edge.to, &shown.edge.label).hash(&mut hasher);
    }
    for (dot, write) in view.writes() {
        (dot, write.target, &write.name, &write.value).hash(&mut hasher);
    }
    view.stranded().hash(&mut hasher);
    view.repairs().hash(&mut hasher);
    hasher.finish()
}
