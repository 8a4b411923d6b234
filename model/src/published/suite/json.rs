//! States and deltas for people and traces.

use super::Held;
use crate::published::graph::{AttributeRegisters, Edge, Node, Value};
use crate::published::register::Register;
use crate::published::{AgentId, Attribute, Message, Operation, REGISTER_ID};
use serde_json::{Map, Value as Json, json};
use std::collections::BTreeSet;

/// What changed between two states: shown facts, and how much waits.
pub(super) fn changes(before: &Held, after: &Held) -> Vec<String> {
    let (old, new) = (before.facts(), after.facts());
    let gone = old.difference(&new).map(|fact| format!("- {fact}"));
    let come = new.difference(&old).map(|fact| format!("+ {fact}"));
    let (waited, waits) = (waiting(before), waiting(after));
    let held_back = waits.difference(&waited).map(|what| format!("held back: {what}"));
    let let_go = waited.difference(&waits).map(|what| format!("no longer held back: {what}"));
    gone.chain(come).chain(held_back).chain(let_go).collect()
}

/// What arrived before what it belongs to.
fn waiting(held: &Held) -> BTreeSet<String> {
    let buffers = &held.replica.buffers;
    let nodes = buffers.node_attributes.keys().map(|(node, key)| format!("#{node}.{key}"));
    let from = buffers.edges_from.keys().map(|(from, to, kind)| format!("#{from} -{kind}-> #{to}"));
    let to = buffers
        .edges_to
        .iter()
        .flat_map(|(to, held)| held.iter().map(move |(from, kind, _)| format!("#{from} -{kind}-> #{to}")));
    let edges =
        buffers.edge_attributes.keys().map(|(from, to, kind, key)| format!("#{from} -{kind}-> #{to}.{key}"));
    nodes.chain(from).chain(to).chain(edges).collect()
}

/// What users do not see, a line each: what waits, what is remembered as deleted, and what registers are made of.
pub(super) fn hidden(held: &Held) -> BTreeSet<String> {
    let replica = &held.replica;
    let mut lines: BTreeSet<String> =
        waiting(held).into_iter().map(|what| format!("{what} held back")).collect();
    lines.extend(replica.deleted.iter().map(|id| format!("#{id} deleted")));
    lines.extend(
        replica.edges.iter().map(|((from, to), kinds)| format!("#{from} -> #{to} indexed as {kinds:?}")),
    );
    for (id, register) in &replica.nodes {
        lines.insert(format!("#{id}: {}", made_of(register, |node| node.agent)));
        let Some(node) = register.value() else { continue };
        lines.extend(attribute_lines(&format!("#{id}"), &node.attributes));
        for ((to, kind), register) in &node.edges {
            let name = format!("#{id} -{kind}-> #{to}");
            lines.insert(format!("{name}: {}", made_of(register, |edge| edge.agent)));
            let attributes = register.value().map(|edge| attribute_lines(&name, &edge.attributes));
            lines.extend(attributes.unwrap_or_default());
        }
    }
    lines
}

fn attribute_lines(of: &str, registers: &AttributeRegisters) -> Vec<String> {
    let line = |(key, register): (&&str, &Register<Attribute>)| {
        format!("{of}.{key}: {}", made_of(register, |attribute| attribute.agent))
    };
    registers.iter().map(line).collect()
}

/// The dots of a register, whose they are, and the counters that it has seen.
fn made_of<T>(register: &Register<T>, agent: impl Fn(&T) -> AgentId) -> String {
    let values =
        register.values().iter().map(|(dot, held)| format!("dot {} of agent {}", dot.n, agent(held)));
    let values: Vec<String> = values.collect();
    let context = register.context();
    let beyond: Vec<u32> = context.cloud().map(|dot| dot.n).collect();
    let seen = context.counter(REGISTER_ID).unwrap_or(0);
    format!("{}, seen up to {seen} and {beyond:?}", values.join(" and "))
}

/// A state: the graph with the dots of its registers, what is remembered as deleted, and what waits.
pub(super) fn state(held: &Held) -> Json {
    let replica = &held.replica;
    json!({
        "clock": held.clock,
        "crash": replica.crash.map(|crash| crash.to_string()),
        "nodes": replica.nodes.iter().map(|(id, register)| {
            let mut node = register_json(register, node);
            node["id"] = (*id).into();
            node
        }).collect::<Json>(),
        "deleted": replica.deleted,
        "names": replica.ids.iter().map(|(name, id)| (name.to_string(), (*id).into())).collect::<Map<_, _>>(),
        "held_back": waiting(held),
    })
}

