//! Runs a course and writes down what is seen. `[spec: TRACE-1]` `[spec: TRACE-2]`

use super::scribe::{Heading, Scribe, message_name};
use super::{Act, Finding, Sent, Trace, TraceReplica};
use crate::course::{Event, Runner, StepError, Stepped};
use crate::semantics::Semantics;
use serde_json::Value;

/// Why an event cannot happen.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum CannotHappen {
    /// The runner refuses it.
    #[error(transparent)]
    Refused(#[from] StepError),
    /// A mutation that the semantics can neither read nor list.
    #[error("{replica} cannot make what is none of its mutations: {mutation}")]
    NoMutation {
        /// The replica's name.
        replica: String,
        /// The mutation, as JSON.
        mutation: String,
    },
}

/// Runs events one by one and has each written down.
#[derive(Debug)]
pub struct Recorder<'s, S: Semantics> {
    runner: Runner<'s, S>,
    scribe: Scribe,
}

/// Who takes part in a course.
#[derive(Clone, Debug)]
pub struct Part<T> {
    /// Its name.
    pub name: String,
    /// The index by which it mutates.
    pub index: usize,
    /// What it starts with, if not with what all start with.
    pub state: Option<T>,
}

impl<'s, S: Semantics> Recorder<'s, S> {
    /// Replicas of these names, at the common start.
    pub fn new(semantics: &'s S, names: impl IntoIterator<Item = String>) -> Self {
        let part = |(index, name)| Part { name, index, state: None };
        Self::starting(semantics, names.into_iter().enumerate().map(part).collect())
    }

    /// Replicas with starts of their own.
    pub fn starting(semantics: &'s S, parts: Vec<Part<S::State>>) -> Self {
        let initial = semantics.initial();
        let replicas = parts.iter().map(|part| TraceReplica {
            name: part.name.clone(),
            index: part.index,
            starts: semantics.shows(part.state.as_ref().unwrap_or(&initial)),
            state: part.state.as_ref().map(|state| semantics.state_json(state)),
        });
        let scribe = Scribe::new(replicas.collect());
        let starts =
            parts.into_iter().map(|part| (part.index, part.state.unwrap_or_else(|| initial.clone())));
        Self { runner: Runner::starting(semantics, starts.collect()), scribe }
    }

    /// What runs.
    pub const fn runner(&self) -> &Runner<'s, S> {
        &self.runner
    }

    /// The replicas' states now.
    pub fn states(&self) -> &[S::State] {
        self.runner.states()
    }

    /// What was written down so far.
    pub const fn scribe(&self) -> &Scribe {
        &self.scribe
    }

    /// Makes an event happen, and writes it down. What cannot happen changes nothing.
    pub fn record(&mut self, event: &Event<S::Mutation>) -> Result<(), CannotHappen> {
        self.step(event).map(|_| ())
    }

    /// The same; what the event did.
    pub fn step(&mut self, event: &Event<S::Mutation>) -> Result<Stepped<S>, CannotHappen> {
        let own = |message: &usize| {
            self.runner.messages().get(*message).is_some_and(|sent| sent.sender == event.replica())
        };
        let stepped = match event {
            Event::Deliver { message, .. } if own(message) => self.runner.give_back(*message)?,
            _ => self.runner.step(event)?,
        };
        let semantics = self.runner.semantics();
        let sends = stepped.sent.map(|message| self.send(message)).into_iter().collect();
        let does = match event {
            Event::Mutate { mutations, .. } => {
                let made = stepped.locals.iter().zip(mutations);
                let texts: Vec<String> =
                    made.map(|(local, mutation)| semantics.mutation_text(&local.before, mutation)).collect();
                let mutations = mutations.iter().map(|mutation| semantics.mutation_json(mutation)).collect();
                Act::Mutate { text: texts.join("; "), mutations, sends }
            }
            Event::Deliver { message, .. } => Act::Deliver { message: message_name(*message), again: false },
            Event::Lose { message, .. } => Act::Lose { message: message_name(*message) },
            Event::Restart { keeps, .. } => Act::Restart { keeps: *keeps },
            Event::Answer { to, .. } => Act::Answer { to: self.scribe.name(*to).to_owned(), sends },
        };
        self.note(stepped.replica, does);
        Ok(stepped)
    }

    /// Writes down something else, which changes nothing.
    pub fn happen(&mut self, replica: usize, text: String) {
        if replica < self.states().len() {
            self.note(replica, Act::Happen { text });
        }
    }

    /// Leaves out a replica to whom nothing has happened.
    pub fn drop_idle(&mut self, name: &str) {
        self.scribe.drop_idle(name);
    }

    /// The trace of what happened.
    pub fn finish(self, title: String, layer: &str, bound: String, finding: Finding) -> Trace {
        let semantics = self.runner.semantics();
        let (name, setup) = (semantics.name(), semantics.setup_json());
        self.scribe.finish(Heading { title, semantics: name, setup, layer: layer.into(), bound }, finding)
    }

    fn send(&mut self, message: usize) -> Sent {
        let semantics = self.runner.semantics();
        let deltas = &self.runner.messages()[message].deltas;
        let texts = deltas.iter().map(|delta| semantics.delta_text(delta)).collect::<Vec<_>>();
        let mut json: Vec<Value> = deltas.iter().map(|delta| semantics.delta_json(delta)).collect();
        // Deltas that cannot be one are a list.
        let json = if json.len() == 1 { json.remove(0) } else { Value::Array(json) };
        self.scribe.send(texts.join(", "), json)
    }

    fn note(&mut self, replica: usize, does: Act) {
        let (semantics, after) = (self.runner.semantics(), &self.runner.states()[replica]);
        let (shows, json) = (semantics.shows(after), semantics.state_json(after));
        self.scribe.note(replica, does, shows, &json);
    }
}
