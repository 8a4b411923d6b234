//! Steps in words.

use crate::case::{Encoded, Step};
use crate::protocol::{EdgeName, Mutation, Tagged, Unique};
use serde_json::Value;

/// What a step does or expects, in a line.
pub fn words(step: &Step) -> String {
    match step {
        Step::Mutate { mutations, r#as, .. } => {
            let to = r#as.as_ref().map(|name| format!("  → {name}")).unwrap_or_default();
            format!("{}{to}", group(mutations))
        }
        Step::Deliver { delta, .. } => format!("receives {delta}"),
        Step::Restart { keeps: true, .. } => "restarts with its state".into(),
        Step::Restart { keeps: false, .. } => "restarts without its state".into(),
        Step::Answer { to, r#as, .. } => format!("makes what {to} lacks  → {as}"),
        Step::Group { deltas, r#as } => format!("{} become one message  → {as}", deltas.join(", ")),
        Step::Load { r#as, .. } => format!("a state comes from outside, as JSON  → {as}"),
        Step::Decode { bytes, r#as } => {
            format!("{} bytes of a state come from outside  → {as}", bytes.0.len())
        }
        Step::AnswerDigest { bytes, r#as, .. } => {
            format!("answers a digest of {} bytes from outside  → {as}", bytes.0.len())
        }
        Step::Expect { .. } => "shows the view below".into(),
        Step::ExpectEqual { replicas } => format!("{} show the same", replicas.join(", ")),
        Step::ExpectRefused { mutations, kind, .. } => format!("is refused, {kind}: {}", group(mutations)),
        Step::ExpectVertex { name, vertex, .. } => {
            format!("the name {name:?} finds {}", vertex.as_deref().unwrap_or("nothing"))
        }
        Step::ExpectState { .. } => "has the state given".into(),
        Step::ExpectDelta { delta, .. } => format!("the delta {delta} is the one given"),
        Step::ExpectDigest { .. } => "has the digest given".into(),
        Step::ExpectBytes { of, bytes } => {
            let whose = match of {
                Encoded::Delta(delta) => format!("the delta {delta}"),
                Encoded::Digest(replica) => format!("the digest of {replica}"),
                Encoded::Fingerprint(replica) => format!("the fingerprint of {replica}"),
            };
            format!("{whose} has the {} bytes given", bytes.0.len())
        }
        Step::ExpectUnloadable { kind, .. } => {
            format!("a state as JSON is refused{}", of_kind(kind.as_ref()))
        }
        Step::ExpectUndecodable { bytes, kind } => {
            format!("{} bytes are refused{}", bytes.0.len(), of_kind(kind.as_ref()))
        }
        Step::ExpectUnanswerable { bytes, .. } => format!("{} bytes of a digest are refused", bytes.0.len()),
    }
}

fn of_kind(kind: Option<&String>) -> String {
    kind.map(|kind| format!(", {kind}")).unwrap_or_default()
}

fn group(mutations: &[Mutation]) -> String {
    if mutations.is_empty() {
        return "an empty group".into();
    }
    mutations.iter().map(mutation).collect::<Vec<_>>().join("; ")
}

fn mutation(mutation: &Mutation) -> String {
    match mutation {
        Mutation::AddVertex { r#as, r#type, name, attributes: given, link } => {
            let link = match (&link.from, &link.to) {
                (Some(from), _) => format!("{from} -{}-> {as}", link.label),
                (None, Some(to)) => format!("{as} -{}-> {to}", link.label),
                (None, None) => format!("-{}->", link.label),
            };
            format!("add {type} {name:?} by {link}{}", attributes(given))
        }
        Mutation::AddEdge { from, label, to, attributes: given } => {
            format!("add edge {from} -{label}-> {to}{}", attributes(given))
        }
        Mutation::UpdateAttributes { vertex, edge: named, attributes } => {
            let of = vertex.clone().or_else(|| named.as_ref().map(edge)).unwrap_or_else(|| "nothing".into());
            let set = attributes.0.iter().map(|(name, given)| match given {
                Some(given) => format!("{name} = {}", value(given)),
                None => format!("no {name}"),
            });
            format!("update {of}: {}", set.collect::<Vec<_>>().join(", "))
        }
        Mutation::RemoveEdge { from, label, to } => format!("remove edge {from} -{label}-> {to}"),
        Mutation::MoveEdge { old, new, attributes: given } => {
            format!("move edge {} to {}{}", edge(old), edge(new), attributes(given))
        }
        Mutation::RemoveVertex { vertex } => format!("remove vertex {vertex}"),
    }
}

fn edge(edge: &EdgeName) -> String {
    format!("{} -{}-> {}", edge.from, edge.label, edge.to)
}

/// ` with a = 1, b = 2`, or nothing.
pub(super) fn attributes(attributes: &Unique<Tagged>) -> String {
    if attributes.is_empty() {
        return String::new();
    }
    let pairs = attributes.0.iter().map(|(name, given)| format!("{name} = {}", value(given)));
    format!(" with {}", pairs.collect::<Vec<_>>().join(", "))
}

/// A value without its type, unless it is no scalar.
fn value(given: &Tagged) -> String {
    match serde_json::to_value(given) {
        Ok(Value::Object(members)) => members.get("value").map_or_else(String::new, ToString::to_string),
        Ok(other) => other.to_string(),
        Err(error) => error.to_string(),
    }
}
