//! Tests in Rust that replay a trace.
//!
//! A trace of the checked semantics becomes a test of `dsr-core` alone: each step is a call, with what it changes.
//! A trace of another semantics becomes a test that replays it by `dsr-model`, with its steps as comments.

mod of_core;
mod of_model;

use crate::trace::Trace;

/// The text of a test.
pub(super) fn rust(trace: &Trace) -> String {
    match of_core::of_core(trace) {
        Some(text) => text,
        None => of_model::of_model(trace),
    }
}

/// A name for the test.
fn test_name(trace: &Trace) -> String {
    let (clause, title) = (&trace.finding.clause, &trace.title);
    let title = if title.contains(&**clause) { title.clone() } else { format!("{clause} {title}") };
    let plain = title
        .chars()
        .map(|letter| if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { ' ' });
    let plain: String = plain.collect();
    let words: Vec<&str> = plain.split_whitespace().take(NAME_WORDS).collect();
    format!("replays_{}", words.join("_"))
}

/// The most words of a name.
const NAME_WORDS: usize = 12;

/// A raw string that holds a text, whatever is in it.
fn raw(text: &str) -> String {
    let most = text.split('"').skip(1).map(|after| after.chars().take_while(|&letter| letter == '#').count());
    let hashes = "#".repeat(most.max().map_or(1, |most| most + 1));
    format!("r{hashes}\"{text}\"{hashes}")
}

/// A text on one line of a comment.
fn comment(text: &str) -> String {
    super::words::one_line(text)
}
