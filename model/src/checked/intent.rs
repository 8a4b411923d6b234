//! Intent: a local mutation shows its effect, and the effect stays until something that beats it by the
//! conflict table is delivered. `[spec: INTENT-1]` `[spec: INTENT-2]` `[spec: INTENT-3]`

use super::Sight;
use crate::semantics::Breach;
use dsr_core::{
    Delta, Dot, Edge, EdgeId, EdgeKey, Mutation, Placement, RT, Record, Repair, Rule, Run, State, VertexId,
    invariant,
};

/// The effect of a mutation is shown by its author at once; the delta brings the author to its own state,
/// adds, and strands nobody. `[property: INTENT-1]` `[property: MUT-0]` `[property: JOIN-4]`
pub(crate) fn check_step(
    before: &impl Sight,
    mutation: &Mutation,
    delta: &Delta,
    after: &impl Sight,
) -> Result<(), Breach> {
    let state = before.state();
    if state.joined(delta) != *after.state() {
        return Err(Breach::new("MUT-0", "the author's state is not its old state joined with the delta"));
    }
    if !state.is_below(after.state()) {
        return Err(Breach::new("JOIN-4", "the author's new state does not include its old one"));
    }
    check_fresh(state, delta)?;
    check_speaks_of(state, delta)?;
    check_effect(after, mutation, delta)?;
    // What is added to a stranded vertex shares its lot; what was there before must not come to it.
    let (was, is) = (before.stranded(), after.stranded());
    let newly = is.iter().find(|&&vertex| before.has_vertex(vertex) && !was.contains(&vertex));
    match newly {
        Some(vertex) => Err(Breach::new("MUT-4.2", format_args!("{vertex} is stranded by a local mutation"))),
        None => check_unrepaired(before, after),
    }
}

/// A local mutation breaks nothing by itself: who saw no repair before sees none after it.
/// `[property: VIEW-12]`
fn check_unrepaired(before: &impl Sight, after: &impl Sight) -> Result<(), Breach> {
    match after.repairs() {
        [repair, ..] if before.repairs().is_empty() => {
            Err(Breach::new("VIEW-12", format_args!("after a local mutation: {repair}")))
        }
        _ => Ok(()),
    }
}

/// A delta speaks of the dots that it makes and of dots that its author held, of no others.
/// `[property: MUT-0.1]`
fn check_speaks_of(before: &State, delta: &State) -> Result<(), Breach> {
    let foreign = |dot: &Dot| !delta.holds(*dot) && !before.holds(*dot);
    match delta.context().runs().flat_map(Run::dots).find(foreign) {
        Some(dot) => {
            let detail = format_args!("the delta speaks of {dot}, which its author did not hold");
            Err(Breach::new("MUT-0.1", detail))
        }
        None => Ok(()),
    }
}

/// New dots are new, and rank above everything held. `[property: ID-3]` `[property: STAMP-1]`
fn check_fresh(before: &State, delta: &State) -> Result<(), Breach> {
    for (dot, record) in delta.records() {
        if before.context().contains(dot) {
            return Err(Breach::new("ID-3", format_args!("dot {dot} is used twice")));
        }
        if record.stamp() <= before.greatest_stamp() {
            return Err(Breach::new("STAMP-1", format_args!("{dot} does not outrank what its author held")));
        }
    }
    Ok(())
}

fn check_effect(after: &impl Sight, mutation: &Mutation, delta: &State) -> Result<(), Breach> {
    let shown = match mutation {
        Mutation::AddVertex { vertex, .. } => {
            let new =
                delta.records().find(|(dot, _)| delta.vertex(*dot).is_some()).map(|(dot, _)| VertexId(dot));
            after.vertex_by_name(&vertex.name) == new && new.is_some() && shows_new_edges(after, delta)
        }
        Mutation::AddEdge { .. } => shows_new_edges(after, delta),
        Mutation::RemoveEdge { key } => !shows_register(after, key),
        Mutation::MoveEdge { from, .. } => shows_new_edges(after, delta) && after.edge_by_key(from).is_none(),
        Mutation::RemoveVertex { vertex } => !after.has_vertex(*vertex),
        Mutation::UpdateAttributes { target, updates } => updates.iter().all(|(name, value)| {
            let shown = after.attribute_writes(*target, name);
            match value {
                Some(value) => shown.len() == 1 && shown[0].1.value == *value,
                None => shown.is_empty(),
            }
        }),
    };
    if shown { Ok(()) } else { Err(Breach::new("INTENT-1", "the author's view does not show the effect")) }
}

