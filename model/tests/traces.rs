//! Counterexamples of L1 as traces: they can be read back, and replayed to the states that they show.

#![expect(
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests: what they expect is what they test"
)]

use dsr_core::{Delta, MutationKind, State};
use dsr_model::alarms::{self, A, B, Broken};
use dsr_model::histories::{Bound, HistoryRun};
use dsr_model::progress::{Limits, Progress};
use dsr_model::semantics::Semantics;
use dsr_model::trace::{Act, FindingKind, TRACE_VERSION, Trace};
use dsr_model::verdict::{RunReport, Verdict};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A run of L1 on a broken core, until it breaks.
fn broken_run(name: &str, replicas: usize, mutations: usize) -> (Arc<Broken>, RunReport) {
    let alarm = alarms::all().into_iter().find(|alarm| alarm.name == name);
    let core = alarm.map(|alarm| Arc::new(alarm.core(&MutationKind::ALL, &[A, B])));
    let semantics = core.unwrap_or_else(|| panic!("no alarm {name}"));
    let bound = Bound { replicas, mutations };
    let run = HistoryRun {
        name: name.into(),
        semantics: semantics.clone(),
        focus: 2,
        bound,
        symmetry: false,
        second_engine: false,
    };
    (semantics, run.run(&Arc::new(Progress::new(Limits::default()))))
}

/// Each replica's state after the steps of a trace, by delivering the deltas that it carries.
fn end_states(semantics: &Broken, trace: &Trace) -> BTreeMap<String, State> {
    let state = |json: &serde_json::Value| serde_json::from_value::<State>(json.clone());
    let initial = state(&trace.setup["initial"]).expect("an initial state");
    let mut messages: BTreeMap<&str, Delta> = BTreeMap::new();
    let mut replicas: BTreeMap<String, State> = BTreeMap::new();
    for step in &trace.steps {
        let before = replicas.entry(step.replica.clone()).or_insert_with(|| initial.clone());
        for sent in step.does.sends() {
            let delta = state(&sent.delta).expect("a delta");
            *before = semantics.join(before, &delta);
            messages.insert(&sent.message, delta);
        }
        if let Some(message) = step.does.message() {
            *before = semantics.join(before, &messages[message]);
        }
    }
    replicas
}

/// `[spec: TRACE-1]` `[spec: TRACE-2]`
#[test]
fn law_a_trace_is_read_back_and_shows_what_its_deltas_lead_to() {
    for (name, replicas, mutations) in [("tie-by-arrival", 1, 2), ("last-delivered-wins", 2, 1)] {
        let (semantics, report) = broken_run(name, replicas, mutations);
        assert_eq!(report.verdict, Verdict::Violated);
        let json = report.traces.first().expect("a counterexample").json.clone();
        let trace = Trace::read(&json.to_string()).expect("the trace's own format");
        assert_eq!(serde_json::to_value(&trace).expect("json"), json);
        assert_eq!((trace.format.as_str(), trace.version), ("dsr-trace", TRACE_VERSION));
        let reached = end_states(&semantics, &trace);
        let shown = trace.graphs().expect("a sound trace");
        for (replica, graph) in trace.replicas.iter().zip(shown.last().expect("a graph")) {
            let reached =
                reached.get(&replica.name).map_or(replica.starts.clone(), |state| semantics.shows(state));
            assert_eq!(reached, *graph, "{name}: {}", replica.name);
        }
        // The same deltas in two orders, and two outcomes.
        assert_eq!((trace.finding.kind, trace.finding.clause.as_str()), (FindingKind::Broken, "JOIN-3"));
        let [one, other] = &trace.finding.replicas[..] else { panic!("{:?}", trace.finding) };
        assert_ne!(reached[one], reached[other]);
    }
}

/// `[spec: TRACE-4]` `[spec: CHECK-8]`
#[test]
fn law_a_counterexample_has_the_fewest_mutations() {
    let (_, report) = broken_run("stamp-not-advanced", 2, 2);
    let trace = Trace::read(&report.traces[0].json.to_string()).expect("a trace");
    let mutations = trace.steps.iter().filter(|step| matches!(step.does, Act::Mutate { .. }));
    assert_eq!(mutations.count(), 1, "{trace}");
    assert_eq!(trace.finding.clause, "STAMP-1");
    assert!(trace.to_string().contains("[STAMP-1]"));
}
