//! An adapter for the conformance cases, to start from: `cargo build`, then `dsr conform run -- target/debug/my-adapter`.
//!
//! `graph.rs` is a small implementation: the last version of a vertex or edge wins. Put your own in its place; this file speaks
//! the protocol (spec/conformance.md), profile `observe`, and can stay. While replicas take turns the cases pass. Then they find
//! the graph wanting, and rightly so: of two writes on one vertex it loses one, and two moves can close a cycle.

mod graph;

use graph::{Delta, Graph};
use serde_json::{json, Map, Value};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead, Write};

/// Why a request is not done: a code and a message.
struct Declined(&'static str, String);

fn rejected(message: impl Into<String>) -> Declined {
    Declined("rejected_input", message.into())
}

const COMMANDS: [&str; 5] = ["hello", "case_begin", "mutate", "deliver", "read"];
const MUTATIONS: [&str; 6] =
    ["add_vertex", "add_edge", "update_attributes", "remove_edge", "move_edge", "remove_vertex"];
const PARTS: [&str; 4] = ["link", "edge", "old", "new"];

/// The members of an object: `?` may be missing, of `a|b` exactly one is there.
fn members(name: &str) -> &'static str {
    match name {
        "hello" => "protocols spec corpus",
        "case_begin" => "case replicas",
        "mutate" => "replica mutations",
        "deliver" => "replica delta",
        "read" => "replica",
        "add_vertex" => "as type name link attributes?",
        "add_edge" => "from label to attributes?",
        "update_attributes" => "vertex|edge attributes",
        "move_edge" => "old new attributes?",
        "remove_vertex" => "vertex",
        "link" => "from|to label attributes?",
        _ => "from label to",
    }
}

fn shape(name: &str, given: &Value) -> Result<(), Declined> {
    let wanted = members(name);
    let wrong = || rejected(format!("{name} is not {{{wanted}}}"));
    let given = given.as_object().ok_or_else(wrong)?;
    let mut known = BTreeSet::new();
    for part in wanted.split(' ') {
        let names: Vec<&str> = part.trim_end_matches('?').split('|').collect();
        let count = names.iter().filter(|name| given.contains_key(**name)).count();
        if count > 1 || (count == 0 && !part.ends_with('?')) {
            return Err(wrong());
        }
        known.extend(names);
    }
    for (name, value) in given {
        let is_part = PARTS.contains(&name.as_str());
        let is_right = match name.as_str() {
            "protocols" | "replicas" | "mutations" => value.is_array(),
            name => if is_part || name == "attributes" { value.is_object() } else { value.is_string() },
        };
        if !is_right || !known.contains(name.as_str()) {
            return Err(wrong());
        }
        if is_part {
            shape(name, value)?;
        }
    }
    Ok(())
}

/// The name and the value of an object's one member.
fn only<'v>(names: &[&str], given: &'v Value, code: &'static str) -> Result<(&'v str, &'v Value), Declined> {
    let mut pairs = given.as_object().into_iter().flatten();
    let (Some((name, value)), None) = (pairs.next(), pairs.next()) else {
        return Err(rejected("not an object with one member"));
    };
    if !names.contains(&name.as_str()) {
        return Err(Declined(code, format!("{name:?} is not known")));
    }
    shape(name, value)?;
    Ok((name, value))
}

fn known<'n, T>(named: &'n mut BTreeMap<String, T>, name: &Value) -> Result<&'n mut T, Declined> {
    let text = name.as_str().unwrap_or_default();
    named.get_mut(text).ok_or_else(|| Declined("unknown", format!("nobody has named {name}")))
}

/// Has all replicas of a case, its deltas, and the handles that are bound.
#[derive(Default)]
struct Adapter {
    replicas: BTreeMap<String, Graph>,
    deltas: BTreeMap<String, Delta>,
    handles: BTreeSet<String>,
}

