//! A history as data, and what becomes of it on the core. `[spec: ORACLE-4]`

use super::counts::Counts;
use crate::compare::{Batch, Fact};
use crate::fact::{Question, of_answer_to, of_join, of_mutation, of_state};
use dsr_core::{
    Author, Delta, Dictionary, Digest, Mutation, ReplicaId, State, check_well_formed, digest, encode, view,
};
use std::collections::BTreeMap;

/// What happens.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Event {
    /// A replica mutates, all or nothing; makes a delta.
    Mutate {
        /// Who.
        replica: usize,
        /// Its clock.
        timestamp_ns: u64,
        /// What it tries, one after the other.
        mutations: Vec<Mutation>,
    },
    /// A delta arrives, perhaps again.
    Deliver {
        /// Where.
        replica: usize,
        /// The event that made it.
        delta: usize,
    },
    /// Deltas become one message; makes a delta.
    Group {
        /// The events that made them.
        deltas: Vec<usize>,
    },
    /// A replica takes over another's whole state.
    Join {
        /// Who.
        replica: usize,
        /// Whose.
        from: usize,
    },
    /// A replica says what it has seen; makes a digest.
    Tell {
        /// Who.
        replica: usize,
    },
    /// A replica answers a digest, perhaps an old one; makes a delta.
    Answer {
        /// Who.
        replica: usize,
        /// The event that made it.
        digest: usize,
    },
    /// A replica goes on as its next incarnation, with its state.
    Restart {
        /// Who.
        replica: usize,
    },
    /// A state from outside; is a delta.
    Outside {
        /// The state.
        state: State,
    },
    /// Bytes from outside.
    Bytes {
        /// The bytes.
        bytes: Vec<u8>,
    },
}

/// A history: its events have numbers that stay theirs when others are left out.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct History {
    /// Its number.
    pub number: u64,
    /// Each replica, and what it knows.
    pub replicas: Vec<(ReplicaId, Dictionary)>,
    /// What happens.
    pub events: Vec<(usize, Event)>,
}

/// The replicas while a history happens.
#[derive(Clone, Debug)]
pub(super) struct World {
    pub(super) replicas: Vec<Replica>,
    pub(super) deltas: BTreeMap<usize, Delta>,
    pub(super) digests: BTreeMap<usize, Digest>,
}

/// One of them.
#[derive(Clone, Debug)]
pub(super) struct Replica {
    pub(super) id: ReplicaId,
    pub(super) dictionary: Dictionary,
    pub(super) state: State,
}

/// What is asked because of an event: under whose dictionary, what.
pub(super) type Asked = Vec<(usize, Question)>;

/// The outcome of an event.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Outcome {
    /// It happened.
    Done,
    /// A mutation is refused, with the name of its error.
    Refused(String),
    /// What it needs is not there: nothing happened.
    Nothing,
    /// What comes of well-formed states is not well-formed, since something waited for a dot that is of another kind: who is
    /// careful does not take it over.
    NotTaken,
}

impl World {
    pub(super) fn of(history: &History) -> Self {
        let replicas = history.replicas.iter().map(|(id, dictionary)| Replica {
            id: *id,
            dictionary: dictionary.clone(),
            state: State::new(),
        });
        Self { replicas: replicas.collect(), deltas: BTreeMap::new(), digests: BTreeMap::new() }
    }

    /// Lets an event happen.
    pub(super) fn happen(&mut self, number: usize, event: &Event) -> (Outcome, Asked) {
        let mut asked = Asked::new();
        let outcome = self.try_event(number, event, &mut asked).unwrap_or(Outcome::Nothing);
        (outcome, asked)
    }

