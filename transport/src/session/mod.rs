//! One member of a group: a replica, and the protocol that keeps it equal to the others.
//!
//! | room | what it does |
//! |---|---|
//! | [`peer`] | what is known of one other member |
//! | [`receive`], [`deliver`] | from datagrams to messages, from messages to the replica |
//! | [`want`] | asks for what is missing; answers who asks |
//! | [`beat`] | tells how far it is, and hears how far others are |
//! | [`resync`] | digests, answers, one exchange at a time |
//! | [`outgoing`] | streams to one peer: windows, acknowledgements, probes |
//! | [`claim`] | the agent id |
//! | [`send`] | from queues to datagrams |
//! | [`timers`] | what is due, and when the next is |

mod beat;
mod claim;
mod deliver;
mod outgoing;
mod peer;
mod receive;
mod resync;
mod send;
mod timers;
mod want;

use crate::action::{Action, Cause, Event, MutateError};
use crate::config::{Config, MS};
use crate::message::Message;
use crate::origin::{Destination, Origin};
use crate::outbox::Outbox;
use crate::pacing::Pacing;
use crate::stats::Stats;
use crate::wire::{GROUP_STREAM, HEADER_BYTES, Item, MESSAGE_BYTES_MAX, PART_BYTES};
use beat::{Beats, Print};
use claim::Phase;
use dsr_core::{Delta, Graph, Mutated, Mutation, Replica};
use outgoing::Outgoing;
use peer::Peer;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};
use resync::Resync;
use std::collections::{BTreeMap, VecDeque};

/// A replica and its protocol: events in, actions out. It owns no clock, no randomness and no socket: equal
/// events at equal times with equal seeds lead to equal actions. `[spec: LINK-2]`
///
/// ```
/// use dsr_core::{Dictionary, Mutation, NewVertex, ReplicaId, VertexId, VertexLink};
/// use dsr_transport::{Action, Config, Event, Session};
///
/// let config = Config::new(ReplicaId::agent(1), 7, "planner", "lab", Dictionary::open());
/// let mut session = Session::new(config, 1, 0);
/// let mut now = 0;
/// while session.is_claiming() {
///     while let Some(action) = session.poll_action() {
///         assert!(matches!(action, Action::Send { .. }), "it claims its agent id");
///     }
///     now = session.next_wake().unwrap_or(now);
///     session.handle(Event::Tick, now);
/// }
/// let vertex = NewVertex::new("room", "kitchen");
/// let mutation = Mutation::AddVertex { vertex, link: VertexLink::child_of(VertexId::ROOT) };
/// session.mutate(&mutation, 0, now)?;
/// # Ok::<(), dsr_transport::MutateError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Session {
    config: Config,
    me: Origin,
    replica: Replica,
    random: ChaCha8Rng,
    /// The latest time, which never goes back, and what is added to the caller's.
    now: u64,
    skew: u64,
    started_at: u64,
    phase: Phase,
    outbox: Outbox,
    peers: BTreeMap<Origin, Peer>,
    outgoing: BTreeMap<u32, Outgoing>,
    /// The stream that was served last.
    turn: u32,
    control: VecDeque<(Destination, Item)>,
    actions: VecDeque<Action>,
    pacing: Pacing,
    beats: Beats,
    print: Print,
    resync: Resync,
    /// What is left of the room for messages that are not complete.
    room: usize,
    gone_said_at: Option<u64>,
    stats: Stats,
}

impl Session {
    /// A session that has seen nothing, and begins to claim its agent id. `seed` is for what is random in it,
    /// `now` in nanoseconds since any start. `[spec: LINK-2]`
    pub fn new(config: Config, seed: u64, now: u64) -> Self {
        let replica = Replica::new(config.replica, config.dictionary.clone());
        Self::on(config, replica.snapshot(), seed, now)
    }

    /// A session that goes on from a graph: what a scene holds, or what an earlier session has saved.
    pub fn on(config: Config, graph: Graph, seed: u64, now: u64) -> Self {
        let me = Origin { replica: config.replica, nonce: config.nonce };
        let overhead = HEADER_BYTES + PART_BYTES;
        let part = config.bounds.datagram_bytes.saturating_sub(overhead).max(64);
        let mut session = Self {
            me,
            replica: Replica::on(config.replica, graph),
            random: ChaCha8Rng::seed_from_u64(seed),
            now,
            skew: 0,
            started_at: now,
            phase: Phase::claiming(&config, now),
            outbox: Outbox::new(GROUP_STREAM, 0, u32::try_from(part).unwrap_or(u32::MAX)),
            peers: BTreeMap::new(),
            outgoing: BTreeMap::new(),
            turn: 0,
            control: VecDeque::new(),
            actions: VecDeque::new(),
            pacing: Pacing::new(config.bounds.bytes_per_second, config.bounds.burst_bytes, now),
            beats: Beats::new(now),
            print: Print::default(),
            resync: Resync::default(),
            room: config.bounds.begun_bytes,
            gone_said_at: None,
            stats: Stats::default(),
            config,
        };
        session.run_timers();
        session
    }

