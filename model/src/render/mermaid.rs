//! Sequence diagrams in the language of Mermaid.
//!
//! A message is drawn when it is received: Mermaid has no arrows that take time. An answer is dotted; what is lost
//! ends in a cross.

use super::diagram::{Arrow, Diagram, Event};
use super::words::{add, one_line, wrap};

/// Characters on a line of a note.
const NOTE_WIDTH: usize = 60;

/// A `sequenceDiagram`, with what changes or without.
pub(super) fn mermaid(diagram: &Diagram<'_>, with_changes: bool) -> String {
    let mut text = String::from("sequenceDiagram\n");
    for (lane, name) in diagram.lanes.iter().enumerate() {
        add(&mut text, format_args!("    participant p{} as {}\n", lane + 1, escape(&one_line(name))));
    }
    for (at, row) in diagram.rows.iter().enumerate() {
        let (step, lane) = (at + 1, row.lane + 1);
        let arrow = match row.event {
            Event::Delivery(Arrow { message, from, is_answer: false, .. }) => Some((from, "->>", message)),
            Event::Delivery(Arrow { message, from, .. }) => Some((from, "-->>", message)),
            Event::Loss(Arrow { message, from, .. }) => Some((from, "-x", message)),
            _ => None,
        };
        let mut lines = Vec::new();
        if let Some((from, arrow, label)) = arrow {
            let label = wrap(&format!("{step}. {label}"), NOTE_WIDTH, 0);
            add(&mut text, format_args!("    p{}{arrow}p{lane}: {}\n", from + 1, joined(&label)));
        } else {
            lines.extend(wrap(&format!("{step}. {}", diagram.words(row)), NOTE_WIDTH, 0));
        }
        let changes = row.changes.iter().filter(|_| with_changes);
        lines.extend(changes.flat_map(|change| wrap(change, NOTE_WIDTH, 0)));
        if !lines.is_empty() {
            add(&mut text, format_args!("    Note over p{lane}: {}\n", joined(&lines)));
        }
    }
    let lane = diagram.last_lane() + 1;
    let finding = wrap(&diagram.finding(), NOTE_WIDTH, 0);
    add(&mut text, format_args!("    Note over p{lane}: {}\n", joined(&finding)));
    text
}

fn joined(lines: &[String]) -> String {
    lines.iter().map(|line| escape(line)).collect::<Vec<_>>().join("<br/>")
}

/// A line of text with Mermaid's entities for every sign that it could take as its own: the signs that end a
/// statement or start an entity, a comment or a tag.
fn escape(line: &str) -> String {
    let mut escaped = String::new();
    for character in line.chars() {
        let is_plain = !character.is_ascii_punctuation() || ".,_-()[]=+*/!?".contains(character);
        if is_plain {
            escaped.push(character);
        } else {
            add(&mut escaped, format_args!("#{};", u32::from(character)));
        }
    }
    escaped
}
