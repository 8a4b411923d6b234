//! The checker on the fast replica, alone and beside the reference: the same states, and nothing to find.

use dsr_core::MutationKind;
use dsr_model::alarms::{A, B, of_replicas, subject};
use dsr_model::histories::{Bound, HistoryRun};
use dsr_model::job::{AlgebraRun, Job};
use dsr_model::progress::{Limits, Progress};
use dsr_model::schedules::{ScheduleBound, ScheduleRun};
use dsr_model::semantics::Semantics;
use dsr_model::trace::Trace;
use dsr_model::twin::{Core, OnCore, Twin};
use dsr_model::verdict::{RunReport, Verdict};
use dsr_model::{replay, why};
use std::sync::Arc;

fn run(job: &dyn Job) -> RunReport {
    job.run(&Arc::new(Progress::new(Limits::default())))
}

/// What must not depend on the core: the verdict, and how many states there are of each kind.
#[track_caller]
fn check(job: impl Fn(Core) -> Box<dyn Job>) {
    let told = |core| {
        let report = run(&*job(core));
        assert_eq!(report.verdict, Verdict::Exhaustive, "{core:?}: {:?}", report.notes);
        let states = report.states;
        (states.unique, states.generated, states.judged, states.diamonds)
    };
    let reference = told(Core::Reference);
    assert!(reference.0 > 1);
    assert_eq!(told(Core::Fast), reference);
    assert_eq!(told(Core::Both), reference);
}

fn histories(replicas: usize, mutations: usize) -> HistoryRun<dsr_model::checked::Checked> {
    HistoryRun {
        name: "twin".into(),
        semantics: Arc::new(subject(&MutationKind::ALL, &[A, B])),
        focus: 2,
        bound: Bound { replicas, mutations },
        symmetry: true,
        second_engine: true,
    }
}

/// [spec: CHECK-15]
#[test]
fn differential_histories_are_the_same_on_either_core() {
    check(|core| histories(2, 1).on(core));
    check(|core| histories(1, 2).on(core));
}

/// [spec: CHECK-15]
#[test]
fn differential_schedules_are_the_same_on_either_core() {
    fn schedules<S: Semantics>(semantics: S) -> Box<dyn Job> {
        let bound =
            ScheduleBound { replicas: 2, readers: 0, mutations: 1, restarts: 0, resynchronisations: 1 };
        let (name, semantics) = ("twin".into(), Arc::new(semantics));
        Box::new(ScheduleRun { name, semantics, focus: 1, bound, second_engine: false })
    }
    let of = || subject(&MutationKind::ALL, &[B]);
    check(|core| match core {
        Core::Reference => schedules(of()),
        Core::Fast => schedules(Twin::alone(of())),
        Core::Both => schedules(Twin::beside(of())),
    });
}

/// [spec: CHECK-15]
#[test]
fn differential_the_algebra_is_the_same_on_either_core() {
    let semantics = Arc::new(subject(&MutationKind::ALL, &[A, B]));
    check(|core| AlgebraRun { semantics: semantics.clone(), records: 3 }.on(core));
}

/// What L1 finds on broken replicas is written down, can be carried out again, and asked why.
/// [spec: CHECK-8] [spec: TRACE-6]
#[test]
fn canary_traces_of_broken_replicas_replay() {
    let mut replayed = 0;
    // What snapshots share with each other is no part of any course, so no course can bring it about again.
    for alarm in of_replicas().into_iter().filter(|alarm| alarm.clause != "REPLICA-2") {
        for (replicas, mutations) in [(1, 1), (1, 2)] {
            let job = alarm.histories(subject(&MutationKind::ALL, &[A, B]), Bound { replicas, mutations });
            for found in &run(&*job).traces {
                let trace = Trace::read(&found.json.to_string()).expect("a trace");
                assert_eq!(trace.semantics, alarm.name);
                let again = replay::replay(&trace);
                assert!(again.is_ok(), "{}: {again:?}\n{}", alarm.name, found.text);
                let answer = why::why(&trace, 0, &trace.replicas[0].name, "b");
                assert!(answer.is_ok(), "{answer:?}");
                replayed += 1;
            }
        }
    }
    assert!(replayed >= 10, "{replayed}");
}
