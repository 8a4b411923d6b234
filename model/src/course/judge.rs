//! A course under judgement: what L2 judges of every event, and what it judges of the moment after the last.
//! `[spec: CHECK-13]`

use super::{Course, Event, Runner, StepError, Stepped};
use crate::replay::{ALL_DELIVERED, ALL_RESYNCHRONISED};
use crate::semantics::{Breach, Delivery, Semantics, Witnesses};
use std::fmt;

/// When a clause was found broken.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Moment {
    /// Before anything has happened: the initial state breaks it.
    Start,
    /// By the event of this index.
    Event(usize),
    /// After the last event: when all that is missing is delivered, or all resynchronise.
    End,
}

/// A clause that does not hold, and where.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Broken {
    /// When.
    pub at: Moment,
    /// At whose place.
    pub replica: Option<usize>,
    /// The clause.
    pub breach: Breach,
}

/// How a course ends.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Outcome {
    /// All that was judged holds.
    Held,
    /// A clause does not hold; later events were not looked at.
    Broken(Broken),
    /// An event cannot happen: the course is none of this semantics.
    Invalid {
        /// The event's index.
        at: usize,
        /// Why.
        why: StepError,
    },
}

impl Outcome {
    /// The clause that breaks, if one does.
    pub fn clause(&self) -> Option<&'static str> {
        match self {
            Self::Broken(broken) => Some(broken.breach.clause),
            Self::Held | Self::Invalid { .. } => None,
        }
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Held => f.write_str("all holds"),
            Self::Broken(Broken { breach, .. }) => write!(f, "[{}] {}", breach.clause, breach.detail),
            Self::Invalid { at, why } => write!(f, "event {at} cannot happen: {why}"),
        }
    }
}

/// Why a judge goes no further.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Stop {
    /// A clause does not hold.
    Broken(Broken),
    /// The event cannot happen; nothing has changed.
    Impossible(StepError),
}

/// A runner that judges each event.
#[derive(Debug)]
pub struct Judge<'s, S: Semantics> {
    runner: Runner<'s, S>,
    events: usize,
    /// What was seen so far.
    pub witnesses: Witnesses,
    /// Replica states judged so far.
    pub judged: u64,
}

/// Runs a course and judges it; with `to_the_end` also what must hold of the moment after the last event.
/// `[spec: CHECK-13]`
pub fn run<S: Semantics>(semantics: &S, course: &Course<S::Mutation>, to_the_end: bool) -> Outcome {
    let mut judge = match Judge::new(semantics, course.replicas.len()) {
        Ok(judge) => judge,
        Err(broken) => return Outcome::Broken(broken),
    };
    for (at, event) in course.events.iter().enumerate() {
        match judge.step(event) {
            Ok(_) => {}
            Err(Stop::Broken(broken)) => return Outcome::Broken(broken),
            Err(Stop::Impossible(why)) => return Outcome::Invalid { at, why },
        }
    }
    let end = if to_the_end { judge.end() } else { Ok(()) };
    end.map_or_else(Outcome::Broken, |()| Outcome::Held)
}

impl<'s, S: Semantics> Judge<'s, S> {
    /// Replicas in the initial state, which is judged.
    pub fn new(semantics: &'s S, replicas: usize) -> Result<Self, Broken> {
        let runner = Runner::new(semantics, replicas);
        let mut judge = Self { runner, events: 0, witnesses: Witnesses::default(), judged: 0 };
        let sound = judge.state(&semantics.initial());
        sound.map_err(|breach| Broken { at: Moment::Start, replica: None, breach })?;
        Ok(judge)
    }

