//! L1: its reductions are exact, its engines agree, and its wrapper cannot be talked into a pass.

#![expect(clippy::unwrap_used, reason = "helpers of tests: what they unwrap is what they test")]

use dsr_core::scene::{Scene, Strictness, TINY};
use dsr_core::{Dictionary, MutationKind, State};
use dsr_model::checked::Checked;
use dsr_model::histories::{Bound, Histories, History, HistoryRun};
use dsr_model::progress::{Limits, Progress};
use dsr_model::search;
use dsr_model::suite::{self, Subject};
use dsr_model::verdict::{PropertyKind, RunReport, Verdict};
use std::collections::BTreeSet;
use std::sync::Arc;

fn tiny() -> (State, Dictionary) {
    let dictionary = Dictionary::aal();
    let scene = Scene::read(TINY, &dictionary, Strictness::Strict).unwrap().scene;
    (scene.state, dictionary)
}

fn run_of(focus: usize, replicas: usize, mutations: usize, kinds: &[MutationKind]) -> HistoryRun<Checked> {
    let (state, dictionary) = tiny();
    let subject =
        Subject { state: &state, dictionary: &dictionary, names: &["kitchen", "robot", "table", "cup"] };
    subject.histories(focus, Bound { replicas, mutations }, kinds).unwrap()
}

fn checked(run: &HistoryRun<Checked>, limits: Limits) -> RunReport {
    run.run(&Arc::new(Progress::new(limits)))
}

/// Every history within the bound.
fn all_histories(run: &HistoryRun<Checked>, symmetry: bool) -> (Histories<Checked>, BTreeSet<History>) {
    let mut histories = Histories::new(run.semantics.clone(), run.bound, symmetry);
    let all = search::all(&mut histories).map_err(|fault| fault.breach().clone());
    (histories, all.unwrap().into_iter().collect())
}

/// The orbits of the histories with symmetry are together exactly as many as the histories without it.
/// `[spec: CHECK-5]`
#[test]
fn differential_orbits_add_up_to_all_histories() {
    use MutationKind as K;
    let cases: [(usize, usize, usize, &[K]); 6] = [
        (2, 2, 1, &K::ALL),
        // New vertices of both replicas, and edges between them.
        (1, 2, 2, &[K::AddVertex, K::AddEdge]),
        (2, 2, 2, &[K::MoveEdge, K::RemoveVertex]),
        (2, 2, 2, &[K::UpdateAttributes, K::RemoveVertex]),
        (2, 3, 1, &[K::AddVertex, K::MoveEdge, K::RemoveVertex]),
        (2, 3, 2, &[K::RemoveEdge, K::RemoveVertex]),
    ];
    for (focus, replicas, mutations, kinds) in cases {
        let run = run_of(focus, replicas, mutations, kinds);
        let (_, plain) = all_histories(&run, false);
        let (mut histories, canonical) = all_histories(&run, true);
        let mut orbits = BTreeSet::new();
        for history in &canonical {
            orbits.extend(histories.orbit(history).iter().map(|image| shape(&histories, image)));
        }
        assert_eq!(orbits.len(), plain.len(), "{replicas} × {mutations}, {kinds:?}");
        if kinds.len() > 2 {
            assert!(canonical.len() < plain.len(), "symmetry saves nothing at {replicas} × {mutations}");
        }
    }
}

/// A history by its states and deltas, whatever their numbers in one search.
fn shape(histories: &Histories<Checked>, history: &History) -> Vec<Option<State>> {
    let tables = histories.tables();
    let deltas = history.deltas.iter().flatten();
    let deltas = deltas.map(|&id| (id != u32::MAX).then(|| (*tables.delta(id)).clone()));
    let last = history.last.iter().map(|&id| (id != u32::MAX).then(|| (*tables.state(id)).clone()));
    deltas.chain(last).collect()
}

/// `[spec: CHECK-9]` `[spec: CHECK-3]` `[spec: CHECK-4]`
#[test]
fn differential_both_engines_count_the_same() {
    for kinds in [&MutationKind::ALL[..], &[MutationKind::MoveEdge, MutationKind::RemoveVertex]] {
        let run = run_of(2, 2, 1, kinds);
        let report = checked(&run, Limits::default());
        let second = report.second_engine.unwrap();
        assert_eq!(report.verdict, Verdict::Exhaustive, "{:?}", report.notes);
        assert_eq!((report.states.unique, report.states.generated), (second.unique, second.generated));
        assert!(report.states.judged > 0 && report.states.diamonds > report.states.judged / 2);
        let mut fresh = Histories::new(run.semantics.clone(), run.bound, true);
        let progress = Progress::new(Limits::default());
        assert_eq!(search::count(&mut fresh, 0, &progress).unwrap().unwrap().unique, second.unique);
    }
}

