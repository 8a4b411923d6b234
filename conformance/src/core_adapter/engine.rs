//! What an implementation on the core's states does with them.

use dsr_core::{Author, Delta, Mutation, ReplicaId, Shows, State, View, delta_for, digest};
use std::fmt::Debug;

/// Why a mutation is refused.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Refusal {
    /// In words.
    pub message: String,
    /// The error's name, if it has one. `[spec: CONF-8]`
    pub kind: Option<String>,
}

/// What becomes of states. Everything is as in the core unless it is overridden.
pub trait Engine: Debug {
    /// The most replicas of a case.
    const REPLICAS_MAX: usize = 64;

    /// Its name.
    fn name(&self) -> String;

    /// The identity of the replica at a place of the case, counted from 0. `[spec: CRASH-2]`
    fn identity(&self, place: u32, incarnation: u32) -> ReplicaId {
        ReplicaId { agent: place.saturating_add(1), incarnation }
    }

    /// The delta of a mutation, and the author's state after it.
    fn mutate(
        &self,
        before: &View<'_>,
        author: Author,
        mutation: &Mutation,
    ) -> Result<(Delta, State), Refusal> {
        let made = mutation.delta(before, author);
        let delta = made.map_err(|error| Refusal { message: error.to_string(), kind: Some(error.kind()) })?;
        let mut after = before.state().clone();
        after.join(&delta);
        Ok((delta, after))
    }

    /// A delta arrives at a state, or joins another one.
    fn join(&self, state: &mut State, delta: &Delta) {
        state.join(delta);
    }

    /// What `theirs` lacks of `ours`.
    fn answer(&self, ours: &State, theirs: &State) -> Delta {
        delta_for(ours, &digest(theirs))
    }

    /// Hands over what the replica at a place shows of its state.
    fn show<T>(&self, view: &View<'_>, place: u32, to: &mut dyn FnMut(&dyn Shows) -> T) -> T {
        let _ = place;
        to(view)
    }
}

/// The core as it ships.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plain;

impl Engine for Plain {
    fn name(&self) -> String {
        "dsr-core".into()
    }
}
