//! What a network does to datagrams.

use crate::config::MS;

/// What happens to datagrams; chances are of a thousand.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Faults {
    /// Lost.
    pub loss: u16,
    /// Delivered twice.
    pub duplicates: u16,
    /// Damaged, or cut off.
    pub damage: u16,
    /// The shortest time on the way, in nanoseconds.
    pub delay_min: u64,
    /// The longest: what differs from the shortest also reorders.
    pub delay_max: u64,
    /// So many datagrams wait for a slow reader; more are lost.
    pub slow_room: usize,
}

impl Faults {
    /// No faults: everything arrives once, in order, after a tenth of a millisecond.
    pub const NONE: Self =
        Self { loss: 0, duplicates: 0, damage: 0, delay_min: MS / 10, delay_max: MS / 10, slow_room: 10_000 };
}
