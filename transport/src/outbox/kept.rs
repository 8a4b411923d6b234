//! A message that is kept for who asks. `[spec: LINK-8]`

use std::collections::BTreeSet;
use std::sync::Arc;

/// A message that is kept.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    pub(super) bytes: Arc<Vec<u8>>,
    pub(super) count: u32,
    /// So many parts have been sent.
    pub(super) sent: u32,
    /// Parts that were sent again lately, and until when that keeps them from being sent once more.
    guarded: BTreeSet<u32>,
    guard_until: u64,
}

impl Kept {
    /// Of this message nothing has been sent.
    pub(super) fn new(bytes: Vec<u8>, count: u32) -> Self {
        Self { bytes: Arc::new(bytes), count, sent: 0, guarded: BTreeSet::new(), guard_until: 0 }
    }

    /// Whether a part may be sent again: it was not just now.
    pub(super) fn passes_guard(&mut self, index: u32, now: u64, guard: u64) -> bool {
        if now >= self.guard_until {
            self.guarded.clear();
            self.guard_until = now.saturating_add(guard);
        }
        self.guarded.insert(index)
    }
}
