//! The search space of schedules over one semantics: successors and judgement, whatever the engine.

use super::state::{Event, Message, NO_ANSWER, Schedule};
use super::{RESYNCHRONISATIONS_MAX, ScheduleBound};
use crate::replay::{ALL_RESYNCHRONISED, all_delivered};
use crate::search::Space;
use crate::semantics::{Breach, Delivery, Semantics};
use crate::tables::{DeltaId, NONE, StateId, Tables};
use rustc_hash::{FxHashMap, FxHashSet};
use std::sync::Arc;

/// The space of one bound.
#[derive(Debug)]
pub struct Schedules<S: Semantics> {
    pub(super) semantics: Arc<S>,
    pub(super) bound: ScheduleBound,
    pub(super) tables: Tables<S>,
    initial: StateId,
    /// Deliveries judged, with the state after them.
    delivered: FxHashMap<(StateId, DeltaId), StateId>,
    judged: FxHashSet<StateId>,
    /// What a state gets from another by resynchronisation.
    answers: FxHashMap<(StateId, StateId), Option<DeltaId>>,
    /// What has happened at least once, by bit: see [`HAPPENINGS`].
    pub(super) happened: u32,
}

/// What a run may have to see, by bit.
pub(super) const HAPPENINGS: [&str; 6] = [
    "a delivery",
    "a delivery that is repeated",
    "a loss",
    "a restart that keeps the state",
    "a restart that loses the state",
    "an answer to a resynchronisation that changes a state",
];

/// A clause that does not hold, and the event after which it does not, if it was an event.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ScheduleFault {
    /// The clause.
    pub breach: Breach,
    /// The event.
    pub event: Option<Event>,
}

type Found = Result<(), ScheduleFault>;

impl<S: Semantics> Schedules<S> {
    /// The space of `bound`.
    pub fn new(semantics: Arc<S>, bound: ScheduleBound) -> Self {
        let mut tables = Tables::default();
        let initial = tables.intern(semantics.initial());
        Self {
            semantics,
            bound,
            tables,
            initial,
            delivered: FxHashMap::default(),
            judged: FxHashSet::default(),
            answers: FxHashMap::default(),
            happened: 0,
        }
    }

    /// The moment before anything has happened.
    pub fn start(&self) -> Schedule {
        Schedule::start(self.initial, self.bound.everybody())
    }

    /// The state that every replica starts from.
    pub fn initial(&self) -> StateId {
        self.initial
    }

    /// What was computed.
    pub fn tables(&self) -> &Tables<S> {
        &self.tables
    }

    /// Different replica states judged, and different deliveries.
    pub fn judged(&self) -> (u64, u64) {
        (self.judged.len() as u64, self.delivered.len() as u64)
    }

    /// Everything that can happen next. `[spec: NET-1]` to `[spec: NET-3]` `[spec: CRASH-2]`
    pub fn successors(&mut self, at: &Schedule, out: &mut Vec<(Event, Schedule)>) -> Found {
        for replica in 0..self.bound.replicas {
            if at.made(replica) < self.bound.mutations {
                self.mutate(at, replica, out)?;
            }
        }
        let under_way: Vec<(Message, usize)> = at.under_way(self.bound.everybody()).collect();
        for (message, replica) in under_way {
            match self.semantics.delivery() {
                Delivery::Any => self.deliver(at, message, replica, out)?,
                Delivery::Once if at.is_next(message, replica) => {
                    self.deliver_once(at, message, replica, out)?;
                }
                Delivery::Once => {}
            }
        }
        if at.restarts() < self.bound.restarts {
            self.restart(at, out);
        }
        let limit = usize::from(self.bound.resynchronisations).min(RESYNCHRONISATIONS_MAX);
        if usize::from(at.resynchronisations) < limit {
            self.resynchronise(at, out);
        }
        Ok(())
    }

