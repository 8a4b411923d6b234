//! Traces as text, as sequence diagrams, as drawings and as logs.

#![expect(
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests: what they expect is what they test"
)]

mod made;

use dsr_core::{Delta, MutationKind, State, delta_for, digest};
use dsr_model::alarms::{self, A, B, Broken, Flaw, subject};
use dsr_model::checked::replica_id;
use dsr_model::histories::{Bound, HistoryRun};
use dsr_model::progress::{Limits, Progress};
use dsr_model::render::{Diagram, Event, Target, render};
use dsr_model::schedules::{ScheduleBound, ScheduleRun};
use dsr_model::semantics::Semantics;
use dsr_model::trace::{Act, Trace};
use dsr_model::verdict::RunReport;
use made::{TARGETS, crossing, mutate, read_log};
use std::collections::BTreeMap;
use std::sync::Arc;

fn core(name: &str) -> Arc<Broken> {
    let alarm = alarms::all().into_iter().find(|alarm| alarm.name == name);
    Arc::new(alarm.unwrap_or_else(|| panic!("no alarm {name}")).core(&MutationKind::ALL, &[A, B]))
}

fn trace_of(report: &RunReport) -> Trace {
    let json = &report.traces.first().expect("a counterexample").json;
    Trace::read(&json.to_string()).expect("the trace's own format")
}

/// A counterexample of L1.
fn of_histories(name: &str, replicas: usize, mutations: usize) -> Trace {
    let bound = Bound { replicas, mutations };
    let (name, semantics) = (name.to_owned(), core(name));
    let run = HistoryRun { name, semantics, focus: 2, bound, symmetry: false, second_engine: false };
    trace_of(&run.run(&Arc::new(Progress::new(Limits::default()))))
}

/// A counterexample of L2.
fn of_schedules(semantics: Arc<Broken>, replicas: usize, mutations: usize, resynchronisations: u8) -> Trace {
    let bound = ScheduleBound { replicas, readers: 0, mutations, restarts: 1, resynchronisations };
    let name = semantics.name();
    let run = ScheduleRun { name, semantics, focus: 2, bound, second_engine: false };
    trace_of(&run.run(&Arc::new(Progress::new(Limits::default()))))
}

/// The first replica, asked by the second before it has heard of it, claims to have seen what it has not. In the
/// checker's own rounds of resynchronisation nobody asks so: the answer must arrive to be found out.
#[derive(Debug)]
struct Pretends;

impl Flaw for Pretends {
    fn repair(&self, ours: &State, theirs: &State) -> Delta {
        let made = |state: &State, replica: usize| state.context().greatest(replica_id(replica)) > 0;
        let delta = delta_for(ours, &digest(theirs));
        if !made(ours, 0) || made(ours, 1) || !made(theirs, 1) {
            return delta;
        }
        let mut context = delta.context().clone();
        context.join(theirs.context());
        State::assemble(delta.records().map(|(dot, record)| (dot, record.clone())), context)
    }
}

/// Runs that have every kind of step between them.
fn real() -> Vec<Trace> {
    vec![
        of_histories("last-delivered-wins", 2, 1),
        of_schedules(core("reused-dot"), 1, 2, 0),
        of_schedules(core("pending-shown"), 2, 1, 1),
        of_schedules(
            Arc::new(Broken::new("pretends", subject(&MutationKind::ALL, &[A, B]), Arc::new(Pretends))),
            2,
            1,
            1,
        ),
    ]
}

fn acts(trace: &Trace, is: fn(&Act) -> bool) -> usize {
    trace.steps.iter().filter(|step| is(&step.does)).count()
}