    fn try_event(&mut self, number: usize, event: &Event, asked: &mut Asked) -> Option<Outcome> {
        match event {
            Event::Mutate { replica, timestamp_ns, mutations } => {
                self.mutate(number, *replica, *timestamp_ns, mutations, asked)
            }
            Event::Deliver { replica, delta } => {
                let delta = self.deltas.get(delta)?.clone();
                self.take(*replica, &delta, asked)
            }
            Event::Join { replica, from } => {
                let other = self.replicas.get(*from)?.state.clone();
                self.take(*replica, &other, asked)
            }
            Event::Group { deltas } => {
                let parts: Vec<&Delta> = deltas.iter().filter_map(|delta| self.deltas.get(delta)).collect();
                if parts.len() < 2 {
                    return None;
                }
                asked.push((0, of_join(&parts)));
                let whole = parts.into_iter().fold(Delta::new(), |whole, part| whole.joined(part));
                Some(self.keep(number, whole))
            }
            Event::Tell { replica } => {
                let state = &self.replicas.get(*replica)?.state;
                asked.push((*replica, Question::Digest(state.clone())));
                self.digests.insert(number, digest(state));
                Some(Outcome::Done)
            }
            Event::Answer { replica, digest } => {
                let (state, theirs) = (&self.replicas.get(*replica)?.state, self.digests.get(digest)?);
                asked.push((*replica, of_answer_to(state, theirs)));
                let delta = dsr_core::delta_for(state, theirs);
                Some(self.keep(number, delta))
            }
            Event::Restart { replica } => {
                let replica = self.replicas.get_mut(*replica)?;
                replica.id = replica.id.next_incarnation()?;
                Some(Outcome::Done)
            }
            Event::Outside { state } => {
                asked.push((0, Question::Accepts(encode(state))));
                asked.extend(of_state(state).map(|question| (0, question)));
                Some(self.keep(number, state.clone()))
            }
            Event::Bytes { bytes } => {
                asked.push((0, Question::Accepts(bytes.clone())));
                Some(Outcome::Done)
            }
        }
    }

    fn mutate(
        &mut self,
        number: usize,
        at: usize,
        timestamp_ns: u64,
        mutations: &[Mutation],
        asked: &mut Asked,
    ) -> Option<Outcome> {
        let replica = self.replicas.get(at)?;
        let author = Author { replica: replica.id, timestamp_ns };
        let (mut state, mut parts) = (replica.state.clone(), Vec::new());
        for mutation in mutations {
            asked.push((at, of_mutation(&state, author, mutation)));
            match mutation.delta(&view(&state, &replica.dictionary), author) {
                Ok(delta) => {
                    state.join(&delta);
                    if check_well_formed(&state).is_err() {
                        return Some(Outcome::NotTaken);
                    }
                    parts.push(delta);
                }
                Err(error) => {
                    let kind = format!("{} {}", mutation.kind().name(), error.kind());
                    return Some(Outcome::Refused(kind));
                }
            }
        }
        if parts.len() > 1 {
            asked.push((at, of_join(&parts.iter().collect::<Vec<_>>())));
        }
        let whole = parts.iter().fold(Delta::new(), |whole, part| whole.joined(part));
        self.arrive(at, state, asked);
        Some(self.keep(number, whole))
    }

    /// A delta that is sent is well-formed: nobody would take it else.
    fn keep(&mut self, number: usize, delta: Delta) -> Outcome {
        if check_well_formed(&delta).is_err() {
            return Outcome::NotTaken;
        }
        self.deltas.insert(number, delta);
        Outcome::Done
    }

    fn take(&mut self, at: usize, other: &State, asked: &mut Asked) -> Option<Outcome> {
        let state = &self.replicas.get(at)?.state;
        asked.push((at, of_join(&[state, other])));
        let joined = state.joined(other);
        if check_well_formed(&joined).is_err() {
            return Some(Outcome::NotTaken);
        }
        self.arrive(at, joined, asked);
        Some(Outcome::Done)
    }

    fn arrive(&mut self, at: usize, state: State, asked: &mut Asked) {
        asked.extend(of_state(&state).map(|question| (at, question)));
        if let Some(replica) = self.replicas.get_mut(at) {
            replica.state = state;
        }
    }
}

/// Lets a history happen on the core: its facts in sequence, about its number; and what occurred is counted.
pub fn carry_out(history: &History, counts: &mut Counts) -> Batch {
    let mut world = World::of(history);
    let mut facts = Batch::new();
    let mut under: Option<Dictionary> = None;
    counts.begin(history);
    for (number, event) in &history.events {
        let (outcome, asked) = world.happen(*number, event);
        counts.event(event, &outcome);
        for (replica, question) in asked {
            let Some(Replica { dictionary, .. }) = world.replicas.get(replica) else { continue };
            if under.as_ref() != Some(dictionary) {
                facts.push(Fact::of_dictionary(dictionary));
                under = Some(dictionary.clone());
            }
            counts.question(&question, dictionary);
            facts.push(Fact::of(history.number, &question, dictionary));
        }
    }
    facts
}
