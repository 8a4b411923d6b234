//! Progress of a run, for whoever watches it, and the means to stop it.

use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering::Relaxed};
use std::time::Instant;

/// Counters of one run, and its limits. Reaching a limit stops the run; its verdict is then *bounded*.
/// `[spec: CHECK-1]`
#[derive(Debug)]
pub struct Progress {
    expanded: AtomicU64,
    generated: AtomicU64,
    judged: AtomicU64,
    recounted: AtomicU64,
    depth: AtomicUsize,
    witnessed: AtomicUsize,
    stop: AtomicBool,
    started: Instant,
    limits: Limits,
}

/// Where a run stops although it has not reached its bound.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Limits {
    /// The most states expanded.
    pub states_max: u64,
    /// The longest time, in seconds.
    pub seconds_max: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { states_max: u64::MAX, seconds_max: f64::INFINITY }
    }
}

impl Progress {
    /// Counters at zero; time runs from now.
    pub fn new(limits: Limits) -> Self {
        Self {
            expanded: AtomicU64::new(0),
            generated: AtomicU64::new(0),
            judged: AtomicU64::new(0),
            recounted: AtomicU64::new(0),
            depth: AtomicUsize::new(0),
            witnessed: AtomicUsize::new(0),
            stop: AtomicBool::new(false),
            started: Instant::now(),
            limits,
        }
    }

    /// Records how far the run is.
    pub fn note(&self, expanded: u64, generated: u64, depth: usize) {
        self.expanded.store(expanded, Relaxed);
        self.generated.store(generated, Relaxed);
        self.depth.fetch_max(depth, Relaxed);
    }

    /// Records how many replica states were judged, and how many different things they bear witness of.
    pub fn note_seen(&self, judged: u64, witnessed: usize) {
        self.judged.store(judged, Relaxed);
        self.witnessed.store(witnessed, Relaxed);
    }

    /// How many different things were witnessed.
    pub fn witnessed(&self) -> usize {
        self.witnessed.load(Relaxed)
    }

    /// States expanded, successors generated, replica states judged, greatest depth.
    pub fn counts(&self) -> (u64, u64, u64, usize) {
        (
            self.expanded.load(Relaxed),
            self.generated.load(Relaxed),
            self.judged.load(Relaxed),
            self.depth.load(Relaxed),
        )
    }

    /// The run's limits.
    pub fn limits(&self) -> Limits {
        self.limits
    }

    /// Tells the run to stop.
    pub fn stop(&self) {
        self.stop.store(true, Relaxed);
    }

    /// Whether the run has reached a limit or was told to stop.
    pub fn must_stop(&self) -> bool {
        let expanded = self.expanded.load(Relaxed);
        // The clock is read now and then only.
        let late = expanded.is_multiple_of(256) && self.seconds() >= self.limits.seconds_max;
        if late || expanded >= self.limits.states_max {
            self.stop();
        }
        self.stop.load(Relaxed)
    }

    /// Whether the run must stop while it counts once more what it has explored.
    pub fn must_stop_recount(&self, counted: u64) -> bool {
        self.recounted.store(counted, Relaxed);
        if counted.is_multiple_of(256) && self.seconds() >= self.limits.seconds_max {
            self.stop();
        }
        self.stop.load(Relaxed)
    }

    /// States counted once more by the second engine.
    pub fn recounted(&self) -> u64 {
        self.recounted.load(Relaxed)
    }

    /// Seconds since the run began.
    pub fn seconds(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }
}
