//! The steps of a case as a space-time diagram for a terminal.
//!
//! ```text
//!       a       b
//!   1   ●       │       add room "kitchen" by root -RT-> k  → 1
//!   2   ├──1───▶◆       receives 1
//! ✗ 3   ?       ?       a, b show the same
//! ```
//!
//! `●` is a mutation, `◆` a delivery, `↻` a restart, `◇` an answer, `?` an expectation, `○` something else; a delta from
//! outside has no arrow.

use super::words::words;
use crate::case::{Case, Step};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Characters on a line.
const WIDTH: usize = 100;
/// The narrowest column.
const PITCH: usize = 8;

/// The diagram, with a step, counted from 1, marked as the one that failed.
pub fn diagram(case: &Case, failed: Option<usize>) -> String {
    let longest = case.replicas.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    let pitch = PITCH.max(longest + 2);
    let lane = |name: &str| case.replicas.iter().position(|replica| replica == name);
    let mut text = String::from("      ");
    for replica in &case.replicas {
        let _ = write!(text, "{replica:<pitch$}");
    }
    text = text.trim_end().to_owned() + "\n";
    let mut senders: BTreeMap<&str, usize> = BTreeMap::new();
    for (step, number) in case.steps.iter().zip(1..) {
        let mut marks = vec![' '; case.replicas.len() * pitch];
        for at in 0..case.replicas.len() {
            marks[at * pitch] = '│';
        }
        if let Step::Deliver { replica, delta } = step
            && let (Some(&from), Some(to)) = (senders.get(delta.as_str()), lane(replica))
        {
            arrow(&mut marks, (from * pitch, to * pitch), delta, pitch);
        }
        let (sign, lanes) = signs(step);
        for at in lanes.into_iter().filter_map(lane) {
            marks[at * pitch] = sign;
        }
        if let (Some(name), Some(from)) =
            (made(step), sender(step, &senders).or_else(|| signs(step).1.first().and_then(|name| lane(name))))
        {
            senders.insert(name, from);
        }
        let drawn: String = marks.iter().collect();
        let fault_sign = if failed == Some(number) { '✗' } else { ' ' };
        let beside = WIDTH.saturating_sub(6 + drawn.chars().count()).max(30);
        for (piece, at) in wrap(&words(step), beside).iter().zip(0..) {
            let quiet = format!("{:<pitch$}", '│').repeat(case.replicas.len());
            let row = if at == 0 {
                format!("{fault_sign}{number:>3}  {drawn}{piece}")
            } else {
                format!("      {quiet}  {piece}")
            };
            let _ = writeln!(text, "{}", row.trim_end());
        }
    }
    text
}

/// The name of the delta that a step makes.
fn made(step: &Step) -> Option<&str> {
    match step {
        Step::Mutate { r#as, .. } => r#as.as_deref(),
        Step::Answer { r#as, .. } | Step::Group { r#as, .. } | Step::AnswerDigest { r#as, .. } => Some(r#as),
        _ => None,
    }
}

/// Where a group of deltas comes from: whence its first.
fn sender(step: &Step, senders: &BTreeMap<&str, usize>) -> Option<usize> {
    match step {
        Step::Group { deltas, .. } => deltas.first().and_then(|delta| senders.get(delta.as_str())).copied(),
        _ => None,
    }
}

/// A step's sign, and whose columns have it.
pub(super) fn signs(step: &Step) -> (char, Vec<&str>) {
    let replicas = step.replicas();
    match step {
        // The other one learns of it when the delta arrives.
        Step::Answer { from, .. } => ('◇', vec![from]),
        Step::AnswerDigest { .. } => ('◇', replicas),
        Step::Mutate { .. } => ('●', replicas),
        Step::Deliver { .. } => ('◆', replicas),
        Step::Restart { .. } => ('↻', replicas),
        _ if replicas.is_empty() => ('○', replicas),
        _ => ('?', replicas),
    }
}

fn arrow(marks: &mut [char], (start, end): (usize, usize), label: &str, pitch: usize) {
    if start == end {
        return;
    }
    let is_rightwards = start < end;
    for mark in &mut marks[start.min(end) + 1..start.max(end)] {
        *mark = if *mark == '│' { '┼' } else { '─' };
    }
    let label: Vec<char> = label.chars().collect();
    if label.len() + 4 <= pitch {
        let first = if is_rightwards { start + 3 } else { start - 1 - label.len() };
        marks[first..first + label.len()].copy_from_slice(&label);
    }
    (marks[start], marks[if is_rightwards { end - 1 } else { end + 1 }]) =
        if is_rightwards { ('├', '▶') } else { ('┤', '◀') };
}

/// A text in lines of at most so many characters, broken at spaces.
fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let fresh = lines
            .last()
            .is_none_or(|line| line.is_empty() || line.chars().count() + 1 + word.chars().count() <= width);
        if !fresh {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines
}
