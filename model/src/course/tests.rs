//! Courses against schedules of L2: the same network, carried out by code that shares only the semantics with it.

use super::{Course, Event, Outcome, Runner, run};
use crate::alarms::{A, B, subject};
use crate::checked::{Act, Checked};
use crate::schedules::{Restricted, ScheduleBound, Schedules};
use crate::search;
use crate::semantics::Semantics;
use dsr_core::{MutationKind, State};
use std::collections::{BTreeSet, VecDeque};
use std::sync::Arc;

type Few = Restricted<Checked>;

/// A removal, an update and a move.
fn few() -> Few {
    let whole = subject(&MutationKind::ALL, &[A, B]);
    let steps = whole.steps(&whole.initial(), 0);
    let of = |kind: MutationKind| steps.iter().find(|(act, _)| act.0.kind() == kind).unwrap().0.clone();
    let kinds = [MutationKind::RemoveVertex, MutationKind::UpdateAttributes, MutationKind::MoveEdge];
    let mutations = kinds.map(of).to_vec();
    Few { whole: Arc::new(whole), mutations }
}

/// Every event that L2's bound leaves open after a course.
fn next(runner: &Runner<'_, Few>, course: &Course<Act>) -> Vec<Event<Act>> {
    let count = |is: &dyn Fn(&Event<Act>) -> bool| course.events.iter().filter(|event| is(event)).count();
    let mut events = Vec::new();
    for replica in 0..2 {
        if count(&|event| matches!(event, Event::Mutate { replica: who, .. } if *who == replica)) == 0 {
            let mutations = runner.semantics().mutations.iter().cloned();
            events.extend(mutations.map(|made| Event::Mutate { replica, mutations: vec![made] }));
        }
        events.extend((0..runner.messages().len()).map(|message| Event::Deliver { replica, message }));
        if count(&|event| matches!(event, Event::Restart { .. })) == 0 {
            events.extend([true, false].map(|keeps| Event::Restart { replica, keeps }));
        }
        if count(&|event| matches!(event, Event::Answer { .. })) == 0 {
            events.push(Event::Answer { replica, to: 1 - replica });
        }
    }
    events
}

/// Courses lead to the states that schedules do, no fewer and no others, and are judged alike.
/// `[spec: CHECK-6]` `[spec: CHECK-13]`
#[test]
fn differential_courses_reach_what_schedules_do() {
    let semantics = few();
    let bound = ScheduleBound { replicas: 2, readers: 0, mutations: 1, restarts: 1, resynchronisations: 1 };
    let mut schedules = Schedules::new(Arc::new(semantics.clone()), bound);
    let reached = search::all(&mut schedules).unwrap();
    let state = |id| (*schedules.tables().state(id)).clone();
    let by_schedules: BTreeSet<Vec<State>> =
        reached.iter().map(|at| vec![state(at.states[0]), state(at.states[1])]).collect();

    let mut by_courses = BTreeSet::new();
    let mut known = BTreeSet::new();
    let mut queue = VecDeque::from([Course::among(2)]);
    while let Some(course) = queue.pop_front() {
        let mut runner = Runner::new(&semantics, 2);
        if course.events.iter().any(|event| runner.step(event).is_err()) {
            continue;
        }
        let sent: Vec<_> = runner.messages().iter().map(|it| (it.sender, it.to, it.deltas.clone())).collect();
        let identities = [runner.identity(0).unwrap(), runner.identity(1).unwrap()];
        if !known.insert((runner.states().to_vec(), sent, identities)) {
            continue;
        }
        assert_eq!(run(&semantics, &course, true), Outcome::Held);
        by_courses.insert(runner.states().to_vec());
        queue.extend(next(&runner, &course).into_iter().map(|event| {
            let events = course.events.iter().cloned().chain([event]).collect();
            Course { events, ..Course::among(2) }
        }));
    }
    println!("{} pairs of states, {} courses, {} schedules", by_courses.len(), known.len(), reached.len());
    assert_eq!(by_courses, by_schedules);
    assert!(by_courses.len() > 50);
}
