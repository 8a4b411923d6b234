//! The cases that ship, in `conformance/corpus/v1`.

mod manifest;
mod validate;

pub use manifest::{Known, known_ids, listed_ids, manifest};
pub use validate::{CorpusFault, faults, faults_of_file};

use crate::case::{Case, CaseError, read};
use crate::protocol::Profile;

/// The version of the corpus. New cases raise the second number, a changed expectation the first.
pub const VERSION: &str = "2.0.0";
/// The version of the specification that it is written for.
pub const SPEC_VERSION: &str = "0.2";

/// Each file of the corpus, in order: its path, and its text.
pub const FILES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/files.rs"));

/// What the specification chooses where it could have chosen otherwise, as JSON: the `choice` of a case is the name of
/// one. `[spec: CONF-11]`
pub const CHOICES: &str = include_str!("../corpus/v1/choices.json");

/// Every case, in the order of files and within them.
pub fn cases() -> Result<Vec<Case>, CaseError> {
    let files = FILES.iter().map(|(path, text)| read(path, text));
    Ok(files.collect::<Result<Vec<_>, _>>()?.into_iter().flat_map(|file| file.cases).collect())
}

/// The cases for a first look: their ids, in the order in which to ask them.
pub const SMOKE: &str = include_str!("../corpus/smoke.json");
/// Every id that a case ever had.
pub const IDS: &str = include_str!("../corpus/ids.txt");
/// What the corpus consists of.
pub const MANIFEST: &str = include_str!("../corpus/MANIFEST.json");

/// The ids of the cases for a first look.
pub fn smoke() -> Result<Vec<String>, serde_json::Error> {
    #[derive(serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Smoke {
        #[serde(rename = "format")]
        _format: u32,
        cases: Vec<String>,
    }

    serde_json::from_str::<Smoke>(SMOKE).map(|smoke| smoke.cases)
}

/// Which cases of the corpus to run.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Filter {
    /// A pattern of ids.
    pub only: String,
    /// The deepest profile; `None` is every one.
    pub profile: Option<Profile>,
    /// A clause that the cases cite; `None` is every one.
    pub clause: Option<String>,
}

impl Filter {
    /// Whether a case is chosen.
    pub fn takes(&self, case: &Case) -> bool {
        matches(&self.only, &case.id)
            && self.profile.is_none_or(|deepest| case.profile <= deepest)
            && self.clause.as_ref().is_none_or(|clause| case.spec.contains(clause))
    }
}

/// The ids that are most like a text that is none, at most three.
pub fn similar<'i>(wanted: &str, ids: impl IntoIterator<Item = &'i str>) -> Vec<&'i str> {
    let mut ranked: Vec<(usize, &str)> = ids
        .into_iter()
        .map(|id| {
            let slug = id.rsplit('/').next().unwrap_or(id);
            let within =
                if id.contains(wanted) { 0 } else { distance(wanted, id).min(distance(wanted, slug)) };
            (within, id)
        })
        .filter(|&(distance, _)| distance <= 3.max(wanted.chars().count() / 3))
        .collect();
    ranked.sort_unstable();
    ranked.into_iter().take(3).map(|(_, id)| id).collect()
}

/// How many characters must be changed, added or left out. O(one · other).
fn distance(one: &str, other: &str) -> usize {
    let other: Vec<char> = other.chars().collect();
    let mut row: Vec<usize> = (0..=other.len()).collect();
    for (at, character) in one.chars().enumerate() {
        let mut before = row[0];
        row[0] = at + 1;
        for (column, &with) in other.iter().enumerate() {
            let changed = before + usize::from(character != with);
            before = row[column + 1];
            row[column + 1] = changed.min(row[column] + 1).min(before + 1);
        }
    }
    row.last().copied().unwrap_or_default()
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
