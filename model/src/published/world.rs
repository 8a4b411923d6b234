//! A moment of all replicas and of the network.

use super::message::Topic;
use super::setup::{Order, REPLICAS_MAX};

/// One copy of a message under way.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Letter {
    /// Who sent it, by position.
    pub from: usize,
    /// Who will get it.
    pub to: usize,
    /// What it travels on.
    pub topic: Topic,
    /// The how-manieth of its sender.
    pub number: u8,
    /// How many messages of each replica its sender had sent or received before.
    pub needs: [u8; REPLICAS_MAX],
    /// The message.
    pub message: u32,
}

/// Whether somebody has restarted.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(super) enum Restarted {
    /// Nobody has.
    #[default]
    Never,
    /// Somebody has.
    Once,
    /// The joiner has, has asked again, and was refused.
    Refused,
}

/// A moment. Replicas are numbers in the table of the space.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Default)]
pub(super) struct World {
    /// The state of each replica.
    pub(super) replicas: Vec<u32>,
    /// How many calls each has made.
    pub(super) made: [u8; REPLICAS_MAX],
    /// What is under way, in an order that depends only on what may be told apart.
    pub(super) letters: Vec<Letter>,
    /// For each replica, how many messages of each it has sent or received; kept for causal order only.
    pub(super) seen: [[u8; REPLICAS_MAX]; REPLICAS_MAX],
    /// Whom the joiner hears, by bit.
    pub(super) heard: u8,
    /// Whether the server has encoded its graph.
    pub(super) encoded: bool,
    /// Whether an early joiner has been told that it has joined.
    pub(super) told: bool,
    /// Whether somebody has restarted, and what came of it.
    pub(super) restart: Restarted,
    /// How many messages were lost.
    pub(super) lost: u8,
    /// How many deliveries were repeated.
    pub(super) repeated: u8,
}

impl World {
    /// How many calls were made, and encodings and restarts: what the clock counts.
    pub(super) fn depth(&self) -> u8 {
        self.made.iter().sum::<u8>() + u8::from(self.encoded) + u8::from(self.restart != Restarted::Never)
    }

    /// Sorts the letters so that equal moments are equal.
    pub(super) fn sort(&mut self, order: Order) {
        match order {
            Order::Causal | Order::Pair => self.letters.sort_by_key(|letter| (letter.from, letter.to)),
            Order::Topic => self.letters.sort_by_key(|letter| (letter.from, letter.to, letter.topic)),
            Order::Pool => self.letters.sort_by_key(|letter| {
                let any = matches!(letter.topic, Topic::Nodes | Topic::Edges);
                (letter.from, letter.to, letter.topic, if any { letter.message } else { 0 })
            }),
        }
    }

    /// Whether a letter may arrive next.
    pub(super) fn may_arrive(&self, at: usize, order: Order) -> bool {
        let letter = self.letters[at];
        let ahead =
            || self.letters[..at].iter().filter(|other| (other.from, other.to) == (letter.from, letter.to));
        match order {
            Order::Causal => {
                let seen = self.seen[letter.to];
                let ready = letter.needs.iter().zip(seen).all(|(&needs, seen)| needs <= seen);
                ready && seen[letter.from] == letter.number
            }
            Order::Pair => ahead().next().is_none(),
            Order::Topic => ahead().all(|other| other.topic != letter.topic),
            Order::Pool if matches!(letter.topic, Topic::Nodes | Topic::Edges) => {
                ahead().all(|other| other.message != letter.message)
            }
            Order::Pool => ahead().all(|other| other.topic != letter.topic),
        }
    }
}

/// One thing that happens.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Event {
    /// A replica makes a call.
    Call {
        /// Who, by position.
        replica: usize,
        /// The how-manieth of those that it may make.
        call: usize,
    },
    /// A message arrives.
    Deliver {
        /// Which copy.
        letter: Letter,
        /// Whether it will arrive again.
        again: bool,
    },
    /// A message is lost.
    Lose {
        /// Which copy.
        letter: Letter,
    },
    /// The joiner finds another replica, and the other it.
    Find {
        /// Whom.
        replica: usize,
    },
    /// The server encodes its whole graph for the joiner, and sends it.
    Encode,
    /// The joiner has the answer, and its user is told that it has joined.
    Tell,
    /// The joiner asks again, and is refused as a duplicate of itself.
    Refuse,
    /// A replica stops and starts again from what it had at first; what was under way to it is gone.
    Restart {
        /// Who.
        replica: usize,
    },
}
