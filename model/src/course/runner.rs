//! Carries out a course, event by event, on any semantics. It judges nothing: see [`Judge`](super::Judge).

use super::Event;
use crate::checked::INCARNATION;
use crate::semantics::{Delivery, Semantics, Step};
use std::collections::BTreeSet;

/// The states of all replicas and the messages sent so far.
///
/// As in L2, an author's state after a mutation is its old state joined with what it broadcasts, or what the step
/// leaves where a delta is not [delivered in any way](Delivery); a message goes
/// to everybody else (an answer only to whom it answers), and a replica that restarts mutates under the next
/// index of its own: `index + INCARNATION * restarts`. `[spec: CRASH-2]`
#[derive(Debug)]
pub struct Runner<'s, S: Semantics> {
    semantics: &'s S,
    /// What each starts with, and starts with again.
    initial: Vec<S::State>,
    /// The index by which each mutates in its first incarnation.
    indices: Vec<usize>,
    states: Vec<S::State>,
    restarts: Vec<usize>,
    messages: Vec<Message<S::Delta>>,
    lost: BTreeSet<(usize, usize)>,
}

/// Something that was sent.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Message<D> {
    /// By whom.
    pub sender: usize,
    /// To whom; `None` for everybody else.
    pub to: Option<usize>,
    /// What is in it: of a group of mutations one delta if the semantics [joins
    /// deltas](Semantics::join_deltas), else all of them, which arrive together and in order.
    pub deltas: Vec<D>,
}

/// One mutation of an event.
#[derive(Debug)]
pub struct Local<S: Semantics> {
    /// Its author's state before it.
    pub before: S::State,
    /// What the semantics says of it.
    pub step: Step<S>,
}

/// What an event did.
#[derive(Debug)]
pub struct Stepped<S: Semantics> {
    /// To whom.
    pub replica: usize,
    /// Its state before.
    pub before: S::State,
    /// Its state after; an event of the network alone changes nothing.
    pub after: S::State,
    /// The number of the message that it sent, if it did: see [`Runner::messages`].
    pub sent: Option<usize>,
    /// Its mutations, one by one.
    pub locals: Vec<Local<S>>,
}

/// Why an event cannot happen. Nothing has changed then.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// Nobody has this number.
    #[error("there is no replica {replica}: they count from 0, and there are {count}")]
    NoReplica {
        /// The number.
        replica: usize,
        /// How many there are.
        count: usize,
    },
    /// A replica that would share its identity with another.
    #[error("replica {replica} cannot mutate: only the first {INCARNATION} have identities of their own")]
    NoIdentity {
        /// Which.
        replica: usize,
    },
    /// A group without mutations.
    #[error("replica {replica} makes no mutation: leave the event out")]
    NothingMade {
        /// Who.
        replica: usize,
    },
    /// The semantics refuses it in that state, or does not [allow](Semantics::allows) it.
    #[error(
        "replica {replica} cannot do {mutation:?}, mutation {at} of the event: it is refused in that state"
    )]
    Refused {
        /// Who.
        replica: usize,
        /// Which mutation of the event, from 0.
        at: usize,
        /// What.
        mutation: String,
    },
    /// Nobody has sent it yet.
    #[error("there is no message {message}: they count from 0, and {sent} were sent so far")]
    NotSent {
        /// The message.
        message: usize,
        /// How many were sent.
        sent: usize,
    },
    /// It is not sent to this replica.
    #[error("message {message} is not for replica {replica}")]
    NotForIt {
        /// The message.
        message: usize,
        /// Who.
        replica: usize,
    },
    /// It was lost for this replica before.
    #[error("message {message} is lost for replica {replica}")]
    IsLost {
        /// The message.
        message: usize,
        /// For whom.
        replica: usize,
    },
    /// Whoever answers itself learns nothing.
    #[error("replica {replica} cannot answer itself")]
    AnswersItself {
        /// Who.
        replica: usize,
    },
    /// The semantics has no resynchronisation.
    #[error("replica {replica} cannot answer: this semantics does not resynchronise")]
    NoAnswer {
        /// Who.
        replica: usize,
    },
}

impl<'s, S: Semantics> Runner<'s, S> {
    /// Some replicas in the initial state, to whom nothing has happened.
    pub fn new(semantics: &'s S, replicas: usize) -> Self {
        let initial = semantics.initial();
        Self::starting(semantics, (0..replicas).map(|index| (index, initial.clone())).collect())
    }

    /// Replicas with indices and starts of their own, to whom nothing has happened.
    pub fn starting(semantics: &'s S, starts: Vec<(usize, S::State)>) -> Self {
        let (indices, initial): (Vec<usize>, Vec<S::State>) = starts.into_iter().unzip();
        Self {
            semantics,
            states: initial.clone(),
            restarts: vec![0; indices.len()],
            initial,
            indices,
            messages: Vec::new(),
            lost: BTreeSet::new(),
        }
    }

