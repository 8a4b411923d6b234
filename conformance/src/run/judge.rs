//! One case. `[spec: CONF-9]`

mod course;
mod expect;
mod invariants;

use super::difference::Difference;
use super::peer::Trouble;
use super::session::Session;
use super::watch::Watch;
use crate::case::{Case, Step};
use crate::protocol::{CaseBegin, Command, Decode, Load, Mutate};
use crate::report::Verdict;
use course::Course;

pub use invariants::{Broken, Tree, broken};

/// What is wrong, and where.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Failure {
    /// The step, counted from 1; 0 before the first.
    pub step: usize,
    /// The invariant that a view breaks by itself, by its clause.
    pub broken: Option<&'static str>,
    /// In words.
    pub what: String,
    /// What was expected and what came, where that is what is wrong.
    pub difference: Option<Difference>,
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.what)?;
        let Some(Difference { expected, got }) = &self.difference else { return Ok(()) };
        expected.iter().try_for_each(|line| write!(f, "\n  - expected {line}"))?;
        got.iter().try_for_each(|line| write!(f, "\n  + got      {line}"))
    }
}

/// Why a case stops before its end.
enum Stop {
    Verdict(Verdict, Failure),
    Trouble(Trouble),
}

impl From<Trouble> for Stop {
    fn from(trouble: Trouble) -> Self {
        Self::Trouble(trouble)
    }
}

/// Runs a case; `Err` if the conversation cannot go on, with the step at which it broke.
pub(super) fn judge(
    session: &mut Session,
    case: &Case,
    watch: &mut dyn Watch,
) -> Result<(Verdict, Failure), (Trouble, usize)> {
    if let Some(what) = unsupported(session, case) {
        return Ok((Verdict::Unsupported, Failure { what, ..Failure::default() }));
    }
    let mut course = Course::new(session, case, watch);
    match course.carry_out() {
        Ok(()) => Ok((Verdict::Pass, Failure::default())),
        Err(Stop::Verdict(verdict, failure)) => Ok((verdict, failure)),
        Err(Stop::Trouble(trouble)) => Err((trouble, course.number())),
    }
}

/// What the adapter lacks for a case. `[spec: CONF-3]`
fn unsupported(session: &Session, case: &Case) -> Option<String> {
    if !session.has_profile(case.profile) {
        return Some(format!("needs the profile {}", case.profile.name()));
    }
    if let Some(feature) = case.requires.iter().find(|feature| !session.has(**feature)) {
        return Some(format!("needs the feature {}", feature.name()));
    }
    let (needed, allowed) = (case.replicas.len(), session.hello.limits.replicas);
    if needed > allowed {
        return Some(format!("needs {needed} replicas; the adapter takes {allowed}"));
    }
    let long = case.steps.iter().filter_map(|step| match step {
        Step::Mutate { replica, mutations, .. } | Step::ExpectRefused { replica, mutations, .. } => {
            Some(Command::Mutate(Mutate { replica: replica.clone(), mutations: mutations.clone() }))
        }
        Step::Load { state, .. } | Step::ExpectUnloadable { state, .. } => {
            Some(Command::Load(Load { state: state.clone() }))
        }
        Step::Decode { bytes, .. } | Step::ExpectUndecodable { bytes, .. } => {
            Some(Command::Decode(Decode { bytes: bytes.clone() }))
        }
        _ => None,
    });
    let fits = std::iter::once(begin(case)).chain(long).all(|command| session.takes(&command));
    (!fits).then(|| format!("has a line of more than {} bytes", session.hello.limits.line_bytes))
}

fn begin(case: &Case) -> Command {
    Command::CaseBegin(CaseBegin {
        case: case.id.clone(),
        replicas: case.replicas.clone(),
        dictionary: case.dictionary.clone(),
    })
}
