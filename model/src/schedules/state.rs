//! A moment of all replicas and of the network.

use super::RESYNCHRONISATIONS_MAX;
use crate::checked::INCARNATION;
use crate::histories::{MUTATIONS_MAX, REPLICAS_MAX};
use crate::search::hash_numbers;
use crate::tables::{DeltaId, NONE, StateId};
use std::hash::{Hash, Hasher};

/// The states of all replicas, what was broadcast, and which copies are still under way.
///
/// Of a copy that is no longer under way it does not matter whether it was delivered or lost: the
/// receiver's state says so.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Schedule {
    /// Per replica, its state.
    pub states: [StateId; REPLICAS_MAX],
    /// Per replica, the deltas that it broadcast, in order.
    pub deltas: [[DeltaId; MUTATIONS_MAX]; REPLICAS_MAX],
    /// Answers to resynchronisations that are under way: to whom, and what.
    pub answers: [(u8, DeltaId); RESYNCHRONISATIONS_MAX],
    /// How often each replica has restarted.
    pub incarnations: [u8; REPLICAS_MAX],
    /// Resynchronisations so far.
    pub resynchronisations: u8,
    /// One bit for each copy of each delta to each replica.
    in_flight: u64,
}

/// No answer.
pub(super) const NO_ANSWER: (u8, DeltaId) = (0, NONE);

/// Something under way to one replica.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Message {
    /// A copy of a delta.
    Delta {
        /// Who broadcast it.
        author: usize,
        /// The how-manieth of its author.
        made: usize,
    },
    /// An answer to a resynchronisation.
    Answer(usize),
}

/// One thing that happens.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Event {
    /// A replica mutates; copies go to all others.
    Mutate {
        /// Who.
        replica: usize,
        /// What is broadcast.
        delta: DeltaId,
    },
    /// A copy arrives, and may arrive again.
    Deliver {
        /// At whom.
        replica: usize,
        /// What.
        message: Message,
        /// Whether a duplicate is still under way.
        again: bool,
    },
    /// A copy is lost.
    Lose {
        /// For whom.
        replica: usize,
        /// What.
        message: Message,
    },
    /// A replica stops and starts again under its next incarnation.
    Restart {
        /// Who.
        replica: usize,
        /// Whether it has kept its state, or starts from the initial one.
        keeps: bool,
    },
    /// A replica sends its digest and is answered; the answer is under way.
    Resynchronise {
        /// Who asks.
        replica: usize,
        /// Who answers.
        from: usize,
    },
}

impl Event {
    /// Who acts.
    pub const fn replica(&self) -> usize {
        match *self {
            Self::Mutate { replica, .. }
            | Self::Deliver { replica, .. }
            | Self::Lose { replica, .. }
            | Self::Restart { replica, .. }
            | Self::Resynchronise { replica, .. } => replica,
        }
    }
}

impl Hash for Schedule {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        hash_numbers(&self.states, hasher);
        hash_numbers(self.deltas.as_flattened(), hasher);
        for &(to, delta) in &self.answers {
            hash_numbers(&[u32::from(to), delta], hasher);
        }
        hasher.write_u32(u32::from_le_bytes(self.incarnations));
        hasher.write_u8(self.resynchronisations);
        hasher.write_u64(self.in_flight);
    }
}

fn bit(author: usize, made: usize, to: usize) -> u64 {
    1 << ((author * MUTATIONS_MAX + made) * REPLICAS_MAX + to)
}

impl Schedule {
    /// The moment before anything has happened.
    pub(super) fn start(initial: StateId, everybody: usize) -> Self {
        let mut states = [NONE; REPLICAS_MAX];
        states[..everybody].fill(initial);
        Self {
            states,
            deltas: [[NONE; MUTATIONS_MAX]; REPLICAS_MAX],
            answers: [NO_ANSWER; RESYNCHRONISATIONS_MAX],
            incarnations: [0; REPLICAS_MAX],
            resynchronisations: 0,
            in_flight: 0,
        }
    }

    /// The index by which a replica mutates: its own, and its incarnation. `[spec: CRASH-2]`
    pub fn identity(&self, replica: usize) -> usize {
        replica + INCARNATION * usize::from(self.incarnations[replica])
    }

    /// How many mutations a replica has made.
    pub fn made(&self, replica: usize) -> usize {
        self.deltas[replica].iter().take_while(|&&delta| delta != NONE).count()
    }

    /// Every delta broadcast.
    pub fn pool(&self) -> impl Iterator<Item = DeltaId> + '_ {
        self.deltas.iter().flatten().copied().filter(|&delta| delta != NONE)
    }

    /// How many restarts there were.
    pub fn restarts(&self) -> u8 {
        self.incarnations.iter().sum()
    }

    /// Everything under way, with its receiver.
    pub fn under_way(&self, everybody: usize) -> impl Iterator<Item = (Message, usize)> + '_ {
        let copies = (0..REPLICAS_MAX).flat_map(move |author| {
            (0..self.made(author)).flat_map(move |made| (0..everybody).map(move |to| (author, made, to)))
        });
        let copies = copies.filter(|&(author, made, to)| self.in_flight & bit(author, made, to) != 0);
        let answers = self.answers.iter().enumerate().filter(|(_, answer)| **answer != NO_ANSWER);
        copies
            .map(|(author, made, to)| (Message::Delta { author, made }, to))
            .chain(answers.map(|(at, answer)| (Message::Answer(at), usize::from(answer.0))))
    }

    /// The delta in a message.
    pub fn content(&self, message: Message) -> DeltaId {
        match message {
            Message::Delta { author, made } => self.deltas[author][made],
            Message::Answer(at) => self.answers[at].1,
        }
    }

    /// Whether nothing that its author sent before a message is still under way to a replica.
    pub(super) fn is_next(&self, message: Message, to: usize) -> bool {
        match message {
            Message::Delta { author, made } => {
                (0..made).all(|made| self.in_flight & bit(author, made, to) == 0)
            }
            Message::Answer(_) => true,
        }
    }

    /// Broadcasts a delta to everybody else.
    pub(super) fn broadcast(&mut self, author: usize, delta: DeltaId, everybody: usize) {
        let made = self.made(author);
        self.deltas[author][made] = delta;
        for to in (0..everybody).filter(|&to| to != author) {
            self.in_flight |= bit(author, made, to);
        }
    }

    /// Takes a message off the network.
    pub(super) fn remove(&mut self, message: Message, to: usize) {
        match message {
            Message::Delta { author, made } => self.in_flight &= !bit(author, made, to),
            Message::Answer(at) => {
                self.answers[at] = NO_ANSWER;
                // Which slot an answer takes makes no difference.
                self.answers.sort_unstable_by_key(|answer| (answer.1, answer.0));
            }
        }
    }
}
