//! A course with something left out or changed, and how it is carried out.

use crate::course::{Course, Event, Runner};
use crate::semantics::Semantics;
use std::collections::BTreeMap;

/// What the events of a course made and sent: the ids by which its mutations go.
#[derive(Debug)]
pub(super) struct Recorded<S: Semantics> {
    names: Vec<String>,
    /// Per event, the delta of each of its mutations.
    deltas: Vec<Vec<S::Delta>>,
    /// Per event, the message that it sent.
    pub(super) sent: Vec<Option<usize>>,
}

impl<S: Semantics> Recorded<S> {
    /// Carries the course out. Of a course that cannot happen, as far as it goes.
    pub(super) fn of(semantics: &S, course: &Course<S::Mutation>) -> Self {
        let mut runner = Runner::new(semantics, course.replicas.len());
        let (mut deltas, mut sent) = (Vec::new(), Vec::new());
        for event in &course.events {
            let Ok(stepped) = runner.step(event) else { break };
            deltas.push(stepped.locals.into_iter().map(|local| local.step.delta).collect());
            sent.push(stepped.sent);
        }
        Self { names: course.replicas.clone(), deltas, sent }
    }
}

/// What is to happen, told in the numbers of the course that it was made from.
#[derive(Clone, Debug)]
pub(super) struct Plan<M> {
    /// Which replicas are there.
    pub(super) replicas: Vec<usize>,
    /// What happens.
    pub(super) items: Vec<Item<M>>,
}

/// One event.
#[derive(Clone, Debug)]
pub(super) struct Item<M> {
    /// The event, in old numbers.
    pub(super) event: Event<M>,
    /// Of each mutation, the event and the place in it that it had.
    pub(super) origins: Vec<(usize, usize)>,
    /// The old messages that its message takes the place of.
    pub(super) sends: Vec<usize>,
}

impl<M: Clone> Plan<M> {
    /// The course as it is.
    pub(super) fn of<S: Semantics<Mutation = M>>(course: &Course<M>, recorded: &Recorded<S>) -> Self {
        let items = course.events.iter().enumerate().map(|(at, event)| Item {
            event: event.clone(),
            origins: match event {
                Event::Mutate { mutations, .. } => (0..mutations.len()).map(|place| (at, place)).collect(),
                _ => Vec::new(),
            },
            sends: recorded.sent.get(at).copied().flatten().into_iter().collect(),
        });
        Self { replicas: (0..course.replicas.len()).collect(), items: items.collect() }
    }

    /// Carries it out on a semantics, renumbered and readdressed, without what cannot happen.
    pub(super) fn carry_out<S: Semantics<Mutation = M>>(
        &self,
        semantics: &S,
        recorded: &Recorded<S>,
    ) -> Course<M> {
        let mut carrier = Carrier {
            runner: Runner::new(semantics, self.replicas.len()),
            recorded,
            plan: self,
            messages: BTreeMap::new(),
            made: Vec::new(),
        };
        let events = self.items.iter().filter_map(|item| carrier.item(item)).collect();
        Course { replicas: self.names(&recorded.names), events }
    }

    /// Names that only tell the position are given anew.
    fn names(&self, old: &[String]) -> Vec<String> {
        let positional = |replicas: usize| Course::<M>::among(replicas).replicas;
        if old == positional(old.len()) {
            return positional(self.replicas.len());
        }
        self.replicas.iter().map(|&replica| old[replica].clone()).collect()
    }
}

struct Carrier<'c, S: Semantics> {
    runner: Runner<'c, S>,
    recorded: &'c Recorded<S>,
    plan: &'c Plan<S::Mutation>,
    /// Old messages in new numbers.
    messages: BTreeMap<usize, usize>,
    /// What each mutation made before, and makes now.
    made: Vec<(S::Delta, S::Delta)>,
}

impl<S: Semantics> Carrier<'_, S> {
    /// One event in new numbers, if it can happen.
    fn item(&mut self, item: &Item<S::Mutation>) -> Option<Event<S::Mutation>> {
        let replica = self.replica(item.event.replica())?;
        let event = match &item.event {
            Event::Mutate { mutations, .. } => {
                let mutations = self.mutations(replica, mutations, &item.origins);
                Event::Mutate { replica, mutations }
            }
            Event::Deliver { message, .. } => {
                Event::Deliver { replica, message: *self.messages.get(message)? }
            }
            Event::Lose { message, .. } => Event::Lose { replica, message: *self.messages.get(message)? },
            Event::Restart { keeps, .. } => Event::Restart { replica, keeps: *keeps },
            Event::Answer { to, .. } => Event::Answer { replica, to: self.replica(*to)? },
        };
        let stepped = self.runner.step(&event).ok()?;
        if let Some(sent) = stepped.sent {
            self.messages.extend(item.sends.iter().map(|&old| (old, sent)));
        }
        Some(event)
    }

    fn replica(&self, old: usize) -> Option<usize> {
        self.plan.replicas.iter().position(|&kept| kept == old)
    }

    /// Those mutations of a group that can be made, one after the other.
    fn mutations(
        &mut self,
        replica: usize,
        mutations: &[S::Mutation],
        origins: &[(usize, usize)],
    ) -> Vec<S::Mutation> {
        let (Ok(identity), Some(state)) =
            (self.runner.identity(replica), self.runner.states().get(replica).cloned())
        else {
            return Vec::new();
        };
        let semantics = self.runner.semantics();
        let (mut now, mut kept) = (state, Vec::new());
        for (mutation, &(event, place)) in mutations.iter().zip(origins) {
            let Some(mutation) = semantics.readdressed(mutation, &self.made) else { continue };
            if !semantics.allows(&now, identity, &mutation) {
                continue;
            }
            let Some(step) = semantics.mutate(&now, identity, &mutation) else { continue };
            now = semantics.author_state(&now, &step);
            let old = self.recorded.deltas.get(event).and_then(|deltas| deltas.get(place));
            self.made.extend(old.map(|old| (old.clone(), step.delta)));
            kept.push(mutation);
        }
        kept
    }
}
