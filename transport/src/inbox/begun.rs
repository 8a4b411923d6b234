//! A message of which some parts have come. `[spec: LINK-6]`

use super::Taken;
use crate::wire::Part;
use std::collections::BTreeMap;

/// A message of which some parts have come.
#[derive(Clone, Debug)]
pub(super) struct Begun {
    count: u32,
    total: u32,
    parts: BTreeMap<u32, Vec<u8>>,
    pub(super) bytes: usize,
    heard_at: u64,
}

impl Begun {
    /// A message of which nothing has come, as its first part describes it.
    pub(super) fn by(part: &Part, now: u64) -> Self {
        Self { count: part.count, total: part.total, parts: BTreeMap::new(), bytes: 0, heard_at: now }
    }

    /// Takes a part for which there is room.
    pub(super) fn take(&mut self, part: Part, now: u64, room: &mut usize) -> Taken {
        if (self.count, self.total) != (part.count, part.total) {
            return Taken::Contradicts;
        }
        if self.parts.contains_key(&part.index) {
            return Taken::Known;
        }
        *room -= part.bytes.len();
        self.bytes += part.bytes.len();
        self.heard_at = now;
        self.parts.insert(part.index, part.bytes);
        if self.parts.len() as u64 != u64::from(self.count) {
            return Taken::Kept;
        }
        *room += self.bytes;
        let parts: Vec<Vec<u8>> = std::mem::take(&mut self.parts).into_values().collect();
        Taken::Complete(parts.concat())
    }

    /// Runs of parts that have not come: below the last that has, and all once nothing comes any more.
    pub(super) fn missing(&self, now: u64, tail: u64, max: usize) -> Vec<(u32, u32)> {
        let quiet = now.saturating_sub(self.heard_at) >= tail;
        let end = if quiet { self.count } else { self.parts.last_key_value().map_or(0, |part| *part.0) };
        let mut runs = Vec::new();
        let mut next = 0;
        for &index in self.parts.keys().chain([&end]) {
            if runs.len() >= max {
                break;
            }
            if next < index {
                runs.push((next, index - 1));
            }
            next = index + 1;
        }
        runs
    }
}
