//! A course: what replicas do and what the network does, in order, for any semantics. It says nothing of
//! outcomes; whoever runs it sees them. `[spec: CHECK-13]`
//!
//! | room | what |
//! |---|---|
//! | `runner` | carries out a course, event by event; refuses what cannot happen |
//! | `judge` | the same, and judges each event as L2 does |

mod judge;
mod runner;
#[cfg(test)]
mod tests;

pub use judge::{Broken, Judge, Moment, Outcome, Stop, judge_mutations, run};
pub use runner::{Local, Message, Runner, StepError, Stepped};

/// A course of events among replicas that all start alike.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Course<M> {
    /// The replicas' names; an event means a replica by its position here.
    pub replicas: Vec<String>,
    /// What happens, in order.
    pub events: Vec<Event<M>>,
}

/// One thing that happens. Messages are numbered from 0 in the order in which they are sent, by mutations
/// and by answers.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Event<M> {
    /// A replica makes mutations one after the other and broadcasts them as one message.
    Mutate {
        /// Who.
        replica: usize,
        /// What; mostly one.
        mutations: Vec<M>,
    },
    /// A message arrives.
    Deliver {
        /// To whom.
        replica: usize,
        /// Which.
        message: usize,
    },
    /// A message will never arrive.
    Lose {
        /// To whom.
        replica: usize,
        /// Which.
        message: usize,
    },
    /// A replica stops and starts again under its next incarnation.
    Restart {
        /// Who.
        replica: usize,
        /// Whether it still has its state; else it starts from what all started from.
        keeps: bool,
    },
    /// A replica sends what another, by its digest, is missing. `[spec: SYNC-3]`
    Answer {
        /// Who sends.
        replica: usize,
        /// Whom it answers.
        to: usize,
    },
}

impl<M> Course<M> {
    /// Replicas `r1`, `r2`, … to whom nothing has happened.
    pub fn among(replicas: usize) -> Self {
        Self { replicas: (1..=replicas).map(|number| format!("r{number}")).collect(), events: Vec::new() }
    }

    /// How many mutations are made, those of groups one by one.
    pub fn mutations(&self) -> usize {
        let made = self.events.iter().map(|event| match event {
            Event::Mutate { mutations, .. } => mutations.len(),
            _ => 0,
        });
        made.sum()
    }
}

impl<M> Event<M> {
    /// Who acts.
    pub const fn replica(&self) -> usize {
        match self {
            Self::Mutate { replica, .. }
            | Self::Deliver { replica, .. }
            | Self::Lose { replica, .. }
            | Self::Restart { replica, .. }
            | Self::Answer { replica, .. } => *replica,
        }
    }

    /// Whether a message is sent.
    pub const fn sends(&self) -> bool {
        matches!(self, Self::Mutate { .. } | Self::Answer { .. })
    }
}
