//! Schedules of the gallery: each step must be one that can happen then.

use super::{Difference, ReplayError, Replayed};
use crate::gallery::{PublishedRun, rows};
use crate::published::{Message, Replica};
use crate::trace::{Trace, TraceReplica, TraceStep};
use std::sync::Arc;

pub(super) fn replay(trace: &Trace) -> Result<Replayed, ReplayError> {
    let mut replay = PublishedReplay::start(trace)?;
    while replay.at < trace.steps.len() {
        replay.step()?;
    }
    let (expected, finding) = (trace.finding.to_string(), &trace.finding);
    match replay.run.judge() {
        Ok(()) => Err(ReplayError::Finding { expected, found: "nothing is broken".into() }),
        Err(breach) if breach.clause == finding.clause && breach.detail == finding.detail => {
            Ok(Replayed { steps: trace.steps.len(), judged: Ok(()) })
        }
        Err(breach) => {
            let found = format!("it is [{}] {}", breach.clause, breach.detail);
            Err(ReplayError::Finding { expected, found })
        }
    }
}

/// A schedule on its way.
#[derive(Debug)]
pub(crate) struct PublishedReplay<'t> {
    trace: &'t Trace,
    run: PublishedRun,
    at: usize,
}

impl<'t> PublishedReplay<'t> {
    /// Before the first step; every replica starts as it is written.
    pub(crate) fn start(trace: &'t Trace) -> Result<Self, ReplayError> {
        let number = trace.setup.get("row").and_then(|row| row.as_str()).unwrap_or_default();
        let row = rows().into_iter().find(|row| row.row == number).ok_or_else(|| ReplayError::Setup {
            semantics: trace.semantics.clone(),
            why: format!("the gallery has no row {number:?}"),
        })?;
        let run = PublishedRun::new(&row.setup);
        let starts = run.scribe().replicas();
        if let Some(difference) = Difference::between(&trace.replicas, &starts.to_vec()) {
            return Err(ReplayError::Start { replica: differing(&trace.replicas, starts), difference });
        }
        Ok(Self { trace, run, at: 0 })
    }

    /// Runs the next step, if there is one, and compares it.
    pub(crate) fn step(&mut self) -> Result<(), ReplayError> {
        let Some(written) = self.trace.steps.get(self.at) else { return Ok(()) };
        self.at += 1;
        let (step, replica) = (self.at, written.replica.clone());
        let possible = self.run.successors();
        let fits =
            |found: &&(_, TraceStep)| found.1.replica == written.replica && found.1.does == written.does;
        let same = possible.iter().find(|(_, found)| found == written);
        let Some((happening, found)) = same.or_else(|| possible.iter().find(fits)) else {
            let lines = possible.iter().map(|(_, step)| format!("{} {}", step.replica, step.does));
            let possible = lines.collect::<Vec<_>>().join("; ");
            return Err(ReplayError::Unscheduled { step, replica, possible });
        };
        if let Some(difference) = Difference::between(written, found) {
            return Err(ReplayError::Step { step, replica, difference });
        }
        self.run.happen(happening);
        Ok(())
    }

    /// A replica by position, as it is now.
    pub(crate) fn replica(&self, replica: usize) -> Arc<Replica> {
        self.run.replica(replica)
    }

    /// What was sent so far, in the order of its names.
    pub(crate) fn messages(&self) -> impl Iterator<Item = &Message> {
        self.run.messages()
    }
}

fn differing(written: &[TraceReplica], starts: &[TraceReplica]) -> String {
    let odd = written.iter().zip(starts).find(|(written, starts)| written != starts);
    odd.map_or_else(|| "the cast".into(), |(written, _)| written.name.clone())
}
