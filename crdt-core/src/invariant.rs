//! The graph invariants I1 to I5 and the claims about views, as checks that properties, tests and fuzzers
//! all call. `[spec: INV-1]` to `[spec: INV-5]`
//!
//! They judge whatever [`Shows`] a state by that face alone: a finished [`View`](crate::View), or what another
//! implementation shows. They share no code with what built it.

use crate::dictionary::Dictionary;
use crate::dot::{Dot, EdgeId, VertexId};
use crate::mutation::is_root_name;
use crate::record::{Edge, EdgeKey, Name, Record, Write};
use crate::state::State;
use crate::value::ValueType;
use crate::view::{Placement, Repair, Shows};
use alloc::vec;
use alloc::vec::Vec;

/// How a view breaks an invariant. Every variant names its clause.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Violation {
    /// I1.
    #[error("[INV-1] {vertex} has no path to the root")]
    NoPath {
        /// The vertex.
        vertex: VertexId,
    },
    /// I2.
    #[error("[INV-2] edge {edge} ends at {vertex}, which is not in the graph")]
    Dangling {
        /// The edge.
        edge: EdgeId,
        /// The missing end.
        vertex: VertexId,
    },
    /// I2 for attributes.
    #[error("[INV-2] write {write} is shown on {target}, which is not in the graph")]
    DanglingWrite {
        /// The write.
        write: Dot,
        /// The missing element.
        target: Dot,
    },
    /// I3: two parents.
    #[error("[INV-3] {child} has two kinematic parents, by {first} and {second}")]
    TwoParents {
        /// The child.
        child: VertexId,
        /// One edge.
        first: EdgeId,
        /// Another.
        second: EdgeId,
    },
    /// I3: a cycle, or a top that is neither the root nor reported as detached.
    #[error("[INV-3] the way up the kinematic tree from {vertex} does not end at the root")]
    NotRooted {
        /// Where it starts.
        vertex: VertexId,
    },
    /// I3: placement and edges disagree.
    #[error("[INV-3] the placement of {vertex} is not what the RT edges say")]
    Misplaced {
        /// The vertex.
        vertex: VertexId,
    },
    /// I4.
    #[error("[INV-4] edge {edge} joins {vertex} to itself")]
    SelfLoop {
        /// The edge.
        edge: EdgeId,
        /// The vertex.
        vertex: VertexId,
    },
    /// I5.
    #[error("[INV-5] attribute {name:?} of type {given} is not declared so")]
    Undeclared {
        /// The attribute.
        name: Name,
        /// The type of the value shown.
        given: ValueType,
    },
    /// A register shows two claims.
    #[error("[VIEW-2] {first} and {second} are both shown for {key}")]
    TwoShown {
        /// The key of one of them.
        key: EdgeKey,
        /// One.
        first: EdgeId,
        /// The other.
        second: EdgeId,
    },
    /// A name finds another vertex than the oldest of that name.
    #[error("[VIEW-7] the name {name:?} does not find {expected}, the oldest that has it")]
    Misnamed {
        /// The name.
        name: Name,
        /// Whom it should find.
        expected: VertexId,
    },
    /// A lesser write is shown before a greater one.
    #[error("[VIEW-8] {winner} is shown, but {greater} is the greater write")]
    Outranked {
        /// The write shown first.
        winner: Dot,
        /// A greater one.
        greater: Dot,
    },
    /// V2: a repair where nothing is broken.
    #[error("[VIEW-10] nothing is broken, but the view reports: {repair}")]
    Needless {
        /// The repair.
        repair: Repair,
    },
    /// V2, the other way round: something is broken, and the view does not say so.
    #[error("[VIEW-9] the claims break {what}, but the view reports no repair")]
    Silent {
        /// What.
        what: &'static str,
    },
}

/// I1 to I5, one claim shown per register, and the right one found by each name and in each attribute.
/// `[property: INV-1]` to `[property: INV-6]`
pub fn check_view(view: &impl Shows) -> Result<(), Violation> {
    check_no_dangling(view)?;
    check_no_self_loop(view)?;
    check_tree(view)?;
    check_paths(view)?;
    check_attributes(view)?;
    check_registers(view)?;
    check_names(view)?;
    check_winners(view)
}

