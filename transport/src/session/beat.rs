//! Beats: how far this session is, and how far others are. `[spec: LINK-11]`

use super::Session;
use crate::origin::{Destination, Origin};
use crate::wire::Item;

/// No beat is so late that its origin has sent more messages since: then what is believed of the stream is a lie.
const LATE: u64 = 1 << 16;

/// When the next beat is due.
#[derive(Clone, Debug)]
pub(super) struct Beats {
    pub(super) at: u64,
    last: u64,
    interval: u64,
}

impl Beats {
    pub(super) fn new(now: u64) -> Self {
        Self { at: now, last: now, interval: 0 }
    }
}

/// The fingerprint of the state, kept until the state changes.
#[derive(Clone, Debug, Default)]
pub(super) struct Print {
    fingerprint: Option<u128>,
    made_at: Option<u64>,
}

impl Print {
    pub(super) fn has_changed(&mut self) {
        self.fingerprint = None;
    }
}

impl Session {
    /// The fingerprint, unless it would have to be made anew too often.
    fn fingerprint(&mut self) -> Option<u128> {
        let may = self.print.made_at.is_none_or(|at| self.now >= at.saturating_add(Self::PRINT_EVERY));
        if self.print.fingerprint.is_none() && may {
            self.print.fingerprint = Some(self.replica.fingerprint().0);
            self.print.made_at = Some(self.now);
        }
        self.print.fingerprint
    }

    /// The last delta of several is followed by a beat soon; while deltas follow each other, beats keep their
    /// period.
    pub(super) fn beat_after_delta(&mut self) {
        let times = &self.config.times;
        self.beats.interval = times.beat_min;
        self.beats.at =
            self.now.saturating_add(times.beat_min).min(self.beats.last.saturating_add(times.beat));
    }

    /// A new peer hears of this session within so short a time.
    pub(super) fn greet(&mut self, within: u64) {
        let wait = self.draw(within);
        self.beats.at = self.beats.at.min(self.now.saturating_add(wait));
    }

    pub(super) fn run_beat(&mut self) {
        if !self.phase.is_member() || self.beats.at > self.now {
            return;
        }
        let (beat, least) = (self.config.times.beat, self.config.times.beat_min);
        self.beats.interval = self.beats.interval.saturating_mul(2).clamp(least, beat.max(least));
        // A tenth at random, so that beats of many do not coincide.
        let interval = self.beats.interval;
        let early = self.draw(interval / 10);
        (self.beats.last, self.beats.at) = (self.now, self.now.saturating_add(interval - early));
        let fingerprint = self.fingerprint();
        let (high, oldest) = (self.outbox.high(), self.outbox.oldest());
        let beat = Item::Beat { high, oldest, fingerprint, name: self.config.name.clone() };
        self.say(Destination::Group, beat);
    }

    pub(super) fn hear_beat(&mut self, sender: Origin, high: u64, oldest: u64, theirs: Option<u128>) {
        let wait = self.patience();
        let ours = if theirs.is_some() { self.fingerprint() } else { None };
        let Some(peer) = self.peers.get_mut(&sender) else { return };
        if let Some(inbox) = peer.inbox.take_if(|inbox| inbox.high() > high.saturating_add(LATE)) {
            self.room += inbox.begun_bytes();
        }
        let inbox = peer.inbox_from(high + 1);
        inbox.exists(high);
        inbox.watch(self.now, wait);
        inbox.hurry(self.now, wait);
        // A late beat says nothing of what was sent after it.
        let is_late = high < inbox.high();
        if let (Some(theirs), Some(ours)) = (theirs, ours) {
            if theirs == ours {
                peer.differs_since = None;
                peer.need &= is_late;
                (peer.asked, peer.quiet_until) = (0, 0);
                self.is_synced();
            } else {
                peer.differs_since.get_or_insert(self.now);
            }
        }
        self.hear_gone(sender, crate::wire::GROUP_STREAM, oldest);
    }
}
