//! States that nobody has made: well-formed, and else as odd as can be. `[spec: WF-1]`

use super::vocabulary::{label_outside, name_outside, once_in, pick, time, value};
use dsr_core::{
    CausalContext, Dot, Edge, RT, Record, ReplicaId, Run, State, Vertex, VertexId, Write, check_well_formed,
    limits,
};
use dsr_model::walks::Dice;

/// The most records.
const RECORDS_MAX: usize = 9;
/// Sequences are mostly among the first few, so that states of one world meet.
const SEQUENCES: usize = 8;

/// A graph that all replicas may start from: a chain below the root with edges across.
pub(super) fn scene(dice: &mut Dice) -> State {
    let vertices = 2 + dice.below(3);
    let dot = |at: usize| Dot::new(ReplicaId::SCENE, at as u64 + 1);
    let mut records: Vec<(Dot, Record)> = Vec::new();
    for at in 0..vertices {
        let name = ["a", "b", "c", "d"][at % 4].into();
        records.push((
            dot(at),
            Record::Vertex(Vertex { vertex_type: "t".into(), name, external_id: None, stamp: 1 }),
        ));
    }
    for child in 0..vertices {
        // Its parent is an earlier one or the root; now and then it has none.
        let parent = dice.below(child + 1);
        let from = if parent == child { VertexId::ROOT } else { VertexId(dot(parent)) };
        let (label, from, to) = match dice.below(6) {
            0 if child > 0 => ("in", VertexId(dot(child)), VertexId(dot(0))),
            1 => ("near", VertexId(dot(child)), VertexId::ROOT),
            _ => (RT, from, VertexId(dot(child))),
        };
        let at = records.len();
        records.push((dot(at), Record::Edge(Edge { from, to, label: label.into(), stamp: 1 })));
    }
    let target = dot(dice.below(records.len()));
    let write = Write { target, name: "x".into(), value: dsr_core::Value::Int(7), timestamp_ns: 0, stamp: 1 };
    let at = records.len();
    records.push((dot(at), Record::Write(write)));
    let context = records.iter().map(|(dot, _)| *dot).collect();
    State::assemble(records, context)
}

/// A state over dots of some replicas and of others; `None` if what was drawn is not well-formed.
pub(super) fn state(dice: &mut Dice, replicas: &[ReplicaId]) -> Option<State> {
    let huge = once_in(dice, 6);
    let mut context = CausalContext::new();
    let mut free: Vec<Dot> = (0..2 + dice.below(RECORDS_MAX)).map(|_| dot(dice, replicas, huge)).collect();
    free.sort_unstable();
    free.dedup();
    let mut records: Vec<(Dot, Record)> = Vec::new();
    let (mut vertices, mut elements) = (vec![VertexId::ROOT.0], vec![VertexId::ROOT.0]);
    let top = if once_in(dice, 12) { limits::STAMP_MAX } else { 3 };
    while !free.is_empty() {
        let at = free.remove(dice.below(free.len()));
        let stamp = top - dice.below(3) as u64;
        let record = match dice.below(8) {
            // A dead dot.
            0 => {
                context.insert(at);
                continue;
            }
            1..=3 => {
                vertices.push(at);
                elements.push(at);
                let external_id = once_in(dice, 4).then(|| time(dice));
                Record::Vertex(Vertex {
                    vertex_type: "t".into(),
                    name: name_outside(dice),
                    external_id,
                    stamp,
                })
            }
            4..=6 => {
                let (from, to) = (anchor(dice, &vertices, replicas), anchor(dice, &vertices, replicas));
                let label = label_outside(dice);
                let enters_root = &*label == RT && to == VertexId::ROOT.0;
                let (from, to) = if enters_root { (to, from) } else { (from, to) };
                if from == to {
                    continue;
                }
                elements.push(at);
                Record::Edge(Edge { from: VertexId(from), to: VertexId(to), label, stamp })
            }
            _ => {
                let target = anchor(dice, &elements, replicas);
                let name = pick(dice, &["x", "x", "y", "odd"]).copied().unwrap_or("x").into();
                Record::Write(Write { target, name, value: value(dice), timestamp_ns: time(dice), stamp })
            }
        };
        context.insert(at);
        records.push((at, record));
    }
    if once_in(dice, 4) {
        let replica = some_replica(dice, replicas);
        let first = 1 + dice.below(SEQUENCES) as u64;
        let last =
            if huge { limits::SEQUENCE_MAX - dice.below(3) as u64 } else { first + dice.below(4) as u64 };
        context.insert_run(Run { replica, first, last: last.max(first) });
    }
    let mut state = State::assemble(records, context);
    state.close();
    check_well_formed(&state).is_ok().then_some(state)
}

/// One of these, or a dot that may be anybody's: then it is not here yet.
fn anchor(dice: &mut Dice, of: &[Dot], replicas: &[ReplicaId]) -> Dot {
    match dice.below(8) {
        0 => dot(dice, replicas, false),
        _ => pick(dice, of).copied().unwrap_or(VertexId::ROOT.0),
    }
}

fn dot(dice: &mut Dice, replicas: &[ReplicaId], huge: bool) -> Dot {
    let replica = some_replica(dice, replicas);
    let near = 1 + dice.below(SEQUENCES) as u64;
    let sequence = if huge && once_in(dice, 4) { limits::SEQUENCE_MAX - near + 1 } else { near };
    Dot::new(replica, sequence)
}

fn some_replica(dice: &mut Dice, replicas: &[ReplicaId]) -> ReplicaId {
    match dice.below(10) {
        0 => ReplicaId { agent: u32::MAX, incarnation: u32::MAX },
        1 => ReplicaId { agent: 1, incarnation: 1 + u32::try_from(dice.below(2)).unwrap_or(0) },
        2 => ReplicaId::agent(9),
        _ => pick(dice, replicas).copied().unwrap_or_default(),
    }
}

/// Bytes that are a state, or nearly.
pub(super) fn bytes(dice: &mut Dice, mut bytes: Vec<u8>) -> Vec<u8> {
    for _ in 0..dice.below(3) {
        let at = dice.below(bytes.len());
        match dice.below(5) {
            0 => bytes.truncate(at),
            1 => bytes.push(u8::try_from(dice.below(256)).unwrap_or(0)),
            2 if !bytes.is_empty() => drop(bytes.remove(at)),
            3 => bytes.insert(at, u8::try_from(dice.below(4)).unwrap_or(0)),
            _ => {
                if let Some(byte) = bytes.get_mut(at) {
                    *byte ^= 1 << dice.below(8);
                }
            }
        }
    }
    bytes
}
