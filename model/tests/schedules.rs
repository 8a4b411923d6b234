//! L2 on the production core.

use dsr_core::{AttributeMap, EdgeKey, ElementId, Mutation, MutationKind, Value, VertexId};
use dsr_model::alarms::{A, B, subject};
use dsr_model::checked::{Act, Checked};
use dsr_model::progress::{Limits, Progress};
use dsr_model::schedules::{Restricted, ScheduleBound, ScheduleRun, check_reduction};
use dsr_model::semantics::Semantics;
use dsr_model::verdict::Verdict;
use std::sync::Arc;

const ONE: ScheduleBound =
    ScheduleBound { replicas: 2, readers: 0, mutations: 1, restarts: 1, resynchronisations: 1 };
const TWO: ScheduleBound = ScheduleBound { mutations: 2, ..ONE };

fn everything() -> Arc<Checked> {
    Arc::new(subject(&MutationKind::ALL, &[A, B]))
}

/// Four mutations that conflict in many ways.
fn four() -> Arc<Restricted<Checked>> {
    let (a, b) = (A, B);
    let kinematic = |from: VertexId, to: VertexId| EdgeKey::new(from, "RT", to);
    let level = [("level".into(), Some(Value::Int(2)))].into();
    let mutations = [
        Mutation::MoveEdge {
            from: kinematic(VertexId::ROOT, a),
            to: kinematic(b, a),
            attributes: AttributeMap::new(),
        },
        Mutation::MoveEdge {
            from: kinematic(VertexId::ROOT, b),
            to: kinematic(a, b),
            attributes: AttributeMap::new(),
        },
        Mutation::UpdateAttributes { target: ElementId::Vertex(b), updates: level },
        Mutation::RemoveVertex { vertex: b },
    ];
    Arc::new(Restricted { whole: everything(), mutations: mutations.map(Act).to_vec() })
}

#[track_caller]
fn check<S: Semantics>(semantics: &Arc<S>, bound: ScheduleBound) {
    let run = ScheduleRun {
        name: "test".into(),
        semantics: semantics.clone(),
        focus: 2,
        bound,
        second_engine: true,
    };
    let report = run.run(&Arc::new(Progress::new(Limits::default())));
    println!("{:?} {:?} {:.2} s {:?}", bound, report.states, report.seconds, report.notes);
    for trace in &report.traces {
        println!("{}", trace.text);
    }
    assert_eq!(report.verdict, Verdict::Exhaustive, "{:#?}", report.properties);
    // [spec: CHECK-9]
    let second = report.second_engine.map(|second| (second.unique, second.generated));
    assert_eq!(second, Some((report.states.unique, report.states.generated)));
}

/// [spec: CHECK-6] [spec: CHECK-9] [spec: CHECK-10]
#[test]
fn law_all_six_kinds_once_each_on_a_lossy_network() {
    check(&everything(), ONE);
}

/// [spec: CHECK-6] [spec: CHECK-9]
#[test]
fn law_four_mutations_twice_each_on_a_lossy_network() {
    check(&four(), ScheduleBound { restarts: 0, ..TWO });
    check(&four(), ScheduleBound { resynchronisations: 0, ..TWO });
}

/// [spec: CHECK-7]
#[test]
fn differential_histories_show_all_that_schedules_do() {
    for (bound, semantics) in [(ONE, everything()), (ScheduleBound { readers: 1, ..ONE }, everything())] {
        println!("{:?}", check_reduction(&semantics, bound).unwrap());
    }
    println!("{:?}", check_reduction(&four(), TWO).unwrap());
}

/// A search that is told to stop has shown less, and says so. [spec: CHECK-1]
#[test]
fn canary_a_search_that_is_cut_is_not_exhaustive() {
    let run = ScheduleRun {
        name: "test".into(),
        semantics: everything(),
        focus: 2,
        bound: ONE,
        second_engine: true,
    };
    let limits = Limits { states_max: 100, ..Limits::default() };
    assert_eq!(run.run(&Arc::new(Progress::new(limits))).verdict, Verdict::Bounded);
}

/// Nothing to lose, nothing to repeat: nothing was shown. [spec: CHECK-1] [spec: CHECK-10]
#[test]
fn canary_a_search_in_which_nothing_happens_is_vacuous() {
    let nothing = Arc::new(Restricted { whole: everything(), mutations: vec![] });
    let run =
        ScheduleRun { name: "test".into(), semantics: nothing, focus: 2, bound: ONE, second_engine: true };
    assert_eq!(run.run(&Arc::new(Progress::new(Limits::default()))).verdict, Verdict::Vacuous);
}