fn shows_new_edges(after: &impl Sight, delta: &State) -> bool {
    let mut edges = delta.records().filter(|(_, record)| matches!(record, Record::Edge(_)));
    edges.all(|(dot, _)| after.shows_edge(EdgeId(dot)))
}

/// Whether a register still shows an edge: no loser may come back when the winner is removed by hand.
fn shows_register(after: &impl Sight, key: &EdgeKey) -> bool {
    if &*key.label == RT {
        return matches!(after.placement(key.to), Some(Placement::Child { .. }));
    }
    if after.dictionary().is_functional(&key.label) {
        return after.edges_from(key.from).iter().any(|shown| shown.edge.label == key.label);
    }
    after.edge_by_key(key).is_some()
}

/// A held claim is hidden only by greater ones: by one shown on its register, or by a way of greater
/// kinematic claims that it would close to a cycle. `[property: INTENT-2]`
pub(crate) fn check_hidden_are_outranked(view: &impl Sight) -> Result<(), Breach> {
    for repair in view.repairs() {
        match repair {
            Repair::Superseded { hidden, shown, rule } => check_superseded(view, *hidden, *shown, *rule)?,
            Repair::CycleBroken { hidden } => check_cycle(view, *hidden)?,
            _ => {}
        }
    }
    let hidden = view
        .repairs()
        .iter()
        .filter(|repair| matches!(repair, Repair::Superseded { .. } | Repair::CycleBroken { .. }));
    let visible = view.state().records().filter(|(_, record)| match record {
        Record::Edge(edge) => view.has_vertex(edge.from) && view.has_vertex(edge.to),
        _ => false,
    });
    if view.edges().len() + hidden.count() != visible.count() {
        return Err(Breach::new("INTENT-2", "an edge claim is neither shown nor reported as hidden"));
    }
    Ok(())
}

fn check_superseded(view: &impl Sight, hidden: EdgeId, shown: EdgeId, rule: Rule) -> Result<(), Breach> {
    let state = view.state();
    let outranked = state.rank(hidden.0) < state.rank(shown.0);
    let (Some(loser), Some(winner)) = (state.edge(hidden.0), state.edge(shown.0)) else {
        return Err(Breach::new("INTENT-2", format_args!("{hidden} or {shown} is not held")));
    };
    let competes = match rule {
        Rule::RtParent => loser.is_rt() && winner.is_rt() && loser.to == winner.to,
        Rule::Functional => loser.label == winner.label && loser.from == winner.from,
        Rule::SameKey => loser.key() == winner.key(),
    };
    if outranked && competes && view.shows_edge(shown) {
        Ok(())
    } else {
        Err(Breach::new("INTENT-2", format_args!("{hidden} is hidden by {shown}, which does not beat it")))
    }
}

fn check_cycle(view: &impl Sight, hidden: EdgeId) -> Result<(), Breach> {
    let state = view.state();
    let fault =
        |what| Err(Breach::new("INTENT-2", format_args!("{hidden} is hidden as a cycle, but {what}")));
    let Some(Edge { from, to, .. }) = state.edge(hidden.0) else {
        return fault("is not held");
    };
    // The way up from its parent must meet its child, over greater claims only.
    for vertex in view.ancestors(*from) {
        if vertex == *to {
            return Ok(());
        }
        if let Some(Placement::Child { edge, .. }) = view.placement(vertex)
            && state.rank(edge.0) < state.rank(hidden.0)
        {
            return fault("a lesser claim is on the way");
        }
    }
    fault("its parent is not below its child")
}

/// What is removed stays removed; what was held is held or dead. `[property: STATE-3]` `[property: JOIN-4]`
pub(crate) fn check_delivery(before: &State, after: &State) -> Result<(), Breach> {
    if let Err(dot) = invariant::check_removal_is_final(before, after) {
        return Err(Breach::new("STATE-3", format_args!("{dot} was removed and is back")));
    }
    if !after.context().includes(before.context()) {
        return Err(Breach::new("JOIN-4", "a delivery made a replica forget what it had seen"));
    }
    Ok(())
}
