//! The published semantics in the checker's ordinary layers. `[spec: CHECK-12]`

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

use dsr_model::histories::Bound;
use dsr_model::job::Job;
use dsr_model::progress::{Limits, Progress};
use dsr_model::published::suite::{CallKind, ClauseRun, Compared, Held, Published, histories};
use dsr_model::published::{
    AgentId, Message, NOBODY, Network, Operation, Order, Play, Powers, Property, Replica, Setup, Stamps,
    Variant, When, Workers,
};
use dsr_model::schedules::{ScheduleBound, ScheduleRun};
use dsr_model::search::find_fault;
use dsr_model::semantics::{Semantics, Step};
use dsr_model::verdict::{RunReport, Verdict};
use std::sync::Arc;

const FORK_STAMPED: Variant = Variant { workers: Workers::One, stamps: Stamps::Author };
const VARIANTS: [Variant; 4] = [Variant::UPSTREAM, Variant::STAMPED, Variant::FORK, FORK_STAMPED];
const ONCE: ScheduleBound =
    ScheduleBound { replicas: 2, readers: 0, mutations: 1, restarts: 0, resynchronisations: 0 };

fn run(job: &dyn Job) -> RunReport {
    job.run(&Arc::new(Progress::new(Limits::default())))
}

fn clause(variant: Variant, clause: &'static str) -> RunReport {
    run(&ClauseRun { variant, clause })
}

/// L2 with some kinds of calls, and one clause.
fn schedules(variant: Variant, kinds: &[CallKind], only: &'static str, bound: ScheduleBound) -> RunReport {
    let kinds = kinds.iter().copied().collect();
    let semantics =
        Published { kinds, compared: Compared::Shown, only: Some(only), ..Published::new(variant) };
    run(&ScheduleRun {
        name: only.into(),
        semantics: Arc::new(semantics),
        focus: 4,
        bound,
        second_engine: true,
    })
}

/// Steps of the only trace, and the mutations among them.
fn lengths(report: &RunReport) -> (usize, usize) {
    let trace = &report.traces[0];
    (trace.steps, trace.text.lines().filter(|line| line.contains("  → m")).count())
}

/// The clauses that break, and the steps and calls that each takes at least: the same in every variant.
#[test]
fn conform_clauses_break_after_these_many_steps() {
    for variant in VARIANTS {
        for (id, steps, calls) in [
            ("JOIN-3", 6, 2),
            ("MUT-0", 1, 1),
            ("JOIN-5", 2, 1),
            ("INV-2", 2, 1),
            ("INV-3", 3, 2),
            ("VIEW-7", 3, 2),
        ] {
            let report = clause(variant, id);
            assert_eq!((report.verdict, &*report.traces[0].clause), (Verdict::Violated, id), "{variant:?}");
            assert_eq!(lengths(&report), (steps, calls), "{variant:?}\n{}", report.traces[0].text);
            assert_eq!(report.name, format!("{id} alone, 2 × 1"));
        }
    }
}

/// Two agents with two calls each leave a register empty: one removes an attribute that the other writes, and
/// the next writes fall into the gap.
#[test]
fn conform_two_agents_with_two_calls_each_crash() {
    let report = clause(Variant::STAMPED, "VIEW-1");
    assert_eq!((report.verdict, lengths(&report)), (Verdict::Violated, (8, 4)), "{:?}", report.notes);
    assert_eq!(report.name, "VIEW-1 alone, 2 × 2 at one node");
    assert!(report.notes.iter().any(|note| note == "holds at 2 × 1"), "{:?}", report.notes);
}

