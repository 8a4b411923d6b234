//! Which part is sent next. `[spec: LINK-5]` `[spec: LINK-10]`

use super::Outbox;
use crate::wire::{Part, part_bounds};

impl Outbox {
    /// The length of the next message of one part, if there is one.
    pub(crate) fn small_bytes(&mut self) -> Option<usize> {
        self.drop_stale();
        let number = self.again_small.first().or_else(|| self.small.front())?;
        Some(self.kept.get(number)?.bytes.len())
    }

    /// The next message of one part: first what is asked for again.
    pub(crate) fn take_small(&mut self) -> Option<Part> {
        if let Some(number) = self.again_small.pop_first() {
            return self.part(number, 0);
        }
        let number = self.small.pop_front()?;
        self.first_part(number)
    }

    /// The next part of a message of several: first what is asked for again.
    pub(crate) fn take_large(&mut self, fresh: bool) -> Option<Part> {
        self.drop_stale();
        if let Some((number, index)) = self.again_large.pop_first() {
            return self.part(number, index);
        }
        if !fresh {
            return None;
        }
        let number = *self.large.front()?;
        let part = self.first_part(number);
        if self.kept.get(&number).is_none_or(|kept| kept.sent == kept.count) {
            self.large.pop_front();
        }
        part
    }

    /// The next part of any size: first what is asked for again, then in the order of numbers. For streams to one
    /// peer.
    pub(crate) fn take_next(&mut self, fresh: bool) -> Option<Part> {
        self.drop_stale();
        if !self.again_small.is_empty() {
            return self.take_small();
        }
        let next_is_large = match (self.small.front(), self.large.front()) {
            (Some(small), Some(large)) => large < small,
            (small, _) => small.is_none(),
        };
        if !self.again_large.is_empty() || !fresh || next_is_large {
            return self.take_large(fresh);
        }
        self.take_small()
    }

    /// What is no longer kept need not be sent again.
    fn drop_stale(&mut self) {
        let oldest = self.oldest();
        while self.again_small.first().is_some_and(|&number| number < oldest) {
            self.again_small.pop_first();
        }
        while self.again_large.first().is_some_and(|at| at.0 < oldest) {
            self.again_large.pop_first();
        }
    }

    fn first_part(&mut self, number: u64) -> Option<Part> {
        let kept = self.kept.get_mut(&number)?;
        let index = kept.sent;
        kept.sent += 1;
        if kept.sent == kept.count {
            self.queued_bytes -= kept.bytes.len();
        }
        let part = self.part(number, index)?;
        self.sent_bytes += part.bytes.len() as u64;
        Some(part)
    }

    fn part(&self, number: u64, index: u32) -> Option<Part> {
        let kept = self.kept.get(&number)?;
        let total = u32::try_from(kept.bytes.len()).ok()?;
        let (first, end) = part_bounds(total, kept.count, index)?;
        let bytes = kept.bytes.get(first..end)?.to_vec();
        Some(Part { stream: self.stream, to: self.to, number, index, count: kept.count, total, bytes })
    }
}