    /// Takes an event. Then [`poll_action`](Self::poll_action) until there is no more.
    pub fn handle(&mut self, event: Event<'_>, now: u64) {
        self.pass_time(now);
        match event {
            Event::Datagram { from, bytes } => self.receive(from, bytes),
            Event::Tick => self.run_timers(),
            Event::Leave => self.leave(),
        }
    }

    /// Carries out a mutation here, and queues its delta for the group. `timestamp_ns` is for readers, as in
    /// [`Replica::mutate`]. `[spec: LINK-5]` `[spec: LINK-10]`
    pub fn mutate(
        &mut self,
        mutation: &Mutation,
        timestamp_ns: u64,
        now: u64,
    ) -> Result<Mutated, MutateError> {
        self.pass_time(now);
        self.may_write()?;
        let (queued, max) = (self.outbox.queued_bytes(), self.config.bounds.queued_bytes);
        if queued >= max {
            self.stats.busy += 1;
            return Err(MutateError::Busy { queued, max });
        }
        let made = self.replica.mutate(mutation, timestamp_ns)?;
        self.publish(&made.delta);
        if !made.changes.is_empty() {
            self.actions.push_back(Action::Changed { changes: made.changes.clone(), cause: Cause::Local });
        }
        Ok(made)
    }

    fn publish(&mut self, delta: &Delta) {
        let bytes = Message::Delta(delta.clone()).encode();
        if bytes.len() <= MESSAGE_BYTES_MAX {
            self.outbox.push(bytes);
        } else {
            // Only a delta of several values is so large, and a piece holds one of any size. [spec: SYNC-6]
            for piece in delta.pieces(MESSAGE_BYTES_MAX / 2) {
                self.outbox.push(Message::Delta(piece).encode());
            }
        }
        self.print.has_changed();
        self.beat_after_delta();
    }

    /// What is to be done next. A caller that cannot send for a while need not ask: then datagrams wait here,
    /// within bounds.
    pub fn poll_action(&mut self) -> Option<Action> {
        self.actions.pop_front().or_else(|| self.next_datagram())
    }

    fn pass_time(&mut self, now: u64) {
        let shifted = now.saturating_add(self.skew);
        if shifted < self.now {
            // The caller's clock has gone back: this one stands still for a moment, and goes on from there.
            self.skew += self.now - shifted;
        }
        self.now = self.now.max(shifted);
    }

    /// A duration below `spread`, at random.
    fn draw(&mut self, spread: u64) -> u64 {
        if spread == 0 { 0 } else { self.random.next_u64() % spread }
    }

    /// How long what is missing is waited for.
    fn patience(&mut self) -> u64 {
        self.config.times.reorder + self.draw(self.config.times.spread)
    }

    /// The graph as it is now, for readers. O(1). `[spec: REPLICA-2]`
    pub fn snapshot(&self) -> Graph {
        self.replica.snapshot()
    }

    /// The replica, to read.
    pub fn replica(&self) -> &Replica {
        &self.replica
    }

    /// Who this is.
    pub fn origin(&self) -> Origin {
        self.me
    }

    /// Every peer that is there, with its name.
    pub fn peers(&self) -> impl Iterator<Item = (Origin, &str)> {
        self.peers.iter().map(|(&origin, peer)| (origin, &*peer.name))
    }

    /// What it has done so far.
    pub fn stats(&self) -> Stats {
        self.stats
    }

    /// Bytes of deltas that wait to be sent. `[spec: LINK-10]`
    pub fn queued_bytes(&self) -> usize {
        self.outbox.queued_bytes()
    }

    /// Whether something is known to be missing: messages that exist and have not come.
    pub fn has_gaps(&self) -> bool {
        self.peers.values().any(|peer| peer.inbox.as_ref().is_some_and(|inbox| !inbox.is_complete()))
    }

    /// The bytes of messages that have not come in whole. `[spec: LINK-6]`
    pub fn begun_bytes(&self) -> usize {
        self.config.bounds.begun_bytes - self.room
    }

    /// The time up to which beats and fingerprints are not made anew.
    const PRINT_EVERY: u64 = 50 * MS;
}
