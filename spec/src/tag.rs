//! Tags in the comments of Rust files.

use crate::witness::function_of;
use crate::{ClauseId, Fault, Place, Source, TestModules, test_lines};

/// What a tag says of the clause that it names.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum TagKind {
    /// The code keeps it: `[spec: …]` outside test code.
    Code,
    /// A test witnesses it: `[spec: …]` in test code; or a function that is a checked property,
    /// `[property: …]` anywhere.
    Witness,
}

/// One clause named by one tag.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Tag {
    /// The clause.
    pub id: ClauseId,
    /// What is said of it.
    pub kind: TagKind,
    /// Where.
    pub place: Place,
    /// The function that carries a witness.
    pub function: Option<String>,
}

const OPENINGS: [(&str, bool); 2] = [("[spec: ", false), ("[property: ", true)];

struct Raw<'s> {
    ids: &'s str,
    property: bool,
    start: usize,
    end: usize,
}

/// Every tag of a file. Only comments count. A `//!` tag in test code belongs to no function and witnesses
/// nothing.
pub fn tags_of(source: &Source, modules: &TestModules, faults: &mut Vec<Fault>) -> Vec<Tag> {
    let test = test_lines(source, modules);
    let lines: Vec<&str> = source.text.lines().collect();
    let mut tags = Vec::new();
    let mut before: Option<(ClauseId, usize)> = None;
    for raw in raw_tags(&source.text) {
        let line = source.text[..raw.start].matches('\n').count();
        let comment = lines[line].trim_start();
        if !comment_precedes(&source.text, raw.start) {
            continue;
        }
        let place = Place { path: source.path.clone(), line: line + 1 };
        let malformed =
            || Fault::MalformedTag { text: source.text[raw.start..raw.end].into(), place: place.clone() };
        let Ok(mut ids) = raw.ids.split(", ").map(str::parse).collect::<Result<Vec<ClauseId>, _>>() else {
            faults.push(malformed());
            continue;
        };
        let last = ids.last().cloned();
        if let Some((first, end)) = before.take()
            && says_to(&source.text[end..raw.start])
        {
            match first.to(&ids[0]) {
                Some(range) => ids.extend(range.into_iter().skip(1)),
                None => faults.push(malformed()),
            }
        }
        before = last.map(|id| (id, raw.end));
        let kind = if raw.property || test[line] { TagKind::Witness } else { TagKind::Code };
        let function = if kind == TagKind::Witness { function_at(&lines, line) } else { None };
        if kind == TagKind::Witness && (comment.starts_with("//!") || function.is_none()) {
            continue;
        }
        let named =
            ids.into_iter().map(|id| Tag { id, kind, place: place.clone(), function: function.clone() });
        tags.extend(named);
    }
    tags.sort_unstable();
    tags.dedup();
    tags
}

fn raw_tags(text: &str) -> Vec<Raw<'_>> {
    let mut raw: Vec<Raw<'_>> = Vec::new();
    for (opening, property) in OPENINGS {
        for (start, _) in text.match_indices(opening) {
            let body = &text[start + opening.len()..];
            let length = body.find(']').unwrap_or(0);
            raw.push(Raw { ids: &body[..length], property, start, end: start + opening.len() + length + 1 });
        }
    }
    raw.retain(|tag| tag.end <= text.len());
    raw.sort_unstable_by_key(|tag| tag.start);
    raw
}

/// Whether the tag stands in a line comment.
fn comment_precedes(text: &str, start: usize) -> bool {
    let line = text[..start].rfind('\n').map_or(0, |at| at + 1);
    text[line..start].contains("//")
}

/// Whether what stands between two tags makes a range of them: `[spec: WF-1]` to `[spec: WF-6]`, over a
/// line break too.
fn says_to(between: &str) -> bool {
    let word: String =
        between.chars().filter(|c| !c.is_whitespace() && !matches!(c, '`' | '/' | '!')).collect();
    word == "to"
}

/// The function that a doc comment precedes, or that a plain comment stands in.
fn function_at(lines: &[&str], line: usize) -> Option<String> {
    if lines[line].trim_start().starts_with("///") {
        lines[line..].iter().find_map(|text| function_of(text))
    } else {
        lines[..line].iter().rev().find_map(|text| function_of(text))
    }
}
