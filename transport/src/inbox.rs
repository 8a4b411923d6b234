//! The receiving end of a stream: puts messages together, delivers each once, knows what is missing.
//! `[spec: LINK-6]` `[spec: LINK-7]`

mod begun;

use crate::config::{Bounds, Times};
use crate::runs::Runs;
use crate::wire::{Missing, Part, WANTED_MAX};
use begun::Begun;
use std::collections::BTreeMap;

/// What has become of a part.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Taken {
    /// It was there already, or the message was.
    Known,
    /// It is kept until the others have come.
    Kept,
    /// It was the last one: the message.
    Complete(Vec<u8>),
    /// There is no room for it.
    NoRoom,
    /// It contradicts the parts before it.
    Contradicts,
}

/// The receiving end of one stream.
#[derive(Clone, Debug)]
pub(crate) struct Inbox {
    delivered: Runs,
    begun: BTreeMap<u64, Begun>,
    /// What is below is not asked for.
    floor: u64,
    /// The greatest number that is known to exist.
    high: u64,
    /// When to ask for what is missing, while something is.
    want_at: Option<u64>,
    tries: u32,
    /// The greatest number that was asked for.
    asked: u64,
    /// Bytes of messages that have come, each counted once.
    received: u64,
    /// Something was missing that is no longer asked for, since there were too many gaps.
    overrun: bool,
}

impl Inbox {
    /// Of a stream that is met at a number: what was before is not asked for. `[spec: LINK-14]`
    pub(crate) fn from(number: u64) -> Self {
        Self {
            delivered: Runs::default(),
            begun: BTreeMap::new(),
            floor: number.max(1),
            high: number.saturating_sub(1),
            want_at: None,
            tries: 0,
            asked: 0,
            received: 0,
            overrun: false,
        }
    }

    /// Whether nothing is missing that is known to exist.
    pub(crate) fn is_complete(&self) -> bool {
        self.begun.is_empty() && self.below() > self.high
    }

    /// Everything below has been delivered, or is not asked for.
    pub(crate) fn below(&self) -> u64 {
        self.delivered.first_gap(self.floor)
    }

    /// The greatest number that is known to exist.
    pub(crate) fn high(&self) -> u64 {
        self.high
    }

    /// Whether gaps were given up since there were too many, since this was asked last.
    pub(crate) fn was_overrun(&mut self) -> bool {
        std::mem::take(&mut self.overrun)
    }

    pub(crate) fn received(&self) -> u64 {
        self.received
    }

    pub(crate) fn want_at(&self) -> Option<u64> {
        self.want_at
    }

    pub(crate) fn tries(&self) -> u32 {
        self.tries
    }

    /// The bytes of messages that are not complete.
    pub(crate) fn begun_bytes(&self) -> usize {
        self.begun.values().map(|begun| begun.bytes).sum()
    }

    /// Takes a part; `room` is how many bytes of incomplete messages may be kept, of all streams.
    pub(crate) fn take(&mut self, part: Part, now: u64, room: &mut usize, bounds: &Bounds) -> Taken {
        let number = part.number;
        self.high = self.high.max(number);
        if self.delivered.contains(number) {
            return Taken::Known;
        }
        let bytes = part.bytes.len();
        let taken = if part.count == 1 {
            self.forget(number, room);
            Taken::Complete(part.bytes)
        } else {
            self.keep(part, now, room, bounds)
        };
        if matches!(taken, Taken::Kept | Taken::Complete(_)) {
            self.received += bytes as u64;
            if number <= self.asked {
                self.tries = 0;
            }
        }
        if matches!(taken, Taken::Complete(_)) {
            self.delivered.insert(number);
            while self.delivered.len() > bounds.runs
                && let Some((first, last)) = self.delivered.forget_lowest()
            {
                self.overrun |= self.floor < first;
                self.floor = self.floor.max(last + 1);
            }
        }
        taken
    }

