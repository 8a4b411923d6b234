//! One alarm through the layers, at growing bounds.

use super::broken::{Broken, Sound};
use super::subject::subject;
use super::Alarm;
use crate::algebra;
use crate::histories::{Bound, HistoryRun};
use crate::progress::{Limits, Progress};
use crate::schedules::{ScheduleBound, ScheduleRun};
use crate::verdict::{RunReport, Verdict};
use dsr_core::MutationKind;
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
    /// The largest bound that was searched, to its end if nothing was found.
    pub searched: String,
    /// How long it took.
    pub seconds: f64,
}

/// The most states of one search.
const STATES_MAX: u64 = 400_000;

/// Tries every layer, the cheapest first; with `all_layers` also those after the first that finds it.
pub fn run_alarm(alarm: &Alarm, all_layers: bool) -> Vec<LayerReport> {
    layers(&|kinds| Broken::new(alarm.name, subject(kinds), alarm.flaw.clone()), all_layers)
}

/// The sound core through the same layers and bounds: nothing may be found.
pub fn run_sound() -> Vec<LayerReport> {
    layers(&|kinds| Broken::new("sound", subject(kinds), Arc::new(Sound)), true)
}

/// The semantics under test with some kinds of mutation.
type Make<'m> = &'m dyn Fn(&[MutationKind]) -> Broken;

fn layers(make: Make<'_>, all_layers: bool) -> Vec<LayerReport> {
    let mut reports = Vec::new();
    for (layer, search) in [("L0", algebra as Search), ("L1", histories), ("L2", schedules)] {
        let started = Instant::now();
        let (finding, searched) = search(make);
        let found = finding.is_some();
        reports.push(LayerReport { layer, finding, searched, seconds: started.elapsed().as_secs_f64() });
        if found && !all_layers {
            break;
        }
    }
    reports
}

type Search = fn(Make<'_>) -> (Option<Finding>, String);

fn algebra(make: Make<'_>) -> (Option<Finding>, String) {
    let broken = make(&MutationKind::ALL);
    let mut searched = String::new();
    for records in 1..=4 {
        searched = format!("{records} records");
        let report = algebra::run(&broken, records);
        let violated = report.violation();
        if let Some((law, example)) = violated.and_then(|law| Some((law, law.example.as_ref()?))) {
            let (clause, bound) = (example.clause.into(), searched.clone());
            let detail = format!("{} ({}: {})", law.law, example.family, example.detail);
            let finding = Finding { layer: "L0", bound, clause, detail, steps: example.states.len() };
            return (Some(finding), searched);
        }
    }
    (None, searched)
}

/// The bounds of L1 and L2 with their kinds of mutation: all six while that is cheap, then pairs of kinds.
fn ladder() -> Vec<(usize, usize, Vec<MutationKind>)> {
    let all = MutationKind::ALL;
    let mut ladder = vec![(1, 1, all.to_vec()), (1, 2, all.to_vec()), (2, 1, all.to_vec())];
    for left in 0..all.len() {
        ladder.extend((left + 1..all.len()).map(|right| (2, 2, vec![all[left], all[right]])));
    }
    ladder
}

fn histories(make: Make<'_>) -> (Option<Finding>, String) {
    let mut searched = String::new();
    for (replicas, mutations, kinds) in ladder() {
        searched = bound_name(replicas, mutations, &kinds);
        let run = HistoryRun {
            name: searched.clone(),
            semantics: Arc::new(make(&kinds)),
            focus: 2,
            bound: Bound { replicas, mutations },
            symmetry: false,
            second_engine: false,
        };
        let report = run.run(&progress());
        if report.verdict == Verdict::Violated {
            return (Some(finding("L1", &report)), searched);
        }
    }
    (None, searched)
}

fn schedules(make: Make<'_>) -> (Option<Finding>, String) {
    let mut searched = String::new();
    for (replicas, mutations, kinds) in schedule_ladder() {
        searched = bound_name(replicas, mutations, &kinds);
        let bound = ScheduleBound { replicas, readers: 0, mutations, restarts: 1, resynchronisations: 1 };
        let run = ScheduleRun { name: searched.clone(), semantics: Arc::new(make(&kinds)), focus: 2, bound };
        let report = run.run(&progress());
        if report.verdict == Verdict::Violated {
            return (Some(finding("L2", &report)), searched);
        }
    }
    (None, searched)
}

fn schedule_ladder() -> Vec<(usize, usize, Vec<MutationKind>)> {
    ladder()
}

fn progress() -> Arc<Progress> {
    Arc::new(Progress::new(Limits { states_max: STATES_MAX, ..Limits::default() }))
}

fn bound_name(replicas: usize, mutations: usize, kinds: &[MutationKind]) -> String {
    let kinds: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
    let kinds = if kinds.len() == MutationKind::ALL.len() { "all six".into() } else { kinds.join(" + ") };
    format!("{replicas} × {mutations}, {kinds}")
}

fn finding(layer: &'static str, report: &RunReport) -> Finding {
    let trace = report.traces.first();
    let clause = trace.map_or_else(|| "?".into(), |trace| trace.clause.clone());
    let detail = trace.and_then(|trace| trace.json["breach"]["detail"].as_str()).map_or_else(
        || report.notes.join("; "),
        Into::into,
    );
    let steps = trace.and_then(|trace| trace.json["steps"].as_array()).map_or(0, Vec::len);
    Finding { layer, bound: report.name.clone(), clause, detail, steps }
}
