//! Logs, counted by family and clause.

use crate::log::{CaseLine, Log};
use dsr_spec::ClauseId;
use std::collections::BTreeSet;

/// A log with the name that reports give it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Named {
    /// The implementation's name and version, or the file's name.
    pub name: String,
    /// The log.
    pub log: Log,
}

/// Passes among the cases that were asked.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Tally {
    /// Passed.
    pub passed: usize,
    /// Bad, and nobody expected it.
    pub bad: usize,
    /// Bad, as expected.
    pub excused: usize,
    /// Skipped, or unsupported.
    pub left_out: usize,
}

impl Named {
    /// Names a log by its implementation; by its file if that is unknown.
    pub fn of(file: &str, log: Log) -> Self {
        let known = log.header.implementation.as_ref();
        let name = known.map_or_else(|| file.to_owned(), |known| format!("{} {}", known.name, known.version));
        Self { name, log }
    }
}

impl Tally {
    /// Counts some cases.
    pub fn of<'l>(cases: impl IntoIterator<Item = &'l CaseLine>) -> Self {
        let mut tally = Self::default();
        for case in cases {
            tally.add(case);
        }
        tally
    }

    fn add(&mut self, case: &CaseLine) {
        if case.verdict == crate::report::Verdict::Pass {
            self.passed += 1;
        } else if case.is_bad() {
            self.bad += 1;
        } else if case.verdict.is_bad() {
            self.excused += 1;
        } else {
            self.left_out += 1;
        }
    }

    /// `12/14`, passes of all; what is left out is told apart.
    pub fn text(self) -> String {
        let asked = self.passed + self.bad + self.excused;
        match (asked, self.left_out) {
            (0, 0) => "–".into(),
            (0, out) => format!("({out} left out)"),
            (_, 0) => format!("{}/{asked}", self.passed),
            (_, out) => format!("{}/{asked} ({out} left out)", self.passed),
        }
    }
}

/// The clauses that cases cite, as people count.
pub(super) fn clauses<'l>(cases: impl IntoIterator<Item = &'l CaseLine>) -> Vec<String> {
    let mut found: BTreeSet<(bool, Option<ClauseId>, String)> = BTreeSet::new();
    for clause in cases.into_iter().flat_map(|case| &case.clauses) {
        let id: Option<ClauseId> = clause.parse().ok();
        found.insert((id.is_none(), id, clause.clone()));
    }
    found.into_iter().map(|(_, _, clause)| clause).collect()
}

/// The families of some cases: what everybody keeps first, what is closest to the bytes last.
pub(super) fn families<'l>(cases: impl IntoIterator<Item = &'l CaseLine>) -> Vec<String> {
    const ORDER: [&str; 4] = ["universal", "resolution", "causal", "wire"];
    let names: BTreeSet<&str> = cases.into_iter().map(CaseLine::family).collect();
    let mut names: Vec<_> = names.into_iter().collect();
    names.sort_by_key(|name| ORDER.iter().position(|family| family == name).unwrap_or(ORDER.len()));
    names.into_iter().map(String::from).collect()
}
