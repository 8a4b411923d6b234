//! Many runs, and how often what is rare has happened.

use super::run::Outcome;
use crate::config::MS;
use crate::stats::Stats;
use std::fmt;

/// What many runs add up to.
#[derive(Clone, Debug, Default)]
pub struct Totals {
    /// Runs.
    pub runs: u64,
    /// Of these, runs that failed.
    pub failed: u64,
    /// Sessions at the ends.
    pub sessions: u64,
    /// Mutations made.
    pub mutations: u64,
    /// Records of the graphs at the ends.
    pub records: u64,
    /// The counters of all sessions.
    pub stats: Stats,
    /// Deliveries, and deliveries lost, cut, damaged, repeated, reordered, overflowed.
    pub deliveries: [u64; 7],
    healed_after: Vec<u64>,
}

impl Totals {
    /// Counts a run in.
    pub fn add(&mut self, outcome: &Outcome) {
        self.runs += 1;
        self.failed += u64::from(outcome.failure.is_some());
        self.sessions += outcome.sessions as u64;
        self.mutations += outcome.mutations;
        self.records += outcome.records as u64;
        self.stats.add(&outcome.stats);
        let traffic = outcome.traffic;
        let counts = [
            traffic.delivered,
            traffic.lost,
            traffic.cut,
            traffic.damaged,
            traffic.duplicated,
            traffic.reordered,
            traffic.overflowed,
        ];
        for (sum, count) in self.deliveries.iter_mut().zip(counts) {
            *sum += count;
        }
        self.healed_after.push(outcome.healed_after);
        self.healed_after.sort_unstable();
    }

    /// From healing until all were equal, in virtual nanoseconds: the time that so many of a thousand runs did not
    /// exceed.
    pub fn healed_after(&self, permille: usize) -> u64 {
        let at = (self.healed_after.len() * permille).div_ceil(1000).saturating_sub(1);
        self.healed_after.get(at).copied().unwrap_or(0)
    }
}

impl fmt::Display for Totals {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { runs, failed, sessions, mutations, records, stats, deliveries, .. } = self;
        writeln!(
            f,
            "{runs} runs, {failed} failed; {sessions} sessions, {mutations} mutations, {records} records"
        )?;
        writeln!(
            f,
            "equal after healing, virtual: median {} ms, 99 % {} ms, all {} ms",
            self.healed_after(500) / MS,
            self.healed_after(990) / MS,
            self.healed_after(1000) / MS
        )?;
        let [delivered, lost, cut, damaged, duplicated, reordered, overflowed] = deliveries;
        writeln!(
            f,
            "deliveries: {delivered}; lost {lost}, cut {cut}, damaged {damaged}, repeated {duplicated}, overtaking \
             {reordered}, unread {overflowed}"
        )?;
        write!(f, "sessions: ")?;
        for (at, (name, count)) in stats.named().into_iter().enumerate() {
            write!(f, "{}{name} {count}", if at == 0 { "" } else { ", " })?;
        }
        Ok(())
    }
}
