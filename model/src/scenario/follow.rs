//! Whether a course is a run of the scenario. `[spec: CHECK-14]`
//!
//! A course tells mutations and deliveries; where a script waits for a guard, leaves a step out or stops, it does
//! not say. So each replica is followed to every place where its script can be by then.

use super::explore::Replicated;
use super::memo::{DeltaId, Move, Next, Position, StateId};
use super::space::{Broken, Choice, Space};
use crate::checked::Act;
use crate::course::{Course, Event};

/// A course that is a run of the scenario.
#[derive(Debug)]
pub(super) struct Followed {
    /// Per replica of the scenario, where its script can be.
    pub(super) seats: Vec<Vec<Place>>,
    /// Per replica, the reader last: what it has received or made, in order.
    pub(super) known: Vec<Vec<DeltaId>>,
    /// Per message, its delta.
    pub(super) made: Vec<DeltaId>,
    /// Every state that somebody has come to, with what led to it.
    pub(super) views: Vec<(StateId, Vec<DeltaId>)>,
    /// A clause that some replica's next step breaks.
    pub(super) broken: Option<Broken>,
    states: Vec<StateId>,
}

/// A place in a script, and how it was reached.
#[derive(Clone, Debug)]
pub(super) struct Place {
    next: Next,
    /// Steps, each with the number of events before it.
    steps: Vec<(usize, Choice)>,
    /// How much of what the replica knows was told with these steps.
    told: usize,
}

/// Follows a course, if every replica does what the scenario says.
pub(super) fn follow<S: Replicated>(space: &mut Space<S>, course: &Course<Act>) -> Option<Followed> {
    let everybody = course.replicas.len();
    let scripts = space.memo.scenario.replicas.len();
    let start = Place { next: Next::At(Position { step: 0, made: 0 }), steps: Vec::new(), told: 0 };
    let mut followed = Followed {
        seats: vec![vec![start]; scripts],
        known: vec![Vec::new(); everybody],
        made: Vec::new(),
        views: vec![(space.initial, Vec::new())],
        broken: None,
        states: vec![space.initial; everybody],
    };
    (0..scripts).for_each(|replica| followed.go_on(space, replica, 0));
    for (at, event) in course.events.iter().enumerate() {
        let replica = event.replica();
        match event {
            Event::Deliver { message, .. } => {
                let delta = *followed.made.get(*message)?;
                let state = followed.states.get_mut(replica)?;
                *state = space.memo.join(*state, delta);
                followed.known[replica].push(delta);
            }
            Event::Mutate { mutations, .. } => followed.mutate(space, replica, mutations, at)?,
            Event::Lose { .. } | Event::Restart { .. } | Event::Answer { .. } => return None,
        }
        followed.views.push((followed.states[replica], followed.known[replica].clone()));
        if replica < scripts {
            followed.go_on(space, replica, at + 1);
        }
    }
    Some(followed)
}

impl Followed {
    /// Follows a replica through whatever steps it can take without a mutation.
    fn go_on<S: Replicated>(&mut self, space: &mut Space<S>, replica: usize, at: usize) {
        let mut next = 0;
        while let Some(place) = self.seats[replica].get(next).cloned() {
            next += 1;
            for (place, _) in self.steps(space, replica, &place, at, <[Act]>::is_empty) {
                self.sit(replica, place);
            }
        }
    }

    /// A replica makes these mutations, from every place from where it can.
    fn mutate<S: Replicated>(
        &mut self,
        space: &mut Space<S>,
        replica: usize,
        mutations: &[Act],
        at: usize,
    ) -> Option<()> {
        let places = std::mem::take(self.seats.get_mut(replica)?);
        let mut made = None;
        for place in &places {
            let steps = self.steps(space, replica, place, at, |acts| acts == mutations);
            for (place, step) in steps {
                made = made.or(step.delta.map(|delta| (delta, step.after)));
                self.sit(replica, place);
            }
        }
        let (delta, after) = made?;
        self.states[replica] = after;
        self.known[replica].push(delta);
        // Whoever made it has not received it.
        self.seats[replica].iter_mut().for_each(|place| place.told += 1);
        self.made.push(delta);
        Some(())
    }

    /// Where a replica can be after one step from a place, of those steps whose mutations are wanted.
    fn steps<S: Replicated>(
        &mut self,
        space: &mut Space<S>,
        replica: usize,
        place: &Place,
        at: usize,
        wanted: impl Fn(&[Act]) -> bool,
    ) -> Vec<(Place, Move)> {
        let Next::At(position) = place.next else { return Vec::new() };
        let received = self.known[replica][place.told..].to_vec();
        let moves = match space.memo.moves(self.states[replica], replica, position) {
            Ok(moves) => moves,
            Err(breach) => {
                self.broken.get_or_insert(Broken { breach, replica: Some(replica), received });
                return Vec::new();
            }
        };
        let moves = moves.iter().filter(|step| wanted(&step.acts));
        let places = moves.map(|step| {
            let choice = Choice { replica, received: received.clone(), at: position, step: step.clone() };
            let mut steps = place.steps.clone();
            steps.push((at, choice));
            (Place { next: step.next, steps, told: self.known[replica].len() }, step.clone())
        });
        places.collect()
    }

    /// Adds a place, unless it is known: the first way there has the fewest steps.
    fn sit(&mut self, replica: usize, place: Place) {
        let seats = &mut self.seats[replica];
        if seats.iter().all(|known| known.next != place.next) {
            seats.push(place);
        }
    }

    /// The steps that lead each replica to one of its places, in the order of the course.
    pub(super) fn way(&self, seats: &[usize]) -> Vec<Choice> {
        let places = self.seats.iter().zip(seats).filter_map(|(places, &seat)| places.get(seat));
        let mut steps: Vec<&(usize, Choice)> = places.flat_map(|place| &place.steps).collect();
        steps.sort_by_key(|(at, _)| *at);
        steps.into_iter().map(|(_, choice)| choice.clone()).collect()
    }

    /// The steps that lead each replica to the first of its places.
    pub(super) fn shortest(&self) -> Vec<Choice> {
        self.way(&vec![0; self.seats.len()])
    }
}

impl Place {
    /// If nothing is left to do here in the state that everybody has in the end: whether the replica is done.
    pub(super) fn end<S: Replicated>(
        &self,
        space: &mut Space<S>,
        replica: usize,
        last: StateId,
        is_free: bool,
    ) -> Option<bool> {
        match self.next {
            Next::At(_) if is_free => Some(true),
            Next::At(position) => {
                let moves = space.memo.moves(last, replica, position).ok()?;
                moves.is_empty().then_some(false)
            }
            Next::Done => Some(true),
            Next::Stopped => Some(false),
        }
    }
}
