//! Random numbers that a seed decides.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

/// A stream of numbers. Its cipher, `ChaCha`, is defined bit for bit, so a seed means the same walk everywhere and for ever;
/// each walk has a stream of its own, so it does not depend on those before it.
#[derive(Clone, Debug)]
pub struct Dice(ChaCha8Rng);

impl Dice {
    /// The stream of one walk under a seed.
    pub fn new(seed: u64, walk: u64) -> Self {
        let mut stream = ChaCha8Rng::seed_from_u64(seed);
        stream.set_stream(walk);
        Self(stream)
    }

    /// A number below `count`, and 0 if there is none.
    pub fn below(&mut self, count: usize) -> usize {
        // The high half of a product: off from equal chances by less than count / 2⁶⁴.
        let wide = u128::from(self.0.next_u64()) * count as u128;
        usize::try_from(wide >> 64).unwrap_or(0)
    }

    /// Which of some weights is drawn, each as likely as it is heavy; `None` if all are nought.
    pub fn weighted(&mut self, weights: &[usize]) -> Option<usize> {
        let total: usize = weights.iter().sum();
        let mut drawn = self.below(total);
        weights.iter().position(|&weight| {
            let is_it = drawn < weight;
            drawn = drawn.saturating_sub(weight);
            is_it
        })
    }
}