/// `[spec: TRACE-3]`
#[test]
fn law_every_kind_of_step_is_rendered_by_every_target() {
    let traces = real();
    let has = |is: fn(&Act) -> bool| traces.iter().any(|trace| acts(trace, is) > 0);
    assert!(has(|act| matches!(act, Act::Mutate { .. })) && has(|act| matches!(act, Act::Deliver { .. })));
    assert!(has(|act| matches!(act, Act::Restart { .. })) && has(|act| matches!(act, Act::Answer { .. })));
    for trace in traces.iter().chain([&crossing()]) {
        let rendered = TARGETS.map(|target| render(trace, target).expect("a sound trace"));
        for (target, text) in TARGETS.iter().zip(&rendered) {
            assert!(text.ends_with('\n') && text.contains(&trace.finding.clause), "{target:?}\n{text}");
            for step in &trace.steps {
                let words = match &step.does {
                    Act::Mutate { sends, .. } | Act::Answer { sends, .. } => sends[0].message.as_str(),
                    Act::Deliver { message, .. } | Act::Lose { message } => message.as_str(),
                    Act::Restart { .. } => "restarts with",
                    Act::Happen { text } => text,
                };
                assert!(text.contains(words), "{target:?}: {words}\n{text}");
            }
        }
        let [text, mermaid, svg, log] = rendered;
        let count = |text: &str, sign: &str| text.matches(sign).count();
        let mutations = acts(trace, |act| matches!(act, Act::Mutate { .. }));
        let deliveries = acts(trace, |act| matches!(act, Act::Deliver { .. }));
        let losses = acts(trace, |act| matches!(act, Act::Lose { .. }));
        let restarts = acts(trace, |act| matches!(act, Act::Restart { .. }));
        let answers = acts(trace, |act| matches!(act, Act::Answer { .. }));
        let others = acts(trace, |act| matches!(act, Act::Happen { .. }));
        let signs = ["●", "◆", "×", "↻", "◇", "○", "✗"].map(|sign| count(&text, sign));
        assert_eq!(signs, [mutations, deliveries, losses, restarts, answers, others, 1], "{text}");
        assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
        let arrows = ["->>", "-x"].map(|arrow| count(&mermaid, &format!("{arrow}p")));
        assert_eq!(arrows, [deliveries, losses], "{mermaid}");
        // One more of each for the legend.
        assert_eq!(count(&svg, "<circle class=\"full\""), mutations + 1);
        assert_eq!(count(&svg, "<circle class=\"hollow\""), others + 1);
        assert_eq!(count(&svg, "<path class=\"full\""), deliveries + 1);
        assert_eq!(count(&svg, "<path class=\"lost-mark\""), losses + 1);
        assert_eq!(count(&svg, "<rect class=\"hollow\""), restarts + 1);
        assert_eq!(count(&svg, "<path class=\"hollow\""), answers + 1);
        assert_eq!((count(&svg, "url(#tip)"), count(&svg, "class=\"ring\"")), (deliveries, 1));
        assert_eq!(read_log(&log).len(), trace.steps.len());
    }
}

/// `[spec: TRACE-3]`
#[test]
fn law_arrows_come_from_the_sender() {
    for trace in real().iter().chain([&crossing()]) {
        let diagram = Diagram::of(trace).expect("a sound trace");
        let mermaid = render(trace, Target::Mermaid).expect("a sound trace");
        for (at, (row, step)) in diagram.rows.iter().zip(&trace.steps).enumerate() {
            assert_eq!(diagram.lanes[row.lane], step.replica);
            let (Event::Delivery(arrow) | Event::Loss(arrow)) = row.event else { continue };
            assert!(arrow.sent < at && step.does.message() == Some(arrow.message));
            let sender = &trace.steps[arrow.sent];
            assert!(sender.does.sends().iter().any(|sent| sent.message == arrow.message));
            assert_eq!(trace.replicas[arrow.from].name, sender.replica);
            let line = match row.event {
                Event::Loss(_) => "-x",
                _ if matches!(sender.does, Act::Answer { .. }) => "-->>",
                _ => "->>",
            };
            let drawn =
                format!("    p{}{line}p{}: {}. {}\n", arrow.from + 1, row.lane + 1, at + 1, arrow.message);
            assert!(mermaid.contains(&drawn), "{drawn}\n{mermaid}");
        }
    }
}

/// The values of an attribute in the tags that start so, in order.
fn attributes<'s>(svg: &'s str, tag: &str, attribute: &str) -> Vec<&'s str> {
    let start = format!(" {attribute}=\"");
    let value = |rest: &'s str| rest.split_once(&start)?.1.split_once('"').map(|(value, _)| value);
    svg.split(tag).skip(1).filter_map(value).collect()
}

