//! The sending end of a stream: cuts messages into parts, keeps what it has sent, sends again what is asked for.
//! `[spec: LINK-5]` `[spec: LINK-8]`

mod kept;
mod next;

use crate::wire::{Missing, part_count};
use kept::Kept;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// The sending end of one stream.
#[derive(Clone, Debug)]
pub(crate) struct Outbox {
    stream: u32,
    to: u64,
    part_size: u32,
    next: u64,
    kept: BTreeMap<u64, Kept>,
    kept_bytes: usize,
    /// Bytes of messages of which not all parts have been sent.
    queued_bytes: usize,
    /// Numbers of messages that are waiting: of one part, and of several.
    small: VecDeque<u64>,
    large: VecDeque<u64>,
    /// Parts to be sent again: of messages of one part, and of several.
    again_small: BTreeSet<u64>,
    again_large: BTreeSet<(u64, u32)>,
    /// Bytes of parts that have been sent, each counted once.
    sent_bytes: u64,
}

/// What a request has led to.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Answered {
    /// So many parts are sent again.
    pub(crate) parts: u64,
    /// Something of it is no longer kept.
    pub(crate) gone: bool,
}

impl Outbox {
    pub(crate) fn new(stream: u32, to: u64, part_size: u32) -> Self {
        Self {
            stream,
            to,
            part_size,
            next: 1,
            kept: BTreeMap::new(),
            kept_bytes: 0,
            queued_bytes: 0,
            small: VecDeque::new(),
            large: VecDeque::new(),
            again_small: BTreeSet::new(),
            again_large: BTreeSet::new(),
            sent_bytes: 0,
        }
    }

    /// The highest number; 0 if there is none.
    pub(crate) fn high(&self) -> u64 {
        self.next - 1
    }

    /// The lowest number kept, or the next one.
    pub(crate) fn oldest(&self) -> u64 {
        self.kept.first_key_value().map_or(self.next, |kept| *kept.0)
    }

    pub(crate) fn queued_bytes(&self) -> usize {
        self.queued_bytes
    }

    pub(crate) fn sent_bytes(&self) -> u64 {
        self.sent_bytes
    }

    /// Whether parts are waiting to be sent for the first time.
    pub(crate) fn has_fresh(&self) -> bool {
        !self.small.is_empty() || !self.large.is_empty()
    }

    pub(crate) fn has_again(&self) -> bool {
        !self.again_small.is_empty() || !self.again_large.is_empty()
    }

    /// Numbers a message and queues its parts.
    pub(crate) fn push(&mut self, bytes: Vec<u8>) -> u64 {
        let number = self.next;
        self.next += 1;
        let total = u32::try_from(bytes.len()).unwrap_or(u32::MAX);
        let count = part_count(total, self.part_size);
        if count == 1 {
            self.small.push_back(number);
        } else {
            self.large.push_back(number);
        }
        self.kept_bytes += bytes.len();
        self.queued_bytes += bytes.len();
        let kept = Kept::new(bytes, count);
        self.kept.insert(number, kept);
        number
    }

    /// Drops the oldest messages that have been sent, down to so many bytes and messages. The latest stays.
    /// `[spec: LINK-8]`
    pub(crate) fn trim(&mut self, bytes: usize, messages: usize) {
        while self.kept.len() > 1 && (self.kept_bytes > bytes || self.kept.len() > messages) {
            let Some(first) = self.kept.first_entry() else { return };
            if first.get().sent < first.get().count {
                return;
            }
            self.kept_bytes -= first.remove().bytes.len();
        }
    }

    /// Drops what has been acknowledged. `[spec: LINK-10]`
    pub(crate) fn acknowledged(&mut self, below: u64) {
        while let Some(first) = self.kept.first_entry() {
            if *first.key() >= below || first.get().sent < first.get().count {
                return;
            }
            self.kept_bytes -= first.remove().bytes.len();
        }
    }

    /// Whether nothing is kept: all has been sent and acknowledged.
    pub(crate) fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }

    /// Queues again what is asked for, if it has been sent, and not just now. `[spec: LINK-8]`
    pub(crate) fn want(&mut self, missing: &[Missing], now: u64, guard: u64) -> Answered {
        let mut answered = Answered::default();
        let oldest = self.oldest();
        for Missing { first, last, parts } in missing {
            answered.gone |= *first < oldest.min(self.next);
            let (first, last) = ((*first).max(oldest), (*last).min(self.high()));
            if first > last {
                continue;
            }
            for (&number, kept) in self.kept.range_mut(first..=last) {
                let sent = kept.sent;
                let all = [(0, u32::MAX)];
                let runs: &[(u32, u32)] = if parts.is_empty() { &all } else { parts };
                for index in runs.iter().flat_map(|&(first, last)| first..last.saturating_add(1).min(sent)) {
                    let is_new = kept.passes_guard(index, now, guard)
                        && if kept.count == 1 {
                            self.again_small.insert(number)
                        } else {
                            self.again_large.insert((number, index))
                        };
                    answered.parts += u64::from(is_new);
                }
            }
        }
        answered
    }

    /// Queues again the last part that has been sent, so that the receiver sees what it lacks, and the last one of
    /// the oldest message that it has not acknowledged, which it lacks perhaps.
    pub(crate) fn probe(&mut self) -> bool {
        let mut sent = self.kept.iter().filter(|(_, kept)| kept.sent > 0);
        let ends = [sent.next(), sent.next_back()].into_iter().flatten();
        let ends: Vec<(u64, u32, u32)> =
            ends.map(|(&number, kept)| (number, kept.sent - 1, kept.count)).collect();
        for &(number, index, count) in &ends {
            if count == 1 {
                self.again_small.insert(number);
            } else {
                self.again_large.insert((number, index));
            }
        }
        !ends.is_empty()
    }
}

#[cfg(test)]
mod tests;
