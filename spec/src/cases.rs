//! The cases of the conformance corpus, by the clauses that they cite.

use crate::{ClauseId, Clauses, Gap, Place, Source};
use serde_json::Value;
use std::collections::BTreeMap;

/// The folder of the corpus, from the workspace root.
pub const CORPUS_PATH: &str = "conformance/corpus/v1";

/// How many cases there are, and how many cite each clause.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Cases {
    /// All of them.
    pub total: usize,
    /// By clause.
    pub citing: BTreeMap<ClauseId, usize>,
}

/// Counts the cases of all files; a file without `cases` has none.
pub fn count_cases(files: &[Source], clauses: &Clauses, gaps: &mut Vec<Gap>) -> Cases {
    let mut cases = Cases::default();
    for file in files {
        let json: Value = match serde_json::from_str(&file.text) {
            Ok(json) => json,
            Err(error) => {
                gaps.push(Gap::Unreadable { path: file.path.clone(), why: error.to_string() });
                continue;
            }
        };
        for case in json["cases"].as_array().into_iter().flatten() {
            cases.total += 1;
            for cited in case["spec"].as_array().into_iter().flatten().filter_map(Value::as_str) {
                if let Some(id) = cited.parse::<ClauseId>().ok().filter(|id| clauses.get(id).is_some()) {
                    *cases.citing.entry(id).or_default() += 1;
                } else {
                    let place = Place { path: file.path.clone(), line: 1 };
                    gaps.push(Gap::NoList { text: cited.into(), place });
                }
            }
        }
    }
    if cases.total == 0 {
        gaps.push(Gap::Empty { path: CORPUS_PATH.into(), what: "cases" });
    }
    cases
}
