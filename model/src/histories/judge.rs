//! Judgement: every delivered subset of a history's deltas, and every diamond in it. `[spec: CHECK-4]`
//!
//! The state of a set is computed by every last delivery: from each set with one delta less. If all agree,
//! on all sets, then every order of delivery agrees (each order is a path through these sets). In sets of at
//! most [`REPLAY_MAX`] deltas, every delta is delivered once more and every part resynchronised with the whole.
//!
//! Sets of one shape are judged once; which order deltas arrive in is tried on the deltas out of time, since
//! joining looks at no stamp. Both are assumptions about the semantics, and are tried again on a sample of
//! the sets that they save. `[spec: CHECK-11]`

use super::known::{Entry, Known, Unlike};
use super::shapes::Grain;
use super::{FoundFault, Histories, History, SAMPLE, TRIED_FIRST};
use crate::replay::{NOT_THE_JOIN, TWICE, another_order};
use crate::semantics::{Breach, Delivery, Judged, Semantics};
use crate::tables::DeltaId;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// Duplicates and resynchronisation are judged in every set of at most this many deltas; of larger sets L0 and
/// L2 judge them.
const REPLAY_MAX: usize = 2;

/// What was judged.
#[derive(Debug)]
pub(super) struct Judge<S: Semantics> {
    known: Known,
    /// Of so many shapes one is in the sample: a power of two.
    pub(super) sample: u64,
    /// The states of sets out of time.
    states: FxHashMap<Box<[DeltaId]>, Arc<S::State>>,
    pub(super) diamonds: u64,
    /// Sets saved by their shape, and judged all the same.
    pub(super) sampled: u64,
    /// Delivered subsets of all histories.
    pub(super) subsets: u64,
}

impl<S: Semantics> Default for Judge<S> {
    fn default() -> Self {
        Self {
            known: Known::default(),
            sample: SAMPLE,
            states: FxHashMap::default(),
            diamonds: 0,
            sampled: 0,
            subsets: 0,
        }
    }
}

impl<S: Semantics> Judge<S> {
    /// Whether what a shape saves is tried all the same. The sample is taken by a hash of the shape, so that
    /// it favours none.
    pub(super) fn is_tried(&self, shape: &[u32]) -> bool {
        let mix = |hash: u64, &word: &u32| {
            (hash ^ u64::from(word)).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29)
        };
        self.sampled < TRIED_FIRST || shape.iter().fold(0, mix) & (self.sample - 1) == 0
    }
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
    /// For a resynchronisation: what had been delivered to the one who is answered.
    pub answered: Option<Vec<DeltaId>>,
}

impl Fault {
    pub(super) fn new(breach: Breach, before: &[DeltaId], last: Option<DeltaId>) -> Self {
        let delivered = before.iter().copied().chain(last).collect();
        Self { breach, delivered, other_order: None, answered: None }
    }
}

/// A set without one of its deltas, and that delta.
fn without(set: &[DeltaId], at: usize) -> (Vec<DeltaId>, DeltaId) {
    let rest = set[..at].iter().chain(&set[at + 1..]).copied();
    (rest.collect(), set[at])
}

impl<S: Semantics> Histories<S> {
    /// Judges every delivered subset of the history's deltas, and where it stands for its images and renaming
    /// replicas can matter, theirs.
    pub fn judge(&mut self, history: &History) -> Result<(), Fault> {
        let pool: Vec<DeltaId> = history.pool().collect();
        self.judge.subsets += 1 << pool.len();
        if self.judge_with_parts(&pool)? > Grain::Outline && !history.concrete {
            for permutation in 1..self.permutations.len() {
                let image = self.rename_set(&pool, permutation);
                self.judge_with_parts(&image)?;
            }
        }
        Ok(())
    }

    /// Judges every subset of some deltas.
    pub fn judge_set(&mut self, deltas: &[DeltaId]) -> Result<(), Fault> {
        self.judge_with_parts(deltas).map(|_| ())
    }

    /// Judges every subset of some deltas; returns the grain that tells them all.
    fn judge_with_parts(&mut self, set: &[DeltaId]) -> Result<Grain, Fault> {
        if let Some(grain) = self.known(set, |entry| entry.with_parts) {
            self.judge_sample(set, grain)?;
            return Ok(grain);
        }
        let mut parts = Grain::Outline;
        for at in 0..set.len() {
            parts = parts.max(self.judge_with_parts(&without(set, at).0)?);
        }
        let alone = match self.known(set, |entry| entry.alone) {
            Some(grain) => grain,
            None => self.judge_alone(set)?,
        };
        self.remember(set, Entry { alone, with_parts: parts.max(alone) })
    }

