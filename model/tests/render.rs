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

/// `[spec: TRACE-3]`
#[test]
fn law_every_kind_of_step_is_rendered_by_every_target() {
    let traces = real();
    let has = |is: fn(&Act) -> bool| traces.iter().any(|trace| trace.steps.iter().any(|step| is(&step.act)));
    assert!(has(|act| matches!(act, Act::Mutate { .. })) && has(|act| matches!(act, Act::Deliver { .. })));
    assert!(has(|act| matches!(act, Act::Restart)) && has(|act| matches!(act, Act::Resynchronise { .. })));
    for trace in traces.iter().chain([&crossing()]) {
        let rendered = TARGETS.map(|target| render(trace, target).expect("a sound trace"));
        for (target, text) in TARGETS.iter().zip(&rendered) {
            assert!(text.ends_with('\n') && text.contains(&trace.breach.clause), "{target:?}\n{text}");
            for step in &trace.steps {
                let words = match &step.act {
                    Act::Mutate { message, .. } | Act::Deliver { message } => message.as_str(),
                    Act::Restart => "restarts",
                    Act::Resynchronise { .. } => "resynchronises with",
                };
                assert!(text.contains(words), "{target:?}: {words}\n{text}");
            }
        }
        let [text, mermaid, svg, log] = rendered;
        let count = |text: &str, sign: &str| text.matches(sign).count();
        let acts = |is: fn(&Act) -> bool| trace.steps.iter().filter(|step| is(&step.act)).count();
        let [mutations, deliveries] =
            [acts(|act| matches!(act, Act::Mutate { .. })), acts(|act| matches!(act, Act::Deliver { .. }))];
        let [restarts, answers] =
            [acts(|act| *act == Act::Restart), acts(|act| matches!(act, Act::Resynchronise { .. }))];
        assert_eq!((count(&text, "●"), count(&text, "◆")), (mutations, deliveries), "{text}");
        assert_eq!(
            (count(&text, "↻"), count(&text, "◇"), count(&text, "✗")),
            (restarts, answers, 1),
            "{text}"
        );
        assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
        assert_eq!(
            (count(&mermaid, "    p"), count(&mermaid, "-->>")),
            (trace.replicas.len() + deliveries + answers, answers)
        );
        // One more of each for the legend.
        assert_eq!(count(&svg, "<circle class=\"full\""), mutations + 1);
        assert_eq!(count(&svg, "<path class=\"full\""), deliveries + 1);
        assert_eq!(count(&svg, "<rect class=\"hollow\""), restarts + 1);
        assert_eq!(count(&svg, "<path class=\"hollow\""), answers + 1);
        assert_eq!((count(&svg, "url(#tip)"), count(&svg, "class=\"ring\"")), (deliveries + answers, 1));
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
            let (from, arrow) = match (row.event, &step.act) {
                (Event::Delivery { message, sent, from }, Act::Deliver { message: named }) => {
                    assert!(sent < at && message == named);
                    let Act::Mutate { message: sends, .. } = &trace.steps[sent].act else { panic!("{sent}") };
                    assert_eq!((sends, trace.replicas[from].as_str()), (named, &*trace.steps[sent].replica));
                    (from, format!("->>p{}: {}. {message}\n", row.lane + 1, at + 1))
                }
                (Event::Resynchronisation { from }, Act::Resynchronise { from: named, .. }) => {
                    assert_eq!(&trace.replicas[from], named);
                    (from, format!("-->>p{}: {}. ", row.lane + 1, at + 1))
                }
                _ => continue,
            };
            assert!(mermaid.contains(&format!("    p{}{arrow}", from + 1)), "{arrow}\n{mermaid}");
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
        let sent_at = attributes(&svg, "<circle class=\"full\"", "cy");
        let arrows = attributes(&svg, "<path class=\"arrow", "d");
        let arriving: Vec<Event<'_>> = diagram.rows.iter().map(|row| row.event).collect();
        let comes =
            |event: &Event<'_>| matches!(event, Event::Delivery { .. } | Event::Resynchronisation { .. });
        assert_eq!(arrows.len(), arriving.iter().filter(|event| comes(event)).count());
        let rows = diagram.rows.iter().filter(|row| comes(&row.event));
        for (row, arrow) in rows.zip(arrows) {
            let (start, from) = match row.event {
                Event::Delivery { sent, from, .. } => {
                    let is_mutation = |event: &&Event<'_>| matches!(event, Event::Mutation { .. });
                    let nth = arriving[..sent].iter().filter(is_mutation).count();
                    (format!("M{} {}", lanes[from], sent_at[nth]), from)
                }
                Event::Resynchronisation { from } => (format!("M{} ", lanes[from]), from),
                _ => panic!("{arrow}"),
            };
            let to = lanes[row.lane];
            let end = if from == row.lane { format!("H{to}") } else { format!("L{to} ") };
            assert!(arrow.starts_with(&start) && arrow.contains(&end), "{start} {end}: {arrow}");
        }
    }
}

#[test]
fn oracle_text_of_crossing_messages() {
    let drawn = "\
made up, L2: 7 steps to JOIN-5

     r1          r2          observer 1
  1  ●           │           │           one  → m1
     │           │           │             + a change
  2  │           ●           │           two  → m2
     │           │           │             + a change
  3  ◆◀───────m2─┤           │           receives m2 from r2
     │           │           │             + a change
  4  ├─m1───────▶◆           │           receives m1 from r1
     │           │           │             + a change
  5  ↻           │           │           restarts under a fresh incarnation
     │           │           │             + a change
  6  ◆           │           │           receives m1 from itself
     │           │           │             + a change
  7  ├╌╌╌╌╌╌╌╌╌╌╌┼╌╌╌╌╌╌╌╌╌╌▶◇           resynchronises with r1
     │           │           │             + a change
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
        r#"observer_1 {"r1": 4, "r2": 1, "observer_1": 1}"#,
    ];
    assert_eq!(told, clocks, "{log}");
}

/// A line that starts with a word, a space and a brace would be read as a host with its clock.
#[test]
fn regress_a_mutation_in_braces_is_no_clock() {
    let mut trace = crossing();
    trace.steps[1].act = mutate("m2", "{\"r1\": 7}");
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
            if let Event::Delivery { sent, .. } = row.event {
                let (_, _, sender) = &log[sent];
                assert!(sender.iter().all(|(host, count)| clock.get(host) >= Some(count)), "{log:?}");
            }
        }
    }
}
