//! Bytes for tests and for the search of seeds: the same on every run.

/// Numbers by the finaliser of `SplitMix64` over a counter.
#[derive(Clone, Debug)]
pub struct Noise(u64);

impl Noise {
    /// Another stream for each seed.
    pub const fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15))
    }

    /// The next number.
    pub const fn number(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut word = self.0;
        word = (word ^ word >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        word = (word ^ word >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        word ^ word >> 31
    }

    /// A number below `end`, or 0.
    pub fn below(&mut self, end: usize) -> usize {
        let word = self.number() % (end.max(1) as u64);
        usize::try_from(word).unwrap_or_default()
    }

    /// So many bytes, small ones as often as all others.
    pub fn bytes(&mut self, length: usize) -> Vec<u8> {
        let byte = |_| {
            let [byte, is_small, ..] = self.number().to_le_bytes();
            if is_small % 2 == 0 { byte % 16 } else { byte }
        };
        (0..length).map(byte).collect()
    }

    /// An input somewhat changed: bytes put in, taken out, replaced, or a piece said twice.
    pub fn changed(&mut self, input: &[u8]) -> Vec<u8> {
        let mut changed = input.to_vec();
        for _ in 0..=self.below(4) {
            let at = self.below(changed.len() + 1);
            let end = (at + 1 + self.below(8)).min(changed.len());
            match self.below(5) {
                0 => changed.insert(at, self.bytes(1)[0]),
                1 => drop(changed.drain(at..end)),
                2 => {
                    let piece: Vec<u8> = changed[at..end.max(at)].to_vec();
                    let to = self.below(changed.len() + 1);
                    drop(changed.splice(to..to, piece));
                }
                3 => changed.truncate(at.max(1)),
                _ if at < changed.len() => changed[at] = self.bytes(1)[0],
                _ => changed.extend(self.bytes(4)),
            }
        }
        changed
    }
}
