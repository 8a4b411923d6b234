//! Traces happen again as they are written; what was changed in them is told with its step.

#![expect(clippy::expect_used, reason = "helpers of tests: what they expect is what they test")]

use dsr_core::MutationKind;
use dsr_model::alarms::{A, B};
use dsr_model::gallery::{rows, run_row};
use dsr_model::graph::{Change, Element};
use dsr_model::histories::{Bound, HistoryRun};
use dsr_model::job::Job;
use dsr_model::progress::{Limits, Progress};
use dsr_model::published::suite::ClauseRun;
use dsr_model::published::{Stamps, Variant, Workers};
use dsr_model::replay::{ReplayError, replay};
use dsr_model::schedules::{ScheduleBound, ScheduleRun};
use dsr_model::trace::{Act, FindingKind, Trace, Unsound};
use dsr_model::walks::{self, Faults, Walk};
use std::sync::{Arc, OnceLock};

/// Both traces of every row of the gallery.
fn of_gallery() -> &'static [Trace] {
    static TRACES: OnceLock<Vec<Trace>> = OnceLock::new();
    TRACES.get_or_init(gallery)
}

fn gallery() -> Vec<Trace> {
    rows()
        .iter()
        .flat_map(|row| {
            let report = run_row(row);
            [report.trace, report.checked.map(|twin| twin.trace)]
        })
        .map(|trace| trace.expect("a trace"))
        .collect()
}

/// What L1 and L2 find in every core broken on purpose, at the least bounds.
fn of_alarms() -> &'static [Trace] {
    static TRACES: OnceLock<Vec<Trace>> = OnceLock::new();
    TRACES.get_or_init(alarms)
}

fn alarms() -> Vec<Trace> {
    let mut traces = Vec::new();
    let (faults, walks) = (Faults::ALL, 40);
    let walk = Walk { replicas: 3, mutations_max: 6, events_max: 60, seed: 1, faults };
    for alarm in dsr_model::alarms::all() {
        let semantics = Arc::new(alarm.core(&MutationKind::ALL, &[A, B]));
        // What random walks find, shrunk.
        let found = walks::find(&semantics, walk, walks);
        traces.extend(found.map(|found| found.trace().expect("a trace")));
        for (replicas, mutations) in [(1, 1), (1, 2), (2, 1)] {
            let name = alarm.name.to_owned();
            let progress = || Arc::new(Progress::new(Limits { states_max: 20_000, ..Limits::default() }));
            let bound = Bound { replicas, mutations };
            let histories = HistoryRun {
                name: name.clone(),
                semantics: semantics.clone(),
                focus: 2,
                bound,
                symmetry: false,
                second_engine: false,
            };
            let (readers, restarts, resynchronisations) = (0, 1, 1);
            let bound = ScheduleBound { replicas, readers, mutations, restarts, resynchronisations };
            let schedules =
                ScheduleRun { name, semantics: semantics.clone(), focus: 2, bound, second_engine: false };
            let runs = [histories.run(&progress()), schedules.run(&progress())];
            for run in &runs {
                assert!(run.notes.iter().all(|note| !note.contains("cannot be shown")), "{:?}", run.notes);
            }
            let json = runs.iter().flat_map(|run| &run.traces).map(|trace| trace.json.to_string());
            traces.extend(json.map(|json| Trace::read(&json).expect("a trace")));
        }
    }
    traces
}

/// `[spec: TRACE-6]`
#[test]
fn law_every_gallery_trace_replays_identically_a_hundred_times() {
    for trace in of_gallery() {
        let first = replay(trace).unwrap_or_else(|error| panic!("{}: {error}\n{trace}", trace.title));
        assert_eq!((first.steps, first.judged), (trace.steps.len(), Ok(())), "{}", trace.title);
        for _ in 1..100 {
            assert_eq!(replay(trace).as_ref(), Ok(&first), "{}", trace.title);
        }
    }
}