/// The gallery's network, which sends each message by itself between agents that know who they are, finds the
/// same crash after as many steps.
#[test]
fn differential_the_gallery_finds_the_same_crash() {
    let set = |value| Operation::Set { node: 4, key: "x", value };
    let remove = Operation::Remove { node: 4, key: "x" };
    let plays = [[set(11), set(12), remove], [set(21), set(22), remove]];
    let setup = Setup {
        variant: Variant::UPSTREAM,
        agents: vec![1, 2],
        before: vec![Operation::InsertNode { id: 4, kind: "thing", name: "cup", attributes: &[("x", 0)] }],
        ignored: Vec::new(),
        plays: plays.iter().map(|calls| Play::any(calls, 2)).collect(),
        powers: Powers::ordered(Order::Pair),
        property: Property::Unreadable,
        when: When::Always,
    };
    let found = find_fault(&mut Network::new(setup), 1_000_000).unwrap();
    assert_eq!(found.events.len(), lengths(&clause(Variant::UPSTREAM, "VIEW-1")).0);
}

/// What holds is said to hold to its bounds, and to no more.
#[test]
fn law_a_clause_that_never_breaks_is_exhaustive_within_its_bound() {
    for id in ["STATE-3", "INTENT-1"] {
        let report = schedules(Variant::UPSTREAM, &CallKind::ALL, id, ONCE);
        assert_eq!((report.verdict, report.traces.len()), (Verdict::Exhaustive, 0));
        let judged: Vec<&str> = report
            .properties
            .iter()
            .filter(|property| !property.claim.is_empty())
            .map(|p| &*p.clause)
            .collect();
        assert_eq!(judged, [id], "nothing is claimed of what was not judged");
        assert!(report.second_engine.is_some());
    }
}

/// Ties of agent 0 are never settled; those of different agents are. The same search as the gallery's (row 3)
/// finds it after as many steps.
#[test]
fn differential_only_agent_zero_ties() {
    let ties = |variant| schedules(variant, &[CallKind::SetAttribute], "JOIN-5", ONCE);
    for variant in [Variant::UPSTREAM, Variant::FORK] {
        let report = ties(variant);
        assert_eq!((report.verdict, lengths(&report)), (Verdict::Violated, (4, 2)), "{:?}", report.notes);
    }
    for variant in [Variant::STAMPED, FORK_STAMPED] {
        assert_eq!(ties(variant).verdict, Verdict::Exhaustive);
    }
}

/// A place says that it is from agent 0, whatever users do.
#[test]
fn regress_places_tie_in_every_variant() {
    for variant in VARIANTS {
        let report = schedules(variant, &[CallKind::Place], "JOIN-5", ONCE);
        assert_eq!((report.verdict, lengths(&report)), (Verdict::Violated, (4, 2)), "{variant:?}");
    }
}

/// L1 names a difference that people see, if there is one; else it says that there is none to see.
#[test]
fn conform_histories_prefer_what_is_shown() {
    let twice = Bound { replicas: 2, mutations: 2 };
    let detail = |variant, kinds: &[CallKind]| {
        let report = run(&histories(variant, twice, kinds));
        report.traces.first().map(|trace| (trace.clause.clone(), trace.detail.clone()))
    };
    let kinds = [CallKind::DeleteEdge, CallKind::SetAttribute];
    let (broken, shown) = detail(Variant::UPSTREAM, &kinds).unwrap();
    assert_eq!(broken, "JOIN-3");
    assert!(shown.contains("only the first shows #2.x = 21"), "{shown}");
    let (broken, hidden) = detail(Variant::STAMPED, &kinds).unwrap();
    assert_eq!(broken, "JOIN-3");
    assert!(hidden.contains("both show the same") && hidden.contains("#4 -on-> #3.w held back"), "{hidden}");
    assert_eq!(detail(Variant::UPSTREAM, &[CallKind::DeleteEdge, CallKind::RemoveAttribute]), None);
}

/// Runs repeat to the letter.
#[test]
fn law_runs_are_deterministic() {
    let told = || {
        ClauseRun::all(Variant::FORK)
            .iter()
            .filter(|run| run.clause != "VIEW-1")
            .take(6)
            .map(run_text)
            .collect::<Vec<_>>()
    };
    assert_eq!(told(), told());
}

