//! A run, line by line: a header, a line for each case, a footer. `[spec: CONF-13]`

mod compare;
mod read;
mod write;

pub use compare::{Change, Comparison, compare};
pub use read::{LOG_BYTES_MAX, Log, LogError, read};
pub use write::LogWriter;

use crate::case::Level;
use crate::protocol::{Implementation, Profile, Unique};
use crate::report::{CaseResult, Outcome, Verdict};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The format of logs.
pub const FORMAT: u32 = 1;

/// One line.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Line {
    /// The first.
    Header(Header),
    /// What came of a case.
    Case(CaseLine),
    /// The last. A log without it is incomplete.
    Footer(Footer),
}

/// What was run.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// 1.
    pub format: u32,
    /// The version of the protocol.
    pub protocol: u32,
    /// The version of the corpus.
    pub corpus: String,
    /// The version of the specification.
    pub spec: String,
    /// What was tested; null if it never said.
    #[serde(deserialize_with = "Option::deserialize")]
    #[schemars(required)]
    pub implementation: Option<Implementation>,
    /// The profiles that it announced.
    pub profiles: Vec<String>,
    /// The features that it announced.
    pub features: Vec<String>,
    /// The command that started it; empty if it ran in the same process.
    pub command: Vec<String>,
    /// The deepest profile that was asked for; null is every one.
    #[serde(deserialize_with = "Option::deserialize")]
    #[schemars(required)]
    pub profile: Option<Profile>,
    /// The pattern that chose the cases.
    pub only: String,
    /// How many cases were to be run.
    pub cases: usize,
}

/// What came of a case.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CaseLine {
    /// Its id.
    pub id: String,
    /// How binding it is.
    pub level: Level,
    /// The clauses that it witnesses.
    pub clauses: Vec<String>,
    /// What came of it.
    pub verdict: Verdict,
    /// The step, counted from 1, at which it ended; left out before the first, and if it passed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step: Option<usize>,
    /// Why, in words.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub detail: String,
    /// The clause that a view breaks by itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub broken: Option<String>,
    /// Lines that should be there and are not.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub expected: Vec<String>,
    /// Lines that are there and should not be.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub got: Vec<String>,
    /// Why this verdict was expected, if it was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub excuse: Option<String>,
    /// How long it took; no reader may depend on it.
    pub milliseconds: u64,
}

/// How the run ended.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Footer {
    /// How it ended.
    pub verdict: Outcome,
    /// How many cases have each verdict, and how many were not run.
    pub counts: Unique<usize>,
}

impl CaseLine {
    /// The line of a result.
    pub fn of(result: &CaseResult, excuse: Option<String>) -> Self {
        let failure = &result.failure;
        let difference = failure.difference.clone().unwrap_or_default();
        Self {
            id: result.id.clone(),
            level: result.level,
            clauses: result.spec.clone(),
            verdict: result.verdict,
            step: (failure.step > 0).then_some(failure.step),
            detail: failure.what.clone(),
            broken: failure.broken.map(String::from),
            expected: difference.expected,
            got: difference.got,
            excuse,
            milliseconds: result.milliseconds,
        }
    }

    /// Whether it is bad, and nobody expected it.
    pub const fn is_bad(&self) -> bool {
        self.verdict.is_bad() && self.excuse.is_none()
    }

    /// The family of the case.
    pub fn family(&self) -> &str {
        self.id.split('/').next().unwrap_or_default()
    }
}

impl Line {
    /// The schema of a line.
    pub fn schema() -> schemars::Schema {
        schemars::schema_for!(Self)
    }
}
