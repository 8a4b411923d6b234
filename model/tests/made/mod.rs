//! Traces that are made up.

use dsr_model::graph::{Change, Graph};
use dsr_model::render::Target;
use dsr_model::trace::{Act, Finding, FindingKind, Sent, Trace, TraceReplica, TraceStep};
use serde_json::Value;
use std::collections::BTreeMap;

pub(crate) const TARGETS: [Target; 4] = [Target::Text, Target::Mermaid, Target::Svg, Target::Shiviz];

pub(crate) fn step(replica: &str, does: Act) -> TraceStep {
    TraceStep { replica: replica.into(), does, changes: Vec::new(), state: String::new() }
}

fn sent(message: &str) -> Vec<Sent> {
    vec![Sent { message: message.into(), text: String::new(), delta: Value::Null }]
}

pub(crate) fn mutate(message: &str, text: &str) -> Act {
    Act::Mutate { text: text.into(), mutations: Vec::new(), sends: sent(message) }
}

pub(crate) fn deliver(message: &str) -> Act {
    Act::Deliver { message: message.into(), again: false }
}

pub(crate) fn lose(message: &str) -> Act {
    Act::Lose { message: message.into() }
}

pub(crate) fn answer(to: &str, message: &str) -> Act {
    Act::Answer { to: to.into(), sends: sent(message) }
}

pub(crate) const RESTART: Act = Act::Restart { keeps: true };

/// Each step brings a remark of its own.
pub(crate) fn made(replicas: &[&str], mut steps: Vec<TraceStep>) -> Trace {
    for (at, step) in steps.iter_mut().enumerate() {
        step.changes = vec![Change::Remark { remark: format!("change {}", at + 1), holds: true }];
    }
    let replica = |(index, name): (usize, &&str)| TraceReplica {
        name: (*name).into(),
        index,
        starts: Graph::default(),
        state: None,
    };
    Trace {
        format: "dsr-trace".into(),
        version: 2,
        title: "crossing messages".into(),
        semantics: "made up".into(),
        setup: Value::Null,
        layer: "L2".into(),
        bound: "none".into(),
        replicas: replicas.iter().enumerate().map(replica).collect(),
        steps,
        finding: Finding {
            kind: FindingKind::Broken,
            clause: "JOIN-5".into(),
            what: "all are equal".into(),
            detail: "unequal".into(),
            replicas: Vec::new(),
        },
    }
}

/// Two messages that cross, a copy that comes back, a loss, a restart, an answer and an observer.
pub(crate) fn crossing() -> Trace {
    made(
        &["r1", "r2", "observer 1"],
        vec![
            step("r1", mutate("m1", "one")),
            step("r2", mutate("m2", "two")),
            step("r1", deliver("m2")),
            step("r2", deliver("m1")),
            step("r1", RESTART),
            step("r1", deliver("m1")),
            step("observer 1", lose("m2")),
            step("r1", answer("observer 1", "m3")),
            step("observer 1", Act::Happen { text: "waits".into() }),
            step("observer 1", deliver("m3")),
        ],
    )
}

/// Events and clocks of a log, read as `ShiViz` reads it.
pub(crate) fn read_log(log: &str) -> Vec<(String, String, BTreeMap<String, u64>)> {
    let lines: Vec<&str> = log.lines().collect();
    assert_eq!(lines.len() % 2, 0, "{log}");
    let entry = |pair: &[&str]| {
        let (host, clock) = pair[1].split_once(' ').expect("a host and its clock");
        (pair[0].to_owned(), host.to_owned(), serde_json::from_str(clock).expect("a clock"))
    };
    lines.chunks(2).map(entry).collect()
}
