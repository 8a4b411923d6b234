//! Whether a replica and the reference can be told apart. `[spec: REPLICA-1]`

use super::Fast;
use crate::semantics::Breach;
use dsr_core::{
    Changes, Delta, Dot, EdgeId, Mutated, MutationError, Shows, State, View, Write, delta_for, digest,
};
use std::collections::BTreeSet;
use std::fmt::Debug;

/// The same, or a breach of `clause` that says what differs and how.
fn same<T: PartialEq + Debug>(
    clause: &'static str,
    what: &str,
    found: &T,
    expected: &T,
) -> Result<(), Breach> {
    if found == expected {
        return Ok(());
    }
    let detail = format_args!("{what}: the replica has {found:?}, the reference {expected:?}");
    Err(Breach::new(clause, detail))
}

/// What a replica holds. `[property: REPLICA-1]`
pub(super) fn held(replica: &impl Fast, expected: &State) -> Result<(), Breach> {
    same("REPLICA-1", "state", &replica.graph().state(), expected)
}

/// All that a replica holds and shows. `[property: REPLICA-1]`
pub(super) fn shown(clause: &'static str, replica: &impl Fast, expected: &View<'_>) -> Result<(), Breach> {
    let (graph, state) = (replica.graph(), expected.state());
    same(clause, "state", &graph.state(), state)?;
    same(clause, "context", graph.context(), state.context())?;
    let shown = graph.shown(state);
    same(clause, "vertices", &shown.vertices(), &expected.vertices())?;
    same(clause, "edges", &shown.edges(), &expected.edges())?;
    same(clause, "writes", &shown.writes(), &expected.writes())?;
    same(clause, "repairs", &&*replica.repairs(), &expected.repairs())?;
    same(clause, "stranded vertices", &&*graph.stranded(), &expected.stranded())?;
    look_ups(clause, replica, expected)
}

/// What indexes answer.
fn look_ups(clause: &'static str, replica: &impl Fast, expected: &View<'_>) -> Result<(), Breach> {
    let graph = replica.graph();
    for &vertex in expected.vertices() {
        same(clause, "placement", &replica.placement(vertex), &expected.placement(vertex))?;
        let at = expected.edges().iter().filter(|shown| [shown.edge.from, shown.edge.to].contains(&vertex));
        let mut at: Vec<EdgeId> = at.map(|shown| shown.id).collect();
        at.sort_unstable();
        same(clause, "edges at a vertex", &replica.edges_at_vertex(vertex), &at)?;
        if let Some(record) = expected.vertex(vertex) {
            same(clause, "record", &graph.vertex(vertex).as_ref(), &Some(record))?;
            let is_found = graph.vertices_of_type(&record.vertex_type).any(|found| found == vertex);
            same(clause, "found by type", &is_found, &true)?;
        }
    }
    for shown in expected.edges() {
        same(clause, "edge by key", &graph.edge_by_key(&shown.edge.key()), &Some(shown.id))?;
        let is_found = graph.edges_of_label(&shown.edge.label).any(|found| found == shown.id);
        same(clause, "found by label", &is_found, &true)?;
    }
    Ok(())
}

/// What names and attributes are found, of all that is or was there: nothing is left of what has gone.
/// `[property: REPLICA-1]`
pub(super) fn found(replica: &impl Fast, before: &View<'_>, expected: &View<'_>) -> Result<(), Breach> {
    for view in [before, expected] {
        for vertex in view.vertices().iter().filter_map(|&id| view.vertex(id)) {
            let (found, sought) =
                (replica.vertex_by_name(&vertex.name), expected.vertex_by_name(&vertex.name));
            same("REPLICA-1", "vertex by name", &found, &sought)?;
        }
        let registers: BTreeSet<(Dot, &str)> =
            view.writes().iter().map(|(_, write)| (write.target, &*write.name)).collect();
        for (target, name) in registers {
            let found = replica.attribute_writes(target, name);
            let found: Vec<(Dot, &Write)> = found.iter().map(|(dot, write)| (*dot, write)).collect();
            same("REPLICA-1", "writes of an attribute", &&*found, &expected.attribute_writes(target, name))?;
        }
    }
    Ok(())
}

/// What a replica has told of a change. `[property: EVENT-1]`
pub(super) fn told(told: &Changes, before: &View<'_>, after: &View<'_>) -> Result<(), Breach> {
    let expected = Changes::between(before, after);
    if let Some(missed) = expected.iter().find(|change| told.iter().all(|told| told != *change)) {
        return Err(Breach::new("EVENT-1", format_args!("not told: {missed:?}")));
    }
    let spurious = told.iter().find(|told| expected.iter().all(|change| change != *told));
    if let Some(spurious) = spurious {
        return Err(Breach::new("EVENT-1", format_args!("told, though it is not so: {spurious:?}")));
    }
    same("EVENT-1", "changes", told, &expected)
}

/// The delta of a mutation, or why it is refused. `[property: REPLICA-1]`
pub(super) fn made(
    found: &Result<Mutated, MutationError>,
    expected: &Result<Delta, MutationError>,
) -> Result<(), Breach> {
    same("REPLICA-1", "mutation", &found.as_ref().map(|made| &made.delta), &expected.as_ref())
}

/// What a replica answers to those who have seen something else. `[property: REPLICA-1]`
pub(super) fn answers(replica: &impl Fast, state: &State, others: &State) -> Result<(), Breach> {
    let (ours, theirs) = (digest(state), digest(others));
    same("REPLICA-1", "digest", &replica.graph().digest(), &ours)?;
    same("REPLICA-1", "answer to a digest", &replica.delta_for(&theirs), &delta_for(state, &theirs))
}
