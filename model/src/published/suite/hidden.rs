//! What users do not see of a replica, for people.

use super::Held;
use crate::published::graph::AttributeRegisters;
use crate::published::register::Register;
use crate::published::{AgentId, Attribute, REGISTER_ID};
use std::collections::BTreeSet;

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
