//! L3: random walks. What they do, that a seed decides it, and that they find what is broken.

use dsr_core::MutationKind;
use dsr_model::alarms::{A, Alarm, B, Broken, all, subject};
use dsr_model::checked::{Act, Checked};
use dsr_model::course::{Course, Event, Outcome, run};
use dsr_model::progress::{Limits, Progress};
use dsr_model::schedules::Restricted;
use dsr_model::semantics::Semantics;
use dsr_model::verdict::{PropertyKind, RunReport, Verdict};
use dsr_model::walks::{Counts, Faults, Walk, WalkRun};
use std::sync::Arc;

const WALK: Walk = Walk { replicas: 3, mutations_max: 8, events_max: 80, seed: 1, faults: Faults::ALL };

fn sound() -> Arc<Checked> {
    Arc::new(subject(&MutationKind::ALL, &[A, B]))
}

#[allow(clippy::expect_used, reason = "a test names an alarm that there is")]
fn alarm(name: &str) -> Alarm {
    all().into_iter().find(|alarm| alarm.name == name).expect("an alarm of this name")
}

fn report<S: Semantics>(semantics: &Arc<S>, walk: Walk, walks: u64, limits: Limits) -> RunReport {
    let run = WalkRun { name: "test".into(), semantics: semantics.clone(), focus: 2, walk, walks };
    run.run(&Arc::new(Progress::new(limits)))
}

/// The same seed and number are the same course on any thread, and other ones are others. [spec: CHECK-13]
#[test]
fn law_a_seed_decides_a_walk() {
    let semantics = sound();
    let course = |seed, number| Walk { seed, ..WALK }.walk(&*semantics, number);
    let here: Vec<_> = (0..8).map(|number| course(1, number)).collect();
    let there: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8).rev().map(|number| scope.spawn(move || course(1, number))).collect();
        threads.into_iter().rev().map(|thread| thread.join().unwrap()).collect()
    });
    assert_eq!(here, there);
    for (at, walked) in here.iter().enumerate() {
        assert!(here[..at].iter().all(|other| other.course != walked.course), "walk {at} is one before it");
    }
    assert_ne!(course(2, 0).course, here[0].course);
}

/// A seed means one walk for ever: this one, by its first mutation and its length. [spec: CHECK-13]
#[test]
fn conform_a_seed_means_the_same_walk_for_ever() {
    let course: Course<Act> = WALK.walk(&*sound(), 0).course;
    let first = course.events.iter().find_map(|event| match event {
        Event::Mutate { replica, mutations } => Some((*replica, mutations[0].to_string())),
        _ => None,
    });
    assert_eq!((first, course.events.len()), (Some((0, "add_edge r0.1 -in-> r0.3".into())), 80));
}

/// What a walk is said to have done is what its course says, and running the course leads where the walk did.
/// [spec: CHECK-13]
#[test]
fn oracle_a_walk_is_its_course() {
    let semantics = sound();
    for number in 0..40 {
        let walked = WALK.walk(&*semantics, number);
        assert_eq!(run(&*semantics, &walked.course, true), Outcome::Held);
        assert_eq!(walked.outcome, Outcome::Held);
        let is = |which: fn(&Event<Act>) -> bool| {
            walked.course.events.iter().filter(|event| which(event)).count() as u64
        };
        let Counts { deliveries, duplicates, losses, restarts, answers, events, .. } = walked.counts;
        assert_eq!(is(|event| matches!(event, Event::Deliver { .. })), deliveries + duplicates);
        assert_eq!(is(|event| matches!(event, Event::Lose { .. })), losses);
        assert_eq!(is(|event| matches!(event, Event::Restart { .. })), restarts);
        assert_eq!(is(|event| matches!(event, Event::Answer { .. })), answers);
        assert_eq!(walked.course.events.len() as u64, events);
        assert_eq!(walked.course.mutations() as u64, walked.counts.mutations.iter().sum::<u64>());
    }
}

