//! What a plan is drawn with.

use super::plan::{Options, Step};
use crate::config::MS;
use crate::memory::Faults;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

/// Draws from a seed.
pub(super) struct Dice(ChaCha8Rng);

impl Dice {
    pub(super) fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub(super) fn below(&mut self, end: u64) -> u64 {
        self.0.next_u64() % end.max(1)
    }

    pub(super) fn node(&mut self, nodes: usize) -> usize {
        usize::try_from(self.below(nodes as u64)).unwrap_or(0)
    }

    pub(super) fn permille(&mut self, max: u64) -> u16 {
        u16::try_from(self.below(max + 1)).unwrap_or(0)
    }

    pub(super) fn faults(&mut self) -> Faults {
        let delay_min = self.below(2 * MS) + 20_000;
        let heavy = self.below(3) == 0;
        Faults {
            loss: self.permille(if heavy { 500 } else { 100 }),
            duplicates: self.permille(200),
            damage: self.permille(50),
            delay_min,
            delay_max: delay_min + self.below(if heavy { 60 * MS } else { 5 * MS }),
            slow_room: self.node(60) + 4,
        }
    }

    pub(super) fn step(&mut self, nodes: usize, options: &Options) -> Step {
        let node = self.node(nodes);
        match self.below(100) {
            0..=6 => Step::Image { node, bytes: 2000 + self.node(150_000) },
            7..=9 => Step::Burst { node, choice: self.0.next_u64(), count: 2 + self.node(30) },
            10..=13 if options.faults => Step::Partition { side: self.0.next_u64() },
            14..=17 if options.faults => Step::Heal,
            18..=20 if options.faults => Step::Slow { node, ms: self.below(400) },
            21..=23 if options.faults => {
                Step::Jump { node, ms: i64::try_from(self.below(6000)).unwrap_or(0) - 2000 }
            }
            24..=29 if options.hostile => Step::Hostile { choice: self.0.next_u64() },
            30..=31 if options.deaths => Step::Crash { node },
            32..=34 if options.deaths => Step::Start { node },
            35 if options.deaths => Step::Leave { node },
            _ => Step::Mutate { node, choice: self.0.next_u64() },
        }
    }
}
