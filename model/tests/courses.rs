//! Courses: what can happen, what cannot, and which states it leads to.

#[expect(dead_code, unreachable_pub, reason = "a program of its own")]
#[path = "../examples/last_writer_wins.rs"]
mod last_writer_wins;

use dsr_core::{MutationKind, State};
use dsr_model::alarms::{A, B, Broken, all, subject};
use dsr_model::checked::{Act, Checked, INCARNATION, replica_id};
use dsr_model::course::{Course, Event, Moment, Outcome, Runner, StepError, run};
use dsr_model::semantics::Semantics;
use dsr_model::shrink::{breaks_as, shrink};
use dsr_model::walks::{Faults, Walk, find};
use last_writer_wins::{Act as Write, LastWriterWins};
use std::collections::BTreeSet;
use std::sync::Arc;

const WALK: Walk = Walk { replicas: 3, mutations_max: 8, events_max: 80, seed: 5, faults: Faults::ALL };

fn semantics() -> Checked {
    subject(&MutationKind::ALL, &[A, B])
}

/// Some mutation that replica 0 can make at the start.
fn mutation() -> Act {
    semantics().steps(&semantics().initial(), 0).remove(0).0
}

fn mutate(replica: usize) -> Event<Act> {
    Event::Mutate { replica, mutations: vec![mutation()] }
}

#[track_caller]
fn cannot(before: Vec<Event<Act>>, event: Event<Act>, why: StepError) {
    let at = before.len();
    let events = before.into_iter().chain([event]).collect();
    let course = Course { events, ..Course::among(2) };
    assert_eq!(run(&semantics(), &course, true), Outcome::Invalid { at, why });
}

/// [spec: CHECK-13]
#[test]
fn oracle_what_cannot_happen_is_refused_with_its_place() {
    let deliver = |replica, message| Event::Deliver { replica, message };
    let lose = |replica, message| Event::Lose { replica, message };
    cannot(vec![], mutate(2), StepError::NoReplica { replica: 2, count: 2 });
    cannot(vec![], deliver(2, 0), StepError::NoReplica { replica: 2, count: 2 });
    cannot(vec![], Event::Restart { replica: 9, keeps: true }, StepError::NoReplica { replica: 9, count: 2 });
    cannot(vec![], Event::Answer { replica: 0, to: 2 }, StepError::NoReplica { replica: 2, count: 2 });
    cannot(vec![], Event::Answer { replica: 1, to: 1 }, StepError::AnswersItself { replica: 1 });
    cannot(vec![], Event::Mutate { replica: 0, mutations: vec![] }, StepError::NothingMade { replica: 0 });
    cannot(vec![], deliver(1, 0), StepError::NotSent { message: 0, sent: 0 });
    cannot(vec![mutate(0)], deliver(1, 1), StepError::NotSent { message: 1, sent: 1 });
    cannot(vec![mutate(0)], deliver(0, 0), StepError::NotForIt { message: 0, replica: 0 });
    cannot(vec![mutate(0)], lose(0, 0), StepError::NotForIt { message: 0, replica: 0 });
    cannot(vec![mutate(0), lose(1, 0)], deliver(1, 0), StepError::IsLost { message: 0, replica: 1 });
    cannot(vec![mutate(0), lose(1, 0)], lose(1, 0), StepError::IsLost { message: 0, replica: 1 });
    let answer = Event::Answer { replica: 0, to: 1 };
    cannot(vec![answer], deliver(0, 0), StepError::NotForIt { message: 0, replica: 0 });
    let twice = Event::Mutate { replica: 0, mutations: vec![mutation(), mutation()] };
    let refused = StepError::Refused { replica: 0, at: 1, mutation: mutation().to_string() };
    cannot(vec![], twice, refused);
}

/// A replica without an identity of its own cannot mutate; one without resynchronisation cannot answer. What is
/// refused changes nothing. [spec: CHECK-13]
#[test]
fn oracle_what_is_refused_changes_nothing() {
    let semantics = semantics();
    let mut runner = Runner::new(&semantics, INCARNATION + 1);
    let replica = INCARNATION;
    assert_eq!(runner.step(&mutate(replica)).unwrap_err(), StepError::NoIdentity { replica });
    let group = Event::Mutate { replica: 0, mutations: vec![mutation(), mutation()] };
    assert!(runner.step(&group).is_err());
    assert!(runner.messages().is_empty());
    assert!(runner.states().iter().all(|state| *state == semantics.initial()));
    let writes = LastWriterWins { ties_by_replica: true };
    let answer = Event::Answer { replica: 0, to: 1 };
    assert_eq!(Runner::new(&writes, 2).step(&answer).unwrap_err(), StepError::NoAnswer { replica: 0 });
}

