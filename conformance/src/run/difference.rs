//! Two views, compared for people. `[spec: CONF-7]`

use crate::protocol::View;

/// What two views in canonical form differ in, line by line.
pub(super) fn differ(expected: &View, found: &View) -> Option<String> {
    if expected == found {
        return None;
    }
    let lines = |view: &View| {
        let mut lines = Vec::new();
        lines.extend(
            view.vertices.0.iter().map(|(handle, vertex)| format!("vertex {handle} {}", text(vertex))),
        );
        lines.extend(view.edges.iter().map(|edge| format!("edge {}", text(edge))));
        lines.push(format!("root {}", text(&view.root)));
        lines.push(format!("repairs {}", text(&view.repairs)));
        lines
    };
    let (expected, found) = (lines(expected), lines(found));
    let missing = without(&expected, &found).map(|line| format!("\n  - expected {line}"));
    let surplus = without(&found, &expected).map(|line| format!("\n  + found    {line}"));
    Some(missing.chain(surplus).collect())
}

/// The lines of one list that the other has not, or not as often.
fn without<'l>(lines: &'l [String], others: &'l [String]) -> impl Iterator<Item = &'l String> {
    let count = |list: &[String], line: &String| list.iter().filter(|other| *other == line).count();
    lines
        .iter()
        .enumerate()
        .filter_map(move |(at, line)| (count(&lines[..=at], line) > count(others, line)).then_some(line))
}

/// A part of a view as JSON.
fn text(part: &impl serde::Serialize) -> String {
    serde_json::to_string(part).unwrap_or_else(|error| error.to_string())
}
