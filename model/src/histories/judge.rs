//! Judgement: every delivered subset of a history's deltas, and every diamond in it. `[spec: CHECK-4]`
//!
//! The state of a set is computed by every last delivery: from each set with one delta less. If all agree,
//! on all sets, then every order of delivery agrees (each order is a path through these sets). In sets of at
//! most `replay_max` deltas, every delta is delivered once more and every part resynchronised with the whole.
//! A set that is part of many histories is judged once.

use super::symmetry::{DeltaSet, delta_set};
use super::{Histories, History};
use crate::semantics::{Breach, Semantics};
use crate::tables::{DeltaId, NONE, StateId};
use rustc_hash::{FxHashMap, FxHashSet};

/// What was judged, and the first fault.
#[derive(Debug, Default)]
pub(super) struct Judge {
    /// Sets judged, with their states; whether their images were judged as well.
    sets: FxHashMap<(DeltaSet, bool), StateId>,
    /// The least images of sets judged together with all their images.
    orbits: FxHashSet<DeltaSet>,
    delivered: u64,
    diamonds: u64,
}

/// A delivered set in which a clause does not hold.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Fault {
    /// The clause.
    pub breach: Breach,
    /// The deltas delivered, the last delivery last.
    pub delivered: Vec<DeltaId>,
    /// For a diamond: the same deltas in another order, which leads elsewhere.
    pub other_order: Option<Vec<DeltaId>>,
}

impl Fault {
    fn new(breach: Breach, before: &[DeltaId], last: Option<DeltaId>) -> Self {
        Self { breach, delivered: before.iter().copied().chain(last).collect(), other_order: None }
    }
}

/// A set without one of its deltas, and that delta.
fn without(set: &[DeltaId], at: usize) -> (Vec<DeltaId>, DeltaId) {
    let rest = set[..at].iter().chain(&set[at + 1..]).copied();
    (rest.collect(), set[at])
}

impl<S: Semantics> Histories<S> {
    /// Sets and diamonds judged so far.
    pub fn judged(&self) -> (u64, u64) {
        (self.judge.delivered, self.judge.diamonds)
    }

    /// Judges every delivered subset of the history's deltas.
    pub fn judge(&mut self, history: &History) -> Result<(), Fault> {
        let pool: Vec<DeltaId> = history.pool().collect();
        self.judge_pool(&pool, !history.concrete)
    }

    /// Judges every subset of some deltas.
    pub fn judge_set(&mut self, deltas: &[DeltaId]) -> Result<(), Fault> {
        self.judge_pool(deltas, false)
    }

    fn judge_pool(&mut self, pool: &[DeltaId], images: bool) -> Result<(), Fault> {
        if pool.is_empty() {
            return self.judge_state(self.initial, images).map_err(|breach| Fault::new(breach, &[], None));
        }
        let (first, _) = self.join_all(pool, images)?;
        self.judge.delivered += 1;
        let breach = self.judge_fresh(&first, images);
        breach.map_err(|breach| Fault::new(breach, pool, None))
    }

    /// The state of a set, the same by every last delivery.
    fn join_all(&mut self, set: &[DeltaId], images: bool) -> Result<(S::State, StateId), Fault> {
        let mut known: Option<(S::State, StateId, Vec<DeltaId>)> = None;
        for at in 0..set.len() {
            let (mut rest, last) = without(set, at);
            let before = self.state_of(&rest, images)?;
            let state = self.tables.state(before);
            let joined = self.semantics.join(&state, &self.tables.delta(last));
            self.judge.diamonds += 1;
            self.semantics
                .judge_delivery(&state, &joined)
                .map_err(|breach| Fault::new(breach, &rest, Some(last)))?;
            match &known {
                Some((first, _, order)) if *first != joined => {
                    rest.push(last);
                    let detail = "the same deltas in another order lead to another state";
                    let breach = Breach::new("JOIN-3", detail);
                    return Err(Fault { breach, delivered: order.clone(), other_order: Some(rest) });
                }
                Some(_) => {}
                None => {
                    rest.push(last);
                    known = Some((joined, before, rest));
                }
            }
        }
        // A set without deltas is the initial state, which its caller treats apart.
        let (state, before, _) = known.unwrap_or((self.semantics.initial(), self.initial, Vec::new()));
        Ok((state, before))
    }

