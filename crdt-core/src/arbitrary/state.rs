//! States over one universe of records.

use super::data::{AGENTS_MAX, SEQUENCES_MAX};
use crate::context::CausalContext;
use crate::dot::{Dot, ReplicaId, VertexId};
use crate::record::{Edge, Record, Vertex, Write};
use crate::state::State;
use crate::value::{Value, ValueType};
use alloc::vec::Vec;
use arbitrary::{Arbitrary, Result, Unstructured};

const NAMES: [&str; 4] = ["a", "b", "c", "kitchen"];
const LABELS: [&str; 4] = [crate::RT, crate::RT, "in", "near"];

/// A fixed, well-mixed number for each dot and purpose: an index of at most `below`, which is not 0.
fn mix(dot: Dot, purpose: u64, below: usize) -> usize {
    // The finaliser of SplitMix64.
    let mut word = u64::from(dot.replica.agent) << 32 ^ dot.sequence << 8 ^ purpose;
    word = (word ^ word >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    word = (word ^ word >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    usize::try_from((word ^ word >> 31) % below.max(1) as u64).unwrap_or_default()
}

/// The dots of the universe.
fn dots() -> impl Iterator<Item = Dot> {
    (1..=AGENTS_MAX).flat_map(|agent| (1..=SEQUENCES_MAX).map(move |n| Dot::new(ReplicaId::agent(agent), n)))
}

/// Per agent: three vertices, three edges, two writes.
fn is_vertex(dot: Dot) -> bool {
    dot.sequence % 8 < 3
}

fn is_edge(dot: Dot) -> bool {
    (3..6).contains(&(dot.sequence % 8))
}

/// A dot, or the root one time in eight, among those that fit.
fn anchor(of: Dot, purpose: u64, fits: fn(Dot) -> bool) -> Dot {
    let fitting: Vec<Dot> = dots().filter(|&dot| fits(dot)).collect();
    match mix(of, purpose, 8) {
        0 => VertexId::ROOT.0,
        _ => fitting[mix(of, purpose ^ 0xff, fitting.len())],
    }
}

/// The one record that each dot of the universe has.
fn record(dot: Dot) -> Record {
    let stamp = 1 + mix(dot, 1, 6) as u64;
    if is_vertex(dot) {
        let external_id = (mix(dot, 2, 2) == 0).then_some(dot.sequence);
        let (vertex_type, name) =
            (NAMES[mix(dot, 3, NAMES.len())].into(), NAMES[mix(dot, 4, NAMES.len())].into());
        return Record::Vertex(Vertex { vertex_type, name, external_id, stamp });
    }
    if is_edge(dot) {
        let to = anchor(dot, 5, is_vertex);
        let from = anchor(dot, 6, is_vertex);
        let label = if to == VertexId::ROOT.0 { "near" } else { LABELS[mix(dot, 7, LABELS.len())] };
        // A loop hangs from the root instead; the root's own is turned into a link to a vertex.
        let (from, to) = match (from == to, VertexId::ROOT.0) {
            (false, _) => (from, to),
            (true, root) if to == root => (root, Dot::new(dot.replica, 1)),
            (true, root) => (root, to),
        };
        return Record::Edge(Edge { from: VertexId(from), to: VertexId(to), label: label.into(), stamp });
    }
    let target = anchor(dot, 8, |other| is_vertex(other) || is_edge(other));
    let value = value(ValueType::ALL[mix(dot, 9, 14)], dot.sequence);
    Record::Write(Write {
        target,
        name: NAMES[mix(dot, 10, NAMES.len())].into(),
        value,
        timestamp_ns: 7,
        stamp,
    })
}

fn value(value_type: ValueType, sequence: u64) -> Value {
    match value_type {
        ValueType::String => "text".into(),
        ValueType::Int => Value::Int(-5),
        ValueType::Float => Value::Float(0.1),
        ValueType::FloatVec => Value::FloatVec([1.5, -0.0].as_slice().into()),
        ValueType::Bool => Value::Bool(true),
        ValueType::ByteVec => Value::ByteVec([0, 255].as_slice().into()),
        ValueType::UInt => Value::UInt(300),
        ValueType::UInt64 => Value::UInt64(sequence),
        ValueType::Double => Value::Double(0.1),
        ValueType::U64Vec => Value::U64Vec([sequence].as_slice().into()),
        ValueType::Vec2 => Value::Vec2([1.0; 2]),
        ValueType::Vec3 => Value::Vec3([1.0; 3]),
        ValueType::Vec4 => Value::Vec4([1.0; 4]),
        ValueType::Vec6 => Value::Vec6([1.0; 6]),
    }
}

/// Each dot of the universe is unseen, held or dead; then closed. `[spec: STATE-3]`
impl<'a> Arbitrary<'a> for State {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let mut context = CausalContext::new();
        let mut records = Vec::new();
        for dot in dots() {
            let fate = u.int_in_range(0..=3_u8)?;
            if fate > 0 {
                context.insert(dot);
            }
            if fate > 1 {
                records.push((dot, record(dot)));
            }
        }
        let mut state = Self::assemble(records, context);
        state.close();
        Ok(state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wellformed::check_well_formed;

    /// The whole universe is well-formed, and so is every state drawn from it.
    #[test]
    fn law_arbitrary_states_are_well_formed() {
        let whole = State::assemble(dots().map(|dot| (dot, record(dot))), dots().collect());
        check_well_formed(&whole).unwrap();
        let mut shapes = 0;
        for seed in 0..=u8::MAX {
            let bytes: Vec<u8> = (0..48_u8)
                .map(|at| at.wrapping_mul(37) ^ seed.wrapping_mul(101).rotate_left(at.into()))
                .collect();
            let state: State = Unstructured::new(&bytes).arbitrary().unwrap();
            check_well_formed(&state).unwrap();
            shapes += usize::from(!state.is_empty());
        }
        assert!(shapes > 200, "{shapes}");
    }
}