/// I1: every vertex has a path to the root, over shown edges and the links that the repairs report,
/// whatever their direction. `[property: INV-1]`
pub fn check_paths(view: &impl Shows) -> Result<(), Violation> {
    let edges = view.edges().iter().map(|shown| (shown.edge.from, shown.edge.to));
    let links = view.repairs().iter().filter_map(|repair| match repair {
        Repair::Detached { vertex } | Repair::Reattached { vertex } => Some((VertexId::ROOT, *vertex)),
        _ => None,
    });
    match first_unreached(view.vertices(), edges.chain(links)) {
        Some(vertex) => Err(Violation::NoPath { vertex }),
        None => Ok(()),
    }
}

/// The first of `vertices` (ascending, the root first) that no path of `edges` joins to the root.
fn first_unreached(
    vertices: &[VertexId],
    edges: impl Iterator<Item = (VertexId, VertexId)>,
) -> Option<VertexId> {
    let mut neighbours: Vec<(VertexId, VertexId)> = Vec::with_capacity(4 * vertices.len());
    neighbours.extend(edges.flat_map(|(from, to)| [(from, to), (to, from)]));
    neighbours.sort_unstable();
    let mut reached = vec![false; vertices.len()];
    let mut frontier = vec![VertexId::ROOT];
    while let Some(vertex) = frontier.pop() {
        let Ok(at) = vertices.binary_search(&vertex) else { continue };
        if !core::mem::replace(&mut reached[at], true) {
            let first = neighbours.partition_point(|&(from, _)| from < vertex);
            let own = neighbours[first..].iter().take_while(|&&(from, _)| from == vertex);
            frontier.extend(own.map(|&(_, to)| to));
        }
    }
    vertices.iter().zip(reached).find(|(_, reached)| !reached).map(|(&vertex, _)| vertex)
}

/// I2: every shown edge and write belongs to elements of the graph. `[property: INV-2]`
pub fn check_no_dangling(view: &impl Shows) -> Result<(), Violation> {
    let present = |vertex: VertexId| vertex.is_root() || view.state().vertex(vertex.0).is_some();
    for shown in view.edges() {
        for vertex in [shown.edge.from, shown.edge.to] {
            if !present(vertex) || view.vertices().binary_search(&vertex).is_err() {
                return Err(Violation::Dangling { edge: shown.id, vertex });
            }
        }
    }
    for &(write, record) in view.writes() {
        let target = record.target;
        let on_edge = || view.state().edge(target).is_some_and(|edge| present(edge.from) && present(edge.to));
        if !present(VertexId(target)) && !on_edge() {
            return Err(Violation::DanglingWrite { write, target });
        }
    }
    Ok(())
}

/// I3: the shown `RT` edges and the reported detachments form one tree rooted at the root, with unique
/// parents and no cycle. `[property: INV-3]`
pub fn check_tree(view: &impl Shows) -> Result<(), Violation> {
    let parents = unique_parents(view)?;
    let is_detached = |vertex| {
        view.repairs().iter().any(|repair| matches!(repair, Repair::Detached { vertex: v } if *v == vertex))
    };
    for &vertex in view.vertices() {
        let expected = match parent_in(&parents, vertex) {
            _ if vertex.is_root() => Placement::Root,
            Some((parent, edge)) => Placement::Child { parent, edge },
            None if is_detached(vertex) => Placement::Detached,
            None => Placement::Outside,
        };
        if view.placement(vertex) != Some(expected) {
            return Err(Violation::Misplaced { vertex });
        }
    }
    let pairs: Vec<(VertexId, VertexId)> =
        parents.iter().map(|&(child, parent, _)| (child, parent)).collect();
    if let Some(vertex) = first_unrooted(&pairs, |top| top.is_root() || is_detached(top)) {
        return Err(Violation::NotRooted { vertex });
    }
    Ok(())
}

/// Child, parent and edge of each shown `RT` edge, by child.
fn unique_parents(view: &impl Shows) -> Result<Vec<(VertexId, VertexId, EdgeId)>, Violation> {
    let kinematic = view.edges().iter().filter(|shown| shown.edge.is_rt());
    let mut parents = Vec::with_capacity(view.vertices().len());
    parents.extend(kinematic.map(|shown| (shown.edge.to, shown.edge.from, shown.id)));
    parents.sort_unstable();
    match parents.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        Some(pair) => Err(Violation::TwoParents { child: pair[0].0, first: pair[0].2, second: pair[1].2 }),
        None => Ok(parents),
    }
}

