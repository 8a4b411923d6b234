//! Replay: a trace is run again, step by step, by the semantics that it names; whatever differs is told.
//! `[spec: TRACE-6]`
//!
//! | room | what |
//! |---|---|
//! | `steps` | any semantics: its [`Recorder`](crate::trace::Recorder) writes the same steps again |
//! | `ends` | what is broken after the last step |
//! | `published` | schedules of the gallery |
//! | `difference` | where two steps differ |

mod difference;
mod ends;
mod published;
mod steps;

pub use difference::Difference;
pub use ends::{
    ALL_DELIVERED, ALL_RESYNCHRONISED, ANOTHER_ORDER, Ends, NOT_THE_JOIN, Shown, TWICE, all_delivered,
    another_order,
};
pub(crate) use published::PublishedReplay;
pub(crate) use steps::Replay;
pub use steps::replay_with;

use crate::alarms;
use crate::checked::Checked;
use crate::checked::alphabet::Alphabet;
use crate::gallery;
use crate::published::suite::Published;
use crate::semantics::Semantics;
use crate::trace::{CannotHappen, Trace, Unsound};
use crate::twin::{self, Twin};

/// Why a trace does not happen again as it is written. Steps count from 1.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum ReplayError {
    /// It cannot be a trace.
    #[error(transparent)]
    Unsound(#[from] Unsound),
    /// Nobody here knows the semantics.
    #[error("no semantics is named {name:?} here")]
    NoSemantics {
        /// Its name.
        name: String,
    },
    /// The setup is not one of that semantics.
    #[error("the setup is none of {semantics:?}: {why}")]
    Setup {
        /// The semantics.
        semantics: String,
        /// What is wrong.
        why: String,
    },
    /// A replica starts otherwise.
    #[error("{replica} starts otherwise: {difference}")]
    Start {
        /// Who.
        replica: String,
        /// Where the first difference is.
        difference: Difference,
    },
    /// A step cannot happen.
    #[error("step {step} cannot happen: {why}")]
    Impossible {
        /// Which step.
        step: usize,
        /// Why.
        why: CannotHappen,
    },
    /// A step of a schedule is none of those that can happen.
    #[error("step {step} cannot happen: {replica} cannot do that now; what can happen is {possible}")]
    Unscheduled {
        /// Which step.
        step: usize,
        /// Who.
        replica: String,
        /// What can happen.
        possible: String,
    },
    /// A step comes out otherwise.
    #[error("step {step} of {replica} comes out otherwise: {difference}")]
    Step {
        /// Which step.
        step: usize,
        /// Who.
        replica: String,
        /// Where the first difference is.
        difference: Difference,
    },
    /// Something else is found at the end.
    #[error("after the last step {expected} is to be found, but {found}")]
    Finding {
        /// What the trace says.
        expected: String,
        /// What is so.
        found: String,
    },
}

/// What a replay has shown.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Replayed {
    /// How many steps came out as they are written.
    pub steps: usize,
    /// Whether what the trace finds was judged again; else why not.
    pub judged: Result<(), &'static str>,
}

/// Runs a trace again by the semantics that it names. `[spec: TRACE-6]`
pub fn replay(trace: &Trace) -> Result<Replayed, ReplayError> {
    trace.check_names()?;
    let name = &*trace.semantics;
    if gallery::is_published(trace) {
        return published::replay(trace);
    }
    if name.starts_with("published") {
        return replay_with(&published_suite(trace)?, trace);
    }
    if name == "checked" {
        return replay_with(&checked(trace)?, trace);
    }
    if let Some(alarm) = alarms::all().into_iter().find(|alarm| alarm.name == name) {
        return replay_with(&alarm.on(checked(trace)?), trace);
    }
    if name == twin::ALONE {
        return replay_with(&Twin::alone(checked(trace)?), trace);
    }
    if name == twin::BESIDE {
        return replay_with(&Twin::beside(checked(trace)?), trace);
    }
    if let Some(alarm) = alarms::of_replicas().into_iter().find(|alarm| alarm.name == name) {
        return alarm.replay(checked(trace)?, trace);
    }
    Err(ReplayError::NoSemantics { name: name.into() })
}

/// The published semantics with the setup of a trace.
pub(crate) fn published_suite(trace: &Trace) -> Result<Published, ReplayError> {
    let found = Published::of_setup(&trace.setup).filter(|found| found.name() == trace.semantics);
    found.ok_or_else(|| ReplayError::Setup {
        semantics: trace.semantics.clone(),
        why: "it names no variant of it".into(),
    })
}

/// The core with the setup of a trace.
pub(crate) fn checked(trace: &Trace) -> Result<Checked, ReplayError> {
    let wrong = |why: String| ReplayError::Setup { semantics: trace.semantics.clone(), why };
    let part = |key: &str| trace.setup.get(key).ok_or_else(|| wrong(format!("it has no `{key}`")));
    let dictionary = serde_json::from_value(part("dictionary")?.clone());
    let initial = serde_json::from_value(part("initial")?.clone());
    Ok(Checked {
        dictionary: dictionary.map_err(|error| wrong(format!("dictionary: {error}")))?,
        initial: initial.map_err(|error| wrong(format!("initial: {error}")))?,
        alphabet: Alphabet::of(&[], Vec::new()),
    })
}
