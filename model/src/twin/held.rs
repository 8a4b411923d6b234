//! A replica's state in the search: the fast replica, and the state that it is to hold.

use super::Fast;
use crate::semantics::Breach;
use dsr_core::{Changes, State};
use std::cmp::Ordering;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

/// Equal where the states are: how a replica came to hold what it holds must not be seen. Where it has been
/// seen, the breach is part of it, so that it is not taken for a sound one.
#[derive(Clone, Debug)]
pub struct Held<F> {
    pub(super) replica: F,
    /// By the reference where there is one, else the replica's own.
    pub(super) state: State,
    pub(super) fault: Option<Arc<Breach>>,
    /// What the replica has told of the mutation that led here, until that is judged.
    pub(super) told: Option<Arc<Changes>>,
}

impl<F: Fast> Held<F> {
    /// What a replica holds, by itself.
    pub(super) fn alone(replica: F) -> Self {
        let state = replica.graph().state();
        Self { replica, state, fault: None, told: None }
    }

    /// The state as one of the core.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The fast replica.
    pub fn replica(&self) -> &F {
        &self.replica
    }

    /// Why the replica is none, if one has differed from the reference on the way here.
    pub(super) fn check(&self) -> Result<(), Breach> {
        self.fault.as_ref().map_or(Ok(()), |fault| Err(Breach::clone(fault)))
    }

    fn identity(&self) -> (&State, Option<&Breach>) {
        (&self.state, self.fault.as_deref())
    }
}

impl<F: Fast> PartialEq for Held<F> {
    fn eq(&self, other: &Self) -> bool {
        self.identity() == other.identity()
    }
}

impl<F: Fast> Eq for Held<F> {}

impl<F: Fast> PartialOrd for Held<F> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<F: Fast> Ord for Held<F> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.identity().cmp(&other.identity())
    }
}

impl<F: Fast> Hash for Held<F> {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        self.identity().hash(hasher);
    }
}
