//! One alarm through the layers, at growing bounds.

use super::Alarm;
use super::broken::{Broken, Sound};
use super::subject::{A, B, subject};
use crate::algebra::{self, Algebra};
use crate::histories::{Bound, HistoryRun};
use crate::progress::{Limits, Progress};
use crate::schedules::{ScheduleBound, ScheduleRun};
use crate::twin::Twin;
use crate::verdict::{RunReport, Verdict};
use dsr_core::{MutationKind, VertexId};
use serde::Serialize;
use std::sync::Arc;
use std::time::Instant;

/// Where a flaw was found.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Finding {
    /// The layer.
    pub layer: &'static str,
    /// Its bound: records for L0, replicas × mutations for L1 and L2.
    pub bound: String,
    /// The clause that broke.
    pub clause: String,
    /// What was wrong.
    pub detail: String,
    /// States in the counterexample of L0, steps in that of L1 and L2.
    pub steps: usize,
}

/// One layer on one alarm.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct LayerReport {
    /// The layer.
    pub layer: &'static str,
    /// What it found, at its smallest bound.
    pub finding: Option<Finding>,
    /// The last bound that was searched.
    pub searched: String,
    /// Whether every bound up to that was searched to its end; a flaw that was found ends the search.
    pub exhaustive: bool,
    /// How long it took.
    pub seconds: f64,
}

/// The most states of a search with all six kinds: never reached.
const STATES_MAX: u64 = 2_000_000;
/// The most states of a search with a pair of kinds.
const PAIR_STATES_MAX: u64 = 100_000;

/// Tries every layer, the cheapest first; with `all_layers` also those after the first that finds it.
pub fn run_alarm(alarm: &Alarm, all_layers: bool) -> Vec<LayerReport> {
    layers(&|kinds, focus| alarm.core(kinds, focus), all_layers)
}

/// The sound core through the same layers and bounds: nothing may be found.
pub fn run_sound() -> Vec<LayerReport> {
    layers(&|kinds, focus| Broken::new("sound", subject(kinds, focus), Arc::new(Sound)), true)
}

/// The sound replica beside the reference, through the same layers and bounds: nothing may be found.
pub fn run_sound_replica() -> Vec<LayerReport> {
    layers(&|kinds, focus| Twin::beside(subject(kinds, focus)), true)
}

/// The semantics under test with some kinds of mutation on some vertices.
pub(super) type Make<'m, S> = &'m dyn Fn(&[MutationKind], &[VertexId]) -> S;

pub(super) fn layers<S: Algebra>(make: Make<'_, S>, all_layers: bool) -> Vec<LayerReport> {
    let mut reports = Vec::new();
    for (layer, search) in [("L0", algebra as Search<S>), ("L1", histories), ("L2", schedules)] {
        let started = Instant::now();
        let Outcome { finding, searched, exhaustive } = search(make);
        let found = finding.is_some();
        let seconds = started.elapsed().as_secs_f64();
        reports.push(LayerReport { layer, finding, searched, exhaustive, seconds });
        if found && !all_layers {
            break;
        }
    }
    reports
}

