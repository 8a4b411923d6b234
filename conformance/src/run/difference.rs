//! What is expected and what is found, compared for people. `[spec: CONF-7]`

use crate::protocol::View;
use dsr_core::State;

/// The lines in which what is expected and what came differ.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Difference {
    /// What should be there and is not.
    pub expected: Vec<String>,
    /// What is there and should not be.
    pub got: Vec<String>,
}

/// What two views in canonical form differ in, line by line.
pub(super) fn differ(expected: &View, found: &View) -> Option<Difference> {
    let lines = |view: &View| {
        let mut lines = Vec::new();
        lines.extend(
            view.vertices.0.iter().map(|(handle, vertex)| format!("vertex {handle} {}", text(vertex))),
        );
        lines.extend(view.edges.iter().map(|edge| format!("edge {}", text(edge))));
        lines.push(format!("root {}", text(&view.root)));
        lines.push(format!("hung {}", text(&view.hung)));
        lines.push(format!("repairs {}", text(&view.repairs)));
        lines
    };
    (expected != found).then(|| in_lines(&lines(expected), &lines(found)))
}

/// What two states differ in, line by line.
pub(super) fn differ_in_state(expected: &State, found: &State) -> Option<Difference> {
    let lines = |state: &State| {
        let mut lines = vec![format!("context {}", text(state.context()))];
        lines.extend(state.records().map(|(dot, record)| format!("{dot} {}", text(record))));
        lines
    };
    (expected != found).then(|| in_lines(&lines(expected), &lines(found)))
}

fn in_lines(expected: &[String], found: &[String]) -> Difference {
    Difference {
        expected: without(expected, found).cloned().collect(),
        got: without(found, expected).cloned().collect(),
    }
}

/// The lines of one list that the other has not, or not as often.
fn without<'l>(lines: &'l [String], others: &'l [String]) -> impl Iterator<Item = &'l String> {
    let count = |list: &[String], line: &String| list.iter().filter(|other| *other == line).count();
    lines
        .iter()
        .enumerate()
        .filter_map(move |(at, line)| (count(&lines[..=at], line) > count(others, line)).then_some(line))
}

/// A part as JSON.
fn text(part: &impl serde::Serialize) -> String {
    serde_json::to_string(part).unwrap_or_else(|error| error.to_string())
}
