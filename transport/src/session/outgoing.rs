//! Streams to one peer: a digest, or its answer. `[spec: LINK-10]` `[spec: LINK-13]`

use super::Session;
use crate::config::Times;
use crate::message::Message;
use crate::origin::{Destination, Origin};
use crate::outbox::Outbox;
use crate::wire::{HEADER_BYTES, Item, PART_BYTES};
use dsr_core::State;
use std::collections::VecDeque;

/// A stream to one peer.
#[derive(Clone, Debug)]
pub(super) struct Outgoing {
    pub(super) to: Origin,
    pub(super) outbox: Outbox,
    pub(super) is_answer: bool,
    /// What has not been encoded yet: payloads are shared with the replica until then.
    pieces: VecDeque<State>,
    /// The digest that is answered, until the end of the answer is queued.
    end: Option<u32>,
    acknowledged: u64,
    probe_at: u64,
    probes: u32,
}

impl Outgoing {
    /// Something came back: the peer is there.
    pub(super) fn is_heard(&mut self, now: u64, times: &Times) {
        (self.probes, self.probe_at) = (0, now.saturating_add(times.probe));
    }

    /// Whether parts may be sent that were not sent yet.
    pub(super) fn is_open(&self, window: u64) -> bool {
        self.outbox.sent_bytes() < self.acknowledged.saturating_add(window)
    }

    /// Encodes the next piece, or the end, if all before it has been sent.
    pub(super) fn refill(&mut self) {
        if self.outbox.has_fresh() {
            return;
        }
        if let Some(piece) = self.pieces.pop_front() {
            self.outbox.push(Message::Delta(piece).encode());
        } else if let Some(request) = self.end.take() {
            self.outbox.push(Message::End(request).encode());
        }
    }

    /// Whether something can be sent now.
    pub(super) fn has_something(&self, window: u64) -> bool {
        let more = self.outbox.has_fresh() || !self.pieces.is_empty() || self.end.is_some();
        self.outbox.has_again() || more && self.is_open(window)
    }

    fn is_done(&self) -> bool {
        self.pieces.is_empty() && self.end.is_none() && self.outbox.is_empty()
    }

    pub(super) fn probe_at(&self) -> u64 {
        self.probe_at
    }
}

impl Session {
    pub(super) fn open(
        &self,
        to: Origin,
        stream: u32,
        pieces: VecDeque<State>,
        answers: Option<u32>,
    ) -> Outgoing {
        let part = self.config.bounds.datagram_bytes.saturating_sub(HEADER_BYTES + PART_BYTES).max(64);
        Outgoing {
            to,
            outbox: Outbox::new(stream, to.nonce, u32::try_from(part).unwrap_or(u32::MAX)),
            is_answer: answers.is_some(),
            pieces,
            end: answers,
            acknowledged: 0,
            probe_at: self.now.saturating_add(self.config.times.probe),
            probes: 0,
        }
    }

    pub(super) fn hear_ack(&mut self, sender: Origin, stream: u32, below: u64, received: u64) {
        let outgoing = self.outgoing.get_mut(&stream).filter(|outgoing| outgoing.to == sender);
        let Some(outgoing) = outgoing else { return };
        outgoing.is_heard(self.now, &self.config.times);
        outgoing.acknowledged = outgoing.acknowledged.max(received.min(outgoing.outbox.sent_bytes()));
        outgoing.outbox.acknowledged(below);
        if below == u64::MAX || outgoing.is_done() {
            self.outgoing.remove(&stream);
        }
        self.resync.progress(sender, self.now);
    }

    /// Sends the last part again where nothing has come back for a while, and gives up in the end.
    pub(super) fn run_probes(&mut self) {
        let (now, times, bounds) = (self.now, &self.config.times, &self.config.bounds);
        let mut unanswered = 0;
        self.outgoing.retain(|_, outgoing| {
            if outgoing.probe_at > now {
                return true;
            }
            outgoing.probe_at =
                now.saturating_add(times.probe.saturating_mul(1 + u64::from(outgoing.probes)));
            if outgoing.outbox.probe() {
                outgoing.probes += 1;
            }
            let gives_up = outgoing.probes > bounds.probes;
            unanswered += u64::from(gives_up);
            !gives_up
        });
        self.stats.unanswered += unanswered;
    }

    /// Acknowledges a stream of a peer, and ends it if all of it has come.
    pub(super) fn acknowledge(&mut self, from: Origin, stream: u32) {
        let Some(peer) = self.peers.get_mut(&from) else { return };
        let Some(incoming) = peer.incoming.get_mut(&stream) else { return };
        incoming.ack_at = None;
        let (done, answers) = (incoming.is_done(), incoming.answers);
        let below = if done { u64::MAX } else { incoming.inbox.below() };
        let ack = Item::Ack { stream, below, received: incoming.inbox.received() };
        let to = Destination::Peer(peer.address);
        self.say(to, ack);
        if done {
            self.close(from, stream);
            self.has_answered(from, answers);
        }
    }

    pub(super) fn run_acks(&mut self) {
        let mut due = Vec::new();
        for (&origin, peer) in &self.peers {
            let incoming = peer.incoming.iter();
            let acks = incoming.filter(|(_, incoming)| incoming.ack_at.is_some_and(|at| at <= self.now));
            due.extend(acks.map(|(&stream, _)| (origin, stream)));
        }
        for (origin, stream) in due {
            self.acknowledge(origin, stream);
        }
    }

    fn close(&mut self, from: Origin, stream: u32) {
        let Some(peer) = self.peers.get_mut(&from) else { return };
        if let Some(incoming) = peer.incoming.remove(&stream) {
            self.room += incoming.inbox.begun_bytes();
        }
        peer.done.insert(stream.into());
        if peer.done.len() > self.config.bounds.runs {
            peer.done.forget_lowest();
        }
    }

    /// A stream of a peer will never come in whole.
    pub(super) fn drop_incoming(&mut self, from: Origin, stream: u32) {
        if self.peers.get(&from).is_some_and(|peer| peer.incoming.contains_key(&stream)) {
            self.close(from, stream);
            self.break_off(from);
        }
    }
}