    fn keep(&mut self, part: Part, now: u64, room: &mut usize, bounds: &Bounds) -> Taken {
        let full = !self.begun.contains_key(&part.number) && self.begun.len() >= bounds.begun_messages;
        if full || part.bytes.len() > *room {
            return Taken::NoRoom;
        }
        let number = part.number;
        let begun = self.begun.entry(number).or_insert_with(|| Begun::by(&part, now));
        let taken = begun.take(part, now, room);
        if matches!(taken, Taken::Complete(_)) {
            self.begun.remove(&number);
        }
        taken
    }

    fn forget(&mut self, number: u64, room: &mut usize) {
        if let Some(begun) = self.begun.remove(&number) {
            *room += begun.bytes;
        }
    }

    /// A number is said to exist, and all below it.
    pub(crate) fn exists(&mut self, high: u64) {
        self.high = self.high.max(high);
    }

    /// Asks for nothing below a number any more; whether something was missing there. `[spec: LINK-9]`
    pub(crate) fn skip(&mut self, below: u64, room: &mut usize) -> bool {
        let below = below.min(self.high.saturating_add(1));
        let lost = self.below() < below || self.begun.first_key_value().is_some_and(|begun| *begun.0 < below);
        if lost {
            let kept = self.begun.split_off(&below);
            *room += self.begun_bytes();
            self.begun = kept;
        }
        self.floor = self.floor.max(below);
        (self.tries, self.want_at) = if lost { (0, None) } else { (self.tries, self.want_at) };
        lost
    }

    /// Counts a message as delivered that was not: what a broken session does.
    pub(crate) fn pretend(&mut self, number: u64) {
        self.delivered.insert(number);
    }

    /// Asks for nothing that is known any more. `[spec: LINK-7]`
    pub(crate) fn give_up(&mut self, room: &mut usize) -> bool {
        self.skip(u64::MAX, room)
    }

    /// Sets when to ask, if something is missing, and unsets it if nothing is. `wait` is drawn at random.
    pub(crate) fn watch(&mut self, now: u64, wait: u64) {
        if self.is_complete() {
            (self.want_at, self.tries) = (None, 0);
        } else if self.want_at.is_none() {
            self.want_at = Some(now.saturating_add(wait));
        }
    }

    /// It has asked, or somebody else has: the next time is later each time. `[spec: LINK-7]`
    pub(crate) fn back_off(&mut self, now: u64, wait: u64, times: &Times) {
        let wait = wait.saturating_mul(2).saturating_mul(1 << self.tries.min(20));
        self.want_at = Some(now.saturating_add(wait.min(times.want_max)));
        self.tries += 1;
        self.asked = self.high;
    }

    /// The sender is there, and waits: what is missing is asked for soon, however often it was before.
    pub(crate) fn hurry(&mut self, now: u64, wait: u64) {
        self.want_at = self.want_at.map(|at| at.min(now.saturating_add(wait)));
    }

    /// Looks again later, without having asked.
    pub(crate) fn look_again(&mut self, now: u64, wait: u64) {
        self.want_at = Some(now.saturating_add(wait));
    }

    /// What is missing: messages, and parts of messages that have begun. What is still coming in, part by part,
    /// is not. `[spec: LINK-7]`
    pub(crate) fn missing(&self, now: u64, tail: u64) -> Vec<Missing> {
        let mut missing = Vec::new();
        let mut runs = 0;
        // A message that has begun is asked for wherever it is.
        for (&number, begun) in &self.begun {
            let parts = begun.missing(now, tail, WANTED_MAX.saturating_sub(runs));
            runs += parts.len();
            if !parts.is_empty() {
                missing.push(Missing { first: number, last: number, parts });
            }
        }
        for (mut first, last) in self.delivered.gaps(self.floor, self.high).take(WANTED_MAX) {
            for &number in self.begun.range(first..=last).map(|(number, _)| number) {
                if first < number {
                    missing.push(Missing { first, last: number - 1, parts: Vec::new() });
                }
                first = number + 1;
            }
            if first <= last {
                missing.push(Missing { first, last, parts: Vec::new() });
            }
        }
        missing.truncate(WANTED_MAX);
        missing
    }
}

#[cfg(test)]
mod tests;