    /// What runs.
    pub fn runner(&self) -> &Runner<'s, S> {
        &self.runner
    }

    /// Lets one event happen, and judges its mutations, its deliveries and the state after it, as L2 does.
    pub fn step(&mut self, event: &Event<S::Mutation>) -> Result<Stepped<S>, Stop> {
        let identity = self.runner.identity(event.replica());
        let stepped = self.runner.step(event).map_err(Stop::Impossible)?;
        let judged = match (event, identity) {
            (Event::Mutate { mutations, .. }, Ok(identity)) => {
                judge_mutations(self.runner.semantics(), identity, mutations, &stepped)
            }
            _ => Ok(()),
        };
        let judged = judged.and_then(|()| self.change(&stepped.before, &stepped.after, event));
        let (at, replica) = (Moment::Event(self.events), Some(stepped.replica));
        judged.map_err(|breach| Stop::Broken(Broken { at, replica, breach }))?;
        self.events += 1;
        Ok(stepped)
    }

    /// Judges what an event did to its replica. Who loses its state at a restart starts anew: nothing grows.
    fn change(
        &mut self,
        before: &S::State,
        after: &S::State,
        event: &Event<S::Mutation>,
    ) -> Result<(), Breach> {
        if before == after || matches!(event, Event::Restart { .. }) {
            return Ok(());
        }
        self.runner.semantics().judge_delivery(before, after)?;
        self.state(after)
    }

    fn state(&mut self, state: &S::State) -> Result<(), Breach> {
        self.judged += 1;
        self.witnesses.insert(self.runner.semantics().judge(state)?.witnesses);
        Ok(())
    }

    /// Judges the moment: delivering to everybody whatever any mutation broadcast makes all states equal, and
    /// so does resynchronisation. `[property: JOIN-5]` `[property: SYNC-5]`
    pub fn end(&mut self) -> Result<(), Broken> {
        if self.runner.semantics().delivery() == Delivery::Once {
            // What was lost or has arrived cannot be delivered later.
            return Ok(());
        }
        let broken = |replica| move |breach| Broken { at: Moment::End, replica: Some(replica), breach };
        let everything: Vec<S::Delta> = self
            .runner
            .messages()
            .iter()
            .filter(|message| message.to.is_none())
            .flat_map(|message| message.deltas.clone())
            .collect();
        let states = self.runner.states().to_vec();
        let mut first: Option<S::State> = None;
        for (replica, state) in states.iter().enumerate() {
            let mut state = state.clone();
            for delta in &everything {
                state = self.receive(&state, delta).map_err(broken(replica))?;
            }
            match &first {
                Some(first) if *first != state => {
                    return Err(broken(replica)(Breach::new("JOIN-5", ALL_DELIVERED)));
                }
                Some(_) => {}
                None => first = Some(state),
            }
        }
        self.resynchronised(&states)
    }

    /// The first replica asks everybody, then everybody asks the first.
    fn resynchronised(&mut self, states: &[S::State]) -> Result<(), Broken> {
        let broken = |replica| move |breach| Broken { at: Moment::End, replica: Some(replica), breach };
        let Some((hub, others)) = states.split_first() else { return Ok(()) };
        let mut hub = hub.clone();
        let semantics = self.runner.semantics();
        for state in others {
            let Some(delta) = semantics.repair(state, &hub) else { return Ok(()) };
            hub = self.receive(&hub, &delta).map_err(broken(0))?;
        }
        for (at, state) in others.iter().enumerate() {
            let Some(delta) = semantics.repair(&hub, state) else { return Ok(()) };
            if self.receive(state, &delta).map_err(broken(at + 1))? != hub {
                let breach = Breach::new("SYNC-5", ALL_RESYNCHRONISED);
                return Err(broken(at + 1)(breach));
            }
        }
        Ok(())
    }

    fn receive(&mut self, before: &S::State, delta: &S::Delta) -> Result<S::State, Breach> {
        let after = self.runner.semantics().join(before, delta);
        if after != *before {
            self.runner.semantics().judge_delivery(before, &after)?;
            self.state(&after)?;
        }
        Ok(after)
    }
}

/// Judges mutations one by one, and that a group is what its message makes of the state before it.
/// `[property: MUT-0]` `[property: MUT-0.4]`
pub fn judge_mutations<S: Semantics>(
    semantics: &S,
    identity: usize,
    mutations: &[S::Mutation],
    stepped: &Stepped<S>,
) -> Result<(), Breach> {
    for (mutation, local) in mutations.iter().zip(&stepped.locals) {
        semantics.judge_step(&local.before, identity, mutation, &local.step)?;
        let joins = semantics.delivery() == Delivery::Any;
        if joins && semantics.join(&local.before, &local.step.delta) != local.step.after {
            let wrong = "the author's state is not its old state joined with the delta";
            return Err(Breach::new("MUT-0", wrong));
        }
    }
    match stepped.locals.last() {
        Some(last) if last.step.after != stepped.after => {
            Err(Breach::new("MUT-0.4", "a group of mutations is not the join of its deltas"))
        }
        _ => Ok(()),
    }
}
