//! L2: schedules. Every order in which a network may lose, repeat and reorder messages, with restarts and
//! resynchronisation, at small bounds. `[spec: CHECK-6]`
//!
//! The layer above explores histories and argues that no schedule can do anything that they do not show
//! (see [`histories`](crate::histories)). This layer makes no such argument: it explores the schedules
//! themselves, and [`check_reduction`] compares what both reached.
//!
//! | room | what |
//! |---|---|
//! | `state` | a moment of all replicas and of the network, and what may happen next |
//! | `space` | successors and judgement, whatever the engine |
//! | `run` | a run and its report |
//! | `reduction` | histories against schedules |
//! | `restricted` | a semantics with a few concrete mutations only |

mod reduction;
mod restricted;
mod run;
mod space;
mod state;
mod trace;

pub use reduction::{Reduction, ReductionFault, check_reduction};
pub use restricted::Restricted;
pub use run::ScheduleRun;
pub use space::{ScheduleFault, Schedules};
pub use state::{Event, Message, Schedule};

use std::fmt;

/// How far a run of schedules goes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ScheduleBound {
    /// Replicas that mutate; with the readers at most [`REPLICAS_MAX`](crate::histories::REPLICAS_MAX).
    pub replicas: usize,
    /// Replicas that only receive.
    pub readers: usize,
    /// Mutations of each replica, at most [`MUTATIONS_MAX`](crate::histories::MUTATIONS_MAX).
    pub mutations: usize,
    /// Restarts, of all replicas together. Each takes a fresh incarnation; it keeps the state or loses it.
    pub restarts: u8,
    /// Resynchronisations, of all replicas together, at most [`RESYNCHRONISATIONS_MAX`].
    pub resynchronisations: u8,
}

/// The most resynchronisations of a run.
pub const RESYNCHRONISATIONS_MAX: usize = 2;

impl ScheduleBound {
    /// Everybody who receives.
    pub fn everybody(&self) -> usize {
        self.replicas + self.readers
    }
}

/// As in `2 replicas × 1 mutation, 1 restart, 1 resynchronisation`.
impl fmt::Display for ScheduleBound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { replicas, readers, mutations, restarts, resynchronisations } = self;
        write!(f, "{replicas} replicas × {mutations} mutations")?;
        let more = [
            (*readers, "readers"),
            ((*restarts).into(), "restarts"),
            ((*resynchronisations).into(), "resynchronisations"),
        ];
        more.iter()
            .filter(|(count, _)| *count > 0)
            .try_for_each(|(count, what)| write!(f, ", {count} {what}"))
    }
}
