//! Shapes and texts.

use super::LETTER;
use crate::render::diagram::Event;
use crate::render::words::one_line;
use crate::trace::FindingKind;

/// A full or hollow circle, a full or hollow diamond, a small cross or a hollow square.
pub(super) fn shape(event: &Event<'_>, x: usize, y: usize) -> String {
    let diamond = |class: &str| {
        let (left, right, top, bottom) = (x - 9, x + 9, y - 9, y + 9);
        format!("<path class=\"{class}\" d=\"M{x} {top}L{right} {y}L{x} {bottom}L{left} {y}z\"/>")
    };
    match event {
        Event::Mutation { .. } => format!("<circle class=\"full\" cx=\"{x}\" cy=\"{y}\" r=\"7\"/>"),
        Event::Other { .. } => format!("<circle class=\"hollow\" cx=\"{x}\" cy=\"{y}\" r=\"7\"/>"),
        Event::Delivery(_) => diamond("full"),
        Event::Answer { .. } => diamond("hollow"),
        Event::Loss(_) => crossed("lost-mark", x, y, 5),
        Event::Restart { .. } => {
            format!("<rect class=\"hollow\" x=\"{}\" y=\"{}\" width=\"14\" height=\"14\"/>", x - 7, y - 7)
        }
    }
}

/// The sign of what is found: a cross, an eye or a tick.
pub(super) fn verdict(kind: FindingKind, x: usize, y: usize) -> String {
    match kind {
        FindingKind::Broken | FindingKind::Fails => crossed("cross", x, y, 7),
        FindingKind::Seen => format!(
            "<circle class=\"sight\" cx=\"{x}\" cy=\"{y}\" r=\"8\"/><circle class=\"full\" cx=\"{x}\" cy=\"{y}\" r=\"3\"/>"
        ),
        FindingKind::Holds => {
            format!("<path class=\"sight\" d=\"M{} {y}L{} {}L{} {}\"/>", x - 8, x - 2, y + 7, x + 8, y - 7)
        }
    }
}

fn crossed(class: &str, x: usize, y: usize, arm: usize) -> String {
    let (left, right, top, bottom) = (x - arm, x + arm, y - arm, y + arm);
    format!("<path class=\"{class}\" d=\"M{left} {top}L{right} {bottom}M{right} {top}L{left} {bottom}\"/>")
}

/// A text of at most `most` characters.
pub(super) fn cut(text: &str, most: usize) -> String {
    let text = one_line(text);
    let is_long = text.chars().count() > most;
    if is_long { text.chars().take(most - 1).chain(['…']).collect() } else { text }
}

/// A line of text; spaces at its start become a shift.
pub(super) fn text(x: usize, y: usize, class: &str, words: &str) -> String {
    let shown = words.trim_start();
    let x = x + (words.len() - shown.len()) * LETTER;
    format!("<text class=\"{class}\" x=\"{x}\" y=\"{y}\">{}</text>", escape(shown))
}

/// Text in XML; its newlines are those of titles.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for line in text.lines() {
        if !escaped.is_empty() {
            escaped.push('\n');
        }
        for character in one_line(line).chars() {
            match character {
                '&' => escaped += "&amp;",
                '<' => escaped += "&lt;",
                '>' => escaped += "&gt;",
                '"' => escaped += "&quot;",
                '\'' => escaped += "&apos;",
                other => escaped.push(other),
            }
        }
    }
    escaped
}