/// `[spec: TRACE-6]`
#[test]
fn law_every_counterexample_of_a_broken_core_replays_to_its_clause() {
    let traces = of_alarms();
    let mut unjudged = Vec::new();
    for trace in traces {
        let replayed = replay(trace)
            .unwrap_or_else(|error| panic!("{} {}: {error}\n{trace}", trace.semantics, trace.layer));
        if replayed.judged.is_err() {
            unjudged.push(trace.finding.clause.as_str());
        }
    }
    assert!(traces.len() > 60, "{}", traces.len());
    // Only clauses of the search itself are not judged again.
    assert!(unjudged.iter().all(|clause| *clause == "CHECK-11"), "{unjudged:?}");
}

/// What the ordinary suite finds in the published semantics, by the clauses that break soon.
/// `[spec: TRACE-6]` `[spec: CHECK-12]`
#[test]
fn law_every_counterexample_of_the_published_suite_replays_to_its_clause() {
    for (workers, stamps) in [(Workers::Several, Stamps::Zero), (Workers::One, Stamps::Author)] {
        for clause in ["MUT-0", "INV-2", "INV-3", "VIEW-7", "JOIN-3", "JOIN-5"] {
            let run = ClauseRun { variant: Variant { workers, stamps }, clause };
            let report = run.run(&Arc::new(Progress::new(Limits::default())));
            let json = report.traces.first().expect("a counterexample").json.to_string();
            let trace = Trace::read(&json).expect("a trace");
            assert_eq!(trace.finding.clause, clause);
            let replayed = replay(&trace).unwrap_or_else(|error| panic!("{clause}: {error}\n{trace}"));
            assert_eq!((replayed.steps, replayed.judged), (trace.steps.len(), Ok(())), "{clause}");
            let mut other = trace.clone();
            other.setup["variant"] = "a third".into();
            assert!(matches!(replay(&other), Err(ReplayError::Setup { .. })));
            other.setup["variant"] = if workers == Workers::One { "upstream".into() } else { "fork".into() };
            assert!(matches!(replay(&other), Err(ReplayError::Setup { .. })), "the name tells the variant");
        }
    }
}

/// The step that an error names.
fn step_of(error: &ReplayError) -> Option<usize> {
    match error {
        ReplayError::Impossible { step, .. }
        | ReplayError::Unscheduled { step, .. }
        | ReplayError::Step { step, .. }
        | ReplayError::Unsound(
            Unsound::Message { step, .. } | Unsound::Change { step, .. } | Unsound::Replica { step, .. },
        ) => Some(*step),
        _ => None,
    }
}

fn all() -> impl Iterator<Item = &'static Trace> {
    of_gallery().iter().chain(of_alarms())
}

/// One step left out: told at the step after it or later, or at the end if it was the last.
#[test]
fn canary_a_step_left_out_is_told() {
    let mut told = 0;
    for trace in all() {
        for at in 0..trace.steps.len() {
            let mut torn = trace.clone();
            torn.steps.remove(at);
            let Err(error) = replay(&torn) else {
                // A step that does nothing that anybody could see, a note or a loss, can be left out.
                let does = &trace.steps[at].does;
                let silent =
                    matches!(does, Act::Happen { .. } | Act::Lose { .. } | Act::Restart { keeps: true });
                // The start of a sound run of one replica is one.
                let short = trace.finding.kind == FindingKind::Holds && trace.replicas.len() == 1;
                let is_idle = silent || short || trace.steps[at].changes.is_empty();
                assert!(is_idle, "{} without step {}\n{trace}", trace.title, at + 1);
                continue;
            };
            let step = step_of(&error).unwrap_or(usize::MAX);
            assert!(step > at, "{} without step {}: {error}", trace.title, at + 1);
            told += 1;
        }
    }
    assert!(told > 300, "{told}");
}

