//! The processor's time of this process: whoever else uses the machine does not count.

use crate::error::Result;
use rustix::time::{ClockId, clock_gettime};

/// Nanoseconds that the processor has worked for this process, in all threads.
///
/// Nothing that is measured waits for anything, so on an idle machine this is the time that passes.
#[allow(clippy::cast_precision_loss, reason = "2⁵³ ns are 104 days")]
pub fn now_ns() -> f64 {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    now.tv_sec as f64 * 1e9 + now.tv_nsec as f64
}

/// Nanoseconds per turn of `turns` turns; the first error ends it.
#[allow(clippy::cast_precision_loss, reason = "turns are few")]
pub fn time(turns: usize, mut turn: impl FnMut(usize) -> Result<()>) -> Result<f64> {
    let start = now_ns();
    for at in 0..turns {
        turn(at)?;
    }
    Ok((now_ns() - start) / turns as f64)
}