/// `[spec: TRACE-3]`
#[test]
fn law_drawn_arrows_start_at_the_sending_step_and_end_at_the_receiver() {
    for trace in real().iter().chain([&crossing()]) {
        let diagram = Diagram::of(trace).expect("a sound trace");
        let svg = render(trace, Target::Svg).expect("a sound trace");
        let lanes = attributes(&svg, "<line class=\"lane\"", "x1");
        let rings = attributes(&svg, "<text class=\"small\" x=\"16\"", "y");
        let arrows = attributes(&svg, "<path class=\"arrow", "d");
        let arriving = diagram.rows.iter().filter_map(|row| match row.event {
            Event::Delivery(arrow) | Event::Loss(arrow) => Some((row, arrow)),
            _ => None,
        });
        assert_eq!(arrows.len(), arriving.clone().count());
        for ((row, arrow), path) in arriving.zip(arrows) {
            // The number of a step stands five below its line.
            let height: usize = rings[arrow.sent].parse::<usize>().expect("a number") - 5;
            let (start, to) = (format!("M{} {height}", lanes[arrow.from]), lanes[row.lane]);
            let end = if arrow.from == row.lane { format!("H{to}") } else { format!("L{to} ") };
            assert!(path.starts_with(&start) && path.contains(&end), "{start} {end}: {path}");
        }
    }
}

#[test]
fn oracle_text_of_crossing_messages() {
    let drawn = "\
crossing messages (made up, L2, 10 steps)

     r1          r2          observer 1
  1  ●           │           │           one  → m1
     │           │           │             + change 1
  2  │           ●           │           two  → m2
     │           │           │             + change 2
  3  ◆◀───────m2─┤           │           receives m2 from r2
     │           │           │             + change 3
  4  ├─m1───────▶◆           │           receives m1 from r1
     │           │           │             + change 4
  5  ↻           │           │           restarts with its state
     │           │           │             + change 5
  6  ◆           │           │           receives m1 from itself
     │           │           │             + change 6
  7  │           ├╌m2╌╌╌╌╌╌╌▶×           never receives m2 from r2
     │           │           │             + change 7
  8  ◇           │           │           sends observer 1 what it lacks  → m3
     │           │           │             + change 8
  9  │           │           ○           waits
     │           │           │             + change 9
 10  ├╌m3╌╌╌╌╌╌╌╌┼╌╌╌╌╌╌╌╌╌╌▶◆           receives m3 from r1
     │           │           │             + change 10
     │           │           ✗           [JOIN-5] unequal
";
    let text = render(&crossing(), Target::Text).expect("a sound trace");
    assert_eq!(text, drawn, "\n{text}");
}

#[test]
fn oracle_clocks_of_crossing_messages() {
    let log = render(&crossing(), Target::Shiviz).expect("a sound trace");
    let told: Vec<&str> = log.lines().skip(1).step_by(2).collect();
    let clocks = [
        r#"r1 {"r1": 1}"#,
        r#"r2 {"r2": 1}"#,
        r#"r1 {"r1": 2, "r2": 1}"#,
        r#"r2 {"r1": 1, "r2": 2}"#,
        r#"r1 {"r1": 3, "r2": 1}"#,
        r#"r1 {"r1": 4, "r2": 1}"#,
        r#"observer_1 {"observer_1": 1}"#,
        r#"r1 {"r1": 5, "r2": 1}"#,
        r#"observer_1 {"observer_1": 2}"#,
        r#"observer_1 {"r1": 5, "r2": 1, "observer_1": 3}"#,
    ];
    assert_eq!(told, clocks, "{log}");
}

/// A line that starts with a word, a space and a brace would be read as a host with its clock.
#[test]
fn regress_a_mutation_in_braces_is_no_clock() {
    let mut trace = crossing();
    trace.steps[1].does = mutate("m2", "{\"r1\": 7}");
    let log = render(&trace, Target::Shiviz).expect("a sound trace");
    let is_clock = |line: &&str| line.split_once(' ').is_some_and(|(_, rest)| rest.starts_with('{'));
    assert_eq!(log.lines().filter(is_clock).count(), trace.steps.len(), "{log}");
}

/// `[spec: TRACE-3]`
#[test]
fn law_a_clock_counts_its_own_events_and_includes_the_sender() {
    for trace in real().iter().chain([&crossing()]) {
        let diagram = Diagram::of(trace).expect("a sound trace");
        let log = read_log(&render(trace, Target::Shiviz).expect("a sound trace"));
        let mut own: BTreeMap<&str, u64> = BTreeMap::new();
        for ((_, host, clock), row) in log.iter().zip(&diagram.rows) {
            let count = own.entry(host).or_default();
            *count += 1;
            assert_eq!(clock[host], *count);
            if let Event::Delivery(arrow) = row.event {
                let (_, _, sender) = &log[arrow.sent];
                assert!(sender.iter().all(|(host, count)| clock.get(host) >= Some(count)), "{log:?}");
            }
        }
    }
}
