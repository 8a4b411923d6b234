//! How many samples the sampled tests take.

use proptest::test_runner::Config;

/// Names the divisor.
const DIVISOR: &str = "DSR_CASES_DIVISOR";

/// A configuration of `count` cases; where the environment variable `DSR_CASES_DIVISOR` is a number from 1 on, of
/// that part of them, and at least one. For runs in which the same tests are repeated thousands of times, as in
/// `docs/mutants.md`.
#[must_use]
pub fn cases(count: u32) -> Config {
    let divisor = std::env::var(DIVISOR).ok().and_then(|text| text.parse().ok()).filter(|&n| n > 0);
    Config::with_cases((count / divisor.unwrap_or(1)).max(1))
}
