//! How many states the checker makes in a second, on the readable reference and on the fast replica.

use crate::error::{BenchError, Result};
use crate::stopwatch::now_ns;
use dsr_core::scene::{FLAT, Scene, Strictness};
use dsr_core::{Dictionary, MutationKind};
use dsr_model::histories::{Bound, HistoryRun};
use dsr_model::job::Job;
use dsr_model::progress::{Limits, Progress};
use dsr_model::schedules::{ScheduleBound, ScheduleRun};
use dsr_model::suite::{FLAT_FOCUS, Subject};
use dsr_model::twin::Twin;
use dsr_model::verdict::{RunReport, Verdict};
use std::sync::Arc;

/// How fast a layer of the checker is, by one engine.
#[derive(Clone, Debug)]
pub struct Pace {
    /// The layer and its run.
    pub id: String,
    /// States generated per second of the processor.
    pub per_second: f64,
}

/// What the pace of the fast replica is called by.
const FAST: &str = "fast replica";

/// What the fast replica makes of the reference's pace, in the run that both have done.
pub fn fast_by_reference(paces: &[Pace]) -> Option<f64> {
    let fast = paces.iter().find(|pace| pace.id.ends_with(FAST))?;
    let reference = paces.iter().find(|pace| fast.id == format!("{}, {FAST}", pace.id))?;
    Some(fast.per_second / reference.per_second)
}

/// The paces of histories (L1) and of schedules (L2), on the embedded flat.
pub fn paces() -> Result<Vec<Pace>> {
    let dictionary = Dictionary::aal();
    let scene = Scene::read(FLAT, &dictionary, Strictness::Strict);
    let scene = scene.map_err(|error| BenchError::Checker(error.to_string()))?.scene;
    let subject = Subject { state: &scene.state, dictionary: &dictionary, names: &FLAT_FOCUS };
    let failed = |error: dsr_model::focus::FocusError| BenchError::Checker(error.to_string());
    let bound = Bound { replicas: 3, mutations: 1 };
    let mut histories = subject.histories(4, bound, &MutationKind::ALL).map_err(failed)?;
    histories.second_engine = false;
    let fast = HistoryRun {
        name: format!("{}, {FAST}", histories.name),
        semantics: Arc::new(Twin::alone((*histories.semantics).clone())),
        focus: histories.focus,
        bound,
        symmetry: histories.symmetry,
        second_engine: false,
    };
    let mut paces = vec![pace(&histories)?, pace(&fast)?];
    let once = Bound { replicas: 2, mutations: 1 };
    let focused = subject.histories(2, once, &MutationKind::ALL).map_err(failed)?;
    let schedules = ScheduleRun {
        name: focused.name,
        semantics: focused.semantics,
        focus: focused.focus,
        bound: ScheduleBound { replicas: 2, readers: 0, mutations: 1, restarts: 1, resynchronisations: 1 },
        second_engine: false,
    };
    paces.push(pace(&schedules)?);
    Ok(paces)
}

fn pace(job: &dyn Job) -> Result<Pace> {
    let start = now_ns();
    let run: RunReport = job.run(&Arc::new(Progress::new(Limits::default())));
    let seconds = (now_ns() - start) / 1e9;
    if run.verdict != Verdict::Exhaustive {
        return Err(BenchError::Checker(format!("{} is not exhaustive", run.name)));
    }
    #[allow(clippy::cast_precision_loss, reason = "2⁵³ states are not made")]
    let per_second = run.states.generated as f64 / seconds;
    Ok(Pace { id: format!("{} {}", job.layer(), job.name()), per_second })
}
