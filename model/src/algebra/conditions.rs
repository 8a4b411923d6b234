//! The oracle: a state as nothing but the condition of each dot. `[spec: STATE-3]`
//!
//! Merge is a pointwise maximum, closure a loop over anchors. No store, no version vector, no cloud.

use dsr_core::{CausalContext, Dot, Record, State, VertexId};

/// What a state says of one dot; it only moves forwards. `[spec: STATE-3]`
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Condition {
    /// Never heard of.
    Unseen,
    /// Its record is there.
    Held,
    /// Seen, and not held.
    Dead,
}
use Condition::{Dead, Held, Unseen};

/// The condition of each record of a family.
pub type Conditions = Vec<Condition>;

/// Every assignment of conditions to `records` records; the first has seen nothing.
pub fn assignments(records: usize) -> Vec<Conditions> {
    let extend = |shorter: Vec<Conditions>, _| {
        let longer = |start: &Conditions| [Unseen, Held, Dead].map(|next| [&start[..], &[next]].concat());
        shorter.iter().flat_map(longer).collect()
    };
    (0..records).fold(vec![vec![]], extend)
}

/// The state that an assignment means.
pub fn state_of(records: &[(Dot, Record)], conditions: &[Condition]) -> State {
    let with = |wanted: fn(Condition) -> bool| {
        records
            .iter()
            .zip(conditions)
            .filter(move |(_, condition)| wanted(**condition))
            .map(|(record, _)| record)
    };
    let seen: CausalContext = with(|condition| condition != Unseen).map(|(dot, _)| *dot).collect();
    State::assemble(with(|condition| condition == Held).cloned(), seen)
}

/// What a state says of each record; `None` if it says anything besides, or holds another record.
pub fn conditions_of(records: &[(Dot, Record)], state: &State) -> Option<Conditions> {
    let condition = |(dot, record): &(Dot, Record)| match state.get(*dot) {
        Some(held) => (held == record && state.context().contains(*dot)).then_some(Held),
        None if state.context().contains(*dot) => Some(Dead),
        None => Some(Unseen),
    };
    let conditions: Conditions = records.iter().map(condition).collect::<Option<_>>()?;
    let count =
        |wanted: fn(Condition) -> bool| conditions.iter().filter(|condition| wanted(**condition)).count();
    let seen = state.context().runs().map(|run| run.dots().count()).sum::<usize>();
    let nothing_else = state.len() == count(|c| c == Held) && seen == count(|c| c != Unseen);
    nothing_else.then_some(conditions)
}

/// The pointwise maximum. `[spec: JOIN-1]`
pub fn merged(left: &[Condition], right: &[Condition]) -> Conditions {
    left.iter().zip(right).map(|(left, right)| *left.max(right)).collect()
}

/// What is anchored to the dead dies, until nothing more does. `[spec: CLOSE-1]`
pub fn closure(records: &[(Dot, Record)], conditions: &[Condition]) -> Conditions {
    let mut closed = conditions.to_vec();
    // Each pass that changes anything kills one record at least.
    for _ in 0..=records.len() {
        for at in 0..records.len() {
            let is_dead = |anchor: Dot| {
                anchor != VertexId::ROOT.0
                    && records
                        .iter()
                        .zip(&closed)
                        .any(|((dot, _), condition)| *dot == anchor && *condition == Dead)
            };
            if closed[at] == Held && records[at].1.anchors().any(is_dead) {
                closed[at] = Dead;
            }
        }
    }
    closed
}

/// The least delta for a replica `to` from a replica `from`, as the clause says it. `[spec: SYNC-3]`
pub fn least_delta(from: &[Condition], to: &[Condition]) -> Conditions {
    let of_dot = |(from, to): (&Condition, &Condition)| match (from, to) {
        (Held, Unseen) => Held,
        (Dead, Unseen | Held) => Dead,
        _ => Unseen,
    };
    from.iter().zip(to).map(of_dot).collect()
}

/// Whether every dot is at least as far in the second. `[spec: JOIN-4]`
pub fn is_below(lower: &[Condition], upper: &[Condition]) -> bool {
    lower.iter().zip(upper).all(|(lower, upper)| lower <= upper)
}

/// The conditions for people, such as `r1.1 held, r2.1 dead`.
pub fn describe(records: &[(Dot, Record)], conditions: &[Condition]) -> String {
    let known = records.iter().zip(conditions).filter(|(_, condition)| **condition != Unseen);
    let parts: Vec<String> = known
        .map(|((dot, record), condition)| match condition {
            Held => format!("{dot} held ({})", describe_record(record)),
            Unseen | Dead => format!("{dot} dead"),
        })
        .collect();
    if parts.is_empty() { "nothing seen".into() } else { parts.join(", ") }
}

fn describe_record(record: &Record) -> String {
    match record {
        Record::Vertex(vertex) => format!("vertex {:?}", &*vertex.name),
        Record::Edge(edge) => format!("edge {}", edge.key()),
        Record::Write(write) if write.target == VertexId::ROOT.0 => format!("write root.{}", write.name),
        Record::Write(write) => format!("write {}.{}", write.target, write.name),
    }
}
