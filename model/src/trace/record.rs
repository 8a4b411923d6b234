//! Runs a course and writes down what is seen. `[spec: TRACE-1]` `[spec: TRACE-2]`

use super::scribe::{Heading, Scribe, message_name};
use super::{Act, Finding, Sent, Trace, TraceReplica};
use crate::checked::INCARNATION;
use crate::course::Event;
use crate::semantics::{Semantics, Step};

/// Why an event cannot happen.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum CannotHappen {
    /// There is no such replica.
    #[error("there is no replica {replica}")]
    NoReplica {
        /// Its position.
        replica: usize,
    },
    /// There is no such message yet.
    #[error("no message {message} was sent")]
    NoMessage {
        /// Its number.
        message: usize,
    },
    /// The semantics refuses the mutation.
    #[error("{replica} cannot: {mutation}")]
    Refused {
        /// The replica's name.
        replica: String,
        /// The mutation, in words.
        mutation: String,
    },
    /// A mutation that the semantics can neither read nor list.
    #[error("{replica} cannot make what is none of its mutations: {mutation}")]
    NoMutation {
        /// The replica's name.
        replica: String,
        /// The mutation, as JSON.
        mutation: String,
    },
    /// Deltas of one group that cannot be one message.
    #[error("the semantics cannot join two deltas to one")]
    Apart,
    /// The semantics has no resynchronisation.
    #[error("the semantics has no means to answer")]
    NoAnswer,
}

/// Runs events one by one and has each written down.
#[derive(Debug)]
pub struct Recorder<'s, S: Semantics> {
    semantics: &'s S,
    scribe: Scribe,
    /// What replicas start with, and start with again.
    initial: Vec<S::State>,
    states: Vec<S::State>,
    indices: Vec<usize>,
    incarnations: Vec<usize>,
    messages: Vec<S::Delta>,
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
        let replicas = parts.iter().map(|part| TraceReplica {
            name: part.name.clone(),
            index: part.index,
            starts: semantics.shows(part.state.as_ref().unwrap_or(&semantics.initial())),
            state: part.state.as_ref().map(|state| semantics.state_json(state)),
        });
        let scribe = Scribe::new(replicas.collect());
        let indices: Vec<usize> = parts.iter().map(|part| part.index).collect();
        let initial: Vec<S::State> =
            parts.into_iter().map(|part| part.state.unwrap_or_else(|| semantics.initial())).collect();
        Self {
            semantics,
            scribe,
            states: initial.clone(),
            initial,
            incarnations: vec![0; indices.len()],
            indices,
            messages: Vec::new(),
        }
    }

    /// The replicas' states now.
    pub fn states(&self) -> &[S::State] {
        &self.states
    }

    /// What was sent so far.
    pub fn messages(&self) -> &[S::Delta] {
        &self.messages
    }

    /// What was written down so far.
    pub const fn scribe(&self) -> &Scribe {
        &self.scribe
    }

    /// The index by which a replica mutates now. `[spec: CRASH-2]`
    pub fn identity(&self, replica: usize) -> usize {
        self.indices[replica] + INCARNATION * self.incarnations[replica]
    }

    /// Makes an event happen, and writes it down. What cannot happen changes nothing.
    pub fn record(&mut self, event: &Event<S::Mutation>) -> Result<(), CannotHappen> {
        let replica = event.replica();
        let before = self.state(replica)?.clone();
        let (does, after) = match event {
            Event::Mutate { mutations, .. } => self.mutate(replica, before, mutations)?,
            Event::Deliver { message, .. } => {
                let after = self.semantics.join(&before, self.message(*message)?);
                (Act::Deliver { message: message_name(*message), again: false }, after)
            }
            Event::Lose { message, .. } => {
                self.message(*message)?;
                (Act::Lose { message: message_name(*message) }, before)
            }
            Event::Restart { keeps, .. } => {
                self.incarnations[replica] += 1;
                let after = if *keeps { before } else { self.initial[replica].clone() };
                (Act::Restart { keeps: *keeps }, after)
            }
            Event::Answer { to, .. } => {
                let theirs = self.state(*to)?;
                let delta = self.semantics.repair(&before, theirs).ok_or(CannotHappen::NoAnswer)?;
                let to = self.scribe.name(*to).to_owned();
                (Act::Answer { to, sends: vec![self.send(delta)] }, before)
            }
        };
        self.note(replica, does, after);
        Ok(())
    }

    /// Writes down something else, which changes nothing.
    pub fn happen(&mut self, replica: usize, text: String) -> Result<(), CannotHappen> {
        let state = self.state(replica)?.clone();
        self.note(replica, Act::Happen { text }, state);
        Ok(())
    }

    /// The trace of what happened.
    pub fn finish(self, title: String, layer: &str, bound: String, finding: Finding) -> Trace {
        let (semantics, setup) = (self.semantics.name(), self.semantics.setup_json());
        self.scribe.finish(Heading { title, semantics, setup, layer: layer.into(), bound }, finding)
    }

    fn state(&self, replica: usize) -> Result<&S::State, CannotHappen> {
        self.states.get(replica).ok_or(CannotHappen::NoReplica { replica })
    }

    fn message(&self, message: usize) -> Result<&S::Delta, CannotHappen> {
        self.messages.get(message).ok_or(CannotHappen::NoMessage { message })
    }

    fn mutate(
        &mut self,
        replica: usize,
        before: S::State,
        mutations: &[S::Mutation],
    ) -> Result<(Act, S::State), CannotHappen> {
        let identity = self.identity(replica);
        let (mut now, mut whole, mut texts) = (before, None, Vec::new());
        for mutation in mutations {
            let text = self.semantics.mutation_text(&now, mutation);
            let step = self.semantics.mutate(&now, identity, mutation);
            let Some(Step { delta, after }) = step else {
                let replica = self.scribe.name(replica).to_owned();
                return Err(CannotHappen::Refused { replica, mutation: text });
            };
            whole = Some(match whole {
                None => delta,
                Some(whole) => self.semantics.join_deltas(&whole, &delta).ok_or(CannotHappen::Apart)?,
            });
            now = after;
            texts.push(text);
        }
        let sends = whole.map(|delta| self.send(delta)).into_iter().collect();
        let mutations = mutations.iter().map(|mutation| self.semantics.mutation_json(mutation)).collect();
        Ok((Act::Mutate { text: texts.join("; "), mutations, sends }, now))
    }

    fn send(&mut self, delta: S::Delta) -> Sent {
        let (text, json) = (self.semantics.delta_text(&delta), self.semantics.delta_json(&delta));
        self.messages.push(delta);
        self.scribe.send(text, json)
    }

    fn note(&mut self, replica: usize, does: Act, after: S::State) {
        let (shows, json) = (self.semantics.shows(&after), self.semantics.state_json(&after));
        self.scribe.note(replica, does, shows, &json);
        self.states[replica] = after;
    }
}
