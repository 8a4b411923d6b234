//! Shrinking: what every shrunk course has to be, on cores that are broken on purpose.

use dsr_core::{EdgeKey, ElementId, Mutation, MutationKind, NewVertex, Value, VertexId, VertexLink};
use dsr_model::alarms::{A, Alarm, B, Broken, all, run_alarm, subject};
use dsr_model::checked::{Act, Checked};
use dsr_model::course::{Course, Event, Outcome, run};
use dsr_model::semantics::Semantics;
use dsr_model::shrink::{Reduction, Shrinker, breaks_as, neighbours, shrink};
use dsr_model::trace::of_course;
use dsr_model::walks::{Faults, Walk, WalkFinding, find};
use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

const WALK: Walk = Walk { replicas: 3, mutations_max: 8, events_max: 80, seed: 1, faults: Faults::ALL };
/// As many walks find every flaw of the core that there is.
const WALKS: u64 = 300;
/// The search is broken there, and the core sound: no walk can tell.
const OF_THE_SEARCH: [&str; 3] = ["ranks-untold", "entanglement-untold", "order-untold"];

type Found = Vec<(Alarm, Option<WalkFinding<Broken>>)>;

/// What walks find of each alarm, shrunk.
fn found() -> &'static Found {
    static FOUND: OnceLock<Found> = OnceLock::new();
    FOUND.get_or_init(|| {
        let find_one = |alarm: Alarm| {
            let core = Arc::new(alarm.core(&MutationKind::ALL, &[A, B]));
            let finding = find(&core, WALK, WALKS);
            (alarm, finding)
        };
        all().into_iter().map(find_one).collect()
    })
}

fn findings() -> impl Iterator<Item = (&'static str, &'static WalkFinding<Broken>)> {
    found().iter().filter_map(|(alarm, finding)| Some((alarm.name, finding.as_ref()?)))
}

/// [spec: CHECK-8] [spec: CHECK-13]
#[test]
fn canary_walks_find_every_flaw_of_the_core() {
    let missed: Vec<&str> =
        found().iter().filter(|(_, finding)| finding.is_none()).map(|(alarm, _)| alarm.name).collect();
    assert_eq!(missed, OF_THE_SEARCH);
}

/// [spec: CHECK-14]
#[test]
fn law_a_shrunk_course_breaks_the_same_clause_and_is_minimal() {
    for (name, finding) in findings() {
        let shrunk = &finding.shrunk;
        let outcome = run(&*shrunk.semantics, &shrunk.course, true);
        assert_eq!(outcome.clause(), finding.outcome.clause(), "{name}");
        assert!(outcome.clause().is_some() && shrunk.is_minimal, "{name}");
        assert!(shrunk.course.events.len() <= finding.course.events.len(), "{name}");
        assert!(shrunk.course.replicas.len() <= finding.course.replicas.len(), "{name}");
        assert_eq!(shrunk.events_before, finding.course.events.len(), "{name}");
        let fails = breaks_as::<Broken>(&finding.outcome);
        for kind in Reduction::ALL {
            for (semantics, course) in neighbours(&shrunk.semantics, &shrunk.course, kind) {
                assert!(!fails(&semantics, &course), "{name}: one of {kind:?} still fails: {course:#?}");
            }
        }
    }
}

/// A course without one of its events, and without what becomes of its message. Shares no code with shrinking.
fn without(course: &Course<Act>, gone: usize) -> Course<Act> {
    let sends = |at: usize| course.events[at].sends();
    let message = sends(gone).then(|| (0..gone).filter(|&at| sends(at)).count());
    let renumbered = |old: usize| match message {
        Some(gone) if old == gone => None,
        Some(gone) if old > gone => Some(old - 1),
        _ => Some(old),
    };
    let rest = course.events.iter().enumerate().filter(|(at, _)| *at != gone);
    let events = rest.filter_map(|(_, event)| {
        Some(match event.clone() {
            Event::Deliver { replica, message } => Event::Deliver { replica, message: renumbered(message)? },
            Event::Lose { replica, message } => Event::Lose { replica, message: renumbered(message)? },
            other => other,
        })
    });
    Course { replicas: course.replicas.clone(), events: events.collect() }
}

