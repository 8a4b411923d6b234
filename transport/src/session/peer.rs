//! What is known of one other member.

use crate::inbox::Inbox;
use crate::origin::Address;
use crate::runs::Runs;
use std::collections::BTreeMap;

/// A peer.
#[derive(Clone, Debug)]
pub(super) struct Peer {
    pub(super) address: Address,
    /// Empty until it has said it.
    pub(super) name: String,
    pub(super) heard_at: u64,
    /// Its stream to the group, once a number of it is known. `[spec: LINK-14]`
    pub(super) inbox: Option<Inbox>,
    /// Its streams to this session.
    pub(super) incoming: BTreeMap<u32, Incoming>,
    /// Those that are done.
    pub(super) done: Runs,
    /// Something is lacking that only a digest can bring. `[spec: LINK-12]`
    pub(super) need: bool,
    /// Since when fingerprints differ.
    pub(super) differs_since: Option<u64>,
    /// Until when it is not asked, and how often it was asked since fingerprints were equal.
    pub(super) quiet_until: u64,
    pub(super) asked: u32,
    /// Exchanges that it has let stall, since it answered one.
    pub(super) stalls: u32,
}

/// A stream of a peer to this session. `[spec: LINK-10]`
#[derive(Clone, Debug)]
pub(super) struct Incoming {
    pub(super) inbox: Inbox,
    /// When to acknowledge.
    pub(super) ack_at: Option<u64>,
    /// The number of the last message, once it is known.
    pub(super) last: Option<u64>,
    /// The digest of this session that it answers, once it has said so.
    pub(super) answers: Option<u32>,
}

impl Peer {
    pub(super) fn new(address: Address, now: u64) -> Self {
        Self {
            address,
            name: String::new(),
            heard_at: now,
            inbox: None,
            incoming: BTreeMap::new(),
            done: Runs::default(),
            need: true,
            differs_since: None,
            quiet_until: 0,
            asked: 0,
            stalls: 0,
        }
    }

    /// Its stream to the group, met at a number if it was not met before. What was before that is lacking, also if
    /// an exchange has ended already: the answer may be older. `[spec: LINK-14]`
    pub(super) fn inbox_from(&mut self, number: u64) -> &mut Inbox {
        self.need |= self.inbox.is_none();
        self.inbox.get_or_insert_with(|| Inbox::from(number))
    }

    /// The bytes of messages that are not complete.
    pub(super) fn begun_bytes(&self) -> usize {
        let group = self.inbox.as_ref().map_or(0, Inbox::begun_bytes);
        group + self.incoming.values().map(|incoming| incoming.inbox.begun_bytes()).sum::<usize>()
    }

    /// Since when a digest is due, if it is: at once where one is needed, else after a settling time without
    /// a gap. `[spec: LINK-12]`
    pub(super) fn ask_at(&self, settle: u64) -> Option<u64> {
        let settled = || {
            let quiet = self.inbox.as_ref().is_none_or(Inbox::is_complete);
            self.differs_since.filter(|_| quiet).map(|since| since.saturating_add(settle))
        };
        let due = if self.need { Some(0) } else { settled() };
        due.map(|due| due.max(self.quiet_until))
    }
}

impl Incoming {
    pub(super) fn new() -> Self {
        Self { inbox: Inbox::from(1), ack_at: None, last: None, answers: None }
    }

    /// Whether all of it has come.
    pub(super) fn is_done(&self) -> bool {
        self.last.is_some_and(|last| self.inbox.below() > last)
    }
}
