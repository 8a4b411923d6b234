//! Schedules of the gallery: each step must be one that can happen then.

use super::{Difference, ReplayError, Replayed};
use crate::gallery::{PublishedRun, rows};
use crate::trace::{Trace, TraceReplica, TraceStep};

pub(super) fn replay(trace: &Trace) -> Result<Replayed, ReplayError> {
    let number = trace.setup.get("row").and_then(|row| row.as_str()).unwrap_or_default();
    let row = rows().into_iter().find(|row| row.row == number).ok_or_else(|| ReplayError::Setup {
        semantics: trace.semantics.clone(),
        why: format!("the gallery has no row {number:?}"),
    })?;
    let mut run = PublishedRun::new(&row.setup);
    let starts = run.scribe().replicas();
    if let Some(difference) = Difference::between(&trace.replicas, &starts.to_vec()) {
        let at = differing(&trace.replicas, starts);
        return Err(ReplayError::Start { replica: at, difference });
    }
    for (at, written) in trace.steps.iter().enumerate() {
        let step = at + 1;
        let possible = run.successors();
        let fits =
            |found: &&(_, TraceStep)| found.1.replica == written.replica && found.1.does == written.does;
        let same = possible.iter().find(|(_, found)| found == written);
        let Some((happening, found)) = same.or_else(|| possible.iter().find(fits)) else {
            let lines = possible.iter().map(|(_, step)| format!("{} {}", step.replica, step.does));
            let possible = lines.collect::<Vec<_>>().join("; ");
            return Err(ReplayError::Unscheduled { step, replica: written.replica.clone(), possible });
        };
        if let Some(difference) = Difference::between(written, found) {
            return Err(ReplayError::Step { step, replica: written.replica.clone(), difference });
        }
        run.happen(happening);
    }
    let (expected, finding) = (trace.finding.to_string(), &trace.finding);
    match run.judge() {
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

fn differing(written: &[TraceReplica], starts: &[TraceReplica]) -> String {
    let odd = written.iter().zip(starts).find(|(written, starts)| written != starts);
    odd.map_or_else(|| "the cast".into(), |(written, _)| written.name.clone())
}