fn parent_in(parents: &[(VertexId, VertexId, EdgeId)], child: VertexId) -> Option<(VertexId, EdgeId)> {
    let at = parents.binary_search_by_key(&child, |entry| entry.0).ok()?;
    Some((parents[at].1, parents[at].2))
}

/// The first child in `parents` (child and parent, by child) whose way up meets a vertex twice or ends at a
/// top that is none. Each edge is walked twice at most.
fn first_unrooted(parents: &[(VertexId, VertexId)], is_top: impl Fn(VertexId) -> bool) -> Option<VertexId> {
    let index = |vertex| parents.binary_search_by_key(&vertex, |&(child, _)| child).ok();
    let mut rooted = vec![false; parents.len()];
    for &(start, _) in parents {
        let mut way = Vec::new();
        let mut at = start;
        while let Some(step) = index(at).filter(|&step| !rooted[step]) {
            if way.len() == parents.len() {
                return Some(start);
            }
            way.push(step);
            at = parents[step].1;
        }
        // The way ended at a vertex that is known to be rooted, or at one without a parent.
        if index(at).is_none() && !is_top(at) {
            return Some(start);
        }
        for step in way {
            rooted[step] = true;
        }
    }
    None
}

/// I4: no edge joins a vertex to itself. `[property: INV-4]`
pub fn check_no_self_loop(view: &impl Shows) -> Result<(), Violation> {
    match view.edges().iter().find(|shown| shown.edge.from == shown.edge.to) {
        Some(shown) => Err(Violation::SelfLoop { edge: shown.id, vertex: shown.edge.to }),
        None => Ok(()),
    }
}

/// I5: every shown attribute is declared, with the type of its value. `[property: INV-5]`
pub fn check_attributes(view: &impl Shows) -> Result<(), Violation> {
    for (_, write) in view.writes() {
        let given = write.value.value_type();
        if !view.dictionary().allows_attribute(&write.name, given) {
            return Err(Violation::Undeclared { name: write.name.clone(), given });
        }
    }
    Ok(())
}

/// One edge per key, and one per functional label of a source. `[property: INV-6]`
pub fn check_registers(view: &impl Shows) -> Result<(), Violation> {
    let mut shown: Vec<_> =
        view.edges().iter().map(|shown| (register_of(shown.edge, view.dictionary()), shown)).collect();
    shown.sort_unstable_by(|l, r| l.0.cmp(&r.0));
    match shown.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        Some(pair) => {
            let (first, second) = (pair[0].1, pair[1].1);
            Err(Violation::TwoShown { key: first.edge.key(), first: first.id, second: second.id })
        }
        None => Ok(()),
    }
}

/// A name finds the oldest of the vertices that have it: the one of least rank. `[property: VIEW-7]`
pub fn check_names(view: &impl Shows) -> Result<(), Violation> {
    let state = view.state();
    let held = view.vertices().iter().filter_map(|&id| Some((state.vertex(id.0)?, id)));
    let mut named: Vec<(&Name, u64, VertexId)> =
        held.map(|(vertex, id)| (&vertex.name, vertex.stamp, id)).collect();
    named.sort_unstable();
    for namesakes in named.chunk_by(|l, r| l.0 == r.0) {
        let [(name, _, oldest), ..] = namesakes else { continue };
        let expected = if is_root_name(name) { VertexId::ROOT } else { *oldest };
        if view.vertex_by_name(name) != Some(expected) {
            return Err(Violation::Misnamed { name: (*name).clone(), expected });
        }
    }
    Ok(())
}

/// The write shown first of an attribute is the greatest. `[property: VIEW-8]`
pub fn check_winners(view: &impl Shows) -> Result<(), Violation> {
    let writes = view.writes();
    let by_rank = |pair: &[(Dot, &Write)]| {
        let [(winner, left), (greater, right)] = pair else { return None };
        let is_fault = (left.target, &left.name) == (right.target, &right.name)
            && (left.stamp, winner) < (right.stamp, greater);
        is_fault.then_some(Violation::Outranked { winner: *winner, greater: *greater })
    };
    writes.windows(2).find_map(by_rank).map_or(Ok(()), Err)
}

