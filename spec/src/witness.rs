//! What kind of witness a function is.

use crate::{Source, TestModules, test_lines};
use std::collections::BTreeMap;

/// How a function that carries a tag bears witness.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum WitnessKind {
    /// A test, or what a test calls.
    Test,
    /// A test of random samples: inside `proptest! { … }` or `prop_state_machine! { … }`, or with a
    /// `TestRunner` of its own.
    Sample,
    /// A judge that tests and the checker call: it shows nothing by itself.
    Judge,
}

const BLOCKS: [&str; 2] = ["proptest! {", "prop_state_machine! {"];

/// Every function of a file. Relies on the layout that `cargo fmt` makes: a block ends where its closing brace
/// stands as deep as its opening.
pub fn witness_kinds(source: &Source, modules: &TestModules) -> BTreeMap<String, WitnessKind> {
    let test = test_lines(source, modules);
    let lines: Vec<&str> = source.text.lines().collect();
    let mut kinds = BTreeMap::new();
    let mut block: Option<usize> = None;
    for (at, line) in lines.iter().enumerate() {
        if BLOCKS.contains(&line.trim()) {
            block = Some(depth(line));
        } else if block == Some(depth(line)) && line.trim() == "}" {
            block = None;
        }
        let Some(name) = function_of(line) else { continue };
        let end =
            (at + 1..lines.len()).find(|&end| depth(lines[end]) == depth(line) && lines[end].trim() == "}");
        let body = &lines[at..end.unwrap_or(at)];
        let is_sample = block.is_some() || body.iter().any(|line| line.contains("TestRunner::"));
        let kind = match (test[at], is_sample) {
            (false, _) => WitnessKind::Judge,
            (true, true) => WitnessKind::Sample,
            (true, false) => WitnessKind::Test,
        };
        kinds.insert(name, kind);
    }
    kinds
}

fn depth(line: &str) -> usize {
    line.len() - line.trim_start().len()
}

/// The name of the function that a line begins.
pub(crate) fn function_of(line: &str) -> Option<String> {
    let code = line.trim_start();
    if code.starts_with("//") {
        return None;
    }
    let (_, rest) = code.strip_prefix("fn ").map(|rest| ("", rest)).or_else(|| code.split_once(" fn "))?;
    let name: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    (!name.is_empty()).then_some(name)
}