/// No event can be left out, by brute force. [spec: CHECK-14]
#[test]
fn oracle_no_event_can_be_left_out() {
    for (name, finding) in findings() {
        let shrunk = &finding.shrunk;
        for gone in 0..shrunk.course.events.len() {
            let outcome = run(&*shrunk.semantics, &without(&shrunk.course, gone), true);
            assert_ne!(outcome.clause(), finding.outcome.clause(), "{name}: not without event {gone}");
        }
        for (at, event) in shrunk.course.events.iter().enumerate() {
            let Event::Mutate { mutations, .. } = event else { continue };
            for place in (0..mutations.len()).filter(|_| mutations.len() > 1) {
                let mut course = shrunk.course.clone();
                if let Event::Mutate { mutations, .. } = &mut course.events[at] {
                    mutations.remove(place);
                }
                let outcome = run(&*shrunk.semantics, &course, true);
                assert_ne!(outcome.clause(), finding.outcome.clause(), "{name}: not without {at}.{place}");
            }
        }
    }
}

/// Shrinking what is shrunk changes nothing, and the same walk shrinks to the same course. [spec: CHECK-14]
#[test]
fn law_shrinking_is_idempotent_and_a_function() {
    for (name, finding) in findings() {
        let core = Arc::new(
            all().iter().find(|alarm| alarm.name == name).unwrap().core(&MutationKind::ALL, &[A, B]),
        );
        let fails = breaks_as::<Broken>(&finding.outcome);
        // Walks this short have all the tries that there are.
        let again = shrink(&core, &finding.course, &fails);
        assert_eq!((&again.course, again.tries), (&finding.shrunk.course, finding.shrunk.tries), "{name}");
        let twice = shrink(&finding.shrunk.semantics, &finding.shrunk.course, &fails);
        assert_eq!(twice.course, finding.shrunk.course, "{name}");
        assert!(twice.made.is_empty() && twice.is_minimal, "{name}");
    }
}

/// Every kind of reduction comes to something somewhere. [spec: CHECK-14]
#[test]
fn canary_every_kind_of_reduction_is_made() {
    let mut made: BTreeMap<Reduction, usize> = BTreeMap::new();
    for (_, finding) in findings() {
        for (kind, count) in &finding.shrunk.made {
            *made.entry(*kind).or_default() += count;
        }
    }
    println!("{made:?}");
    for kind in Reduction::ALL {
        assert!(made.get(&kind).is_some_and(|&count| count > 0), "{kind:?} is never made");
    }
}

/// Where L2 breaks the same clause, its shortest schedule is at most three events shorter; in all such cases
/// together shrunk courses are not longer. The table says by how much in each. [spec: CHECK-14]
#[test]
fn oracle_shrunk_courses_are_about_as_short_as_schedules_can_be() {
    let (mut compared, mut excess_all, mut none) = (0, 0_isize, 0);
    println!("{:<24} {:<9} {:>6} {:>6} {:>8} {:>6}", "alarm", "clause", "walked", "shrunk", "L2", "excess");
    for (name, finding) in findings() {
        let alarm = found().iter().map(|(alarm, _)| alarm).find(|alarm| alarm.name == name).unwrap();
        let layers = run_alarm(alarm, true);
        let shortest = layers.iter().filter_map(|layer| layer.finding.as_ref()).find(|it| it.layer == "L2");
        let (clause, events) = (finding.outcome.clause().unwrap(), finding.shrunk.course.events.len());
        let same = shortest.filter(|shortest| shortest.clause == clause);
        let excess = same.map(|shortest| events.cast_signed() - shortest.steps.cast_signed());
        println!(
            "{name:<24} {clause:<9} {:>6} {events:>6} {:>8} {:>6}",
            finding.course.events.len(),
            shortest.map_or("-".into(), |it| it.steps.to_string()),
            excess.map_or_else(|| "other".into(), |excess| excess.to_string())
        );
        if let Some(excess) = excess {
            assert!(excess <= 3, "{name}");
            (compared, excess_all, none) =
                (compared + 1, excess_all + excess, none + usize::from(excess <= 0));
        }
    }
    println!("{compared} compared, {none} as short or shorter, {excess_all} events longer in all");
    assert!(compared >= 20 && none + 1 >= compared && excess_all <= 0);
}

