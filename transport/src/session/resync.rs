//! Exchanges of a digest and its answer, one at a time. `[spec: LINK-12]` `[spec: LINK-13]` `[spec: LINK-14]`

use super::Session;
use super::outgoing::Outgoing;
use crate::action::Action;
use crate::flaw::Flaw;
use crate::message::Message;
use crate::origin::Origin;
use dsr_core::Digest;

/// The exchange that is under way, and when the next one begins.
#[derive(Clone, Debug, Default)]
pub(super) struct Resync {
    exchange: Option<Exchange>,
    begins_at: Option<u64>,
    /// Whose answer has brought a part and was broken off.
    broken_off: Option<Origin>,
    streams: u32,
    synced: bool,
}

#[derive(Clone, Debug)]
struct Exchange {
    peer: Origin,
    stream: u32,
    progress_at: u64,
    learned: bool,
    needed: bool,
}

impl Resync {
    pub(super) fn progress(&mut self, from: Origin, now: u64) {
        if let Some(exchange) = self.exchange.as_mut().filter(|exchange| exchange.peer == from) {
            exchange.progress_at = now;
        }
    }

    pub(super) fn has_learned(&mut self, from: Origin) {
        if let Some(exchange) = self.exchange.as_mut().filter(|exchange| exchange.peer == from) {
            exchange.learned = true;
        }
    }

    pub(super) fn part_with(&mut self, peer: Origin) {
        if self.exchange.as_ref().is_some_and(|exchange| exchange.peer == peer)
            && let Some(exchange) = self.exchange.take()
            && exchange.learned
        {
            self.broken_off = Some(peer);
        }
    }

    pub(super) fn next_stream(&mut self) -> u32 {
        // Numbers go round after four thousand million streams of one start.
        self.streams = self.streams.checked_add(1).unwrap_or(1);
        self.streams
    }
}

impl Session {
    /// Something is lacking that only a digest brings: it is sent to this peer, or to another that is ahead.
    pub(super) fn need(&mut self, origin: Origin) {
        if let Some(peer) = self.peers.get_mut(&origin) {
            peer.need = true;
            peer.quiet_until = peer.quiet_until.min(self.now.saturating_add(self.config.times.settle));
        }
    }

    pub(super) fn is_synced(&mut self) {
        if !self.resync.synced {
            self.resync.synced = true;
            self.actions.push_back(Action::Synced);
        }
    }

    /// Sets when the next exchange begins, if one is due and none is under way.
    pub(super) fn consider_resync(&mut self) {
        if self.resync.exchange.is_some() || self.resync.begins_at.is_some() {
            return;
        }
        let (now, settle) = (self.now, self.config.times.settle);
        if self.peers.values().any(|peer| peer.ask_at(settle).is_some_and(|at| at <= now)) {
            let wait = self.draw(self.config.times.spread);
            self.resync.begins_at = Some(now.saturating_add(wait));
        }
    }

    /// Breaks off what makes no progress, and begins what is due.
    pub(super) fn run_resync(&mut self) {
        let (now, patience) = (self.now, self.config.times.exchange);
        let stalled = |exchange: &&Exchange| exchange.progress_at.saturating_add(patience) <= now;
        if let Some(peer) = self.resync.exchange.as_ref().filter(stalled).map(|exchange| exchange.peer) {
            self.break_off(peer);
        }
        self.consider_resync();
        if self.resync.begins_at.is_some_and(|at| at <= now) {
            self.resync.begins_at = None;
            self.begin();
        }
        if self.peers.is_empty() && now >= self.started_at.saturating_add(self.config.times.alone) {
            self.is_synced();
        }
    }