/// `[spec: CHECK-1]`
#[test]
fn law_a_limit_makes_the_verdict_bounded() {
    let run = run_of(2, 2, 2, &MutationKind::ALL);
    let report = checked(&run, Limits { states_max: 50, ..Limits::default() });
    assert_eq!(report.verdict, Verdict::Bounded);
    let always = report.properties.iter().filter(|property| property.kind == PropertyKind::Always);
    assert!(always.map(|property| property.verdict).all(|verdict| verdict == Verdict::Bounded));
    assert!(report.notes.iter().any(|note| note.contains("before its end")), "{:?}", report.notes);
    let late = checked(&run, Limits { seconds_max: 0.0, ..Limits::default() });
    assert_eq!(late.verdict, Verdict::Bounded);
}

/// Nothing but the robot in focus: no edge can be removed, so a run of removals proves nothing.
/// `[spec: CHECK-10]`
#[test]
fn law_a_run_that_never_sees_its_kinds_is_vacuous() {
    let (state, dictionary) = tiny();
    let subject = Subject { state: &state, dictionary: &dictionary, names: &["robot"] };
    let bound = Bound { replicas: 2, mutations: 1 };
    let run = subject.histories(1, bound, &[MutationKind::RemoveEdge]).unwrap();
    let report = checked(&run, Limits::default());
    assert_eq!(report.verdict, Verdict::Vacuous);
    let unseen = report.properties.iter().filter(|property| property.verdict == Verdict::Vacuous);
    assert!(unseen.into_iter().any(|property| property.clause == "remove_edge is done"));
}

/// Every repair that a common dictionary leaves possible occurs in the smallest run of all six.
/// `[spec: CHECK-10]` `[spec: VIEW-9]`
#[test]
fn law_every_repair_is_witnessed() {
    let report = checked(&run_of(3, 3, 1, &MutationKind::ALL), Limits::default());
    let seen: BTreeSet<&str> = report.properties.iter().map(|property| property.clause.as_str()).collect();
    for repair in
        ["same-key", "functional", "rt-parent", "cycle-broken", "detached", "reattached", "name-clash"]
    {
        assert!(seen.contains(format!("repair: {repair}").as_str()), "{repair} was never seen");
    }
    assert_eq!(report.verdict, Verdict::Exhaustive, "{:?}", report.notes);
}

/// A suite that has not seen a repair says so. `[spec: CHECK-10]`
#[test]
fn law_a_suite_tells_what_it_has_not_seen() {
    let narrow = checked(&run_of(2, 2, 1, &[MutationKind::UpdateAttributes]), Limits::default());
    assert_eq!(narrow.verdict, Verdict::Exhaustive);
    let unseen = suite::unseen(&[narrow]);
    assert!(unseen.contains(&"repair: detached") && !unseen.contains(&"two live writes of one attribute"));
    let wide = checked(&run_of(3, 3, 1, &MutationKind::ALL), Limits::default());
    assert_eq!(suite::unseen(&[wide]), ["a gap in a context"; 0]);
}

/// Every conclusion from a shape is tried, on every set that it saves and on every step; and without shapes
/// the same histories are found, and all is as well. `[spec: CHECK-11]`
#[test]
fn differential_shapes_save_nothing_that_matters() {
    use MutationKind as K;
    let cases: [(usize, usize, usize, &[K]); 5] = [
        (2, 3, 1, &K::ALL),
        (2, 2, 2, &[K::MoveEdge, K::RemoveVertex]),
        (2, 2, 2, &[K::UpdateAttributes, K::MoveEdge]),
        (2, 2, 2, &[K::AddVertex, K::RemoveEdge]),
        (2, 2, 2, &[K::AddEdge, K::RemoveEdge]),
    ];
    for (focus, replicas, mutations, kinds) in cases {
        let run = run_of(focus, replicas, mutations, kinds);
        let [saving, plain] = [true, false].map(|shapes| {
            let mut histories = Histories::new(run.semantics.clone(), run.bound, true);
            histories.set_shapes(shapes, 1);
            let all = search::all(&mut histories).map_err(|fault| fault.breach().clone()).unwrap();
            for history in &all {
                histories.judge(history).unwrap();
            }
            (all.len(), histories.judged(), histories.tables().witnesses)
        });
        println!("{replicas} × {mutations} {kinds:?}: {saving:?} {plain:?}");
        assert_eq!((saving.0, saving.2), (plain.0, plain.2));
        assert!(saving.1.states < plain.1.states && saving.1.sampled > saving.1.states / 2);
    }
}
