//! A token bucket: how much may be sent now. `[spec: LINK-10]`

use crate::config::SECOND;

/// Fills with time, up to a burst; what is sent empties it. A datagram may overdraw it; the debt is waited for.
#[derive(Clone, Debug)]
pub(crate) struct Pacing {
    per_second: u64,
    burst: u64,
    tokens: u64,
    debt: u64,
    filled_at: u64,
}

impl Pacing {
    pub(crate) fn new(per_second: u64, burst: u64, now: u64) -> Self {
        let burst = burst.max(1);
        Self { per_second: per_second.max(1), burst, tokens: burst, debt: 0, filled_at: now }
    }

    pub(crate) fn fill(&mut self, now: u64) {
        let span = u128::from(now.saturating_sub(self.filled_at));
        let gained = span * u128::from(self.per_second) / u128::from(SECOND);
        if gained > 0 {
            let gained = u64::try_from(gained).unwrap_or(u64::MAX);
            let left = gained.saturating_sub(self.debt);
            self.debt = self.debt.saturating_sub(gained);
            self.tokens = self.tokens.saturating_add(left).min(self.burst);
            self.filled_at = now;
        }
    }

    /// Whether something may be sent.
    pub(crate) fn is_open(&self) -> bool {
        self.tokens > 0
    }

    pub(crate) fn spend(&mut self, bytes: usize) {
        let bytes = bytes as u64;
        self.debt = self.debt.saturating_add(bytes.saturating_sub(self.tokens));
        self.tokens = self.tokens.saturating_sub(bytes);
    }

    /// When something may be sent again.
    pub(crate) fn opens_at(&self) -> u64 {
        if self.is_open() {
            return self.filled_at;
        }
        let wait = u128::from(self.debt + 1) * u128::from(SECOND) / u128::from(self.per_second) + 1;
        self.filled_at.saturating_add(u64::try_from(wait).unwrap_or(u64::MAX))
    }
}

#[cfg(test)]
mod tests {
    use super::{Pacing, SECOND};

    /// Whatever the sizes: after the burst the rate is kept, and waking when it says is enough. `[spec: LINK-10]`
    #[test]
    fn law_the_rate_is_kept() {
        for (rate, burst, size) in [(1_000_000, 3000, 1400), (50, 1, 1400), (SECOND, 10, 7), (3, 100, 2)] {
            let mut pacing = Pacing::new(rate, burst, 0);
            let (mut now, mut sent) = (0, 0_u128);
            for _ in 0..500 {
                pacing.fill(now);
                if pacing.is_open() {
                    pacing.spend(size);
                    sent += size as u128;
                } else {
                    assert!(pacing.opens_at() > now, "time must pass");
                }
                now = now.max(pacing.opens_at());
            }
            let allowed = u128::from(now) * u128::from(rate) / u128::from(SECOND) + u128::from(burst);
            assert!(sent <= allowed + size as u128, "{sent} of {allowed}");
            assert!(
                sent * 10 >= allowed.min(u128::from(rate)),
                "{sent} of {allowed}: much slower than allowed"
            );
        }
    }
}
