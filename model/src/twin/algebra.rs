//! The states of L0 with their replicas. `[spec: CHECK-2]`

use super::{Fast, Held, Twin};
use crate::algebra::{Algebra, Family, core_universe};
use dsr_core::{Delta, State};

/// A replica joins and closes at once: the laws of merge and of closure by themselves are those of the reference.
impl<F: Fast> Algebra for Twin<F> {
    fn universe(&self, records: usize) -> Vec<Family<Held<F>>> {
        let families = core_universe(records).into_iter();
        families
            .map(|Family { name, records, all, closed }| {
                let of = |(at, state)| {
                    if closed.binary_search(&at).is_ok() {
                        self.replica_of(&state)
                    } else {
                        self.without_replica(state)
                    }
                };
                let all = all.into_iter().enumerate().map(of).collect();
                Family { name, records, all, closed }
            })
            .collect()
    }

    fn body<'s>(&self, held: &'s Held<F>) -> Option<&'s State> {
        Some(&held.state)
    }

    fn delta_body<'d>(&self, delta: &'d Delta) -> Option<&'d State> {
        Some(delta)
    }

    fn merge(&self, left: &Held<F>, right: &Held<F>) -> Option<Held<F>> {
        self.core.merge(&left.state, &right.state).map(|state| self.without_replica(state))
    }

    fn close(&self, held: &Held<F>) -> Option<Held<F>> {
        self.core.close(&held.state).map(|state| self.without_replica(state))
    }
}