/// A replica's state is the join of what it has made and received since it last lost its state.
/// [spec: CHECK-13] [spec: JOIN-5]
#[test]
fn oracle_a_state_is_the_join_of_what_was_received() {
    let semantics = semantics();
    for number in 0..40 {
        let course = WALK.walk(&semantics, number).course;
        let mut runner = Runner::new(&semantics, course.replicas.len());
        let mut known: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); course.replicas.len()];
        for event in &course.events {
            let stepped = runner.step(event).unwrap();
            let replica = event.replica();
            match event {
                Event::Mutate { .. } => known[replica].extend(stepped.sent),
                Event::Deliver { message, .. } => known[replica].extend([*message]),
                Event::Restart { keeps: false, .. } => known[replica].clear(),
                _ => {}
            }
            for (state, known) in runner.states().iter().zip(&known) {
                let deltas = known.iter().flat_map(|&message| &runner.messages()[message].deltas);
                let joined = deltas.fold(semantics.initial(), |state: State, delta| state.joined(delta));
                assert_eq!(*state, joined, "walk {number}");
            }
        }
    }
}

/// After a restart a replica makes dots of its next incarnation. [spec: CRASH-2]
#[test]
fn law_a_restart_takes_the_next_incarnation() {
    let semantics = semantics();
    let mut runner = Runner::new(&semantics, 2);
    for restarts in 0..3 {
        assert_eq!(runner.identity(1), Ok(1 + INCARNATION * restarts));
        let stepped = runner.step(&Event::Restart { replica: 1, keeps: false }).unwrap();
        assert_eq!(stepped.after, semantics.initial());
    }
    let add = semantics.steps(&semantics.initial(), 1).remove(0).0;
    let sent = runner.step(&Event::Mutate { replica: 1, mutations: vec![add] }).unwrap().sent.unwrap();
    let delta = &runner.messages()[sent].deltas[0];
    assert!(delta.records().all(|(dot, _)| dot.replica == replica_id(1 + 3 * INCARNATION)));
    assert!(delta.records().next().is_some());
}

/// A group is one message: one delta where the semantics joins deltas, else all of them, delivered together.
/// [spec: CHECK-13] [spec: MUT-0.4]
#[test]
fn law_a_group_is_one_message() {
    let semantics = semantics();
    let mut runner = Runner::new(&semantics, 2);
    let first = mutation();
    let next = semantics.mutate(&semantics.initial(), 0, &first).unwrap().after;
    let second = semantics.steps(&next, 0).remove(3).0;
    let sent = runner.step(&Event::Mutate { replica: 0, mutations: vec![first, second] }).unwrap().sent;
    assert_eq!((sent, runner.messages()[0].deltas.len()), (Some(0), 1));

    let writes = LastWriterWins { ties_by_replica: true };
    let mut runner = Runner::new(&writes, 2);
    runner.step(&Event::Mutate { replica: 0, mutations: vec![Write::Link, Write::Unlink] }).unwrap();
    assert_eq!(runner.messages()[0].deltas.len(), 2);
    runner.step(&Event::Deliver { replica: 1, message: 0 }).unwrap();
    assert_eq!(runner.states()[0], runner.states()[1]);
}

/// A semantics in six methods is walked, broken and shrunk like any other. [spec: CHECK-13] [spec: CHECK-14]
#[test]
fn canary_a_semantics_of_ones_own_is_walked_and_shrunk() {
    let clause = |ties_by_replica| {
        let found = find(&Arc::new(LastWriterWins { ties_by_replica }), WALK, 300).unwrap();
        assert!(found.shrunk.is_minimal);
        (found.outcome.clause().unwrap(), found.shrunk.course.events.len())
    };
    assert_eq!(clause(false), ("JOIN-5", 2));
    // Two would do, if the replicas had each other's numbers: no single reduction exchanges them.
    assert_eq!(clause(true), ("INV-2", 3));
}

/// An initial state that is broken by itself is told as such, and is no shrunk form of a later failure.
/// [spec: CHECK-14]
#[test]
fn canary_a_broken_start_is_not_a_later_failure() {
    let alarm = all().into_iter().find(|alarm| alarm.name == "losers-kept").unwrap();
    let mut core = subject(&MutationKind::ALL, &[A, B]);
    // An edge whose end was removed and not closed over.
    let held = core.initial.records().filter(|(dot, _)| *dot != A.0);
    core.initial =
        State::assemble(held.map(|(dot, record)| (dot, record.clone())), core.initial.context().clone());
    let outcome = run(&core, &Course::among(1), true);
    let Outcome::Broken(broken) = &outcome else { panic!("{outcome}") };
    assert_eq!((broken.at, broken.breach.clause), (Moment::Start, "STATE-6"));
    let found = find(&Arc::new(alarm.core(&MutationKind::ALL, &[A, B])), WALK, 300).unwrap();
    assert!(!breaks_as::<Broken>(&found.outcome)(&found.shrunk.semantics, &Course::among(1)));
    assert!(!breaks_as::<Checked>(&found.outcome)(&core, &Course::among(1)));
    let shrunk =
        shrink(&Arc::new(core), &Course { events: vec![mutate(0)], ..Course::among(2) }, breaks_as(&outcome));
    assert!(shrunk.course.events.is_empty() && shrunk.course.replicas.len() == 1);
}
