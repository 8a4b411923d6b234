//! Traces without what their finding does not need. `[spec: CHECK-14]` `[spec: SCEN-13]`
//!
//! The search finds fewest mutations first; which deliveries lead there is left to chance. So what it found is
//! turned into a course, and deliveries and mutations are left out of that as long as it is still a run of the
//! scenario, each replica doing what its script or alphabet says, and still shows the same: that a property is
//! decided, or that a clause breaks. Replicas keep their numbers and the graph stays whole, since properties may
//! speak of both.

use super::explore::Replicated;
use super::follow::{Followed, follow};
use super::memo::DeltaId;
use super::script::Conduct;
use super::space::{Broken, Choice, SUBSET_DELTAS_MAX, Space};
use super::trace::{Last, Sought, Trace, tell};
use crate::checked::Act;
use crate::course::{Course, Event, Outcome, run};
use crate::shrink::{Reduction, Shrinker};
use std::cell::RefCell;

/// The most courses tried for one trace: each follows every script through its run.
const TRIES_MAX: usize = 2_000;

/// Tells a way and its end, without what the finding does not need.
pub(super) fn reduced<S: Replicated>(
    space: &mut Space<S>,
    way: &[Choice],
    last: Last,
    finding: Sought,
) -> Trace {
    let semantics = space.memo.semantics.clone();
    let course = course(space, way, &last);
    let whole = tell(space, way, last, finding);
    if semantics.initial() != space.memo.scenario.initial {
        return whole;
    }
    let space = RefCell::new(space);
    let shows = |course: &Course<Act>| {
        let space = &mut **space.borrow_mut();
        follow(space, course).and_then(|followed| shown(space, course, &followed, finding))
    };
    let shrinker = Shrinker { kinds: vec![Reduction::Event], tries_max: TRIES_MAX };
    let shrunk = shrinker.shrink(&semantics, &course, |_, course| shows(course).is_some());
    let Some((way, last)) = shows(&shrunk.course) else { return whole };
    let trace = tell(&**space.borrow(), &way, last, finding);
    match whole.happenings().checked_sub(trace.happenings()) {
        // What is minimal is shown as it was found.
        None | Some(0) => whole,
        Some(left_out) => Trace { left_out, ..trace },
    }
}

/// A way as a course of the replicas and a reader, who receives what the finding is seen in.
fn course<S: Replicated>(space: &Space<S>, way: &[Choice], last: &Last) -> Course<Act> {
    let scenario = &space.memo.scenario;
    let reader = scenario.replicas.len();
    let names = scenario.replicas().map(str::to_owned).chain(["a reader".into()]);
    let mut writer = Writer { made: Vec::new(), received: vec![Vec::new(); reader + 1], events: Vec::new() };
    for Choice { replica, received, step, .. } in way {
        writer.receive(*replica, received);
        if let Some(delta) = step.delta {
            writer.events.push(Event::Mutate { replica: *replica, mutations: step.acts.to_vec() });
            writer.received[*replica].push(delta);
            writer.made.push(delta);
        }
    }
    match last {
        Last::View(_, received) => writer.receive(reader, received),
        Last::Broken(Broken { replica, received, .. }) => writer.receive(replica.unwrap_or(reader), received),
        Last::End(_) => {}
    }
    Course { replicas: names.collect(), events: writer.events }
}

struct Writer {
    /// The delta of each message.
    made: Vec<DeltaId>,
    received: Vec<Vec<DeltaId>>,
    events: Vec<Event<Act>>,
}

impl Writer {
    fn receive(&mut self, replica: usize, deltas: &[DeltaId]) {
        for &delta in deltas {
            let message = self.made.iter().position(|made| *made == delta);
            if let Some(message) = message.filter(|_| !self.received[replica].contains(&delta)) {
                self.received[replica].push(delta);
                self.events.push(Event::Deliver { replica, message });
            }
        }
    }
}

/// What a run of the scenario shows of the finding: the steps to it, and its end.
fn shown<S: Replicated>(
    space: &mut Space<S>,
    course: &Course<Act>,
    followed: &Followed,
    finding: Sought,
) -> Option<(Vec<Choice>, Last)> {
    let scenario = space.memo.scenario.clone();
    match finding {
        Sought::Breach(clause) => {
            let broken = broken(space, course, followed, clause)?;
            Some((followed.shortest(), Last::Broken(broken)))
        }
        Sought::Property(at) if scenario.properties[at].kind.is_of_ends() => ended(space, followed, at),
        Sought::Property(at) => {
            let property = &scenario.properties[at];
            let decides = |(state, _): &&(u32, Vec<DeltaId>)| {
                property.is_decided_by(property.predicate.holds(space.memo.answers(*state), 0))
            };
            let (state, known) = followed.views.iter().find(decides)?;
            Some((followed.shortest(), Last::View(*state, known.clone())))
        }
    }
}

