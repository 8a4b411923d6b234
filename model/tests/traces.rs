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
use dsr_model::trace::{Act, TRACE_VERSION, Trace};
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
fn replay(semantics: &Broken, trace: &Trace) -> BTreeMap<String, State> {
    let state = |json: &serde_json::Value| serde_json::from_value::<State>(json.clone());
    let initial = state(&trace.initial).expect("an initial state");
    let mut messages: BTreeMap<&str, Delta> = BTreeMap::new();
    let mut replicas: BTreeMap<String, State> = BTreeMap::new();
    for step in &trace.steps {
        let before = replicas.entry(step.replica.clone()).or_insert_with(|| initial.clone());
        match &step.act {
            Act::Mutate { message, delta, .. } => {
                let delta = state(delta).expect("a delta");
                *before = semantics.join(before, &delta);
                messages.insert(message, delta);
            }
            Act::Deliver { message } => *before = semantics.join(before, &messages[message.as_str()]),
            Act::Restart | Act::Resynchronise { .. } => unreachable!("L1 has neither"),
        }
    }
    replicas
}

/// `[spec: TRACE-1]`
#[test]
fn law_a_trace_is_read_back_and_replays_to_the_states_that_it_shows() {
    for (name, replicas, mutations) in [("tie-by-arrival", 1, 2), ("last-delivered-wins", 2, 1)] {
        let (semantics, report) = broken_run(name, replicas, mutations);
        assert_eq!(report.verdict, Verdict::Violated);
        let json = report.traces.first().expect("a counterexample").json.clone();
        let trace: Trace = serde_json::from_value(json.clone()).expect("the trace's own format");
        assert_eq!(serde_json::to_value(&trace).expect("json"), json);
        assert_eq!((trace.format.as_str(), trace.version), ("dsr-trace", TRACE_VERSION));
        let reached = replay(&semantics, &trace);
        assert!(!trace.breach.states.is_empty());
        for (replica, shown) in &trace.breach.states {
            let shown: State = serde_json::from_value(shown.clone()).expect("a state");
            assert_eq!(reached[replica], shown, "{name}: {replica}");
        }
        // The same deltas in two orders, and two outcomes.
        assert_eq!(trace.breach.clause, "JOIN-3");
        assert_ne!(trace.breach.states[0].1, trace.breach.states[1].1);
    }
}

/// `[spec: TRACE-1]` `[spec: CHECK-8]`
#[test]
fn law_a_counterexample_has_the_fewest_mutations() {
    let (_, report) = broken_run("stamp-not-advanced", 2, 2);
    let trace: Trace = serde_json::from_value(report.traces[0].json.clone()).expect("a trace");
    let mutations = trace.steps.iter().filter(|step| matches!(step.act, Act::Mutate { .. }));
    assert_eq!(mutations.count(), 1, "{trace}");
    assert_eq!(trace.breach.clause, "STAMP-1");
    assert!(trace.to_string().contains("[STAMP-1]"));
}
