//! The trace of a course that was run.

use super::{CannotHappen, Finding, FindingKind, Recorder, Trace};
use crate::course::{Course, Moment, Outcome};
use crate::semantics::{Clause, Semantics};

/// The trace of a course up to the event that breaks a clause, and if it is the moment after the last, until it
/// has come to rest.
pub fn of_course<S: Semantics>(
    semantics: &S,
    course: &Course<S::Mutation>,
    outcome: &Outcome,
    clauses: &[Clause],
    (layer, bound): (&str, String),
) -> Result<Trace, CannotHappen> {
    let mut recorder = Recorder::new(semantics, course.replicas.iter().cloned());
    let broken = match outcome {
        Outcome::Broken(broken) => Some(broken),
        Outcome::Held | Outcome::Invalid { .. } => None,
    };
    let events = match broken.map(|broken| broken.at) {
        Some(Moment::Start) => 0,
        Some(Moment::Event(last)) => last + 1,
        Some(Moment::End) | None => course.events.len(),
    };
    for event in course.events.iter().take(events) {
        recorder.record(event)?;
    }
    let by = match broken {
        Some(broken) if broken.at == Moment::End => recorder.come_to_rest()?,
        Some(broken) => broken.replica.into_iter().collect(),
        None => Vec::new(),
    };
    let by = recorder.scribe().names(by);
    let finding = match broken {
        Some(broken) => Finding::broken(clauses, &broken.breach, by),
        None => Finding {
            kind: FindingKind::Holds,
            clause: String::new(),
            what: String::new(),
            detail: outcome.to_string(),
            replicas: by,
        },
    };
    let title = format!("{} is broken: {}", finding.clause, finding.what);
    Ok(recorder.finish(title, layer, bound, finding))
}
