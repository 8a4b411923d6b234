//! Traces that are made up.

use dsr_model::render::Target;
use dsr_model::trace::{Act, Trace, TraceBreach, TraceStep};
use serde_json::Value;
use std::collections::BTreeMap;

pub(crate) const TARGETS: [Target; 4] = [Target::Text, Target::Mermaid, Target::Svg, Target::Shiviz];

pub(crate) fn step(replica: &str, act: Act) -> TraceStep {
    TraceStep { replica: replica.into(), act, changes: vec!["+ a change".into()] }
}

pub(crate) fn mutate(message: &str, text: &str) -> Act {
    Act::Mutate { message: message.into(), text: text.into(), mutation: Value::Null, delta: Value::Null }
}

pub(crate) fn deliver(message: &str) -> Act {
    Act::Deliver { message: message.into() }
}

pub(crate) fn resynchronise(from: &str) -> Act {
    Act::Resynchronise { from: from.into(), delta: Value::Null }
}

pub(crate) fn made(replicas: &[&str], steps: Vec<TraceStep>) -> Trace {
    Trace {
        format: "dsr-trace".into(),
        version: 1,
        semantics: "made up".into(),
        layer: "L2".into(),
        replicas: replicas.iter().map(|name| (*name).into()).collect(),
        initial: Value::Null,
        steps,
        breach: TraceBreach { clause: "JOIN-5".into(), detail: "unequal".into(), states: Vec::new() },
    }
}

/// Two messages that cross, a copy that comes back, a restart, an answer and an observer.
pub(crate) fn crossing() -> Trace {
    made(
        &["r1", "r2", "observer 1"],
        vec![
            step("r1", mutate("m1", "one")),
            step("r2", mutate("m2", "two")),
            step("r1", deliver("m2")),
            step("r2", deliver("m1")),
            step("r1", Act::Restart),
            step("r1", deliver("m1")),
            step("observer 1", resynchronise("r1")),
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