    /// What runs.
    pub fn semantics(&self) -> &'s S {
        self.semantics
    }

    /// What each starts from.
    pub fn initial(&self) -> &[S::State] {
        &self.initial
    }

    /// Each replica's state.
    pub fn states(&self) -> &[S::State] {
        &self.states
    }

    /// What was sent so far, by number.
    pub fn messages(&self) -> &[Message<S::Delta>] {
        &self.messages
    }

    /// Under which index of the checker a replica mutates now.
    pub fn identity(&self, replica: usize) -> Result<usize, StepError> {
        let restarts = self.restarts.get(replica).ok_or(self.no_replica(replica))?;
        let index = self.indices[replica];
        if index < INCARNATION {
            Ok(index + INCARNATION * restarts)
        } else {
            Err(StepError::NoIdentity { replica })
        }
    }

    /// Whether the network can still bring a message to a replica. It brings nobody's own: see
    /// [`give_back`](Self::give_back).
    pub fn can_arrive(&self, message: usize, replica: usize) -> Result<(), StepError> {
        self.state(replica)?;
        let sent =
            self.messages.get(message).ok_or(StepError::NotSent { message, sent: self.messages.len() })?;
        if sent.sender == replica || sent.to.is_some_and(|to| to != replica) {
            Err(StepError::NotForIt { message, replica })
        } else if self.lost.contains(&(message, replica)) {
            Err(StepError::IsLost { message, replica })
        } else {
            Ok(())
        }
    }

    /// Lets one event happen.
    pub fn step(&mut self, event: &Event<S::Mutation>) -> Result<Stepped<S>, StepError> {
        let replica = event.replica();
        let before = self.state(replica)?.clone();
        let (mut sent, mut locals) = (None, Vec::new());
        let after = match event {
            Event::Mutate { mutations, .. } => {
                locals = self.locals(replica, mutations)?;
                let deltas = self.joined(&locals);
                let after = match (self.semantics.delivery(), locals.last()) {
                    (Delivery::Once, Some(last)) => last.step.after.clone(),
                    _ => self.semantics.join_all(&before, &deltas.iter().collect::<Vec<_>>()),
                };
                sent = Some(self.send(Message { sender: replica, to: None, deltas }));
                after
            }
            Event::Deliver { message, .. } => {
                self.can_arrive(*message, replica)?;
                self.joined_with(&before, *message)
            }
            Event::Lose { message, .. } => {
                self.can_arrive(*message, replica)?;
                self.lost.insert((*message, replica));
                before.clone()
            }
            Event::Restart { keeps, .. } => {
                self.restarts[replica] += 1;
                if *keeps { before.clone() } else { self.initial[replica].clone() }
            }
            Event::Answer { to, .. } => {
                let theirs = self.state(*to)?;
                if *to == replica {
                    return Err(StepError::AnswersItself { replica });
                }
                let delta = self.semantics.repair(&before, theirs).ok_or(StepError::NoAnswer { replica })?;
                sent = Some(self.send(Message { sender: replica, to: Some(*to), deltas: vec![delta] }));
                before.clone()
            }
        };
        self.states[replica].clone_from(&after);
        Ok(Stepped { replica, before, after, sent, locals })
    }

    /// Gives a replica a message of its own, as who has lost its state may need it.
    pub fn give_back(&mut self, message: usize) -> Result<Stepped<S>, StepError> {
        let sent = self.messages.len();
        let replica = self.messages.get(message).ok_or(StepError::NotSent { message, sent })?.sender;
        let before = self.states[replica].clone();
        let after = self.joined_with(&before, message);
        self.states[replica].clone_from(&after);
        Ok(Stepped { replica, before, after, sent: None, locals: Vec::new() })
    }

    fn joined_with(&self, state: &S::State, message: usize) -> S::State {
        self.semantics.join_all(state, &self.messages[message].deltas.iter().collect::<Vec<_>>())
    }

    /// Mutations one after the other.
    fn locals(&self, replica: usize, mutations: &[S::Mutation]) -> Result<Vec<Local<S>>, StepError> {
        let identity = self.identity(replica)?;
        if mutations.is_empty() {
            return Err(StepError::NothingMade { replica });
        }
        let mut now = self.state(replica)?.clone();
        let mut locals = Vec::with_capacity(mutations.len());
        for (at, mutation) in mutations.iter().enumerate() {
            let allowed = self.semantics.allows(&now, identity, mutation);
            let step = allowed.then(|| self.semantics.mutate(&now, identity, mutation)).flatten();
            let refused = || StepError::Refused { replica, at, mutation: mutation.to_string() };
            let step = step.ok_or_else(refused)?;
            let after = self.semantics.author_state(&now, &step);
            locals.push(Local { before: std::mem::replace(&mut now, after), step });
        }
        Ok(locals)
    }

    /// The deltas of a group: as one, if the semantics joins deltas.
    fn joined(&self, locals: &[Local<S>]) -> Vec<S::Delta> {
        let deltas = || locals.iter().map(|local| local.step.delta.clone());
        let mut rest = deltas();
        let first = rest.next();
        let whole = first.and_then(|first| {
            rest.try_fold(first, |whole, delta| self.semantics.join_deltas(&whole, &delta))
        });
        whole.map_or_else(|| deltas().collect(), |whole| vec![whole])
    }

    fn send(&mut self, message: Message<S::Delta>) -> usize {
        self.messages.push(message);
        self.messages.len() - 1
    }

    fn state(&self, replica: usize) -> Result<&S::State, StepError> {
        self.states.get(replica).ok_or(self.no_replica(replica))
    }

    fn no_replica(&self, replica: usize) -> StepError {
        StepError::NoReplica { replica, count: self.states.len() }
    }
}
