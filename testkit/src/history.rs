//! Histories: what replicas and network do, step by step, as data that shrinks.

use dsr_core::{Mutation, MutationKind};
use proptest::collection::vec;
use proptest::prelude::*;

/// One step. Numbers are taken modulo what there is, so that every history can be run.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Step {
    /// A replica mutates.
    Mutate {
        /// Which replica.
        replica: usize,
        /// By which of the six mutations.
        kind: MutationKind,
        /// Which of those enabled.
        choice: usize,
    },
    /// A replica tries a mutation of what is there, allowed or not.
    Attempt {
        /// Which replica.
        replica: usize,
        /// By which of the six mutations.
        kind: MutationKind,
        /// Which of all candidates.
        choice: usize,
    },
    /// A replica tries a mutation with whatever arguments; most are refused.
    Try {
        /// Which replica.
        replica: usize,
        /// What it tries.
        mutation: Box<Mutation>,
    },
    /// A replica gets one of the deltas sent so far: late, early, or again.
    Deliver {
        /// Which delta.
        delta: usize,
        /// Which replica.
        to: usize,
    },
    /// A replica answers another's digest.
    Resynchronise {
        /// Who answers.
        from: usize,
        /// Whose digest it was.
        to: usize,
    },
    /// A replica gets several of the deltas sent so far, joined into one.
    Group {
        /// Which deltas.
        deltas: Vec<usize>,
        /// Which replica.
        to: usize,
    },
    /// A replica stops and goes on as its next incarnation. `[spec: CRASH-2]`
    Restart {
        /// Which replica.
        replica: usize,
        /// Whether with its state; else with nothing.
        keeps: bool,
    },
}

/// Steps of some replicas.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct History {
    /// How many replicas there are.
    pub replicas: usize,
    /// What happens.
    pub steps: Vec<Step>,
}

/// One step of `replicas` replicas: additions more often than the rest, or nothing would be there to change.
pub fn step(replicas: usize) -> impl Strategy<Value = Step> {
    let kind = prop_oneof![3 => Just(MutationKind::AddVertex), 5 => prop::sample::select(MutationKind::ALL.to_vec())];
    prop_oneof![
        5 => (0..replicas, kind, 0..1000_usize)
            .prop_map(|(replica, kind, choice)| Step::Mutate { replica, kind, choice }),
        5 => (0..1000_usize, 0..replicas).prop_map(|(delta, to)| Step::Deliver { delta, to }),
        1 => (0..replicas, 0..replicas).prop_map(|(from, to)| Step::Resynchronise { from, to }),
    ]
}

/// The same, and now and then deltas that arrive as one, and a restart.
pub fn any_step(replicas: usize) -> impl Strategy<Value = Step> {
    let group = (vec(0..1000_usize, 1..4), 0..replicas).prop_map(|(deltas, to)| Step::Group { deltas, to });
    let restart = (0..replicas, any::<bool>()).prop_map(|(replica, keeps)| Step::Restart { replica, keeps });
    prop_oneof![20 => step(replicas), 2 => group, 1 => restart]
}

/// Histories of two to `replicas_max` replicas.
pub fn histories(replicas_max: usize, steps_max: usize) -> impl Strategy<Value = History> {
    (2..=replicas_max.max(2), vec(step(replicas_max), 0..=steps_max))
        .prop_map(|(replicas, steps)| History { replicas, steps })
}

impl History {
    /// Runs the history, and calls `check` after every step.
    pub fn run<E>(
        &self,
        world: &mut crate::World,
        mut check: impl FnMut(&crate::World, &Step) -> Result<(), E>,
    ) -> Result<(), E> {
        self.steps.iter().try_for_each(|step| {
            world.step(step);
            check(world, step)
        })
    }
}
