//! Space-time diagrams for a terminal.
//!
//! ```text
//!      r1      r2
//!   1  ●       │      add_edge v1 -in-> v2  → m1
//!      │       │        + edge v1 -in-> v2
//!   2  ├──m1──▶◆      receives m1 from r1
//!      │       │        + edge v1 -in-> v2
//!      │       ✗      [JOIN-3] …
//! ```
//!
//! Time goes down. `●` is a mutation, `◆` a delivery, `×` a loss, `↻` a restart, `◇` an answer, `○` something
//! else. An arrow starts in the sender's column, in the line of its arrival. No line is wider than 100 characters: long
//! texts go on in the next line, and names that are wider than their columns become numbers with a list above.

use super::RenderError;
use super::diagram::{Arrow, Diagram, Event, Row};
use super::words::{add, one_line, wrap};
use crate::trace::Finding;

/// Characters on a line.
const WIDTH: usize = 100;
/// Of these, at most for the columns of replicas.
const LANES_WIDTH: usize = 56;
/// The narrowest column: an arrow with its head.
const PITCH_MIN: usize = 4;
/// A column that holds the name of a message within an arrow.
const PITCH: usize = 8;

/// The diagram of a trace.
pub(super) fn text(diagram: &Diagram<'_>) -> Result<String, RenderError> {
    let (replicas, most) = (diagram.lanes.len(), LANES_WIDTH / PITCH_MIN);
    if replicas > most {
        return Err(RenderError::TooWide { replicas, most });
    }
    let names: Vec<String> = diagram.lanes.iter().map(|name| one_line(name)).collect();
    let longest = names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    let pitch = PITCH.max(longest + 2).min(LANES_WIDTH / replicas);
    let mut page = Page {
        pitch,
        lanes: replicas,
        numbers: diagram.rows.len().to_string().len().max(3),
        text: String::new(),
    };
    for line in wrap(&diagram.headline(), WIDTH, 2) {
        add(&mut page.text, format_args!("{line}\n"));
    }
    page.text.push('\n');
    page.heads(&names, longest + 1 > pitch);
    for (at, row) in diagram.rows.iter().enumerate() {
        let width = page.beside();
        let mut lines = wrap(&diagram.words(row), width, 4);
        let changes = row.changes.iter().flat_map(|change| wrap(change, width - 2, 2));
        lines.extend(changes.map(|line| format!("  {line}")));
        page.block(&(at + 1).to_string(), &page.marks(row), &lines);
    }
    let mut marks = page.quiet();
    let Finding { kind, .. } = &diagram.trace.finding;
    marks[page.column(diagram.last_lane())] = kind.sign();
    page.block("", &marks, &wrap(&diagram.trace.finding.to_string(), page.beside(), 4));
    Ok(page.text)
}

/// What is written so far, and where columns stand.
struct Page {
    pitch: usize,
    lanes: usize,
    numbers: usize,
    text: String,
}

impl Page {
    fn column(&self, lane: usize) -> usize {
        lane * self.pitch
    }

    /// The width beside the columns.
    fn beside(&self) -> usize {
        (WIDTH - self.numbers - 2).saturating_sub(self.lanes * self.pitch).max(8)
    }

    fn heads(&mut self, names: &[String], are_too_long: bool) {
        let mut heads = String::new();
        for (lane, name) in names.iter().enumerate() {
            let number = (lane + 1).to_string();
            if are_too_long {
                for line in wrap(&format!("{number} is {name}"), WIDTH, 4) {
                    add(&mut self.text, format_args!("{line}\n"));
                }
            }
            let head = if are_too_long { &number } else { name };
            add(&mut heads, format_args!("{head:<0$}", self.pitch));
        }
        add(&mut self.text, format_args!("{}  {}\n", " ".repeat(self.numbers), heads.trim_end()));
    }

    /// Columns in which nothing happens.
    fn quiet(&self) -> Vec<char> {
        let mut marks = vec![' '; self.lanes * self.pitch];
        for lane in 0..self.lanes {
            marks[lane * self.pitch] = '│';
        }
        marks
    }

    /// The columns of a step: its sign, and an arrow to it.
    fn marks(&self, row: &Row<'_>) -> Vec<char> {
        let mut marks = self.quiet();
        let sign = match row.event {
            Event::Mutation { .. } => '●',
            Event::Restart { .. } => '↻',
            Event::Answer { .. } => '◇',
            Event::Other { .. } => '○',
            Event::Delivery(Arrow { message, from, is_answer, .. }) => {
                self.arrow(&mut marks, from, row.lane, if is_answer { '╌' } else { '─' }, &one_line(message));
                '◆'
            }
            Event::Loss(Arrow { message, from, .. }) => {
                self.arrow(&mut marks, from, row.lane, '╌', &one_line(message));
                '×'
            }
        };
        marks[self.column(row.lane)] = sign;
        marks
    }

    /// An arrow with its label next to the sender, where that fits.
    fn arrow(&self, marks: &mut [char], from: usize, to: usize, line: char, label: &str) {
        let (start, end) = (self.column(from), self.column(to));
        if start == end {
            return;
        }
        for mark in &mut marks[start.min(end) + 1..start.max(end)] {
            *mark = if *mark == '│' { '┼' } else { line };
        }
        let label: Vec<char> = label.chars().collect();
        let fits = label.len() + 4 <= self.pitch;
        let is_rightwards = start < end;
        (marks[start], marks[if is_rightwards { end - 1 } else { end + 1 }]) =
            if is_rightwards { ('├', '▶') } else { ('┤', '◀') };
        if fits {
            let first = if is_rightwards { start + 2 } else { start - 1 - label.len() };
            marks[first..first + label.len()].copy_from_slice(&label);
        }
    }

    /// A step: its number, its columns, and lines beside them.
    fn block(&mut self, number: &str, marks: &[char], lines: &[String]) {
        let quiet = self.quiet();
        for (at, line) in lines.iter().enumerate() {
            let (number, marks) = if at == 0 { (number, marks) } else { ("", quiet.as_slice()) };
            let marks: String = marks.iter().collect();
            let line = format!("{number:>0$}  {marks}{line}", self.numbers);
            add(&mut self.text, format_args!("{}\n", line.trim_end()));
        }
    }
}