fn run_text(job: &ClauseRun) -> (u64, u64, Vec<String>) {
    let report = run(job);
    let traces = report.traces.iter().map(|trace| format!("{} {}", trace.text, trace.json));
    (report.states.unique, report.states.generated, traces.collect())
}

/// A replica that knows whose it is from the start.
fn of_agent(held: &Held, agent: AgentId) -> Held {
    Held { replica: Replica { agent, ..held.replica.clone() }, clock: held.clock }
}

/// The checker's replicas do not say whose they are until they call. Real ones do, and it makes no difference:
/// in every run of two calls of two agents, delivered either way, they send and show the same.
#[test]
fn oracle_replicas_that_know_their_agent_do_the_same() {
    let mut runs = 0;
    for variant in VARIANTS {
        let semantics = Published::new(variant);
        let start = semantics.initial();
        assert_eq!(start.replica.agent, NOBODY);
        let calls = |held: &Held, replica| semantics.steps(held, replica);
        for (call, first) in calls(&start, 0) {
            let (sent, real) = of_agent(&start, 1).called(1, &call).unwrap();
            assert_eq!((&sent, &real), (&first.delta, &first.after));
            for at in [start.clone(), start.received(&sent)] {
                for (call, second) in calls(&at, 1) {
                    let (answer, real_second) = of_agent(&at, 2).called(2, &call).unwrap();
                    assert_eq!((&answer, &real_second), (&second.delta, &second.after));
                    let ends: [(&Held, Held, &[Message]); 2] =
                        [(&first.after, real.clone(), &answer), (&second.after, real_second, &sent)];
                    for (held, real, message) in ends {
                        assert_eq!(held.received(message).facts(), real.received(message).facts());
                        runs += 1;
                    }
                }
            }
        }
    }
    assert!(runs > 1000, "{runs}");
}

/// Who inserted a node passes over another's removal of its attribute, as the messages say that they are its
/// own: the state knows whose it is once it has called.
#[test]
fn regress_an_author_passes_over_removals_that_bear_its_name() {
    let made = |variant| {
        let semantics = Published::new(variant);
        let insert = |(call, _): &(Operation, Step<Published>)| CallKind::of(call) == CallKind::InsertNode;
        let (_, step) = semantics.steps(&semantics.initial(), 0).into_iter().find(insert).unwrap();
        let reader = semantics.initial().received(&step.delta);
        let remove = Operation::Remove { node: 11, key: "x" };
        let removal = semantics.mutate(&reader, 1, &remove).unwrap();
        step.after.received(&removal.delta).replica.attribute(11, "x").is_some()
    };
    assert!(made(Variant::STAMPED) && !made(Variant::UPSTREAM));
}

/// The judges of what never broke can see it break.
#[test]
fn canary_judges_see_what_was_broken_on_purpose() {
    let semantics = Published::new(Variant::STAMPED);
    let start = semantics.initial();
    for (call, Step { delta, .. }) in semantics.steps(&start, 0) {
        let idle = Step { delta, after: of_agent(&start, 1) };
        let breach = semantics.judge_step(&start, 0, &call, &idle).unwrap_err();
        assert_eq!(breach.clause, "INTENT-1", "{call}");
    }
    let delete = Operation::DeleteNode { node: 3 };
    let deleted = semantics.mutate(&start, 0, &delete).unwrap().after;
    let mut revived = deleted.clone();
    revived.replica.nodes = start.replica.nodes.clone();
    assert_eq!(semantics.judge_delivery(&deleted, &revived).unwrap_err().clause, "STATE-3");
    assert_eq!(semantics.judge_delivery(&deleted, &deleted), Ok(()));
    let set = Operation::Set { node: 3, key: "x", value: 11 };
    let step = semantics.mutate(&start, 0, &set).unwrap();
    let silent = Step { delta: Vec::new(), after: step.after };
    assert_eq!(semantics.judge_step(&start, 0, &set, &silent).unwrap_err().clause, "MUT-0");
}
