//! The shape of a state: what its view can depend on, and nothing else. `[spec: CHECK-11]`
//!
//! The view compares ranks and names; it never looks at a stamp, a dot or a value as such. So states that
//! differ only by an order-preserving renaming of dots and stamps have views that differ by the same
//! renaming, and one verdict serves for all of them.

use dsr_core::{Dot, Record, State, Value};

/// A state up to renaming dots and stamps in order: equal shapes have views that differ only in names of
/// dots. Records that wait for an anchor keep their place and nothing more of that anchor.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Shape(Vec<u8>);

const ROOT: u8 = 255;
const UNSEEN: u8 = 254;
/// Records beyond which ranks no longer fit a byte; such states have no shape and are judged each.
const RECORDS_MAX: usize = 250;

/// The shape of a state, if it is small enough to have one.
pub(super) fn shape_of(state: &State) -> Option<Shape> {
    if state.len() > RECORDS_MAX {
        return None;
    }
    let dots: Vec<Dot> = state.records().map(|(dot, _)| dot).collect();
    let mut stamps: Vec<u64> = state.records().map(|(_, record)| record.stamp()).collect();
    stamps.sort_unstable();
    stamps.dedup();
    let rank = |dot: Dot| match dots.binary_search(&dot) {
        _ if dot.sequence == 0 => ROOT,
        Ok(at) => byte(at),
        Err(_) => UNSEEN,
    };
    let mut shape = Vec::with_capacity(dots.len() * 16);
    for (_, record) in state.records() {
        shape.push(byte(stamps.binary_search(&record.stamp()).unwrap_or_default()));
        match record {
            Record::Vertex(vertex) => {
                // Only whether names are equal matters; a fresh name is its dot's and equal to no other.
                let is_fresh = vertex.name.starts_with('@');
                shape.push(u8::from(!is_fresh));
                push_text(&mut shape, if is_fresh { "" } else { &vertex.name });
            }
            Record::Edge(edge) => {
                shape.extend([2, rank(edge.from.0), rank(edge.to.0)]);
                push_text(&mut shape, &edge.label);
            }
            Record::Write(write) => {
                shape.extend([3, rank(write.target), type_of(&write.value)]);
                push_text(&mut shape, &write.name);
            }
        }
    }
    Some(Shape(shape))
}

fn type_of(value: &Value) -> u8 {
    value.value_type().number()
}

/// Ranks are below [`RECORDS_MAX`], lengths below the limit of names.
fn byte(at: usize) -> u8 {
    u8::try_from(at).unwrap_or(UNSEEN)
}

fn push_text(shape: &mut Vec<u8>, text: &str) {
    shape.push(byte(text.len()));
    shape.extend_from_slice(text.as_bytes());
}
