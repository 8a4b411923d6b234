//! A core broken on purpose, as an engine.

use crate::adapter::{Engine, Refusal};
use dsr_core::{Author, Delta, Mutation, ReplicaId, Shows, State, View};
use dsr_model::alarms::{Alarm, Flaw};
use dsr_model::checked::{INCARNATION, replica_id};

/// The core with the flaw of an alarm.
#[derive(Clone, Debug)]
pub struct Flawed(pub Alarm);

impl Flawed {
    fn flaw(&self) -> &dyn Flaw {
        self.0.flaw()
    }
}

impl Engine for Flawed {
    /// The checker numbers the incarnations of as many.
    const REPLICAS_MAX: usize = INCARNATION;

    fn name(&self) -> String {
        format!("dsr-core, {}", self.0.name)
    }

    fn identity(&self, place: u32, incarnation: u32) -> ReplicaId {
        let number = |count| usize::try_from(count).unwrap_or(usize::MAX);
        let index = number(incarnation).saturating_mul(INCARNATION).saturating_add(number(place));
        replica_id(self.flaw().identity(index))
    }

    fn mutate(
        &self,
        before: &View<'_>,
        author: Author,
        mutation: &Mutation,
    ) -> Result<(Delta, State), Refusal> {
        let Some(delta) = self.flaw().delta(before, author, mutation) else {
            let (message, kind) = match mutation.delta(before, author) {
                Err(error) => (error.to_string(), Some(error.kind())),
                Ok(_) => ("refused by the flaw".into(), None),
            };
            return Err(Refusal { message, kind });
        };
        let after = self.flaw().after(before, author, mutation, &delta);
        Ok((delta, after))
    }

    fn join(&self, state: &mut State, delta: &Delta) {
        *state = self.flaw().close(self.flaw().merge(state, delta));
    }

    fn answer(&self, ours: &State, theirs: &State) -> Delta {
        self.flaw().repair(ours, theirs)
    }

    fn show<T>(&self, view: &View<'_>, place: u32, to: &mut dyn FnMut(&dyn Shows) -> T) -> T {
        to(&self.flaw().show(view, usize::try_from(place).unwrap_or(usize::MAX)))
    }
}