/// One value changed, wherever an attribute or a name changes: told at that step.
#[test]
fn canary_a_changed_value_is_told_at_its_step() {
    let mut told = 0;
    for trace in all() {
        for at in 0..trace.steps.len() {
            let mut torn = trace.clone();
            let Some(Change::Element { after: Some(element), .. }) = torn.steps[at].changes.first_mut()
            else {
                continue;
            };
            let (Element::Vertex { attributes, .. } | Element::Edge { attributes, .. }) = element;
            match attributes.values_mut().next() {
                Some(value) => value.push('q'),
                None => continue,
            }
            let error = replay(&torn).expect_err("a difference");
            assert_eq!(step_of(&error), Some(at + 1), "{}: {error}", trace.title);
            let ReplayError::Step { difference, .. } = &error else { continue };
            assert!(difference.path.starts_with("changes[0].after.attributes."), "{difference}");
            assert!(difference.written.ends_with("q\"") && !difference.found.ends_with("q\""));
            told += 1;
        }
    }
    assert!(told > 50, "{told}");
}

/// One delivery changed to that of another message: told at that step, unless both bring the same.
#[test]
fn canary_a_changed_delivery_is_told_at_its_step() {
    let mut told = 0;
    for trace in all() {
        let sent: Vec<String> =
            trace.steps.iter().flat_map(|step| step.does.sends()).map(|sent| sent.message.clone()).collect();
        for at in 0..trace.steps.len() {
            let Act::Deliver { message: right, .. } = &trace.steps[at].does else { continue };
            for wrong in sent.iter().filter(|message| *message != right) {
                let mut torn = trace.clone();
                let Act::Deliver { message, .. } = &mut torn.steps[at].does else { continue };
                message.clone_from(wrong);
                let Err(error) = replay(&torn) else {
                    // The other message says the same, or neither says anything new; or an answer says more, and
                    // the end of a sound run is the same.
                    let delta = |name: &String| {
                        let mut sent = trace.steps.iter().flat_map(|step| step.does.sends());
                        sent.find(|sent| sent.message == *name).map(|sent| &sent.delta)
                    };
                    let is_same = delta(wrong) == delta(right) || trace.steps[at].changes.is_empty();
                    let holds = trace.finding.kind == FindingKind::Holds;
                    assert!(is_same || holds, "{wrong} for {right}\n{trace}");
                    continue;
                };
                // What changes nothing here may be missed at the end only.
                let is_missed = matches!(error, ReplayError::Finding { .. });
                let is_told = step_of(&error) == Some(at + 1);
                assert!(is_told || is_missed, "{}: step {}: {error}", trace.title, at + 1);
                told += 1;
            }
        }
    }
    assert!(told > 100, "{told}");
}

/// The state behind what is shown, the start, the setup, the semantics, and what is found.
#[test]
fn canary_everything_else_that_was_changed_is_told() {
    for trace in all() {
        for at in 0..trace.steps.len() {
            let mut torn = trace.clone();
            torn.steps[at].state = "0123456789abcdef".into();
            let error = replay(&torn).expect_err("a difference");
            assert!(
                matches!(&error, ReplayError::Step { step, difference, .. }
                if *step == at + 1 && difference.path == "state"),
                "{error}"
            );
        }
        let mut torn = trace.clone();
        torn.replicas[0].starts.remarks.insert("odd".into());
        let error = replay(&torn).expect_err("a difference");
        assert!(matches!(error, ReplayError::Start { .. } | ReplayError::Unsound(_)), "{error}");
        let mut torn = trace.clone();
        torn.semantics = "nobody's".into();
        assert_eq!(replay(&torn), Err(ReplayError::NoSemantics { name: "nobody's".into() }));
        let mut torn = trace.clone();
        torn.setup = serde_json::Value::Null;
        let error = replay(&torn).expect_err("a difference");
        assert!(matches!(error, ReplayError::Setup { .. } | ReplayError::NoSemantics { .. }), "{error}");
        if trace.finding.clause != "CHECK-11" {
            let mut torn = trace.clone();
            torn.finding.clause = "INV-9".into();
            torn.finding.detail = "nothing".into();
            match replay(&torn) {
                Err(error) => assert!(matches!(error, ReplayError::Finding { .. }), "{error}"),
                Ok(_) => assert_eq!(trace.finding.kind, FindingKind::Holds),
            }
        }
    }
}
