//! One walk. `[spec: CHECK-13]`

use super::counts::Counts;
use super::dice::Dice;
use crate::course::{Course, Event, Judge, Outcome, Stop};
use crate::semantics::Semantics;
use std::collections::BTreeSet;

/// What a network may do besides delivering everything once, in any order.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each fault happens or does not, whatever the others do")]
pub struct Faults {
    /// Messages are lost.
    pub losses: bool,
    /// Messages arrive again.
    pub duplicates: bool,
    /// Replicas restart, with or without their state.
    pub restarts: bool,
    /// Replicas answer each other's digests.
    pub resynchronisation: bool,
}

impl Faults {
    /// All of them.
    pub const ALL: Self = Self { losses: true, duplicates: true, restarts: true, resynchronisation: true };
    /// None: every message arrives once, whenever it pleases.
    pub const NONE: Self =
        Self { losses: false, duplicates: false, restarts: false, resynchronisation: false };
}

/// How walks go.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Walk {
    /// Replicas, at most [`INCARNATION`](crate::checked::INCARNATION).
    pub replicas: usize,
    /// Mutations of each replica, at most; those of groups one by one.
    pub mutations_max: usize,
    /// Events, at most.
    pub events_max: usize,
    /// What decides everything else, together with a walk's number.
    pub seed: u64,
    /// What the network may do.
    pub faults: Faults,
}

/// A walk that is over.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Walked<M> {
    /// What happened.
    pub course: Course<M>,
    /// How it ended.
    pub outcome: Outcome,
    /// What was counted.
    pub counts: Counts,
}

/// How likely each kind of event is beside the others, where it can happen: mutations and deliveries mostly, so
/// that walks are about concurrent mutations and not about faults.
const WEIGHTS: [(Kind, usize); 6] = [
    (Kind::Mutate, 36),
    (Kind::Deliver, 44),
    (Kind::Again, 6),
    (Kind::Lose, 6),
    (Kind::Answer, 6),
    (Kind::Restart, 2),
];
/// One message in so many carries a group.
const GROUP_IN: usize = 8;
/// So many mutations are drawn before a replica is taken to have nothing to do.
const DRAWS_MAX: usize = 16;

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Kind {
    Mutate,
    Deliver,
    Again,
    Lose,
    Answer,
    Restart,
}

impl Walk {
    /// The walk of this number: the same for the same seed, whatever was walked before. It ends when nothing can
    /// happen any more, at the most events, or where a clause breaks. `[spec: CHECK-13]`
    pub fn walk<S: Semantics>(&self, semantics: &S, number: u64) -> Walked<S::Mutation> {
        let course = Course::among(self.replicas);
        let counts = Counts { walks: 1, mutations: vec![0; semantics.kinds().len()], ..Counts::default() };
        match Judge::new(semantics, self.replicas) {
            Ok(judge) => {
                let dice = Dice::new(self.seed, number);
                let (made, arrived) = (vec![0; self.replicas], BTreeSet::new());
                Walker { walk: *self, judge, dice, course, counts, made, arrived }.walk()
            }
            Err(broken) => Walked { course, outcome: Outcome::Broken(broken), counts },
        }
    }
}

/// A walk under way.
struct Walker<'s, S: Semantics> {
    walk: Walk,
    judge: Judge<'s, S>,
    dice: Dice,
    course: Course<S::Mutation>,
    counts: Counts,
    /// Per replica, mutations made.
    made: Vec<usize>,
    /// Messages that have arrived at a replica.
    arrived: BTreeSet<(usize, usize)>,
}