/// Whether everything delivered to everybody ends the run, in a way that decides a property of ends: each replica
/// may be at any of the places where its script can be by now. `[spec: SCEN-9]`
fn ended<S: Replicated>(space: &mut Space<S>, followed: &Followed, at: usize) -> Option<(Vec<Choice>, Last)> {
    let scenario = space.memo.scenario.clone();
    let everything = followed.made.iter().fold(space.initial, |state, &delta| space.memo.join(state, delta));
    let mut ways: Vec<(Vec<usize>, u32)> = vec![(Vec::new(), 0)];
    for (replica, seats) in followed.seats.iter().enumerate() {
        let is_free = matches!(scenario.replicas[replica].conduct, Conduct::Free { .. });
        let mut longer = Vec::new();
        for (seat, place) in seats.iter().enumerate() {
            let Some(done) = place.end(space, replica, everything, is_free) else { continue };
            for (way, known) in &ways {
                let way = way.iter().copied().chain([seat]).collect();
                longer.push((way, known | u32::from(done) << replica));
            }
        }
        // Of ways that leave the same replicas done, one is enough.
        longer.sort_by_key(|(_, done)| *done);
        longer.dedup_by_key(|(_, done)| *done);
        ways = longer;
    }
    let property = &scenario.properties[at];
    let answers = space.memo.answers(everything);
    let decides =
        |(_, done): &(Vec<usize>, u32)| property.is_decided_by(property.predicate.holds(answers, *done));
    let (seats, _) = ways.into_iter().find(decides)?;
    Some((followed.way(&seats), Last::End(everything)))
}

/// Where a clause breaks after a run: in what a replica can do next, in the run itself, or in some order of its
/// deltas.
fn broken<S: Replicated>(
    space: &mut Space<S>,
    course: &Course<Act>,
    followed: &Followed,
    clause: &'static str,
) -> Option<Broken> {
    let same = |broken: &Broken| broken.breach.clause == clause;
    if let Some(broken) = followed.broken.clone().filter(same) {
        return Some(broken);
    }
    if let Outcome::Broken(found) = run(&*space.memo.semantics, course, false) {
        let replica = found.replica.filter(|&replica| replica < space.memo.scenario.replicas.len());
        let received = found.replica.map_or_else(Vec::new, |replica| followed.known[replica].clone());
        return Some(Broken { breach: found.breach, replica, received }).filter(same);
    }
    let mut pool = followed.made.clone();
    pool.sort_unstable();
    pool.dedup();
    if pool.len() > SUBSET_DELTAS_MAX {
        return None;
    }
    space.memo.fault = None;
    space.states_of(&pool).err().filter(same)
}

#[cfg(test)]
mod tests {
    use super::super::memo::Memo;
    use super::super::{Options, Scenario, ScenarioStep, shipped};
    use super::*;
    use crate::checked::Checked;
    use crate::checked::alphabet::Alphabet;
    use std::sync::Arc;

    fn space(scenario: &Scenario) -> Space<Checked> {
        let semantics = scenario.checked(Alphabet::of(&[], Vec::new()));
        Space::new(Memo::new(Arc::new(scenario.clone()), semantics), Options::default())
    }

    /// A way on which everybody does all that they can, having received whatever there is.
    fn longest(space: &mut Space<Checked>) -> (Vec<Choice>, super::super::space::Node) {
        let (mut node, mut way) = (space.start(), Vec::new());
        loop {
            let mut successors = Vec::new();
            space.successors(&node, &mut successors).unwrap();
            let Some((choice, next)) = successors.pop() else { return (way, node) };
            way.push(choice);
            node = next;
        }
    }

    /// Ways on which far more happens than a finding needs are reduced to about what the search for the shortest
    /// finds: never fewer mutations. `[spec: CHECK-14]`
    #[test]
    fn oracle_a_long_way_is_reduced_to_its_finding() {
        let (mut reductions, mut longer) = (0, 0);
        for (file, text) in &shipped()[3..] {
            let scenario = Scenario::read(text, file).unwrap();
            let report = scenario.check(Options::default());
            let mut space = space(&scenario);
            let (way, node) = longest(&mut space);
            let course = course(&space, &way, &Last::View(space.initial, node.pool.to_vec()));
            let followed = follow(&mut space, &course).expect("a way is a run of its scenario");
            for (at, property) in report.properties.iter().enumerate() {
                let Some((_, last)) = shown(&mut space, &course, &followed, Sought::Property(at)) else {
                    continue;
                };
                let before = tell(&space, &way, last.clone(), Sought::Property(at));
                let trace = reduced(&mut space, &way, last, Sought::Property(at));
                let shortest =
                    property.trace.as_ref().expect("universal properties of shipped scenarios hold");
                assert!(trace.mutations >= shortest.mutations, "{file}: {}", property.name);
                assert!(matches!(trace.steps.last(), Some(ScenarioStep::See { .. })), "{file}");
                assert_eq!(before.happenings() - trace.happenings(), trace.left_out, "{file}");
                reductions += usize::from(trace.left_out > 0);
                longer += trace.mutations - shortest.mutations;
                println!("{file}: {}: {} of {}", property.name, trace.happenings(), before.happenings());
            }
        }
        println!("{reductions} reduced; {longer} mutations more than the shortest in all");
        assert!(reductions >= 3 && longer <= 2);
    }
}
