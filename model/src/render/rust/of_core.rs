//! A test of `dsr-core` that does what the replicas of a trace do. `[spec: TRACE-8]`

use super::{comment, raw, test_name};
use crate::checked::replica_id;
use crate::graph::{Element, Graph};
use crate::render::words::add;
use crate::trace::{Act, FindingKind, Sent, Trace, TraceStep};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// The replica of the test, the same for every test.
const SUPPORT: &str = include_str!("core_support.txt");

/// `None` if the trace is not one of the core.
pub(super) fn of_core(trace: &Trace) -> Option<String> {
    if trace.semantics != "checked" {
        return None;
    }
    let (dictionary, initial) = (trace.setup.get("dictionary")?, trace.setup.get("initial")?);
    let names = variables(trace);
    let mut text = format!("// {}\n", comment(&trace.title));
    text += "// A test of a crate that depends on `dsr-core` (features `std` and `serde`) and on `serde_json`.\n\n\
             use dsr_core::{\n    Author, Delta, Dictionary, EdgeId, Mutation, ReplicaId, State, VertexId, delta_for, digest, view,\n};\n\
             use std::collections::BTreeSet;\n\n#[test]\n";
    add(&mut text, format_args!("fn {}() {{\n", test_name(trace)));
    for replica in &trace.replicas {
        let name = names.get(&*replica.name)?;
        let agent = replica_id(replica.index).agent;
        let start = match &replica.state {
            Some(state) => raw(&state.to_string()),
            None => "START".into(),
        };
        let is_changed = trace.steps.iter().any(|step| step.replica == replica.name && acts(&step.does));
        let binding = if is_changed { "mut " } else { "" };
        add(&mut text, format_args!("    let {binding}{name} = Replica::new({agent}, {start});\n"));
    }
    let mut graphs: Vec<Graph> = trace.replicas.iter().map(|replica| replica.starts.clone()).collect();
    for (at, step) in trace.steps.iter().enumerate() {
        let position = trace.replicas.iter().position(|replica| replica.name == step.replica)?;
        let before = facts(&graphs[position]);
        step.changes.iter().try_for_each(|change| graphs[position].change(change)).ok()?;
        let after = facts(&graphs[position]);
        let line = comment(&format!("{}: {}", step.replica, step.does));
        add(&mut text, format_args!("    // {}. {line}\n", at + 1));
        let arrives = |message: &str| {
            trace
                .steps
                .iter()
                .any(|step| matches!(&step.does, Act::Deliver { message: m, .. } if m == message))
        };
        let who = names.get(&*step.replica)?;
        add(&mut text, call(step, who, &names, &changes(&before, &after), &arrives)?);
    }
    let finding = &trace.finding;
    add(&mut text, format_args!("    // {} {}\n", finding.kind.sign(), comment(&finding.to_string())));
    if finding.kind == FindingKind::Holds {
        let mut others = trace.replicas.iter().skip(1);
        let first = names.get(&*trace.replicas.first()?.name)?;
        others.try_for_each(|other| {
            let other = names.get(&*other.name)?;
            writeln!(text, "    assert_eq!({first}.state, {other}.state);").ok()
        })?;
    }
    text += "}\n\n";
    add(&mut text, format_args!("const DICTIONARY: &str = {};\n", raw(&dictionary.to_string())));
    if trace.replicas.iter().any(|replica| replica.state.is_none()) {
        add(&mut text, format_args!("const START: &str = {};\n", raw(&initial.to_string())));
    }
    Some(text + SUPPORT)
}

fn acts(does: &Act) -> bool {
    matches!(does, Act::Mutate { .. } | Act::Deliver { .. } | Act::Restart { .. })
}

/// Names of variables for replicas: letters, digits and underscores, each its own.
fn variables(trace: &Trace) -> BTreeMap<&str, String> {
    let mut names: BTreeMap<&str, String> = BTreeMap::new();
    for (at, replica) in trace.replicas.iter().enumerate() {
        let plain =
            |letter: char| if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { '_' };
        let mut name: String = replica.name.chars().map(plain).collect();
        let is_word = name.starts_with(|letter: char| letter.is_ascii_alphabetic()) && name.len() > 1;
        if !is_word || names.values().any(|known| *known == name) {
            name = format!("replica_{}", at + 1);
        }
        names.insert(&replica.name, name);
    }
    names
}

fn call(
    step: &TraceStep,
    who: &str,
    names: &BTreeMap<&str, String>,
    changes: &str,
    arrives: &dyn Fn(&str) -> bool,
) -> Option<String> {
    // What nobody gets needs no name.
    let name = |sent: &Sent| if arrives(&sent.message) { sent.message.clone() } else { "_".into() };
    Some(match &step.does {
        Act::Mutate { mutations, sends, .. } => {
            let made: Vec<String> = mutations.iter().map(|made: &Value| raw(&made.to_string())).collect();
            let made = made.join(", ");
            match &sends[..] {
                [sent] => format!("    let {} = {who}.mutate(&[{made}], {changes});\n", name(sent)),
                _ => format!("    {who}.mutate(&[{made}], {changes});\n"),
            }
        }
        Act::Deliver { message, .. } => format!("    {who}.receive(&{message}, {changes});\n"),
        Act::Restart { keeps } => format!("    {who}.restart({keeps}, {changes});\n"),
        Act::Answer { to, sends } => {
            let [sent] = &sends[..] else { return None };
            format!("    let {} = {who}.answer(&{});\n", name(sent), names.get(&**to)?)
        }
        Act::Lose { .. } | Act::Happen { .. } => String::new(),
    })
}

/// What a graph shows, a line for each fact, as the test's own replica tells it.
fn facts(graph: &Graph) -> BTreeSet<String> {
    let mut facts: BTreeSet<String> = graph.remarks.clone();
    for (id, element) in &graph.elements {
        facts.insert(match element {
            Element::Vertex { name, vertex_type, .. } => format!("vertex {id} {name} ({vertex_type})"),
            Element::Edge { from, to, label, .. } => format!("edge {id} {from} -{label}-> {to}"),
        });
        let attributes = element.attributes().iter();
        facts.extend(attributes.map(|(name, value)| format!("{id}.{name} = {value}")));
    }
    facts
}

fn changes(before: &BTreeSet<String>, after: &BTreeSet<String>) -> String {
    let gone = before.difference(after).map(|fact| format!("- {fact}"));
    let come = after.difference(before).map(|fact| format!("+ {fact}"));
    let lines: Vec<String> = gone.chain(come).map(|line| format!("{line:?}")).collect();
    match lines.len() {
        0 => "&[]".into(),
        1 => format!("&[{}]", lines[0]),
        _ => format!("&[\n        {},\n    ]", lines.join(",\n        ")),
    }
}
