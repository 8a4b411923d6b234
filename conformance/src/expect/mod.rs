//! Failures that are expected, each with its reason. `[spec: CONF-14]`

mod update;

pub use update::update;

use crate::corpus::matches;
use crate::protocol::read_strictly;
use crate::report::{CaseResult, Report, Verdict};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A file of expectations.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Expectations {
    /// The name of the implementation that they are about.
    pub implementation: String,
    /// What does not pass.
    pub expected: Vec<Expected>,
}

/// Cases that do not pass, and why.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Expected {
    /// A case's id, or a pattern in which `*` stands for any characters.
    pub case: String,
    /// What comes of it. Two entries for one case allow two verdicts.
    pub verdict: Verdict,
    /// Why.
    pub reason: String,
    /// Where it is followed up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub issue: Option<String>,
}

/// Why a text is no file of expectations, or one that cannot be used.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum ExpectError {
    /// It has another form.
    #[error("{file}:{line}: {what}; write what conformance/schema/expectations.json allows")]
    Form {
        /// The file.
        file: String,
        /// The line, counted from 1.
        line: usize,
        /// What is wrong.
        what: String,
    },
    /// An entry has no reason.
    #[error(
        "{file}: {case:?} has no `reason`; write why it is a {verdict}, or repair it and delete the entry"
    )]
    NoReason {
        /// The file.
        file: String,
        /// The entry.
        case: String,
        /// The verdict expected.
        verdict: &'static str,
    },
    /// Two entries say the same.
    #[error("{file}: {case:?} is twice expected to be a {verdict}; delete one entry")]
    Twice {
        /// The file.
        file: String,
        /// The entry.
        case: String,
        /// The verdict expected.
        verdict: &'static str,
    },
    /// An entry matches no case.
    #[error("{file}: {case:?} matches no case of the corpus; see `dsr conform list`")]
    NoCase {
        /// The file.
        file: String,
        /// The entry.
        case: String,
    },
    /// The expectations are of something else.
    #[error(
        "{file} is about {expected:?}, and the adapter is one of {found:?}; use the file of that implementation"
    )]
    Implementation {
        /// The file.
        file: String,
        /// Whom it is about.
        expected: String,
        /// Who answered.
        found: String,
    },
}

/// What is not as expected.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Surprise {
    /// A case passes that should not.
    #[error("{id} passes, and {pattern:?} expects {expected}: delete the entry, or narrow it")]
    Passes {
        /// The case.
        id: String,
        /// The entry.
        pattern: String,
        /// What the entry expects.
        expected: &'static str,
    },
    /// A case comes out otherwise.
    #[error("{id} is {verdict}, and {pattern:?} expects {expected}")]
    Otherwise {
        /// The case.
        id: String,
        /// What came of it.
        verdict: &'static str,
        /// The entry.
        pattern: String,
        /// What the entry expects.
        expected: &'static str,
    },
    /// An entry matches no case of the corpus.
    #[error("{pattern:?} matches no case of the corpus: delete the entry")]
    MatchesNothing {
        /// The entry.
        pattern: String,
    },
}

impl Expectations {
    /// Reads a file. Reasons may still be missing.
    pub fn read(file: &str, text: &str) -> Result<Self, ExpectError> {
        let read: Self = read_strictly(text).map_err(|error| ExpectError::Form {
            file: file.into(),
            line: error.line().max(1),
            what: error.to_string(),
        })?;
        for (at, entry) in read.expected.iter().enumerate() {
            let is_same = |other: &Expected| (&other.case, other.verdict) == (&entry.case, entry.verdict);
            if read.expected[..at].iter().any(is_same) {
                let (file, case) = (file.into(), entry.case.clone());
                return Err(ExpectError::Twice { file, case, verdict: entry.verdict.name() });
            }
        }
        Ok(read)
    }

    /// Whether each entry has a reason.
    pub fn have_reasons(&self, file: &str) -> Result<(), ExpectError> {
        match self.expected.iter().find(|entry| entry.reason.trim().is_empty()) {
            None => Ok(()),
            Some(entry) => Err(ExpectError::NoReason {
                file: file.into(),
                case: entry.case.clone(),
                verdict: entry.verdict.name(),
            }),
        }
    }

    /// Whether each entry matches a case.
    pub fn match_cases(&self, file: &str, ids: &[String]) -> Result<(), ExpectError> {
        match self.expected.iter().find(|entry| !ids.iter().any(|id| matches(&entry.case, id))) {
            None => Ok(()),
            Some(entry) => Err(ExpectError::NoCase { file: file.into(), case: entry.case.clone() }),
        }
    }

    /// The entry that expects this verdict of this case.
    pub fn excuse(&self, id: &str, verdict: Verdict) -> Option<&Expected> {
        self.expected.iter().find(|entry| entry.verdict == verdict && matches(&entry.case, id))
    }

    fn about<'e>(&'e self, id: &'e str) -> impl Iterator<Item = &'e Expected> + 'e {
        self.expected.iter().filter(move |entry| matches(&entry.case, id))
    }

    /// Whether a result is expected though it is no pass.
    pub fn excuses(&self, result: &CaseResult) -> bool {
        self.excuse(&result.id, result.verdict).is_some()
    }

    /// What is not as expected. `ids` are those of the whole corpus. `[spec: CONF-14]`
    pub fn surprises(&self, report: &Report, ids: &[String]) -> Vec<Surprise> {
        let results = report.results.iter().filter(|result| !self.excuses(result));
        let wrong = results.filter_map(|result| {
            let entry = self.about(&result.id).next()?;
            let (id, pattern, expected) = (result.id.clone(), entry.case.clone(), entry.verdict.name());
            Some(if result.verdict == Verdict::Pass {
                Surprise::Passes { id, pattern, expected }
            } else {
                Surprise::Otherwise { id, verdict: result.verdict.name(), pattern, expected }
            })
        });
        let unmatched = self.expected.iter().filter(|entry| !ids.iter().any(|id| matches(&entry.case, id)));
        let unmatched = unmatched.map(|entry| Surprise::MatchesNothing { pattern: entry.case.clone() });
        wrong.chain(unmatched).collect()
    }

    /// The file's text.
    pub fn text(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self).map(|text| text + "\n")
    }

    /// The schema of the file.
    pub fn schema() -> schemars::Schema {
        schemars::schema_for!(Self)
    }
}