/// A limit of tries leaves a course that fails and says that it may not be minimal. [spec: CHECK-14]
#[test]
fn canary_a_shrinker_that_gives_up_says_so() {
    let (_, finding) = findings().find(|(_, finding)| finding.course.events.len() > 60).unwrap();
    let core = all().into_iter().find(|alarm| alarm.name == finding.shrunk.semantics.name()).unwrap();
    let core = Arc::new(core.core(&MutationKind::ALL, &[A, B]));
    let shrinker = Shrinker { tries_max: 5, ..Shrinker::default() };
    let shrunk = shrinker.shrink(&core, &finding.course, breaks_as(&finding.outcome));
    assert!(!shrunk.is_minimal && shrunk.tries <= 5);
    assert_eq!(run(&*shrunk.semantics, &shrunk.course, true).clause(), finding.outcome.clause());
}

/// A course that does not fail is left as it is, and is not said to be minimal. [spec: CHECK-14]
#[test]
fn canary_what_does_not_fail_is_not_shrunk() {
    let semantics = Arc::new(subject(&MutationKind::ALL, &[A, B]));
    let walked = WALK.walk(&*semantics, 0);
    let shrunk = shrink(&semantics, &walked.course, breaks_as(&walked.outcome));
    assert_eq!(shrunk.course, walked.course);
    assert!(!shrunk.is_minimal && shrunk.made.is_empty());
}

fn add(name: &str) -> Event<Act> {
    let vertex = NewVertex::new("object", name);
    let link = VertexLink::child_of(VertexId::ROOT);
    Event::Mutate { replica: 0, mutations: vec![Act(Mutation::AddVertex { vertex, link })] }
}

fn removes(course: &Course<Act>, name: &str, semantics: &Checked) -> bool {
    let mut runner = dsr_model::course::Runner::new(semantics, course.replicas.len());
    let mut vertices = 0;
    for event in &course.events {
        let Ok(stepped) = runner.step(event) else { return false };
        let names = |state: &dsr_core::State| {
            state.records().filter(|(dot, _)| state.vertex(*dot).is_some_and(|it| &*it.name == name)).count()
        };
        vertices += names(&stepped.before).saturating_sub(names(&stepped.after));
    }
    vertices > 0
}

/// An earlier mutation goes, ids move up, and later mutations go on naming what they named. [spec: CHECK-14]
#[test]
fn law_what_a_mutation_names_is_found_again() {
    let semantics = Arc::new(subject(&MutationKind::ALL, &[A, B]));
    let dot = |sequence| VertexId(dsr_core::Dot::new(dsr_core::ReplicaId::agent(1), sequence));
    let remove =
        |vertex| Event::Mutate { replica: 0, mutations: vec![Act(Mutation::RemoveVertex { vertex })] };
    let course = Course { events: vec![add("first"), add("second"), remove(dot(3))], ..Course::among(1) };
    let shrinker = Shrinker { kinds: vec![Reduction::Event], ..Shrinker::default() };
    let fails = |semantics: &Checked, course: &Course<Act>| removes(course, "second", semantics);
    let shrunk = shrinker.shrink(&semantics, &course, fails);
    assert_eq!(shrunk.course.events, [add("second"), remove(dot(1))]);
    // What nobody makes any more cannot be named: that reduction leads nowhere.
    let gone = neighbours(&semantics, &shrunk.course, Reduction::Event);
    assert!(gone.iter().any(|(_, course)| course.events.is_empty()));
}

/// The graph that all start from loses what the course does not need, and stays a graph without repairs.
/// [spec: CHECK-14]
#[test]
fn law_the_initial_graph_shrinks_too() {
    let semantics = Arc::new(subject(&MutationKind::ALL, &[A, B]));
    let course = Course { events: vec![add("first")], ..Course::among(1) };
    let fails = |_: &Checked, course: &Course<Act>| course.events.len() == 1;
    let shrunk = shrink(&semantics, &course, fails);
    assert!(shrunk.semantics.initial.is_empty() && !semantics.initial.is_empty());
    for smaller in semantics.simpler_initial() {
        assert!(smaller.initial.len() < semantics.initial.len());
        assert!(smaller.judge(&smaller.initial).is_ok());
        assert!(dsr_core::view(&smaller.initial, &smaller.dictionary).repairs().is_empty());
    }
}