impl Adapter {
    fn answer(&mut self, request: &Map<String, Value>) -> Result<Value, Declined> {
        let asked = request.get("do").filter(|_| request.len() == 2);
        let asked = asked.ok_or_else(|| rejected("not {id, do}"))?;
        let (command, given) = only(&COMMANDS, asked, "unsupported")?;
        match command {
            "hello" => Self::hello(given),
            "case_begin" => self.case_begin(given),
            "mutate" => self.mutate(given),
            "deliver" => {
                let delta = known(&mut self.deltas, &given["delta"])?.clone();
                known(&mut self.replicas, &given["replica"])?.join(&delta);
                Ok(json!({}))
            }
            _ => Ok(json!({"view": known(&mut self.replicas, &given["replica"])?.view()})),
        }
    }

    fn hello(given: &Value) -> Result<Value, Declined> {
        if !given["protocols"].as_array().is_some_and(|offered| offered.contains(&json!(1))) {
            return Err(Declined("unsupported", "this adapter speaks protocol 1".into()));
        }
        let about =
            json!({"name": "my graph", "version": "0.1.0", "language": "Rust", "source": "src/graph.rs"});
        Ok(json!({
            "protocol": 1,
            "implementation": about,
            "profiles": ["observe"],
            "features": [],
            "limits": {"line_bytes": 1 << 20, "replicas": 64},
        }))
    }

    fn case_begin(&mut self, given: &Value) -> Result<Value, Declined> {
        *self = Self::default();
        self.handles.insert("root".into());
        for (number, name) in given["replicas"].as_array().into_iter().flatten().enumerate() {
            let name = name.as_str().ok_or_else(|| rejected("a replica's name is a text"))?;
            self.replicas.insert(name.into(), Graph::new(number));
        }
        Ok(json!({}))
    }

    fn mutate(&mut self, given: &Value) -> Result<Value, Declined> {
        let mut bound = self.handles.clone();
        let mut group = Vec::new();
        for mutation in given["mutations"].as_array().into_iter().flatten() {
            let (name, given) = only(&MUTATIONS, mutation, "rejected_input")?;
            for part in PARTS.iter().map(|part| &given[*part]).chain([given]) {
                for handle in ["from", "to", "vertex"].iter().filter_map(|end| part[*end].as_str()) {
                    if !bound.contains(handle) {
                        return Err(Declined("unknown", format!("no vertex has the handle {handle:?}")));
                    }
                }
            }
            if let Some(handle) = given["as"].as_str() {
                if !bound.insert(handle.into()) {
                    return Err(rejected(format!("the handle {handle:?} is bound already")));
                }
            }
            group.push((name, given));
        }
        let made = known(&mut self.replicas, &given["replica"])?.mutate(&group);
        let delta = made.map_err(|why| Declined("refused", why))?;
        self.handles = bound;
        let name = format!("d{}", self.deltas.len());
        self.deltas.insert(name.clone(), delta);
        Ok(json!({"delta": name}))
    }
}

/// Whether no object names a key twice: each member has one colon outside of texts, and a key that stands twice is read once.
fn names_each_key_once(text: &str, read: &Value) -> bool {
    fn count(value: &Value) -> usize {
        match value {
            Value::Object(members) => members.values().map(|value| 1 + count(value)).sum(),
            Value::Array(items) => items.iter().map(count).sum(),
            _ => 0,
        }
    }
    let (mut colons, mut in_text, mut escaped) = (0, false, false);
    for byte in text.bytes() {
        match byte {
            _ if escaped => escaped = false,
            b'\\' if in_text => escaped = true,
            b'"' => in_text = !in_text,
            b':' if !in_text => colons += 1,
            _ => {}
        }
    }
    colons == count(read)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut adapter = Adapter::default();
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        // What is no request and has no id ends the conversation.
        let read: Value = serde_json::from_str(&line)?;
        let request = read.as_object().ok_or("a request is an object")?;
        let id = request.get("id").and_then(Value::as_u64).ok_or("a request has an id")?;
        let answer = if names_each_key_once(&line, &read) {
            adapter.answer(request)
        } else {
            Err(rejected("a key stands twice"))
        };
        let reply = match answer {
            Ok(answer) => json!({"id": id, "ok": answer}),
            Err(Declined(code, message)) => json!({"id": id, "error": {"code": code, "message": message}}),
        };
        let mut out = std::io::stdout().lock();
        writeln!(out, "{reply}")?;
        out.flush()?;
    }
    Ok(())
}