fn node(node: &Node) -> Map<String, Json> {
    let edges = node.edges.iter().map(|((to, kind), register)| {
        let mut edge = register_json(register, edge);
        (edge["to"], edge["type"]) = ((*to).into(), (*kind).into());
        edge
    });
    Map::from_iter([
        ("type".into(), node.kind.into()),
        ("name".into(), node.name.to_string().into()),
        ("agent".into(), node.agent.into()),
        ("attributes".into(), attributes(&node.attributes)),
        ("edges".into(), edges.collect()),
    ])
}

fn edge(edge: &Edge) -> Map<String, Json> {
    Map::from_iter([("agent".into(), edge.agent.into()), ("attributes".into(), attributes(&edge.attributes))])
}

fn attributes(registers: &AttributeRegisters) -> Json {
    let each =
        registers.iter().map(|(key, register)| ((*key).to_owned(), register_json(register, attribute)));
    Json::Object(each.collect())
}

fn attribute(attribute: &Attribute) -> Map<String, Json> {
    Map::from_iter([("value".into(), value(attribute.value)), ("agent".into(), attribute.agent.into())])
}

fn value(value: Value) -> Json {
    match value {
        Value::Number(number) => number.into(),
        Value::Node(node) => json!({ "node": node }),
    }
}

/// What a register holds, beside its dots and the counters that it has seen; `empty` where it holds nothing.
fn register_json<T>(register: &Register<T>, held: impl Fn(&T) -> Map<String, Json>) -> Json {
    let mut json = register.value().map(held).unwrap_or_default();
    if register.is_empty() {
        json.insert("empty".into(), true.into());
    }
    json.insert("dots".into(), register.values().keys().map(|dot| dot.n).collect::<Json>());
    let context = register.context();
    let seen = context.counter(REGISTER_ID).unwrap_or(0);
    json.insert("seen_up_to".into(), seen.into());
    let beyond: Vec<u32> = context.cloud().map(|dot| dot.n).collect();
    if !beyond.is_empty() {
        json.insert("seen_beyond".into(), beyond.into());
    }
    Json::Object(json)
}

/// A message: its topic, its time, and what it brings.
pub(super) fn message(message: &Message) -> Json {
    let mut json = match message {
        Message::Node { sender, id, delta, .. } => {
            json!({ "node": id, "sender": sender, "delta": register_json(delta, node) })
        }
        Message::NodeAttributes { parts, .. } => json!({ "node_attributes": parts.iter().map(|part| {
            json!({ "node": part.node, "key": part.key, "sender": part.sender,
                "delta": register_json(&part.delta, attribute) })
        }).collect::<Json>() }),
        Message::Edge { sender, from, to, kind, delta, .. } => json!({
            "edge": { "from": from, "to": to, "type": kind }, "sender": sender,
            "delta": register_json(delta, edge) }),
        Message::EdgeAttributes { parts, .. } => json!({ "edge_attributes": parts.iter().map(|part| {
            json!({ "from": part.from, "to": part.to, "type": part.kind, "key": part.key,
                "sender": part.sender, "delta": register_json(&part.delta, attribute) })
        }).collect::<Json>() }),
        Message::Graph { nodes, .. } => json!({ "graph": nodes.iter().map(|(id, register)| {
            let mut node = register_json(register, node);
            node["id"] = (*id).into();
            node
        }).collect::<Json>() }),
    };
    json["time"] = message.time().into();
    json
}

/// A call with its arguments.
pub(super) fn operation(operation: &Operation) -> Json {
    let attributes = |attributes: &[(&str, i64)]| {
        Json::Object(attributes.iter().map(|(key, value)| ((*key).to_owned(), (*value).into())).collect())
    };
    match *operation {
        Operation::InsertNode { id, kind, name, attributes: of } => {
            json!({ "insert_node": { "node": id, "type": kind, "name": name, "attributes": attributes(of) } })
        }
        Operation::Set { node, key, value } => {
            json!({ "set_attribute": { "node": node, "key": key, "value": value } })
        }
        Operation::Remove { node, key } => json!({ "remove_attribute": { "node": node, "key": key } }),
        Operation::Get { node } => json!({ "get_node": { "node": node } }),
        Operation::PutBack { key, value } => json!({ "put_back": { "key": key, "value": value } }),
        Operation::DeleteNode { node } => json!({ "delete_node": { "node": node } }),
        Operation::AssignEdge { from, to, kind, attributes: of } => json!({
            "insert_or_assign_edge": { "from": from, "to": to, "type": kind, "attributes": attributes(of) } }),
        Operation::DeleteEdge { from, to, kind } => {
            json!({ "delete_edge": { "from": from, "to": to, "type": kind } })
        }
        Operation::Place { from, to, pose } => json!({ "place": { "from": from, "to": to, "pose": pose } }),
    }
}
