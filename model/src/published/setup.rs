//! Several replicas: what they start from, what each may call, what the network and the machines may do.

use super::operation::Operation;
use super::property::Property;
use super::replica::Replica;
use super::variant::Variant;
use super::world::{Restarted, World};
use super::{AgentId, Key, Kind, NodeId, Time, Value};
use std::collections::BTreeSet;

/// How many replicas there can be.
pub const REPLICAS_MAX: usize = 4;

/// What must be so at a replica before it makes a call.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Guard {
    /// Nothing.
    Always,
    /// It shows a number.
    Shows(NodeId, Key, i64),
    /// It shows a node, without this attribute.
    Lacks(NodeId, Key),
    /// It has no gap in what it has seen of an attribute.
    Gapless(NodeId, Key),
    /// It does not show an edge of this start, end and type.
    Unlinked(NodeId, NodeId, Kind),
    /// It shows such an edge.
    Linked(NodeId, NodeId, Kind),
    /// It knows that a node is deleted.
    Gone(NodeId),
    /// Another replica has made so many calls: an order in time that no message tells of.
    Made(usize, u8),
    /// The server has encoded its graph for the joiner.
    Encoded,
    /// Somebody has restarted.
    Restarted,
}

impl Guard {
    /// Whether it holds at a replica.
    pub(super) fn allows(self, world: &World, replica: &Replica) -> bool {
        match self {
            Self::Always => true,
            Self::Shows(node, key, value) => {
                replica.attribute(node, key).is_some_and(|held| held.value == Value::Number(value))
            }
            Self::Lacks(node, key) => {
                replica.node(node).is_some_and(|node| !node.attributes.contains_key(key))
            }
            Self::Gapless(node, key) => {
                let register = replica.node(node).and_then(|node| node.attributes.get(key));
                register.is_none_or(|register| register.context().cloud().next().is_none())
            }
            Self::Unlinked(from, to, kind) => replica.edge((from, to, kind)).is_none(),
            Self::Linked(from, to, kind) => replica.edge((from, to, kind)).is_some(),
            Self::Gone(node) => replica.deleted.contains(&node),
            Self::Made(other, calls) => world.made[other] >= calls,
            Self::Encoded => world.encoded,
            Self::Restarted => world.restart != Restarted::Never,
        }
    }
}

/// What one replica may call.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Play {
    /// The calls, each with its condition.
    pub calls: Vec<(Guard, Operation)>,
    /// Whether they are made once each and in this order; otherwise in any order, and again.
    pub in_order: bool,
    /// How many are made at most.
    pub calls_max: u8,
}

impl Play {
    /// Each of these once, in this order.
    pub fn script(calls: &[(Guard, Operation)]) -> Self {
        let calls_max = u8::try_from(calls.len()).unwrap_or(u8::MAX);
        Self { calls: calls.to_vec(), in_order: true, calls_max }
    }

    /// As many calls as there are of these, in any order, each as often as it is allowed.
    pub fn free(calls: &[(Guard, Operation)]) -> Self {
        Self { in_order: false, ..Self::script(calls) }
    }

    /// Up to so many of these, in any order.
    pub fn any(operations: &[Operation], calls_max: u8) -> Self {
        let calls = operations.iter().map(|&operation| (Guard::Always, operation)).collect();
        Self { calls, in_order: false, calls_max }
    }
}

/// In which order messages may arrive, from the strictest network to the freest.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Order {
    /// After all that their sender had sent or received before. No published network does this; it shows
    /// which faults need disorder. Not for losses, restarts or joiners.
    Causal,
    /// From one sender to one receiver, as sent.
    Pair,
    /// From one sender to one receiver on one topic, as sent.
    Topic,
    /// As by topic, but nodes and edges in any order: upstream hands them to several threads.
    Pool,
}

/// One who joins while the others run.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Joiner {
    /// Which replica.
    pub replica: usize,
    /// Whom it asks for the whole graph.
    pub server: usize,
    /// Whom it hears from the start; it finds the others later, one by one.
    pub hears: Vec<usize>,
    /// What must be so at the server before it is asked.
    pub asks: Guard,
    /// Whether it counts as joined once it has the answer, which another thread then takes in.
    pub early: bool,
    /// Whether it asks again after a restart. Who has been answered counts as connected until its lease ends, so it
    /// is refused as a duplicate of itself, and gives up.
    pub again: bool,
}

/// What the network and the machines may do.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Powers {
    /// In which order messages arrive.
    pub order: Order,
    /// How many messages may be lost.
    pub losses_max: u8,
    /// How many deliveries may be repeated.
    pub duplicates_max: u8,
    /// Who may restart once, from what it started with, and what must be so there before.
    pub restarts: Option<(usize, Guard)>,
    /// Who joins.
    pub joiner: Option<Joiner>,
    /// A node whose copy reaches a replica only when all else has happened. Only where nodes may arrive in
    /// any order.
    pub slow: Option<(NodeId, usize)>,
    /// By how many nanoseconds each replica's clock is ahead of the right time. One call takes
    /// [`CALL_TIME`].
    pub ahead: Vec<Time>,
}

/// The time from one call to the next, in nanoseconds.
pub const CALL_TIME: Time = 1000;

impl Powers {
    /// An ordinary network of this order, with right clocks.
    pub const fn ordered(order: Order) -> Self {
        Self {
            order,
            losses_max: 0,
            duplicates_max: 0,
            restarts: None,
            joiner: None,
            slow: None,
            ahead: Vec::new(),
        }
    }
}

/// When a property is judged.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum When {
    /// At every moment.
    Always,
    /// When nothing is under way, and who joins has joined and heard of everybody.
    Quiet,
    /// When besides that all calls have been made.
    Finished,
}

/// All that a search is given.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Setup {
    /// Which implementation.
    pub variant: Variant,
    /// The agents, one for each replica.
    pub agents: Vec<AgentId>,
    /// What the first replica has called before the search, with all of it delivered to everybody but a
    /// joiner.
    pub before: Vec<Operation>,
    /// Attributes that the first replica ignores from then on.
    pub ignored: Vec<Key>,
    /// What each replica may call.
    pub plays: Vec<Play>,
    /// What else may happen.
    pub powers: Powers,
    /// What ought not to be found.
    pub property: Property,
    /// When it is judged.
    pub when: When,
}

impl Setup {
    /// How many replicas.
    pub fn replicas(&self) -> usize {
        self.agents.len().min(REPLICAS_MAX)
    }

    /// What everybody starts with: the first replica has made its calls, and everybody but a joiner has got
    /// the messages. The calls are timed before all others.
    pub(super) fn initial(&self) -> Vec<Replica> {
        let new = |&agent| Replica::new(agent, self.variant, BTreeSet::new());
        let mut replicas: Vec<Replica> = self.agents.iter().take(REPLICAS_MAX).map(new).collect();
        let joiner = self.powers.joiner.as_ref().map(|joiner| joiner.replica);
        let Some((first, others)) = replicas.split_first_mut() else { return replicas };
        for (time, operation) in (0..).zip(&self.before) {
            let messages = first.call(operation, time).ok().flatten().unwrap_or_default();
            let hears = |at: usize| Some(at + 1) != joiner;
            let others = others.iter_mut().enumerate().filter(|(at, _)| hears(*at));
            for (_, other) in others {
                let received = messages.iter().try_for_each(|message| other.receive(message));
                other.crash = other.crash.or(received.err());
            }
        }
        first.ignored = self.ignored.iter().copied().collect();
        replicas
    }
}