/// Whatever is made simpler stays of its kind, and there is an end to it, whichever way is taken.
/// [spec: CHECK-14]
#[test]
fn law_simpler_comes_to_an_end() {
    let semantics = subject(&MutationKind::ALL, &[A, B]);
    let dot = |sequence| VertexId(dsr_core::Dot::new(dsr_core::ReplicaId::agent(1), sequence));
    let text = |text: &str| Value::String(text.into());
    let attributes: BTreeMap<dsr_core::Name, Value> = [
        ("a".into(), Value::Int(-3)),
        ("b".into(), text("wide")),
        ("c".into(), Value::FloatVec([1.0, 2.0].into())),
        ("d".into(), Value::Double(f64::NAN)),
    ]
    .into();
    let mut vertex = NewVertex::new("object", "a long name");
    (vertex.external_id, vertex.attributes) = (Some(7), attributes.clone());
    let link = VertexLink { attributes: attributes.clone(), ..VertexLink::child_of(dot(5)) };
    let (from, to) = (EdgeKey::new(dot(1), "has", dot(2)), EdgeKey::new(dot(3), "has", dot(4)));
    let updates = attributes.iter().map(|(name, value)| (name.clone(), Some(value.clone())));
    let updates = updates.chain([("e".into(), None)]).collect();
    let mutations = [
        Mutation::AddVertex { vertex, link },
        Mutation::AddEdge { key: from.clone(), attributes: attributes.clone() },
        Mutation::MoveEdge { from: from.clone(), to, attributes },
        Mutation::UpdateAttributes { target: ElementId::Vertex(dot(1)), updates },
        Mutation::RemoveEdge { key: from },
        Mutation::RemoveVertex { vertex: dot(1) },
    ];
    for mutation in mutations.map(Act) {
        let mut way = vec![mutation.clone()];
        for turn in 0.. {
            assert!(turn < 200, "no end: {mutation}");
            let simpler = semantics.simpler(&way[way.len() - 1]);
            assert!(simpler.iter().all(|simpler| semantics.kind(simpler) == semantics.kind(&mutation)));
            assert!(simpler.iter().all(|simpler| !way.contains(simpler)), "in a circle: {mutation}");
            // The last one takes away least, so this way is among the longest.
            let Some(last) = simpler.last() else { break };
            way.push(last.clone());
        }
        assert!(way.len() > 1, "never simpler: {mutation}");
    }
}

/// What cannot happen is left as it is. [spec: CHECK-13] [spec: CHECK-14]
#[test]
fn canary_a_course_that_cannot_happen_is_not_shrunk() {
    let semantics = Arc::new(subject(&MutationKind::ALL, &[A, B]));
    let events = vec![add("first"), Event::Deliver { replica: 1, message: 4 }, add("second")];
    let course = Course { events, ..Course::among(2) };
    let outcome = run(&*semantics, &course, true);
    assert!(matches!(outcome, Outcome::Invalid { at: 1, .. }), "{outcome}");
    let shrunk = shrink(&semantics, &course, breaks_as(&outcome));
    assert_eq!((shrunk.course, shrunk.is_minimal), (course.clone(), false));
    // Of what is left of it, what cannot happen goes.
    let fewer = neighbours(&semantics, &course, Reduction::Event);
    assert!(fewer.iter().all(|(_, course)| run(&*semantics, course, true) == Outcome::Held));
}

/// A course that was run is written down event by event, and replays.
/// `[spec: TRACE-1]` `[spec: TRACE-6]`
#[test]
fn conform_a_course_as_a_trace() {
    let semantics = subject(&MutationKind::ALL, &[A, B]);
    let events = vec![
        add("first"),
        Event::Deliver { replica: 1, message: 0 },
        Event::Restart { replica: 1, keeps: false },
        Event::Answer { replica: 0, to: 1 },
        Event::Lose { replica: 1, message: 1 },
    ];
    let course = Course { events, ..Course::among(2) };
    let outcome = run(&semantics, &course, true);
    let trace = of_course(&semantics, &course, &outcome, &[], ("L3", "made up".into())).unwrap();
    let told: Vec<String> =
        trace.steps.iter().map(|step| format!("{}: {}", step.replica, step.does)).collect();
    let expected = [
        "r1: add_vertex root -RT-> \"first\"  → m1",
        "r2: receives m1",
        "r2: restarts without its state",
        "r1: sends r2 what it lacks  → m2",
        "r2: never receives m2",
    ];
    assert_eq!((told, trace.finding.detail.as_str()), (expected.map(str::to_owned).to_vec(), "all holds"));
    let outcome = run(&semantics, &Course { events: vec![add("a")], ..Course::among(1) }, true);
    assert!(matches!(&outcome, Outcome::Invalid { at: 0, .. }), "{outcome}");
    assert!(outcome.to_string().contains("refused"), "{outcome}");
}
