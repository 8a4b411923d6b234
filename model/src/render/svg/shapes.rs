//! Shapes and texts.

use super::LETTER;
use crate::render::diagram::Event;
use crate::render::words::one_line;

/// A full circle, a full diamond, a hollow square or a hollow diamond.
pub(super) fn shape(event: &Event<'_>, x: usize, y: usize) -> String {
    let diamond = |class: &str| {
        let (left, right, top, bottom) = (x - 9, x + 9, y - 9, y + 9);
        format!("<path class=\"{class}\" d=\"M{x} {top}L{right} {y}L{x} {bottom}L{left} {y}z\"/>")
    };
    match event {
        Event::Mutation { .. } => format!("<circle class=\"full\" cx=\"{x}\" cy=\"{y}\" r=\"7\"/>"),
        Event::Delivery { .. } => diamond("full"),
        Event::Resynchronisation { .. } => diamond("hollow"),
        Event::Restart => {
            format!("<rect class=\"hollow\" x=\"{}\" y=\"{}\" width=\"14\" height=\"14\"/>", x - 7, y - 7)
        }
    }
}

pub(super) fn cross(x: usize, y: usize) -> String {
    let (left, right, top, bottom) = (x - 7, x + 7, y - 7, y + 7);
    format!("<path class=\"cross\" d=\"M{left} {top}L{right} {bottom}M{right} {top}L{left} {bottom}\"/>")
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