/// What a symbolic edge competes on: its source, label and, unless that is functional, target.
fn register_of<'e>(edge: &'e Edge, dictionary: &Dictionary) -> (VertexId, &'e str, Option<VertexId>) {
    (edge.from, &edge.label, (!dictionary.is_functional(&edge.label)).then_some(edge.to))
}

/// V2: repairs are reported exactly where the live claims, taken as they are, break something.
/// `[property: VIEW-9]` `[property: VIEW-10]`
pub fn check_repairs(view: &impl Shows) -> Result<(), Violation> {
    match (broken_claim(view), view.repairs()) {
        (None, [repair, ..]) => Err(Violation::Needless { repair: repair.clone() }),
        (Some(what), []) => Err(Violation::Silent { what }),
        _ => Ok(()),
    }
}

/// What the live claims break when nothing is repaired, judged from the records alone.
fn broken_claim(view: &impl Shows) -> Option<&'static str> {
    let (state, dictionary) = (view.state(), view.dictionary());
    let lives = |vertex: VertexId| vertex.is_root() || state.vertex(vertex.0).is_some();
    let joins = |edge: &&Edge| edge.from != edge.to && lives(edge.from) && lives(edge.to);
    let edges: Vec<&Edge> = state.records().filter_map(|(dot, _)| state.edge(dot)).filter(joins).collect();
    let symbolic = edges.iter().filter(|edge| !edge.is_rt());
    if has_twins(symbolic.map(|edge| register_of(edge, dictionary)).collect()) {
        return Some("one edge per register");
    }
    let mut parents: Vec<(VertexId, VertexId)> = Vec::new();
    parents.extend(
        edges.iter().filter(|edge| edge.is_rt() && !edge.to.is_root()).map(|edge| (edge.to, edge.from)),
    );
    if has_twins(parents.iter().map(|&(child, _)| child).collect()) {
        return Some("one kinematic parent");
    }
    parents.sort_unstable();
    if first_unrooted(&parents, VertexId::is_root).is_some() {
        return Some("one kinematic tree");
    }
    let held = state.records().filter(|(_, record)| matches!(record, Record::Vertex(_)));
    let vertices: Vec<VertexId> =
        core::iter::once(VertexId::ROOT).chain(held.map(|(dot, _)| VertexId(dot))).collect();
    if first_unreached(&vertices, edges.iter().map(|edge| (edge.from, edge.to))).is_some() {
        return Some("a path to the root");
    }
    let names = vertices.iter().filter_map(|&vertex| state.vertex(vertex.0)).map(|vertex| &*vertex.name);
    if has_twins(names.chain(["root", "world"]).collect()) {
        return Some("one vertex per name");
    }
    let undeclared = state.records().filter_map(|(dot, _)| state.write(dot)).any(|write| {
        let on_edge = || state.edge(write.target).is_some_and(|edge| joins(&edge));
        !dictionary.allows_attribute(&write.name, write.value.value_type())
            && (lives(VertexId(write.target)) || on_edge())
    });
    undeclared.then_some("declared attributes")
}

fn has_twins<T: Ord>(mut items: Vec<T>) -> bool {
    items.sort_unstable();
    items.windows(2).any(|pair| pair[0] == pair[1])
}

/// Every record is live or pending, never dead: nothing is kept of what was removed. `[property: STATE-6]`
pub fn check_no_remains(state: &State) -> Result<(), crate::Malformed> {
    crate::check_well_formed(state)
}

/// What is removed stays removed: no dot dead in `before` is held in `after`. `[property: STATE-3]`
pub fn check_removal_is_final(before: &State, after: &State) -> Result<(), Dot> {
    let mut kept = before.records().map(|(dot, _)| dot).peekable();
    for (dot, _) in after.records() {
        while kept.next_if(|&known| known < dot).is_some() {}
        // What was held before cannot have been dead.
        if kept.peek() != Some(&dot) && before.context().contains(dot) {
            return Err(dot);
        }
    }
    Ok(())
}