    /// The state of a set smaller than a whole history, judged when it is first met.
    fn state_of(&mut self, set: &[DeltaId], images: bool) -> Result<StateId, Fault> {
        if set.is_empty() {
            return Ok(self.initial);
        }
        let key = (delta_set(set.iter().copied()), images);
        if let Some(&state) = self.judge.sets.get(&key) {
            return Ok(state);
        }
        let orbit = images.then(|| self.canonical_set(set));
        if orbit.is_some_and(|orbit| !self.judge.orbits.insert(orbit)) {
            // An image of this set was judged: here only its state is needed.
            let (last, rest) = set.split_last().unwrap_or((&NONE, &[]));
            let before = self.state_of(rest, images)?;
            let id = self.tables.join(&self.semantics, before, *last);
            self.judge.sets.insert(key, id);
            return Ok(id);
        }
        let (state, _) = self.join_all(set, images)?;
        let id = self.tables.intern(state);
        self.judge.delivered += 1;
        self.judge_state(id, images).map_err(|breach| Fault::new(breach, set, None))?;
        if set.len() <= self.replay_max {
            self.judge_again(id, set)?;
            self.judge_repair(id, set, images)?;
        }
        self.judge.sets.insert(key, id);
        Ok(id)
    }

    /// What was delivered changes nothing when it is delivered again.
    fn judge_again(&mut self, state: StateId, set: &[DeltaId]) -> Result<(), Fault> {
        for &delta in set {
            if self.tables.join(&self.semantics, state, delta) != state {
                let breach = Breach::new("JOIN-3", "a delta delivered twice is not the same as once");
                return Err(Fault::new(breach, set, Some(delta)));
            }
        }
        Ok(())
    }

    /// Resynchronisation brings either side of each pair (a set, the set without one delta) to their join.
    fn judge_repair(&mut self, state: StateId, set: &[DeltaId], images: bool) -> Result<(), Fault> {
        let whole = self.tables.state(state);
        for at in 0..set.len() {
            let (rest, _) = without(set, at);
            let part = self.state_of(&rest, images)?;
            let part = self.tables.state(part);
            for (ours, theirs) in [(&whole, &part), (&part, &whole)] {
                let (Some(delta), Some(joined)) =
                    (self.semantics.repair(ours, theirs), self.semantics.join_states(theirs, ours))
                else {
                    continue;
                };
                if self.semantics.join(theirs, &delta) != joined {
                    let breach = Breach::new("SYNC-3", "resynchronisation does not lead to the join of both");
                    return Err(Fault::new(breach, &rest, Some(set[at])));
                }
            }
        }
        Ok(())
    }

    fn judge_state(&mut self, id: StateId, images: bool) -> Result<(), Breach> {
        let state = self.tables.state(id);
        self.judge_fresh(&state, images)
    }

    /// Judges a state, and its images where they are not judged by symmetry.
    fn judge_fresh(&mut self, state: &S::State, images: bool) -> Result<(), Breach> {
        let judged = self.tables.judge(&self.semantics, state)?;
        if images && judged.order_sensitive {
            for permutation in 1..self.permutations.len() {
                let image = self.semantics.rename_state(state, self.permutations.get(permutation));
                self.tables.judge(&self.semantics, &image)?;
            }
        }
        Ok(())
    }

    /// Whether a longer history exists: what is delivered here is then judged as part of that one.
    pub fn is_extended(&mut self, history: &History) -> bool {
        (0..self.bound.replicas).any(|replica| {
            let last = history.last[replica];
            // A faulty step is a fault, not an end: the search is about to meet it.
            last != NONE
                && self.tables.moves(&self.semantics, last, replica).map_or(true, |moves| !moves.is_empty())
        })
    }
}