    fn mutate(&mut self, at: &Schedule, replica: usize, out: &mut Vec<(Event, Schedule)>) -> Found {
        let before = at.states[replica];
        let identity = at.identity(replica);
        let moves = match self.tables.moves(&self.semantics, before, identity) {
            Ok(moves) => moves,
            Err(fault) => {
                let delta = self.tables.intern_delta(fault.step.delta, 0);
                let event = Event::Mutate { replica, delta };
                return Err(ScheduleFault { breach: fault.breach, event: Some(event) });
            }
        };
        for step in moves.iter() {
            let event = Event::Mutate { replica, delta: step.delta };
            let mut next = *at;
            next.states[replica] = match step.after {
                NONE => self.receive(before, step.delta, event)?,
                after => {
                    let judged = self.judge_state(after);
                    judged.map_err(|breach| ScheduleFault { breach, event: Some(event) })?;
                    after
                }
            };
            next.broadcast(replica, step.delta, self.bound.everybody());
            out.push((event, next));
        }
        Ok(())
    }

    fn deliver(
        &mut self,
        at: &Schedule,
        message: Message,
        replica: usize,
        out: &mut Vec<(Event, Schedule)>,
    ) -> Found {
        let delta = at.content(message);
        let mut lost = *at;
        lost.remove(message, replica);
        out.push((Event::Lose { replica, message }, lost));
        let event = Event::Deliver { replica, message, again: true };
        let after = self.receive(at.states[replica], delta, event)?;
        let mut kept = *at;
        kept.states[replica] = after;
        let mut gone = lost;
        gone.states[replica] = after;
        if after != at.states[replica] {
            out.push((event, kept));
            out.push((Event::Deliver { replica, message, again: false }, gone));
            self.happened |= if matches!(message, Message::Answer(_)) { 1 | 1 << 5 } else { 1 };
        }
        // What changes nothing leads where losing it leads; that it changes nothing was judged above.
        self.happened |= 1 << 2 | u32::from(after == at.states[replica]) << 1;
        Ok(())
    }

    fn deliver_once(
        &mut self,
        at: &Schedule,
        message: Message,
        replica: usize,
        out: &mut Vec<(Event, Schedule)>,
    ) -> Found {
        let event = Event::Deliver { replica, message, again: false };
        let mut next = *at;
        next.states[replica] = self.receive(at.states[replica], at.content(message), event)?;
        next.remove(message, replica);
        self.happened |= 1;
        out.push((event, next));
        Ok(())
    }

    fn restart(&mut self, at: &Schedule, out: &mut Vec<(Event, Schedule)>) {
        for replica in 0..self.bound.replicas {
            for keeps in [true, false] {
                let mut next = *at;
                next.incarnations[replica] += 1;
                if !keeps {
                    next.states[replica] = self.initial;
                }
                self.happened |= if keeps { 1 << 3 } else { 1 << 4 };
                out.push((Event::Restart { replica, keeps }, next));
            }
        }
    }

    fn resynchronise(&mut self, at: &Schedule, out: &mut Vec<(Event, Schedule)>) {
        for replica in 0..self.bound.everybody() {
            for from in (0..self.bound.everybody()).filter(|&from| from != replica) {
                let Some(delta) = self.answer(at.states[from], at.states[replica]) else { continue };
                let Some(free) = at.answers.iter().position(|answer| *answer == NO_ANSWER) else { continue };
                let mut next = *at;
                next.resynchronisations += 1;
                next.answers[free] = (u8::try_from(replica).unwrap_or(0), delta);
                next.answers.sort_unstable_by_key(|answer| (answer.1, answer.0));
                out.push((Event::Resynchronise { replica, from }, next));
            }
        }
    }

    /// What a replica in state `asks` is sent by one in state `from`.
    fn answer(&mut self, from: StateId, asks: StateId) -> Option<DeltaId> {
        if let Some(known) = self.answers.get(&(from, asks)) {
            return *known;
        }
        let delta = self.semantics.repair(&self.tables.state(from), &self.tables.state(asks));
        let delta = delta.map(|delta| self.tables.intern_delta(delta, 0));
        self.answers.insert((from, asks), delta);
        delta
    }

