//! What is explained is what is shown.

#![expect(clippy::expect_used, reason = "helpers of tests: what they expect is what they test")]

use dsr_core::MutationKind;
use dsr_model::alarms::{self, A, B};
use dsr_model::gallery::{rows, run_row};
use dsr_model::graph::Element;
use dsr_model::histories::{Bound, HistoryRun};
use dsr_model::progress::{Limits, Progress};
use dsr_model::trace::Trace;
use dsr_model::why::{Fate, TargetError, Why, WhyError, why};
use std::sync::Arc;

fn row(number: &str) -> [Trace; 2] {
    let row = rows().into_iter().find(|row| row.row == number).expect("a row");
    let report = run_row(&row);
    [report.trace.expect("a trace"), report.checked.expect("a twin").trace]
}

fn of_alarm(name: &str, mutations: usize) -> Trace {
    let alarm = alarms::all().into_iter().find(|alarm| alarm.name == name).expect("an alarm");
    let run = HistoryRun {
        name: name.into(),
        semantics: Arc::new(alarm.core(&MutationKind::ALL, &[A, B])),
        focus: 2,
        bound: Bound { replicas: 2, mutations },
        symmetry: false,
        second_engine: false,
    };
    let report = run.run(&Arc::new(Progress::new(Limits::default())));
    Trace::read(&report.traces.first().expect("a counterexample").json.to_string()).expect("a trace")
}

fn fates(answer: &Why, fate: Fate) -> Vec<&str> {
    answer.claims.iter().filter(|told| told.standing.fate == fate).map(|told| &*told.claim.text).collect()
}

/// Every attribute, vertex and edge that any replica shows after any step has one claim that is shown: made before
/// the first step, or in a step that its story names, and come here before.
/// `[spec: TRACE-7]`
#[test]
fn law_everything_shown_has_one_claim_that_is_shown() {
    let gallery = rows().into_iter().flat_map(|row| {
        let report = run_row(&row);
        [report.trace.expect("a trace"), report.checked.expect("a twin").trace]
    });
    let mut asked = 0;
    for trace in gallery.chain([of_alarm("last-delivered-wins", 1), of_alarm("resurrection", 1)]) {
        let graphs = trace.graphs().expect("a sound trace");
        for step in [0, trace.steps.len() / 2, trace.steps.len()] {
            for (replica, graph) in trace.replicas.iter().zip(&graphs[step]) {
                let ask = |element: &str| {
                    let answer = why(&trace, step, &replica.name, element);
                    answer.unwrap_or_else(|error| panic!("{element} at {}: {error}\n{trace}", replica.name))
                };
                for (id, element) in &graph.elements {
                    if id != "root" {
                        let answer = ask(id);
                        assert_eq!(fates(&answer, Fate::Shown).len(), 1, "{id}\n{answer}\n{trace}");
                        asked += 1;
                    }
                    for (name, value) in element.attributes().iter().filter(|(_, value)| *value != "empty") {
                        let answer = ask(&format!("{id}.{name}"));
                        let shown = fates(&answer, Fate::Shown);
                        let [shown] = shown[..] else { panic!("{id}.{name}\n{answer}\n{trace}") };
                        let told = format!("{name} = {value}");
                        assert!(shown == told || shown.starts_with(&format!("{told},")), "{shown} {told}");
                        asked += 1;
                        for told in &answer.claims {
                            let made = told.made_at.unwrap_or(0);
                            assert!(
                                made <= step && told.came.iter().all(|(at, _)| (made..=step).contains(at))
                            );
                            let is_here = told.standing.fate == Fate::Shown;
                            let came = made == 0 || !told.came.is_empty();
                            let is_own = told.made_by.as_ref() == Some(&replica.name);
                            assert!(!is_here || came || is_own, "{answer}\n{trace}");
                        }
                    }
                    assert!(matches!(element, Element::Vertex { .. } | Element::Edge { .. }));
                }
            }
        }
    }
    assert!(asked > 1500, "{asked}");
}

/// `[spec: TRACE-7]`
#[test]
fn oracle_a_write_that_a_joiner_drops() {
    let [published, checked] = row("15");
    let answer = why(&published, 8, "agent 3", "#1.x").expect("an answer");
    assert_eq!(fates(&answer, Fate::Shown), ["x = 2, of agent 1"]);
    assert_eq!(fates(&answer, Fate::Dropped), ["x = 3, of agent 1"]);
    let lost = answer.claims.iter().find(|told| told.standing.fate == Fate::Dropped).expect("a claim");
    assert_eq!((lost.made_at, lost.came.as_slice()), (Some(5), &[(7, "m3".to_owned())][..]));
    let answer = why(&checked, 8, "agent 3", "k.x").expect("an answer");
    assert_eq!((fates(&answer, Fate::Shown), fates(&answer, Fate::Gone)), (vec!["x = 3"], vec!["x = 2"]));
    let gone = answer.claims.iter().find(|told| told.standing.fate == Fate::Gone).expect("a claim");
    let ended = gone.ended.as_ref().expect("an end");
    assert_eq!((ended.step, ended.message.as_str(), gone.standing.clause), (5, "m3", "STATE-3"));
    // Before anything came: what was not known.
    let early = why(&checked, 4, "agent 3", "k.x").expect("an answer");
    assert_eq!((fates(&early, Fate::Shown), fates(&early, Fate::Waits)), (vec![], vec!["x = 2"]));
}

/// Of two concurrent placements the greater is shown, and the other is told to be beaten by it, or not to be held.
/// `[spec: TRACE-7]`
#[test]
fn oracle_what_a_claim_beat_is_told_with_the_clause() {
    let [_, checked] = row("21");
    let end = checked.steps.len();
    let graphs = checked.graphs().expect("a sound trace");
    let edges = graphs[end][0]
        .elements
        .iter()
        .filter(|(_, element)| matches!(element, Element::Edge { label, .. } if label == "RT"));
    let beaten: Vec<_> = edges
        .flat_map(|(id, _)| why(&checked, end, &checked.replicas[0].name, id).expect("an answer").claims)
        .filter(|told| told.standing.fate == Fate::Beaten)
        .collect();
    assert!(!beaten.is_empty(), "{checked}");
    for told in beaten {
        assert_eq!(told.standing.clause, "VIEW-3");
        assert!(told.standing.why.contains("is the greater claim on the kinematic parent"), "{told:?}");
    }
}

#[test]
fn law_what_cannot_be_answered_is_told() {
    let [trace, _] = row("2");
    let steps = trace.steps.len();
    assert_eq!(why(&trace, steps + 1, "agent 1", "#1"), Err(WhyError::NoStep { step: steps + 1, steps }));
    let nobody = WhyError::NoReplica { name: "r9".into(), known: "agent 1, agent 2".into() };
    assert_eq!(why(&trace, 1, "r9", "#1"), Err(nobody));
    let unknown = why(&trace, 1, "agent 1", "table").expect_err("no such element");
    assert!(
        matches!(&unknown, WhyError::Target(TargetError::Unknown { element, known })
        if element == "table" && known.contains("#1")),
        "{unknown}"
    );
    let nothing = why(&trace, 1, "agent 1", "#1.colour").expect_err("no such attribute");
    assert!(matches!(nothing, WhyError::Nothing { step: 1, .. }), "{nothing}");
    let mut torn = trace;
    torn.steps[0].state.push('0');
    assert!(matches!(why(&torn, 1, "agent 1", "#1"), Err(WhyError::Replay(_))));
}
