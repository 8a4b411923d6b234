//! A small language for states, one record a line:
//!
//! ```text
//! r1.1 vertex room kitchen @1          type, name, stamp; `#7` after it is an external id
//! r1.2 edge root -RT-> r1.1 @1         source, label, target, stamp
//! r1.3 write r1.1 level=5 @2           target, name, value (int, bool or text), stamp
//! dead r2.1 r2.2                       seen, not held
//! ```

use dsr_core::{CausalContext, Dot, Edge, Record, State, Value, Vertex, VertexId, Write, check_well_formed};

/// The state that a text describes.
///
/// # Panics
///
/// If the text describes none, with the line and what is wrong with it.
#[track_caller]
#[allow(clippy::panic, reason = "the text is written by the test that fails")]
pub fn state(text: &str) -> State {
    parse_state(text).unwrap_or_else(|fault| panic!("{fault}"))
}

/// The state that a text describes, or what is wrong with which line.
pub fn parse_state(text: &str) -> Result<State, String> {
    let mut records = Vec::new();
    let mut context = CausalContext::new();
    for (at, line) in text.lines().enumerate() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let fault = |what: &str| format!("line {}: {what}: {}", at + 1, line.trim());
        match words.as_slice() {
            [] => {}
            ["dead", dots @ ..] => {
                for dot in dots {
                    context.insert(dot.parse().map_err(|_error| fault("not a dot"))?);
                }
            }
            [dot, rest @ ..] => {
                let dot: Dot = dot.parse().map_err(|_error| fault("not a dot"))?;
                context.insert(dot);
                records.push((dot, record(rest).ok_or_else(|| fault("not a record"))?));
            }
        }
    }
    let state = State::assemble(records, context);
    check_well_formed(&state).map_err(|fault| fault.to_string())?;
    Ok(state)
}

fn record(words: &[&str]) -> Option<Record> {
    let (at, words) = words.iter().position(|word| word.starts_with('@')).map(|at| words.split_at(at))?;
    let stamp = words.first()?.strip_prefix('@')?.parse().ok()?;
    match (at, &words[1..]) {
        (["vertex", vertex_type, name], rest) => {
            let external_id = match rest {
                [] => None,
                [id] => Some(id.strip_prefix('#')?.parse().ok()?),
                _ => return None,
            };
            let (vertex_type, name) = ((*vertex_type).into(), (*name).into());
            Some(Record::Vertex(Vertex { vertex_type, name, external_id, stamp }))
        }
        (["edge", from, label, to], []) => Some(Record::Edge(Edge {
            from: from.parse().ok()?,
            to: to.parse().ok()?,
            label: label.strip_prefix('-')?.strip_suffix("->")?.into(),
            stamp,
        })),
        (["write", target, assignment], []) => {
            let (name, text) = assignment.split_once('=')?;
            let target = target.parse::<VertexId>().ok()?.0;
            Some(Record::Write(Write {
                target,
                name: name.into(),
                value: value(text),
                timestamp_ns: 0,
                stamp,
            }))
        }
        _ => None,
    }
}

fn value(text: &str) -> Value {
    text.parse::<i32>()
        .map(Value::Int)
        .or_else(|_| text.parse().map(Value::Bool))
        .unwrap_or_else(|_| text.into())
}
