//! How many of the checker's broken cores the corpus finds. `[spec: CONF-19]`
//!
//! A corpus that fails nobody proves nothing. The checker has cores broken on purpose, one flaw each; each of them is
//! run as an implementation would be, and must fail a case.

mod flawed;

pub use flawed::Flawed;

use crate::adapter::CoreAdapter;
use crate::case::{Case, Step};
use crate::report::{Report, Verdict};
use crate::run::{InProcess, run};
use dsr_core::{CausalContext, State, decode, decode_digest};
use dsr_model::alarms::{Alarm, all};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Up to which sequence the broken cores are asked.
const NEAR: u64 = 10_000;

/// What the corpus finds of one broken core.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Score {
    /// The flaw's name.
    pub flaw: &'static str,
    /// What is broken.
    pub broken: &'static str,
    /// The clause that it offends, at its root.
    pub clause: &'static str,
    /// How many cases it does not pass.
    pub failed: usize,
    /// The one of these with the fewest steps.
    pub shortest: Option<String>,
}

/// The scores of all broken cores.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scores {
    /// Core by core.
    pub cores: Vec<Score>,
    /// How many were found.
    pub found: usize,
    /// How many cases were run on each.
    pub cases: usize,
}

impl Scores {
    /// Whether none was missed.
    pub fn is_full(&self) -> bool {
        self.found == self.cores.len()
    }
}

/// The checker's broken cores. Its alarms of a broken *search* are left out: their core is sound.
pub fn broken_cores() -> impl Iterator<Item = Alarm> {
    all().into_iter().filter(|alarm| !alarm.is_of_the_search())
}

/// Runs one broken core on cases.
pub fn run_broken(alarm: &Alarm, cases: &[Case]) -> Report {
    run(&mut InProcess(|| CoreAdapter::of(Flawed(alarm.clone()))), cases)
}

/// Runs every broken core on cases. Some of them count dots one by one: cases that name far ones are left out.
pub fn score(cases: &[Case]) -> Scores {
    let cases: Vec<Case> = cases.iter().filter(|case| !names_far_dots(case)).cloned().collect();
    let cores: Vec<_> = broken_cores().map(|alarm| of(&alarm, &cases)).collect();
    Scores { found: cores.iter().filter(|core| core.failed > 0).count(), cores, cases: cases.len() }
}

/// Whether something that comes from outside has a dot of a sequence over [`NEAR`].
fn names_far_dots(case: &Case) -> bool {
    let is_far = |context: &CausalContext| context.runs().any(|run| run.last > NEAR);
    case.steps.iter().any(|step| match step {
        Step::Load { state, .. } | Step::ExpectUnloadable { state, .. } => {
            State::deserialize(state).is_ok_and(|state| is_far(state.context()))
        }
        Step::Decode { bytes, .. } | Step::ExpectUndecodable { bytes, .. } => {
            decode(&bytes.0).is_ok_and(|state| is_far(state.context()))
        }
        Step::AnswerDigest { bytes, .. } | Step::ExpectUnanswerable { bytes, .. } => {
            decode_digest(&bytes.0).is_ok_and(|digest| is_far(&digest.context))
        }
        _ => false,
    })
}

fn of(alarm: &Alarm, cases: &[Case]) -> Score {
    let report = run_broken(alarm, cases);
    let bad = report.results.iter().zip(cases).filter(|(result, _)| result.verdict == Verdict::Fail);
    let bad: Vec<_> = bad.map(|(_, case)| case).collect();
    let shortest = bad.iter().min_by_key(|case| case.steps.len());
    Score {
        flaw: alarm.name,
        broken: alarm.broken,
        clause: alarm.clause,
        failed: bad.len(),
        shortest: shortest.map(|case| case.id.clone()),
    }
}
