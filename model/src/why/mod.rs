//! Why a replica shows a thing as it does: which dot supports it, who wrote that, which messages brought it, what
//! it beat, and by which clause. `[spec: TRACE-7]`
//!
//! | room | what |
//! |---|---|
//! | `target` | the element or attribute that is asked about, by id or by name |
//! | `tell` | the answer, whatever the semantics |

mod target;
mod tell;

pub use target::{Target, TargetError};
pub use tell::{Claim, Ended, Fate, Standing, Why};

use crate::alarms;
use crate::gallery;
use crate::replay::{self, Replay, ReplayError};
use crate::semantics::Semantics;
use crate::trace::Trace;
use crate::twin;
use tell::{Evidence, tell};

/// Why there is no answer. Steps count from 1.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum WhyError {
    /// The trace does not happen again.
    #[error("the trace does not happen again: {0}")]
    Replay(#[from] ReplayError),
    /// There is no such step.
    #[error("there is no step {step}: the trace has {steps}; 0 is the start")]
    NoStep {
        /// Which.
        step: usize,
        /// How many there are.
        steps: usize,
    },
    /// There is no such replica.
    #[error("no replica is named {name:?}: there are {known}")]
    NoReplica {
        /// The name.
        name: String,
        /// Those that there are.
        known: String,
    },
    /// There is no such element.
    #[error(transparent)]
    Target(#[from] TargetError),
    /// Nobody has ever said anything about it.
    #[error("nobody has said anything about {what} up to step {step}")]
    Nothing {
        /// The element or attribute.
        what: String,
        /// The step.
        step: usize,
    },
}

/// Why replica `replica` shows `element` as it does after step `step` of a trace; step 0 is the start.
/// `[spec: TRACE-7]`
pub fn why(trace: &Trace, step: usize, replica: &str, element: &str) -> Result<Why, WhyError> {
    trace.check().map_err(ReplayError::from)?;
    if step > trace.steps.len() {
        return Err(WhyError::NoStep { step, steps: trace.steps.len() });
    }
    let Some(at) = trace.replicas.iter().position(|known| known.name == replica) else {
        let known: Vec<&str> = trace.replicas.iter().map(|known| &*known.name).collect();
        return Err(WhyError::NoReplica { name: replica.into(), known: known.join(", ") });
    };
    let target = Target::find(trace, element)?;
    let name = &*trace.semantics;
    if gallery::is_published(trace) {
        return of_gallery(trace, step, at, &target);
    }
    if name.starts_with("published") {
        return why_with(&replay::published_suite(trace)?, trace, step, at, &target);
    }
    // What a replica of either kind holds and shows is told by the reference.
    let is_replica = [twin::ALONE, twin::BESIDE].contains(&name)
        || alarms::of_replicas().iter().any(|alarm| alarm.name == name);
    if name == "checked" || is_replica {
        return why_with(&replay::checked(trace)?, trace, step, at, &target);
    }
    match alarms::all().into_iter().find(|alarm| alarm.name == name) {
        Some(alarm) => why_with(&alarm.on(replay::checked(trace)?), trace, step, at, &target),
        None => Err(ReplayError::NoSemantics { name: name.into() }.into()),
    }
}

/// The same for any semantics that can tell claims apart.
pub fn why_with<S: Semantics>(
    semantics: &S,
    trace: &Trace,
    step: usize,
    replica: usize,
    target: &Target,
) -> Result<Why, WhyError> {
    let mut run = Replay::start(semantics, trace)?;
    let mut held = vec![semantics.claims_held(&run.recorder.states()[replica], target)];
    for _ in 0..step {
        run.step()?;
        held.push(semantics.claims_held(&run.recorder.states()[replica], target));
    }
    let state = &run.recorder.states()[replica];
    let sent = run.recorder.runner().messages();
    let claims = |delta: &S::Delta| semantics.claims(delta, target);
    let messages: Vec<Vec<Claim>> =
        sent.iter().map(|message| message.deltas.iter().flat_map(claims).collect()).collect();
    let ends = |message: usize, claim: &Claim| {
        let deltas = sent.get(message).map(|message| &message.deltas);
        deltas.is_some_and(|deltas| deltas.iter().any(|delta| semantics.ends(delta, target, claim)))
    };
    let standing = |claim: &Claim| semantics.standing(state, target, claim);
    tell(trace, step, replica, target, Evidence { held, messages, ends: &ends, standing: &standing })
}

fn of_gallery(trace: &Trace, step: usize, replica: usize, target: &Target) -> Result<Why, WhyError> {
    let mut run = replay::PublishedReplay::start(trace)?;
    let mut held = vec![run.replica(replica).claims_held(target)];
    for _ in 0..step {
        run.step()?;
        held.push(run.replica(replica).claims_held(target));
    }
    let messages: Vec<Vec<Claim>> = run.messages().map(|message| message.claims(target)).collect();
    let sent: Vec<_> = run.messages().collect();
    let ends = |message: usize, claim: &Claim| sent.get(message).is_some_and(|sent| sent.ends(target, claim));
    let holder = run.replica(replica);
    let standing = |claim: &Claim| holder.standing(target, claim);
    tell(trace, step, replica, target, Evidence { held, messages, ends: &ends, standing: &standing })
}
