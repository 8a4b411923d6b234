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
use dsr_model::alarms::{Alarm, all, none};
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
    /// How many cases it does not pass; null if nobody has counted.
    pub failed: Option<usize>,
    /// The one of these with the fewest steps.
    pub shortest: Option<String>,
}

/// The scores of all broken cores.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scores {
    /// Core by core.
    pub cores: Vec<Score>,
    /// Cases that the sound core does not pass in the place of a broken one: there must be none, or what is found is not
    /// due to the flaws.
    pub control: Vec<String>,
    /// How many were found.
    pub found: usize,
    /// How many cases there are that can be run on each.
    pub cases: usize,
}

impl Scores {
    /// Whether none was missed, and the sound core fails nothing.
    pub fn is_full(&self) -> bool {
        self.control.is_empty() && self.found == self.cores.len()
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

/// How much is run.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Extent {
    /// Of each core the cases in the order of their length, until one fails.
    UntilFound,
    /// Every case.
    All,
}

/// Runs every broken core on cases. Some of them count dots one by one: cases that name far ones are left out.
pub fn score(cases: &[Case], extent: Extent) -> Scores {
    let mut cases: Vec<Case> = cases.iter().filter(|case| !names_far_dots(case)).cloned().collect();
    cases.sort_by_key(|case| case.steps.len());
    let of = |alarm: Alarm| match extent {
        Extent::All => counted(&alarm, &cases),
        Extent::UntilFound => first(&alarm, &cases),
    };
    let cores: Vec<_> = broken_cores().map(of).collect();
    let found = cores.iter().filter(|core| core.shortest.is_some()).count();
    let control = run_broken(&none(), &cases).results.into_iter();
    let control = control.filter(|result| result.verdict.is_bad()).map(|result| result.id).collect();
    Scores { control, found, cores, cases: cases.len() }
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

fn first(alarm: &Alarm, shortest_first: &[Case]) -> Score {
    let fails = |case: &&Case| run_broken(alarm, std::slice::from_ref(*case)).count(Verdict::Fail) > 0;
    of(alarm, None, shortest_first.iter().find(fails))
}

fn counted(alarm: &Alarm, shortest_first: &[Case]) -> Score {
    let report = run_broken(alarm, shortest_first);
    let results = report.results.iter().zip(shortest_first);
    let bad: Vec<_> = results.filter(|(result, _)| result.verdict == Verdict::Fail).collect();
    of(alarm, Some(bad.len()), bad.first().map(|(_, case)| *case))
}

fn of(alarm: &Alarm, failed: Option<usize>, shortest: Option<&Case>) -> Score {
    let (flaw, broken, clause) = (alarm.name, alarm.broken, alarm.clause);
    Score { flaw, broken, clause, failed, shortest: shortest.map(|case| case.id.clone()) }
}
