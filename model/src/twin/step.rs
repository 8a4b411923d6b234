//! One mutation tried on a replica. `[property: REPLICA-1]`

use super::{Fast, Held, Twin, compare};
use crate::checked::{Act, replica_id};
use crate::semantics::Step;
use dsr_core::{Author, View};
use std::sync::Arc;

impl<F: Fast> Twin<F> {
    /// A step beside the reference. Where both refuse it alike there is none; where they differ, the state after
    /// it says how.
    pub(super) fn step(held: &Held<F>, before: &View<'_>, replica: usize, act: &Act) -> Option<Step<Self>> {
        let author = Author::new(replica_id(replica));
        let expected = act.0.delta(before, author);
        let mut replica = held.replica.for_author(author.replica);
        let found = replica.mutate(&act.0);
        let mut fault = compare::made(&found, &expected).err();
        if fault.is_none() && found.is_err() {
            fault = compare::shown("REPLICA-1", &replica, before).err();
            fault.as_ref()?;
        }
        let told = found.as_ref().map(|made| Arc::new(made.changes.clone())).ok();
        let delta = expected.ok().or_else(|| Some(found.ok()?.delta)).unwrap_or_default();
        let fault = held.fault.clone().or_else(|| fault.map(Arc::new));
        let after = Held { replica, state: held.state.joined(&delta), fault, told };
        Some(Step { delta, after })
    }

    pub(super) fn step_alone(held: &Held<F>, replica: usize, act: &Act) -> Option<Step<Self>> {
        let mut replica = held.replica.for_author(replica_id(replica));
        let made = replica.mutate(&act.0).ok()?;
        Some(Step { delta: made.delta, after: Held::alone(replica) })
    }
}
