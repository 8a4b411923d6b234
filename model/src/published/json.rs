//! Replicas, messages and calls as JSON, for traces. Dots are written `register.counter`.

use super::context::Context;
use super::graph::{Attribute, AttributeRegisters, Edge, Node};
use super::message::Message;
use super::operation::Operation;
use super::register::Register;
use super::replica::Replica;
use super::{Key, Kind, NodeId};
use serde_json::{Map, Value, json};

fn object(entries: impl Iterator<Item = (String, Value)>) -> Value {
    Value::Object(entries.collect::<Map<_, _>>())
}

fn key((from, to, kind): (NodeId, NodeId, Kind)) -> String {
    format!("#{from} -{kind}-> #{to}")
}

fn context(context: &Context) -> Value {
    let counted = context.counters().map(|(id, n)| format!("1 to {id}.{n}"));
    let beyond = context.cloud().map(|dot| format!("{}.{}", dot.id, dot.n));
    counted.chain(beyond).collect()
}

fn register<T>(register: &Register<T>, value: impl Fn(&T) -> Value) -> Value {
    let values = register.values().iter().map(|(dot, held)| (format!("{}.{}", dot.id, dot.n), value(held)));
    json!({ "values": object(values), "seen": context(register.context()) })
}

fn attribute(attribute: &Attribute) -> Value {
    json!({ "value": attribute.value.to_string(), "agent": attribute.agent })
}

fn attributes(registers: &AttributeRegisters) -> Value {
    object(registers.iter().map(|(&key, held)| (key.to_owned(), register(held, attribute))))
}

fn edge(edge: &Edge) -> Value {
    json!({
        "edge": key((edge.from, edge.to, edge.kind)), "agent": edge.agent, "attributes": attributes(&edge.attributes),
    })
}

fn node(node: &Node) -> Value {
    let edges = node.edges.iter().map(|(&(to, kind), held)| (key((node.id, to, kind)), register(held, edge)));
    json!({
        "name": node.name.to_string(), "type": node.kind, "agent": node.agent,
        "attributes": attributes(&node.attributes), "edges": object(edges),
    })
}

impl Replica {
    /// Its whole state.
    pub fn json(&self) -> Value {
        let nodes = self.nodes.iter().map(|(id, held)| (format!("#{id}"), register(held, node)));
        let ids = self.ids.iter().map(|(name, id)| (name.to_string(), json!(id)));
        let names = self.names.iter().map(|(id, name)| (format!("#{id}"), json!(name.to_string())));
        let indexed = self.edges.iter().flat_map(|(&(from, to), kinds)| {
            kinds.iter().map(move |&kind| Value::from(key((from, to, kind))))
        });
        let copy = self.copy.as_ref().map(|copy| {
            let held = copy.attributes.iter().map(|(&key, held)| (key.to_owned(), attribute(held)));
            json!({ "node": copy.id, "name": copy.name.to_string(), "attributes": object(held) })
        });
        json!({
            "agent": self.agent,
            "nodes": object(nodes),
            "deleted": self.deleted,
            "index": { "ids": object(ids), "names": object(names), "edges": indexed.collect::<Vec<_>>() },
            "held back": self.held(),
            "ignored": self.ignored,
            "copy": copy,
            "stopped": self.crash.map(|crash| crash.to_string()),
        })
    }

    fn held(&self) -> Value {
        let buffers = &self.buffers;
        let entry = |what: String, delta: Value, time| json!({ "what": what, "delta": delta, "time": time });
        let nodes = buffers.node_attributes.iter().map(|((id, key), held)| {
            entry(format!("#{id}.{key}"), register(&held.delta, attribute), held.time)
        });
        let from = buffers
            .edges_from
            .iter()
            .map(|(&at, held)| entry(key(at), register(&held.delta, edge), held.time));
        let to = buffers.edges_to.iter().flat_map(|(&to, all)| {
            all.iter().map(move |(from, kind, held)| {
                entry(key((*from, to, kind)), register(&held.delta, edge), held.time)
            })
        });
        let attributes = buffers.edge_attributes.iter().map(|(&(from, to, kind, name), held)| {
            let what = format!("{}.{name}", key((from, to, kind)));
            entry(what, register(&held.delta, attribute), held.time)
        });
        nodes.chain(from).chain(to).chain(attributes).collect()
    }
}

impl Message {
    /// Its whole content.
    pub fn json(&self) -> Value {
        let part = |sender, what: String, delta| json!({ "sender": sender, "what": what, "delta": delta });
        match self {
            Self::Node { sender, time, id, delta } => json!({
                "topic": "nodes", "sender": sender, "time": time, "node": id, "delta": register(delta, node),
            }),
            Self::Edge { sender, time, from, to, kind, delta } => json!({
                "topic": "edges", "sender": sender, "time": time, "edge": key((*from, *to, kind)),
                "delta": register(delta, edge),
            }),
            Self::NodeAttributes { time, parts } => {
                let parts = parts.iter().map(|held| {
                    part(
                        held.sender,
                        format!("#{}.{}", held.node, held.key),
                        register(&held.delta, attribute),
                    )
                });
                json!({ "topic": "node attributes", "time": time, "parts": parts.collect::<Vec<_>>() })
            }
            Self::EdgeAttributes { time, parts } => {
                let parts = parts.iter().map(|held| {
                    let what = format!("{}.{}", key((held.from, held.to, held.kind)), held.key);
                    part(held.sender, what, register(&held.delta, attribute))
                });
                json!({ "topic": "edge attributes", "time": time, "parts": parts.collect::<Vec<_>>() })
            }
            Self::Graph { time, nodes } => {
                let nodes = nodes.iter().map(|(id, held)| (format!("#{id}"), register(held, node)));
                json!({ "topic": "graph", "time": time, "nodes": object(nodes) })
            }
        }
    }
}

impl Operation {
    /// The call.
    pub fn json(&self) -> Value {
        let numbers = |attributes: &[(Key, i64)]| -> Value {
            object(attributes.iter().map(|&(key, value)| (key.to_owned(), json!(value))))
        };
        match *self {
            Self::InsertNode { id, kind, name, attributes } => json!({
                "insert_node": { "id": id, "type": kind, "name": name, "attributes": numbers(attributes) },
            }),
            Self::Set { node, key, value } => json!({ "set": { "node": node, "key": key, "value": value } }),
            Self::Remove { node, key } => json!({ "remove": { "node": node, "key": key } }),
            Self::Get { node } => json!({ "get": { "node": node } }),
            Self::PutBack { key, value } => json!({ "put_back": { "key": key, "value": value } }),
            Self::DeleteNode { node } => json!({ "delete_node": { "node": node } }),
            Self::AssignEdge { from, to, kind, attributes } => json!({
                "assign_edge": { "from": from, "to": to, "type": kind, "attributes": numbers(attributes) },
            }),
            Self::DeleteEdge { from, to, kind } => {
                json!({ "delete_edge": { "from": from, "to": to, "type": kind } })
            }
            Self::Place { from, to, pose } => json!({ "place": { "from": from, "to": to, "pose": pose } }),
        }
    }
}