impl<S: Semantics> Walker<'_, S> {
    fn walk(mut self) -> Walked<S::Mutation> {
        let mut outcome = None;
        while outcome.is_none() && self.course.events.len() < self.walk.events_max {
            let Some(event) = self.draw() else { break };
            let stopped = self.judge.step(&event).err();
            self.count(&event);
            self.course.events.push(event);
            outcome = stopped.map(|stop| match stop {
                Stop::Broken(broken) => Outcome::Broken(broken),
                Stop::Impossible(why) => Outcome::Invalid { at: self.course.events.len() - 1, why },
            });
        }
        let outcome =
            outcome.unwrap_or_else(|| self.judge.end().map_or_else(Outcome::Broken, |()| Outcome::Held));
        (self.counts.judged, self.counts.witnesses) = (self.judge.judged, self.judge.witnesses);
        Walked { course: self.course, outcome, counts: self.counts }
    }

    /// An event that can happen: first its kind is drawn, then one of that kind. `None` if there is none.
    fn draw(&mut self) -> Option<Event<S::Mutation>> {
        let faults = self.walk.faults;
        let under_way = self.under_way();
        let again: Vec<(usize, usize)> = self.arrived.iter().copied().collect();
        let again: Vec<(usize, usize)> =
            again.into_iter().filter(|&(message, to)| self.can_arrive(message, to)).collect();
        let may_mutate = self.may_mutate();
        let is_over = may_mutate.is_empty() && under_way.is_empty();
        let can = |kind| {
            !is_over
                && match kind {
                    Kind::Mutate => !may_mutate.is_empty(),
                    Kind::Deliver => !under_way.is_empty(),
                    Kind::Again => faults.duplicates && !again.is_empty(),
                    Kind::Lose => faults.losses && !under_way.is_empty(),
                    Kind::Answer => faults.resynchronisation && self.walk.replicas > 1,
                    Kind::Restart => faults.restarts,
                }
        };
        let mut weights = WEIGHTS.map(|(kind, weight)| if can(kind) { weight } else { 0 });
        loop {
            let at = self.dice.weighted(&weights)?;
            let event = match WEIGHTS[at].0 {
                Kind::Mutate => self.mutate(&may_mutate),
                Kind::Deliver => {
                    self.one_of(&under_way).map(|(message, replica)| Event::Deliver { replica, message })
                }
                Kind::Again => {
                    self.one_of(&again).map(|(message, replica)| Event::Deliver { replica, message })
                }
                Kind::Lose => {
                    self.one_of(&under_way).map(|(message, replica)| Event::Lose { replica, message })
                }
                Kind::Answer => self.answer(),
                Kind::Restart => {
                    let replica = self.dice.below(self.walk.replicas);
                    Some(Event::Restart { replica, keeps: self.dice.below(2) == 0 })
                }
            };
            if event.is_some() {
                return event;
            }
            weights[at] = 0;
        }
    }

    fn one_of<T: Copy>(&mut self, items: &[T]) -> Option<T> {
        items.get(self.dice.below(items.len())).copied()
    }

    fn can_arrive(&self, message: usize, replica: usize) -> bool {
        self.judge.runner().can_arrive(message, replica).is_ok()
    }

    /// Messages that can arrive somewhere for the first time.
    fn under_way(&self) -> Vec<(usize, usize)> {
        let sent = self.judge.runner().messages().len();
        let copies = (0..sent).flat_map(|message| (0..self.walk.replicas).map(move |to| (message, to)));
        let is_under_way =
            |copy: &(usize, usize)| !self.arrived.contains(copy) && self.can_arrive(copy.0, copy.1);
        copies.filter(is_under_way).collect()
    }

    fn may_mutate(&self) -> Vec<usize> {
        let may = |&replica: &usize| {
            self.made[replica] < self.walk.mutations_max && self.judge.runner().identity(replica).is_ok()
        };
        (0..self.walk.replicas).filter(may).collect()
    }

    /// A mutation of somebody who has one left, or now and then a group of two.
    fn mutate(&mut self, may: &[usize]) -> Option<Event<S::Mutation>> {
        let replica = self.one_of(may)?;
        let wants_two = self.dice.below(GROUP_IN) == 0 && self.made[replica] + 1 < self.walk.mutations_max;
        let (semantics, identity) =
            (self.judge.runner().semantics(), self.judge.runner().identity(replica).ok()?);
        let state = self.judge.runner().states().get(replica)?.clone();
        let (mutation, after) = self.mutation(semantics, &state, identity)?;
        let mut mutations = vec![mutation];
        if wants_two {
            mutations.extend(self.mutation(semantics, &after, identity).map(|(mutation, _)| mutation));
        }
        Some(Event::Mutate { replica, mutations })
    }

    /// A mutation that is not refused, of a kind drawn first: there are far more concrete ones of some kinds
    /// than of others.
    fn mutation(
        &mut self,
        semantics: &S,
        state: &S::State,
        identity: usize,
    ) -> Option<(S::Mutation, S::State)> {
        let mut by_kind: Vec<Vec<S::Mutation>> = vec![Vec::new(); semantics.kinds().len()];
        for mutation in semantics.mutations(state, identity) {
            if let Some(of_kind) = by_kind.get_mut(semantics.kind(&mutation)) {
                of_kind.push(mutation);
            }
        }
        by_kind.retain(|of_kind| !of_kind.is_empty());
        for _ in 0..DRAWS_MAX {
            let kind = self.dice.below(by_kind.len());
            let of_kind = by_kind.get(kind)?;
            let mutation = of_kind.get(self.dice.below(of_kind.len()))?;
            if let Some(step) = semantics.mutate(state, identity, mutation) {
                return Some((mutation.clone(), semantics.author_state(state, &step)));
            }
        }
        None
    }

    /// Somebody's answer to another, if the semantics has one.
    fn answer(&mut self) -> Option<Event<S::Mutation>> {
        let replica = self.dice.below(self.walk.replicas);
        let to = (replica + 1 + self.dice.below(self.walk.replicas - 1)) % self.walk.replicas;
        let states = self.judge.runner().states();
        let has_one = self.judge.runner().semantics().repair(&states[replica], &states[to]).is_some();
        has_one.then_some(Event::Answer { replica, to })
    }

    /// Counts an event that was carried out, though it may have broken something.
    fn count(&mut self, event: &Event<S::Mutation>) {
        self.counts.events += 1;
        match event {
            Event::Mutate { replica, mutations } => {
                self.made[*replica] += mutations.len();
                self.counts.groups += u64::from(mutations.len() > 1);
                for mutation in mutations {
                    let kind = self.judge.runner().semantics().kind(mutation);
                    self.counts.mutations.get_mut(kind).into_iter().for_each(|count| *count += 1);
                }
            }
            Event::Deliver { replica, message } => {
                let messages = self.judge.runner().messages();
                let overtakes = (0..*message).any(|earlier| {
                    messages[earlier].sender == messages[*message].sender
                        && self.can_arrive(earlier, *replica)
                        && !self.arrived.contains(&(earlier, *replica))
                });
                if self.arrived.insert((*message, *replica)) {
                    self.counts.deliveries += 1;
                    self.counts.reorderings += u64::from(overtakes);
                } else {
                    self.counts.duplicates += 1;
                }
            }
            Event::Lose { .. } => self.counts.losses += 1,
            Event::Restart { .. } => self.counts.restarts += 1,
            Event::Answer { .. } => self.counts.answers += 1,
        }
    }
}