    /// At which grain something is known of a set, if it is.
    fn known(&mut self, set: &[DeltaId], what: impl Fn(Entry) -> Grain) -> Option<Grain> {
        let mut at = Grain::Outline;
        loop {
            let shape = self.shapes.of(&*self.semantics, &mut self.tables, set, at);
            let known = what(self.judge.known.at(shape)?);
            if known <= at {
                return Some(known);
            }
            at = known;
        }
    }

    fn remember(&mut self, set: &[DeltaId], entry: Entry) -> Result<Grain, Fault> {
        for at in Grain::ALL.into_iter().filter(|&at| at <= entry.with_parts) {
            let shape = self.shapes.of(&*self.semantics, &mut self.tables, set, at);
            let next = at.finer();
            let entry = Entry { alone: entry.alone.min(next), with_parts: entry.with_parts.min(next) };
            self.judge.known.insert(shape, entry).map_err(|Unlike| Fault::new(unlike(), set, None))?;
        }
        Ok(entry.with_parts)
    }

    /// Judges one set, but for its parts; returns the grain that tells it.
    fn judge_alone(&mut self, set: &[DeltaId]) -> Result<Grain, Fault> {
        let outline = self.shapes.of(&*self.semantics, &mut self.tables, set, Grain::Outline);
        if self.judge.known.at(outline).is_none() {
            let timeless = self.shapes.timeless(&*self.semantics, &mut self.tables, set);
            self.state_of(&timeless).map_err(|fault| self.in_time(set, fault))?;
        }
        let state = self.deliver(set);
        let judged = self.tables.judge(&self.semantics, &state);
        let judged = judged.map_err(|breach| Fault::new(breach, set, None))?;
        if set.len() <= REPLAY_MAX {
            if self.semantics.delivery() == Delivery::Any {
                self.judge_again(&state, set)?;
            }
            self.judge_repair(&state, set)?;
        }
        Ok(grain_of(judged))
    }

    /// The state after some deliveries, in order.
    fn deliver(&self, order: &[DeltaId]) -> S::State {
        let deltas: Vec<Arc<S::Delta>> = order.iter().map(|&delta| self.tables.delta(delta)).collect();
        let deltas: Vec<&S::Delta> = deltas.iter().map(|delta| &**delta).collect();
        self.semantics.join_all(&self.tables.state(self.initial), &deltas)
    }

    /// The state of a set out of time, the same by every last delivery.
    fn state_of(&mut self, set: &[DeltaId]) -> Result<Arc<S::State>, Fault> {
        if set.is_empty() {
            return Ok(self.tables.state(self.initial));
        }
        if let Some(state) = self.judge.states.get(set) {
            return Ok(state.clone());
        }
        let mut known: Option<(S::State, Vec<DeltaId>)> = None;
        for at in 0..set.len() {
            let (mut order, last) = without(set, at);
            let mut before = self.state_of(&order)?;
            if self.semantics.delivery() == Delivery::Once {
                // Where different states may count as equal, of the orders that led here the one named counts.
                before = Arc::new(self.deliver(&order));
            }
            let joined = self.semantics.join(&before, &self.tables.delta(last));
            self.judge.diamonds += 1;
            let delivery = self.semantics.judge_delivery(&before, &joined);
            delivery.map_err(|breach| Fault::new(breach, &order, Some(last)))?;
            order.push(last);
            match &known {
                Some((state, delivered)) => {
                    if let Some(what) = self.semantics.differ(state, &joined) {
                        return Err(diamond(delivered.clone(), order, &what));
                    }
                }
                None => known = Some((joined, order)),
            }
        }
        let state = known.map(|(state, _)| Arc::new(state));
        let state = state.unwrap_or_else(|| self.tables.state(self.initial));
        // Sets of everything that there can be are part of no other.
        if set.len() < self.bound.replicas * self.bound.mutations {
            self.judge.states.insert(set.into(), state.clone());
        }
        Ok(state)
    }

    /// A fault of deltas out of time, told of the deltas of a set that they are.
    fn in_time(&mut self, set: &[DeltaId], fault: Fault) -> Fault {
        let mut told = |order: &[DeltaId]| -> Vec<DeltaId> {
            let mut own = |timeless: &DeltaId| {
                let is_it = |&&delta: &&DeltaId| {
                    self.shapes.timeless(&*self.semantics, &mut self.tables, &[delta]) == [*timeless]
                };
                set.iter().find(is_it).copied().unwrap_or(*timeless)
            };
            order.iter().map(&mut own).collect()
        };
        let (delivered, other_order) = (told(&fault.delivered), fault.other_order.as_deref().map(&mut told));
        if let Some(other) = &other_order
            && self.deliver(other) == self.deliver(&delivered)
        {
            return Fault::new(unlike(), set, None);
        }
        Fault { delivered, other_order, ..fault }
    }