    fn receive(&mut self, before: StateId, delta: DeltaId, event: Event) -> Result<StateId, ScheduleFault> {
        self.join(before, delta).map_err(|breach| ScheduleFault { breach, event: Some(event) })
    }

    /// The state after a delivery; the delivery and the state are judged when they are first met.
    fn join(&mut self, before: StateId, delta: DeltaId) -> Result<StateId, Breach> {
        if let Some(&after) = self.delivered.get(&(before, delta)) {
            return Ok(after);
        }
        let after = self.tables.join(&self.semantics, before, delta);
        self.semantics.judge_delivery(&self.tables.state(before), &self.tables.state(after))?;
        self.judge_state(after)?;
        self.delivered.insert((before, delta), after);
        Ok(after)
    }

    fn judge_state(&mut self, id: StateId) -> Result<(), Breach> {
        if self.judged.insert(id) {
            let state = self.tables.state(id);
            self.tables.judge(&self.semantics, &state)?;
        }
        Ok(())
    }

    /// Quiescence, stated as safety: from here, delivering whatever anybody misses makes all states equal,
    /// and so does resynchronisation. `[property: JOIN-5]` `[property: SYNC-5]`
    pub fn judge(&mut self, at: &Schedule) -> Result<(), Breach> {
        self.judge_state(self.initial)?;
        let everybody = self.bound.everybody();
        if self.semantics.delivery() == Delivery::Once {
            // Moments at which nothing is under way follow from every other.
            let quiet = at.under_way(everybody).next().is_none();
            return if quiet { self.judge_equal(&at.states[..everybody]) } else { Ok(()) };
        }
        let mut ends = Vec::with_capacity(everybody);
        for replica in 0..everybody {
            let mut state = at.states[replica];
            for delta in at.pool() {
                state = self.join(state, delta)?;
            }
            ends.push(state);
        }
        self.judge_equal(&ends)?;
        self.judge_resynchronised(at)
    }

    fn judge_equal(&self, ends: &[StateId]) -> Result<(), Breach> {
        let first = ends.first().copied().unwrap_or(self.initial);
        for (replica, &end) in ends.iter().enumerate().filter(|(_, end)| **end != first) {
            if let Some(what) = self.semantics.differ(&self.tables.state(first), &self.tables.state(end))
                && self.semantics.judges("JOIN-5")
            {
                return Err(Breach::new("JOIN-5", all_delivered(replica, &what)));
            }
        }
        Ok(())
    }

    /// The first replica asks everybody, then everybody asks the first.
    fn judge_resynchronised(&mut self, at: &Schedule) -> Result<(), Breach> {
        let everybody = self.bound.everybody();
        let mut hub = at.states[0];
        for replica in 1..everybody {
            let Some(delta) = self.answer(at.states[replica], hub) else { return Ok(()) };
            hub = self.join(hub, delta)?;
        }
        for replica in 1..everybody {
            let Some(delta) = self.answer(hub, at.states[replica]) else { return Ok(()) };
            if self.join(at.states[replica], delta)? != hub {
                return Err(Breach::new("SYNC-5", ALL_RESYNCHRONISED));
            }
        }
        Ok(())
    }
}

impl<S: Semantics> Space for Schedules<S> {
    type Node = Schedule;
    type Event = Event;
    type Fault = ScheduleFault;

    fn start(&self) -> Schedule {
        Self::start(self)
    }

    fn successors(&mut self, at: &Schedule, out: &mut Vec<(Event, Schedule)>) -> Found {
        Self::successors(self, at, out)
    }

    fn judge(&mut self, at: &Schedule) -> Found {
        Self::judge(self, at).map_err(|breach| ScheduleFault { breach, event: None })
    }

    fn depth(&self, at: &Schedule) -> usize {
        at.pool().count()
    }

    fn states_judged(&self) -> u64 {
        self.judged.len() as u64
    }

    fn witnessed(&self) -> usize {
        self.tables.witnesses.count() + self.happened.count_ones() as usize
    }
}
