//! Asks for what is missing, and answers who asks. `[spec: LINK-7]` `[spec: LINK-8]` `[spec: LINK-9]`

use super::Session;
use crate::flaw::Flaw;
use crate::inbox::Inbox;
use crate::origin::{Destination, Origin};
use crate::wire::{GROUP_STREAM, Item, Missing};

/// What to do about a stream of which something is missing.
enum Due {
    LookAgain,
    GiveUp,
    Ask(Vec<Missing>),
}

impl Session {
    fn due(&self, inbox: &Inbox) -> Option<Due> {
        inbox.want_at().filter(|&at| at <= self.now)?;
        let missing = inbox.missing(self.now, self.config.times.tail);
        Some(if missing.is_empty() || self.config.is_flawed(Flaw::ForgetsToWant) {
            Due::LookAgain
        } else if inbox.tries() >= self.config.bounds.wants {
            Due::GiveUp
        } else {
            Due::Ask(missing)
        })
    }

    /// Asks the group for what is missing of streams to it, and peers for what is missing of theirs.
    pub(super) fn run_wants(&mut self) {
        let origins: Vec<Origin> = self.peers.keys().copied().collect();
        for origin in origins {
            self.want_from_group(origin);
            let streams = self.peers.get(&origin).map(|peer| peer.incoming.keys().copied().collect());
            let streams: Vec<u32> = streams.unwrap_or_default();
            for stream in streams {
                self.want_from_peer(origin, stream);
            }
        }
    }

    fn want_from_group(&mut self, origin: Origin) {
        let peer = self.peers.get(&origin);
        let Some(due) = peer.and_then(|peer| peer.inbox.as_ref()).and_then(|inbox| self.due(inbox)) else {
            return;
        };
        let wait = self.patience();
        let peer = self.peers.get_mut(&origin);
        let Some(inbox) = peer.and_then(|peer| peer.inbox.as_mut()) else { return };
        match due {
            Due::LookAgain => inbox.look_again(self.now, wait + self.config.times.tail),
            Due::GiveUp => {
                inbox.give_up(&mut self.room);
                self.stats.given_up += 1;
                self.need(origin);
            }
            Due::Ask(missing) => {
                inbox.back_off(self.now, wait, &self.config.times);
                self.stats.wants += 1;
                let item = Item::Want { origin, stream: GROUP_STREAM, missing };
                self.say(Destination::Group, item);
            }
        }
    }

    fn want_from_peer(&mut self, origin: Origin, stream: u32) {
        let incoming = self.peers.get(&origin).and_then(|peer| peer.incoming.get(&stream));
        let Some(due) = incoming.and_then(|incoming| self.due(&incoming.inbox)) else { return };
        let wait = self.patience();
        let Some(peer) = self.peers.get_mut(&origin) else { return };
        let Some(incoming) = peer.incoming.get_mut(&stream) else { return };
        match due {
            Due::LookAgain => incoming.inbox.look_again(self.now, wait + self.config.times.tail),
            Due::GiveUp => {
                self.stats.given_up += 1;
                self.drop_incoming(origin, stream);
            }
            Due::Ask(missing) => {
                incoming.inbox.back_off(self.now, wait, &self.config.times);
                self.stats.wants += 1;
                let item = Item::Want { origin, stream, missing };
                let to = Destination::Peer(peer.address);
                self.say(to, item);
            }
        }
    }

    /// Somebody asks: this session, or another one for what is perhaps missing here, too.
    pub(super) fn hear_want(&mut self, sender: Origin, origin: Origin, stream: u32, missing: &[Missing]) {
        if origin == self.me {
            if stream == GROUP_STREAM {
                self.answer_group(missing);
            } else {
                self.answer_peer(sender, stream, missing);
            }
        } else if stream == GROUP_STREAM {
            self.hear_others_want(origin, missing);
        }
    }

    fn answer_group(&mut self, missing: &[Missing]) {
        let guard = self.config.times.guard;
        let answered = self.outbox.want(missing, self.now, guard);
        self.stats.resent += answered.parts;
        let guarded = self.gone_said_at.is_some_and(|at| self.now < at.saturating_add(guard));
        if answered.gone && !guarded {
            self.gone_said_at = Some(self.now);
            self.stats.gone_said += 1;
            let gone = Item::Gone { stream: GROUP_STREAM, below: self.outbox.oldest() };
            self.say(Destination::Group, gone);
        }
    }

    fn answer_peer(&mut self, sender: Origin, stream: u32, missing: &[Missing]) {
        let Some(peer) = self.peers.get(&sender) else { return };
        let outgoing = self.outgoing.get_mut(&stream).filter(|outgoing| outgoing.to == sender);
        if let Some(outgoing) = outgoing {
            outgoing.is_heard(self.now, &self.config.times);
            self.stats.resent += outgoing.outbox.want(missing, self.now, self.config.times.guard).parts;
        } else {
            let gone = Item::Gone { stream, below: u64::MAX };
            self.say(Destination::Peer(peer.address), gone);
        }
    }

    /// If all that is missing here has been asked for, this session waits for the answer. `[spec: LINK-7]`
    fn hear_others_want(&mut self, origin: Origin, theirs: &[Missing]) {
        let wait = self.patience();
        let (now, tail) = (self.now, self.config.times.tail);
        let peer = self.peers.get_mut(&origin);
        let Some(inbox) = peer.and_then(|peer| peer.inbox.as_mut()) else { return };
        if inbox.want_at().is_none() {
            return;
        }
        let ours = inbox.missing(now, tail);
        if !ours.is_empty() && ours.iter().all(|ours| theirs.iter().any(|theirs| theirs.covers(ours))) {
            inbox.back_off(now, wait, &self.config.times);
            self.stats.suppressed += 1;
        }
    }

    /// A stream of the sender has lost what was before a number. `[spec: LINK-9]`
    pub(super) fn hear_gone(&mut self, sender: Origin, stream: u32, below: u64) {
        if stream != GROUP_STREAM {
            self.drop_incoming(sender, stream);
            return;
        }
        let peer = self.peers.get_mut(&sender);
        let Some(inbox) = peer.and_then(|peer| peer.inbox.as_mut()) else { return };
        if inbox.skip(below, &mut self.room) {
            self.stats.gone_heard += 1;
            if !self.config.is_flawed(Flaw::GoneIsIgnored) {
                self.need(sender);
            }
        }
    }
}

impl Missing {
    /// Whether all of another request is asked for by this one.
    fn covers(&self, other: &Self) -> bool {
        let numbers = self.first <= other.first && other.last <= self.last;
        let within = |part: &(u32, u32)| self.parts.iter().any(|run| run.0 <= part.0 && part.1 <= run.1);
        numbers && (self.parts.is_empty() || !other.parts.is_empty() && other.parts.iter().all(within))
    }
}
