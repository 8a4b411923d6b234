//! From datagrams to items. `[spec: LINK-1]` `[spec: LINK-6]`

use super::Session;
use super::peer::{Incoming, Peer};
use crate::action::{Action, Presence};
use crate::config::MS;
use crate::flaw::Flaw;
use crate::inbox::Taken;
use crate::origin::{Address, Destination, Origin};
use crate::wire::{Datagram, GROUP_STREAM, Item, Part};

/// How soon a new peer is told that this session is there.
const GREETING: u64 = 10 * MS;

impl Session {
    /// Takes any bytes: what is no datagram of this group is counted, and has no other effect.
    pub(super) fn receive(&mut self, from: Address, bytes: &[u8]) {
        if self.phase.is_over() {
            return;
        }
        let Ok(datagram) = Datagram::decode(bytes, self.config.group) else {
            self.stats.refused += 1;
            return;
        };
        let sender = datagram.sender;
        if sender == self.me {
            // The group hears itself.
            return;
        }
        self.stats.received += 1;
        if let Some(peer) = self.peers.get_mut(&sender) {
            (peer.address, peer.heard_at) = (from, self.now);
        }
        for item in datagram.items {
            self.take(sender, from, item);
        }
        self.consider_resync();
    }

    fn take(&mut self, sender: Origin, from: Address, item: Item) {
        match item {
            Item::Part(part) => {
                self.hear_of_agent(sender, from);
                if self.meet(sender, from) {
                    self.take_part(sender, part);
                }
            }
            Item::Beat { high, oldest, fingerprint, name } => {
                self.hear_of_agent(sender, from);
                if self.meet(sender, from) {
                    self.introduce(sender, name);
                    self.hear_beat(sender, high, oldest, fingerprint);
                }
            }
            Item::Want { origin, stream, missing } => self.hear_want(sender, origin, stream, &missing),
            Item::Gone { stream, below } => self.hear_gone(sender, stream, below),
            Item::Ack { stream, below, received } => self.hear_ack(sender, stream, below, received),
            Item::Hello { .. } => self.hear_hello(sender, from),
            Item::Object { to, name } => self.hear_objection(sender, to, name),
            Item::Bye => self.part_with(sender, Presence::Left),
        }
    }

    /// Makes a peer of a sender, if there is room; whether it is one.
    fn meet(&mut self, sender: Origin, from: Address) -> bool {
        if self.peers.contains_key(&sender) {
            return true;
        }
        if self.peers.len() >= self.config.bounds.peers {
            self.stats.overflows += 1;
            return false;
        }
        self.peers.insert(sender, Peer::new(from, self.now));
        self.greet(GREETING);
        true
    }

    fn introduce(&mut self, sender: Origin, name: String) {
        let Some(peer) = self.peers.get_mut(&sender) else { return };
        if peer.name.is_empty() {
            peer.name = if name.is_empty() { sender.replica.to_string() } else { name };
            let (name, presence) = (peer.name.clone(), Presence::Joined);
            self.actions.push_back(Action::Peer { origin: sender, name, presence });
        }
    }

    /// Forgets a peer, and gives back what it took. `[spec: LINK-16]`
    pub(super) fn part_with(&mut self, origin: Origin, presence: Presence) {
        let Some(peer) = self.peers.remove(&origin) else { return };
        self.room += peer.begun_bytes();
        self.outgoing.retain(|_, outgoing| outgoing.to != origin);
        self.resync.part_with(origin);
        if !peer.name.is_empty() {
            self.actions.push_back(Action::Peer { origin, name: peer.name, presence });
        }
    }

    fn take_part(&mut self, sender: Origin, part: Part) {
        if part.stream == GROUP_STREAM {
            self.take_from_group(sender, part);
        } else if part.to == self.me.nonce {
            self.take_from_peer(sender, part);
        }
    }

    fn take_from_group(&mut self, sender: Origin, part: Part) {
        let wait = self.patience();
        let Some(peer) = self.peers.get_mut(&sender) else { return };
        let number = part.number;
        let several = part.count > 1;
        let inbox = peer.inbox_from(number);
        let taken = inbox.take(part, self.now, &mut self.room, &self.config.bounds);
        inbox.watch(self.now, wait);
        if taken == Taken::NoRoom && self.config.is_flawed(Flaw::DropsSilently) {
            inbox.pretend(number);
        }
        let overrun = inbox.was_overrun();
        self.count(&taken);
        if overrun {
            self.stats.overflows += 1;
            self.need(sender);
        }
        if let Taken::Complete(bytes) = taken {
            let bytes = self.assembled(bytes, several);
            self.deliver_delta(sender, &bytes);
        }
    }

    fn take_from_peer(&mut self, sender: Origin, part: Part) {
        let wait = self.patience();
        let Some(peer) = self.peers.get_mut(&sender) else { return };
        let (stream, number, several) = (part.stream, part.number, part.count > 1);
        let address = Destination::Peer(peer.address);
        if peer.done.contains(stream.into()) {
            self.say(address, Item::Ack { stream, below: u64::MAX, received: u64::MAX });
            return;
        }
        if !peer.incoming.contains_key(&stream) && peer.incoming.len() >= self.config.bounds.incoming {
            self.stats.overflows += 1;
            return;
        }
        let incoming = peer.incoming.entry(stream).or_insert_with(Incoming::new);
        let taken = incoming.inbox.take(part, self.now, &mut self.room, &self.config.bounds);
        incoming.inbox.watch(self.now, wait);
        if taken == Taken::Known {
            // Perhaps a probe: then the sender knows nothing of what has not come.
            incoming.inbox.hurry(self.now, wait);
        }
        incoming.ack_at = incoming.ack_at.or(Some(self.now.saturating_add(self.config.times.ack)));
        let overrun = incoming.inbox.was_overrun();
        self.count(&taken);
        self.resync.progress(sender, self.now);
        if let Taken::Complete(bytes) = taken {
            let bytes = self.assembled(bytes, several);
            self.deliver(sender, stream, number, &bytes);
            if overrun {
                self.stats.overflows += 1;
                self.drop_incoming(sender, stream);
            } else {
                self.acknowledge(sender, stream);
            }
        }
    }

    fn count(&mut self, taken: &Taken) {
        match taken {
            Taken::Known => self.stats.repeated += 1,
            Taken::NoRoom => self.stats.overflows += 1,
            Taken::Contradicts => self.stats.contradicting += 1,
            Taken::Kept | Taken::Complete(_) => {}
        }
    }

    /// The bytes of a message, of which a broken session puts the parts together in the wrong order.
    fn assembled(&self, mut bytes: Vec<u8>, several: bool) -> Vec<u8> {
        if several && self.config.is_flawed(Flaw::PartsReversed) {
            let middle = bytes.len() / 2;
            bytes.rotate_left(middle);
        }
        bytes
    }
}