    /// Sends the digest to one of the peers that are due, at random: to one that has let few exchanges stall.
    fn begin(&mut self) {
        let (now, settle) = (self.now, self.config.times.settle);
        let due = |(_, peer): &(&Origin, &super::Peer)| peer.ask_at(settle).is_some_and(|at| at <= now);
        let least = self.peers.iter().filter(due).map(|(_, peer)| peer.stalls).min();
        let due = self.peers.iter().filter(due).filter(|(_, peer)| Some(peer.stalls) == least);
        let due: Vec<Origin> = due.map(|(&origin, _)| origin).collect();
        let at = self.draw(due.len() as u64);
        let Some(&to) = usize::try_from(at).ok().and_then(|at| due.get(at)) else { return };
        // What is lacking from now on is not in the answer.
        let needed = self.peers.get_mut(&to).is_some_and(|peer| std::mem::take(&mut peer.need));
        let stream = self.resync.next_stream();
        let digest = self.digest();
        let mut outgoing = self.open(to, stream, [].into(), None);
        outgoing.outbox.push(Message::Digest(digest).encode());
        self.outgoing.insert(stream, outgoing);
        let exchange = Exchange { peer: to, stream, progress_at: now, learned: false, needed };
        self.resync.exchange = Some(exchange);
        self.stats.digests += 1;
        if self.resync.broken_off.take().is_some_and(|before| before != to) {
            self.stats.resumed += 1;
        }
    }

    /// Answers a digest: what its sender lacks, in pieces. `[spec: LINK-13]` `[spec: SYNC-3]`
    pub(super) fn answer(&mut self, to: Origin, request: u32, digest: &Digest) {
        // Who asks again has given up the answer before.
        self.outgoing.retain(|_, outgoing| outgoing.to != to || !outgoing.is_answer);
        let answers = self.outgoing.values().filter(|outgoing| outgoing.is_answer).count();
        if answers >= self.config.bounds.answers {
            self.stats.answers_refused += 1;
            return;
        }
        let pieces = self.replica.delta_for(digest).pieces(self.config.bounds.piece_bytes);
        let stream = self.resync.next_stream();
        let outgoing: Outgoing = self.open(to, stream, pieces.into(), Some(request));
        self.outgoing.insert(stream, outgoing);
        self.stats.answers += 1;
    }

    /// A stream of a peer has come in whole: perhaps the answer that was waited for.
    pub(super) fn has_answered(&mut self, from: Origin, request: Option<u32>) {
        let matches = |exchange: &Exchange| exchange.peer == from && request == Some(exchange.stream);
        let Some(exchange) = self.resync.exchange.take_if(|exchange| matches(exchange)) else { return };
        self.outgoing.remove(&exchange.stream);
        self.stats.exchanges += 1;
        let (now, settle, max) = (self.now, self.config.times.settle, self.config.times.quiet_max);
        if let Some(peer) = self.peers.get_mut(&from) {
            (peer.differs_since, peer.stalls) = (None, 0);
            if !exchange.needed || !exchange.learned {
                peer.quiet_until =
                    now.saturating_add(settle.saturating_mul(1 << peer.asked.min(16)).min(max));
                peer.asked += 1;
            }
        }
        self.is_synced();
    }

    /// An exchange is given up: another peer may be asked, or the same one later.
    pub(super) fn break_off(&mut self, peer: Origin) {
        let Some(exchange) = self.resync.exchange.take_if(|exchange| exchange.peer == peer) else { return };
        self.outgoing.remove(&exchange.stream);
        self.stats.stalled += 1;
        if exchange.learned {
            self.resync.broken_off = Some(peer);
        }
        if let Some(known) = self.peers.get_mut(&peer) {
            known.need = true;
            let wait = self.config.times.exchange.saturating_mul(1 << known.stalls.min(16));
            known.quiet_until = self.now.saturating_add(wait.min(self.config.times.quiet_max));
            known.stalls += 1;
        }
    }

    /// When something of this is due.
    pub(super) fn resync_wake(&self) -> Option<u64> {
        if let Some(exchange) = &self.resync.exchange {
            return Some(exchange.progress_at.saturating_add(self.config.times.exchange));
        }
        let settle = self.config.times.settle;
        let due = self.peers.values().filter_map(|peer| peer.ask_at(settle)).min();
        let alone = self.started_at.saturating_add(self.config.times.alone);
        let alone = Some(alone).filter(|_| !self.resync.synced && self.peers.is_empty());
        [self.resync.begins_at.or(due), alone].into_iter().flatten().min()
    }

    fn digest(&self) -> Digest {
        let mut digest = self.replica.digest();
        if self.config.is_flawed(Flaw::ContextAsDigest) {
            digest.live.clear();
        }
        digest
    }
}