type Search<S> = fn(Make<'_, S>) -> Outcome;

/// What one layer came to.
struct Outcome {
    finding: Option<Finding>,
    searched: String,
    exhaustive: bool,
}

fn algebra<S: Algebra>(make: Make<'_, S>) -> Outcome {
    let broken = make(&MutationKind::ALL, &[A, B]);
    let mut searched = String::new();
    for records in 1..=4 {
        searched = format!("{records} records");
        let report = algebra::run(&broken, records);
        let violated = report.violation();
        if let Some((law, example)) = violated.and_then(|law| Some((law, law.example.as_ref()?))) {
            let (clause, bound) = (example.clause.into(), searched.clone());
            let detail = format!("{} ({}: {})", law.law, example.family, example.detail);
            let finding = Finding { layer: "L0", bound, clause, detail, steps: example.states.len() };
            return Outcome { finding: Some(finding), searched, exhaustive: true };
        }
    }
    Outcome { finding: None, searched, exhaustive: true }
}

/// One bound of L1 and L2.
struct Rung {
    replicas: usize,
    mutations: usize,
    kinds: Vec<MutationKind>,
    focus: &'static [VertexId],
    states_max: u64,
}

/// All six kinds on two vertices while that is cheap; then, on one vertex, pairs of kinds that add none; last
/// one pair on both.
fn ladder() -> Vec<Rung> {
    let all = MutationKind::ALL;
    let rung = |replicas, mutations| Rung {
        replicas,
        mutations,
        kinds: all.to_vec(),
        focus: &[A, B],
        states_max: STATES_MAX,
    };
    let mut ladder = vec![rung(1, 1), rung(1, 2), rung(2, 1)];
    let fixed = &all[1..];
    for left in 0..fixed.len() {
        ladder.extend((left + 1..fixed.len()).map(|right| {
            let kinds = vec![fixed[left], fixed[right]];
            Rung { kinds, focus: &[B], states_max: PAIR_STATES_MAX, ..rung(2, 2) }
        }));
    }
    // Two vertices that can come to be below each other, and something that shifts stamps.
    let kinds = vec![MutationKind::UpdateAttributes, MutationKind::MoveEdge];
    ladder.push(Rung { kinds, states_max: PAIR_STATES_MAX, ..rung(2, 2) });
    ladder
}

/// Climbs the ladder until something is found.
fn climb(layer: &'static str, search: impl Fn(&Rung, String, &Arc<Progress>) -> RunReport) -> Outcome {
    let mut outcome = Outcome { finding: None, searched: String::new(), exhaustive: true };
    for rung in ladder() {
        outcome.searched = bound_name(rung.replicas, rung.mutations, &rung.kinds);
        let limits = Limits { states_max: rung.states_max, ..Limits::default() };
        let report = search(&rung, outcome.searched.clone(), &Arc::new(Progress::new(limits)));
        outcome.exhaustive &= report.verdict != Verdict::Bounded;
        if report.verdict == Verdict::Violated {
            outcome.finding = Some(finding(layer, &report));
            break;
        }
    }
    outcome
}

fn histories<S: Algebra>(make: Make<'_, S>) -> Outcome {
    climb("L1", |rung, name, progress| {
        let run = HistoryRun {
            name,
            semantics: Arc::new(make(&rung.kinds, rung.focus)),
            focus: rung.focus.len(),
            bound: Bound { replicas: rung.replicas, mutations: rung.mutations },
            symmetry: false,
            second_engine: false,
        };
        run.run(progress)
    })
}

/// With a restart and a resynchronisation while that is cheap, then with a restart.
fn schedules<S: Algebra>(make: Make<'_, S>) -> Outcome {
    climb("L2", |rung, name, progress| {
        let (replicas, mutations) = (rung.replicas, rung.mutations);
        let resynchronisations = u8::from(replicas * mutations < 4);
        let bound = ScheduleBound { replicas, readers: 0, mutations, restarts: 1, resynchronisations };
        let semantics = Arc::new(make(&rung.kinds, rung.focus));
        ScheduleRun { name, semantics, focus: rung.focus.len(), bound, second_engine: false }.run(progress)
    })
}

fn bound_name(replicas: usize, mutations: usize, kinds: &[MutationKind]) -> String {
    let kinds: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
    let kinds = if kinds.len() == MutationKind::ALL.len() { "all six".into() } else { kinds.join(" + ") };
    format!("{replicas} × {mutations}, {kinds}")
}

fn finding(layer: &'static str, report: &RunReport) -> Finding {
    let trace = report.traces.first();
    let clause = trace.map_or_else(|| "?".into(), |trace| trace.clause.clone());
    let detail = trace
        .and_then(|trace| trace.json["finding"]["detail"].as_str())
        .map_or_else(|| report.notes.join("; "), Into::into);
    let steps = trace.and_then(|trace| trace.json["steps"].as_array()).map_or(0, Vec::len);
    Finding { layer, bound: report.name.clone(), clause, detail, steps }
}