    /// Tries on a set whose shape, the last that was made, is known at `grain` what was concluded from that, if
    /// the shape is of the sample.
    fn judge_sample(&mut self, set: &[DeltaId], grain: Grain) -> Result<(), Fault> {
        if !self.judge.is_tried(self.shapes.last()) {
            return Ok(());
        }
        self.judge.sampled += 1;
        let state = self.deliver(set);
        for at in 0..set.len() {
            let (mut order, last) = without(set, at);
            order.push(last);
            if let Some(what) = self.semantics.differ(&state, &self.deliver(&order)) {
                return Err(diamond(set.into(), order, &what));
            }
        }
        let fault = |breach| Fault::new(breach, set, None);
        let own = grain_of(self.semantics.judge(&state).map_err(fault)?);
        let shape = self.shapes.of(&*self.semantics, &mut self.tables, set, own).to_vec();
        let to = self.permutations.get(self.shapes.by());
        let appearance = self.semantics.appearance(&self.semantics.rename_state(&state, to));
        let alike = self.judge.known.compare(&shape, appearance);
        // A set may be told by less than its parts are, but not by more.
        if own > grain || alike.is_err() { Err(fault(unlike())) } else { Ok(()) }
    }

    /// What was delivered changes nothing when it is delivered again.
    fn judge_again(&self, state: &S::State, set: &[DeltaId]) -> Result<(), Fault> {
        for &delta in set {
            let again = self.semantics.join(state, &self.tables.delta(delta));
            let delivery = self.semantics.judge_delivery(state, &again);
            delivery.map_err(|breach| Fault::new(breach, set, Some(delta)))?;
            if again != *state {
                let breach = Breach::new("JOIN-3", TWICE);
                return Err(Fault::new(breach, set, Some(delta)));
            }
        }
        Ok(())
    }

    /// Resynchronisation brings either side of each pair (a set, the set without one delta) to their join.
    fn judge_repair(&self, whole: &S::State, set: &[DeltaId]) -> Result<(), Fault> {
        for at in 0..set.len() {
            let (rest, _) = without(set, at);
            let part = &self.deliver(&rest);
            for ((ours, has), (theirs, had)) in
                [((whole, set), (part, &*rest)), ((part, &*rest), (whole, set))]
            {
                let (Some(delta), Some(joined)) =
                    (self.semantics.repair(ours, theirs), self.semantics.join_states(theirs, ours))
                else {
                    continue;
                };
                if self.semantics.join(theirs, &delta) != joined {
                    let fault = Fault::new(Breach::new("SYNC-3", NOT_THE_JOIN), has, None);
                    return Err(Fault { answered: Some(had.to_vec()), ..fault });
                }
            }
        }
        Ok(())
    }

    /// A fault with as few deliveries as show it.
    pub(super) fn shrunk(&mut self, fault: FoundFault<S>) -> FoundFault<S> {
        match fault {
            FoundFault::Delivered(fault) => FoundFault::Delivered(self.shrink(fault)),
            FoundFault::Step(_) => fault,
        }
    }

    /// Leaves out deliveries while the same clause still breaks in the delivered set.
    fn shrink(&mut self, mut fault: Fault) -> Fault {
        let mut at = 0;
        while at < fault.delivered.len() {
            let (fewer, _) = without(&fault.delivered, at);
            match self.judge_set(&fewer) {
                Err(smaller) if smaller.breach.clause == fault.breach.clause => {
                    fault = smaller;
                    at = 0;
                }
                _ => at += 1,
            }
        }
        fault
    }
}

fn diamond(order: Vec<DeltaId>, other: Vec<DeltaId>, what: &str) -> Fault {
    let breach = Breach::new("JOIN-3", another_order(what));
    Fault { breach, delivered: order, other_order: Some(other), answered: None }
}

/// What tells sets that are judged so.
fn grain_of(judged: Judged) -> Grain {
    match judged {
        Judged { entangled: true, .. } => Grain::Fine,
        Judged { order_sensitive: true, .. } => Grain::Coarse,
        _ => Grain::Outline,
    }
}

pub(super) fn unlike() -> Breach {
    Breach::new("CHECK-11", "sets of deltas are taken to look alike, and do not")
}
