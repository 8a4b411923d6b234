//! Judges what is shown: the invariants, and who wins, from the records alone. It shares no code with the
//! core's view nor with the core's own checks, and the sound core passes it as well.

use super::shown::Shown;
use crate::semantics::Breach;
use dsr_core::{Dictionary, Edge, EdgeId, Record, State, VertexId};
use std::collections::{BTreeMap, BTreeSet};

/// Every clause that holds of what one replica shows.
pub(super) fn judge_shown(shown: &Shown, state: &State, dictionary: &Dictionary) -> Result<(), Breach> {
    check_ends(shown)?;
    check_tree(shown)?;
    check_paths(shown)?;
    check_registers(shown, dictionary)?;
    check_all_accounted(shown, state)?;
    check_names(shown, state)?;
    check_attributes(shown, state)
}

/// `[property: INV-2]` `[property: INV-4]`
fn check_ends(shown: &Shown) -> Result<(), Breach> {
    for (id, edge) in &shown.edges {
        if !shown.vertices.contains(&edge.from) || !shown.vertices.contains(&edge.to) {
            return Err(Breach::new("INV-2", format_args!("an end of edge {id} is not in the graph")));
        }
        if edge.from == edge.to {
            return Err(Breach::new("INV-4", format_args!("edge {id} joins {} to itself", edge.to)));
        }
    }
    Ok(())
}

/// `[property: INV-3]`
fn check_tree(shown: &Shown) -> Result<(), Breach> {
    let kinematic = || shown.edges.iter().filter(|(_, edge)| edge.is_rt());
    let mut parents = BTreeMap::new();
    for (id, edge) in kinematic() {
        if parents.insert(edge.to, edge.from).is_some() {
            return Err(Breach::new("INV-3", format_args!("{id} gives {} a second parent", edge.to)));
        }
    }
    for (_, edge) in kinematic() {
        let mut at = edge.from;
        let mut steps = 0;
        while let Some(&parent) = parents.get(&at) {
            at = parent;
            steps += 1;
            if steps > shown.vertices.len() {
                return Err(Breach::new("INV-3", format_args!("{} is below itself", edge.to)));
            }
        }
        if !at.is_root() && !shown.hung.contains(&at) {
            return Err(Breach::new(
                "INV-3",
                format_args!("the tree of {} does not end at the root", edge.to),
            ));
        }
    }
    Ok(())
}

/// `[property: INV-1]`
fn check_paths(shown: &Shown) -> Result<(), Breach> {
    let mut reached: BTreeSet<VertexId> = shown.hung.iter().copied().chain([VertexId::ROOT]).collect();
    loop {
        let before = reached.len();
        for edge in shown.edges.values() {
            if reached.contains(&edge.from) || reached.contains(&edge.to) {
                reached.extend([edge.from, edge.to]);
            }
        }
        if reached.len() == before {
            break;
        }
    }
    match shown.vertices.difference(&reached).next() {
        Some(vertex) => Err(Breach::new("INV-1", format_args!("{vertex} has no path to the root"))),
        None => Ok(()),
    }
}

/// `[property: INV-6]`
fn check_registers(shown: &Shown, dictionary: &Dictionary) -> Result<(), Breach> {
    let mut seen = BTreeSet::new();
    for (id, Edge { from, to, label, .. }) in &shown.edges {
        let target = (!dictionary.is_functional(label)).then_some(*to);
        if !seen.insert((*from, label, target)) {
            return Err(Breach::new("INV-6", format_args!("{id} is a second edge {label:?} of {from}")));
        }
    }
    Ok(())
}

/// Every edge between vertices of the graph is shown or reported. `[property: VIEW-9]`
fn check_all_accounted(shown: &Shown, state: &State) -> Result<(), Breach> {
    for (dot, record) in state.records() {
        let Record::Edge(edge) = record else { continue };
        let visible = shown.vertices.contains(&edge.from) && shown.vertices.contains(&edge.to);
        let id = EdgeId(dot);
        if visible && !shown.edges.contains_key(&id) && !shown.hidden.contains(&id) {
            return Err(Breach::new("VIEW-9", format_args!("{id} is neither shown nor reported")));
        }
    }
    Ok(())
}

/// A name finds the least claim on it. `[property: VIEW-7]`
fn check_names(shown: &Shown, state: &State) -> Result<(), Breach> {
    let mut least = BTreeMap::new();
    for vertex in &shown.vertices {
        if let (Some(record), Some(rank)) = (state.vertex(vertex.0), state.rank(vertex.0)) {
            let known = least.entry(record.name.clone()).or_insert((rank, *vertex));
            *known = (*known).min((rank, *vertex));
        }
    }
    for (name, (_, vertex)) in least {
        let found = shown.names.get(&name);
        if found != Some(&vertex) {
            return Err(Breach::new(
                "VIEW-7",
                format_args!("{name:?} does not find {vertex}, the oldest of that name"),
            ));
        }
    }
    Ok(())
}

/// The shown write is the greatest of its register. `[property: VIEW-8]`
fn check_attributes(shown: &Shown, state: &State) -> Result<(), Breach> {
    for ((target, name), winner) in &shown.attributes {
        for (dot, record) in state.records() {
            let Record::Write(write) = record else { continue };
            if write.target == *target && write.name == *name && state.rank(dot) > state.rank(*winner) {
                return Err(Breach::new(
                    "VIEW-8",
                    format_args!("{winner} is shown, but {dot} is the greater write"),
                ));
            }
        }
    }
    Ok(())
}