/// Without faults every message arrives once, at everybody but its sender, and nothing else happens.
/// [spec: CHECK-13]
#[test]
fn law_without_faults_every_message_arrives_once() {
    let walk = Walk { faults: Faults::NONE, events_max: 1000, ..WALK };
    for number in 0..10 {
        let Counts { deliveries, duplicates, losses, restarts, answers, events, .. } =
            walk.walk(&*sound(), number).counts;
        assert_eq!((duplicates, losses, restarts, answers), (0, 0, 0, 0));
        assert_eq!(deliveries, 2 * (events - deliveries));
    }
}

/// Walks of the sound core see every kind of mutation, event and repair, and prove nothing. [spec: CHECK-13]
/// [spec: CHECK-1] [spec: CHECK-10]
#[test]
fn law_walks_of_the_core_hold_and_are_bounded() {
    let report = report(&sound(), WALK, 200, Limits::default());
    assert_eq!(report.verdict, Verdict::Bounded, "{:#?}", report.traces);
    assert!(report.traces.is_empty());
    let unseen: Vec<_> = report
        .properties
        .iter()
        .filter(|property| property.kind == PropertyKind::Sometimes && property.verdict == Verdict::Vacuous)
        .collect();
    assert!(unseen.is_empty(), "{unseen:#?}");
    for repair in
        ["same-key", "functional", "rt-parent", "cycle-broken", "detached", "reattached", "name-clash"]
    {
        let witness = format!("repair: {repair}");
        assert!(report.properties.iter().any(|property| property.clause == witness), "{repair}");
    }
    assert!(report.notes[0].starts_with("seed 1, walks 0 to 199 of 200"), "{:?}", report.notes);
}

/// What is broken is reported with its seed, what it was shrunk from and to, and the course. [spec: CHECK-13]
#[test]
fn canary_a_broken_core_is_reported_with_its_seed() {
    let broken = Arc::new(alarm("losers-kept").core(&MutationKind::ALL, &[A, B]));
    let report = report(&broken, WALK, 300, Limits::default());
    assert_eq!(report.verdict, Verdict::Violated);
    let [trace] = &report.traces[..] else { panic!("one trace, not {}", report.traces.len()) };
    assert_eq!(trace.clause, "INTENT-1");
    assert!(trace.text.contains("remove_edge") && trace.text.contains("✗"), "{}", trace.text);
    assert_eq!(trace.json["steps"].as_array().map(Vec::len), Some(trace.steps));
    let notes = report.notes.join("\n");
    assert!(notes.contains("of seed 1: [INTENT-1]") && notes.contains("shrunk from"), "{notes}");
    let broken: Vec<&str> = report
        .properties
        .iter()
        .filter(|property| property.verdict == Verdict::Violated)
        .map(|property| &*property.clause)
        .collect();
    assert_eq!(broken, ["INTENT-1"]);
}

/// Nothing to do: nothing is seen, and the run says what it did not see. [spec: CHECK-10]
#[test]
fn canary_walks_in_which_nothing_can_be_done_say_so() {
    let nothing = Arc::new(Restricted { whole: sound(), mutations: vec![] });
    let report = report(&nothing, Walk { faults: Faults::NONE, ..WALK }, 10, Limits::default());
    assert_eq!((report.verdict, report.states.generated), (Verdict::Bounded, 0));
    let vacuous =
        |name: &str| report.properties.iter().any(|it| it.clause == name && it.verdict == Verdict::Vacuous);
    assert!(vacuous("a delivery") && vacuous("a delivery out of order"));
}

/// A limit of time ends a run between two walks. [spec: CHECK-1]
#[test]
fn canary_a_run_that_is_late_ends() {
    let limits = Limits { seconds_max: 0.0, ..Limits::default() };
    assert_eq!(report(&sound(), WALK, 1000, limits).states.unique, 1);
}

/// Each alarm's walks on the sound core would hold: there is no false alarm. [spec: CHECK-8] [spec: CHECK-13]
#[test]
fn canary_the_sound_core_breaks_nothing() {
    use dsr_model::alarms::Sound;
    let sound = Broken::new("sound", subject(&MutationKind::ALL, &[A, B]), Arc::new(Sound));
    assert_eq!(report(&Arc::new(sound), WALK, 300, Limits::default()).verdict, Verdict::Bounded);
}
