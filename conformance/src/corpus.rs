//! The cases that ship, in `conformance/corpus/v1`.

use crate::case::{Case, CaseError, read};

/// The version of the corpus. New cases raise the second number, a changed expectation the first.
pub const VERSION: &str = "1.0.0";
/// The version of the specification that it is written for.
pub const SPEC_VERSION: &str = "0.1";

/// Each file of the corpus, in order: its path, and its text.
pub const FILES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/files.rs"));

/// Every case, in the order of files and within them.
pub fn cases() -> Result<Vec<Case>, CaseError> {
    let files = FILES.iter().map(|(path, text)| read(path, text));
    Ok(files.collect::<Result<Vec<_>, _>>()?.into_iter().flat_map(|file| file.cases).collect())
}

/// Whether an id matches a pattern, in which `*` stands for any characters.
pub fn matches(pattern: &str, id: &str) -> bool {
    let mut parts = pattern.split('*');
    let Some(mut rest) = parts.next().and_then(|start| id.strip_prefix(start)) else { return false };
    let mut parts = parts.peekable();
    if parts.peek().is_none() {
        return rest.is_empty();
    }
    while let Some(part) = parts.next() {
        if parts.peek().is_none() {
            return rest.ends_with(part);
        }
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    true
}
