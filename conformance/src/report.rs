//! Verdicts, counted. `[spec: CONF-9]` `[spec: CONF-10]`

use crate::case::{Case, Level};
use crate::corpus;
use crate::protocol::{Implementation, PROTOCOL};
use crate::run::Failure;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::time::Duration;

/// What comes of a case.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Everything is as expected.
    Pass,
    /// Something is not.
    Fail,
    /// The adapter replies an error where something else is asked for.
    Error,
    /// The adapter ends before the case.
    Crash,
    /// A reply does not come in time.
    Timeout,
    /// What the adapter writes is not what the protocol allows.
    ProtocolError,
    /// The adapter asks to leave the case out.
    Skip,
    /// The adapter has not announced what the case requires.
    Unsupported,
}

impl Verdict {
    /// All eight.
    pub const ALL: [Self; 8] = [
        Self::Pass,
        Self::Fail,
        Self::Error,
        Self::Crash,
        Self::Timeout,
        Self::ProtocolError,
        Self::Skip,
        Self::Unsupported,
    ];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::Error => "error",
            Self::Crash => "crash",
            Self::Timeout => "timeout",
            Self::ProtocolError => "protocol_error",
            Self::Skip => "skip",
            Self::Unsupported => "unsupported",
        }
    }

    /// Whether it is neither a pass nor a case left out.
    pub const fn is_bad(self) -> bool {
        !matches!(self, Self::Pass | Self::Skip | Self::Unsupported)
    }
}

/// One case and what came of it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct CaseResult {
    /// The case's id.
    pub id: String,
    /// How binding it is.
    pub level: Level,
    /// The clauses that it witnesses.
    pub spec: Vec<String>,
    /// What came of it.
    pub verdict: Verdict,
    /// Why, unless it passed.
    pub failure: Failure,
    /// How long it took.
    pub milliseconds: u64,
}

impl CaseResult {
    pub(crate) fn of(case: &Case, verdict: Verdict, failure: Failure, took: Duration) -> Self {
        let milliseconds = u64::try_from(took.as_millis()).unwrap_or(u64::MAX);
        let (id, level, spec) = (case.id.clone(), case.level, case.spec.clone());
        Self { id, level, spec, verdict, failure, milliseconds }
    }
}

/// How a run ends.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Some case passed, none was left out unannounced, and none that is a MUST is bad. Exit status 0.
    Expected,
    /// A case that is a MUST is bad. Exit status 1.
    Unexpected,
    /// Nothing is bad, and cases were skipped or not run, or none passed. Exit status 2.
    Incomplete,
}

/// What came of a run.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Report {
    /// What was tested, once it said so.
    pub implementation: Option<Implementation>,
    /// Case by case.
    pub results: Vec<CaseResult>,
    /// How many cases were to be run.
    pub wanted: usize,
}

/// A report in numbers, as `dsr conform --format json` prints it.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Summary {
    /// How the run ended.
    pub verdict: Outcome,
    /// The version of the protocol.
    pub protocol: u32,
    /// The version of the corpus.
    pub corpus: &'static str,
    /// The version of the specification.
    pub spec: &'static str,
    /// What was tested; null if it never said.
    pub implementation: Option<Implementation>,
    /// How many cases have each verdict; `not_run` are those that the run did not come to.
    pub counts: BTreeMap<&'static str, usize>,
    /// The same by family, verdicts that occur.
    pub families: BTreeMap<String, BTreeMap<&'static str, usize>>,
    /// The single runs, where there is more than one. `[spec: CONF-18]`
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub runs: Vec<SingleRun>,
}

/// One of several runs of the same cases.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SingleRun {
    /// How the adapter was asked: `in-process` or `stdio`.
    pub transport: &'static str,
    /// How the run ended.
    pub verdict: Outcome,
    /// How many cases have each verdict.
    pub counts: BTreeMap<&'static str, usize>,
    /// The same by family.
    pub families: BTreeMap<String, BTreeMap<&'static str, usize>>,
}

impl Summary {
    /// Runs of the same cases in one summary: the worst verdict, and the counts of the first run with it. Runs that differ
    /// in their counts are unexpected. `None` if there is no run. `[spec: CONF-18]`
    pub fn together(runs: Vec<(&'static str, Self)>) -> Option<Self> {
        let worst = runs.iter().max_by_key(|(_, run)| std::cmp::Reverse(run.verdict.rank()))?.1.clone();
        let differ = runs.iter().any(|(_, run)| run.counts != worst.counts || run.families != worst.families);
        let verdict = if differ { Outcome::Unexpected } else { worst.verdict };
        let runs = runs.into_iter().map(|(transport, run)| SingleRun {
            transport,
            verdict: run.verdict,
            counts: run.counts,
            families: run.families,
        });
        Some(Self { verdict, runs: runs.collect(), ..worst })
    }
}

impl Outcome {
    /// What is worst first: something definite is wrong, something is unknown, neither.
    const fn rank(self) -> u8 {
        match self {
            Self::Unexpected => 0,
            Self::Incomplete => 1,
            Self::Expected => 2,
        }
    }
}

impl Report {
    pub(crate) const fn new(wanted: usize) -> Self {
        Self { implementation: None, results: Vec::new(), wanted }
    }

    pub(crate) fn add(&mut self, result: CaseResult) {
        self.results.push(result);
    }

    /// How many cases have a verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.results.iter().filter(|result| result.verdict == verdict).count()
    }

    /// How the run ended.
    pub fn outcome(&self) -> Outcome {
        self.outcome_but(&|_| false)
    }

    /// How the run ended, if what is excused counts as expected. `[spec: CONF-10]`
    pub fn outcome_but(&self, is_excused: &dyn Fn(&CaseResult) -> bool) -> Outcome {
        let counted = || self.results.iter().filter(|result| !is_excused(result));
        if counted().any(|result| result.level == Level::Must && result.verdict.is_bad()) {
            Outcome::Unexpected
        } else if self.results.len() < self.wanted
            || counted().any(|result| result.verdict == Verdict::Skip)
            || self.count(Verdict::Pass) == 0
        {
            Outcome::Incomplete
        } else {
            Outcome::Expected
        }
    }

    /// The report in numbers.
    pub fn summary(&self) -> Summary {
        let mut families: BTreeMap<String, BTreeMap<&'static str, usize>> = BTreeMap::new();
        for result in &self.results {
            let family = result.id.split('/').next().unwrap_or_default();
            *families.entry(family.into()).or_default().entry(result.verdict.name()).or_default() += 1;
        }
        let mut counts: BTreeMap<_, _> =
            Verdict::ALL.iter().map(|&verdict| (verdict.name(), self.count(verdict))).collect();
        counts.insert("not_run", self.wanted - self.results.len());
        Summary {
            verdict: self.outcome(),
            protocol: PROTOCOL,
            corpus: corpus::VERSION,
            spec: corpus::SPEC_VERSION,
            implementation: self.implementation.clone(),
            counts,
            families,
            runs: Vec::new(),
        }
    }
}
