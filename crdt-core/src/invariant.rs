//! The graph invariants I1 to I5 and the claims about views, as checks that properties, tests and fuzzers
//! all call. `[spec: INV-1]` to `[spec: INV-5]`
//!
//! They judge a finished [`View`] by its public face alone and share no code with what built it.

use crate::dot::{Dot, EdgeId, VertexId};
use crate::record::{Edge, EdgeKey, Name, Record};
use crate::state::State;
use crate::value::ValueType;
use crate::view::{Placement, Repair, View};
use alloc::collections::{BTreeMap, BTreeSet};
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

/// I1 to I5 and one claim shown per register. `[spec: INV-1]` to `[spec: INV-6]`
pub fn check_view(view: &View<'_>) -> Result<(), Violation> {
    check_no_dangling(view)?;
    check_no_self_loop(view)?;
    check_tree(view)?;
    check_paths(view)?;
    check_attributes(view)?;
    check_registers(view)
}

/// I1: every vertex has a path to the root, over shown edges and the links that the repairs report,
/// whatever their direction. `[spec: INV-1]`
pub fn check_paths(view: &View<'_>) -> Result<(), Violation> {
    let mut neighbours: BTreeMap<VertexId, Vec<VertexId>> = BTreeMap::new();
    let edges = view.edges().iter().map(|shown| (shown.edge.from, shown.edge.to));
    let links = view.repairs().iter().filter_map(|repair| match repair {
        Repair::Detached { vertex } | Repair::Reattached { vertex } => Some((VertexId::ROOT, *vertex)),
        _ => None,
    });
    for (from, to) in edges.chain(links) {
        neighbours.entry(from).or_default().push(to);
        neighbours.entry(to).or_default().push(from);
    }
    let mut reached = BTreeSet::from([VertexId::ROOT]);
    let mut frontier = Vec::from([VertexId::ROOT]);
    while let Some(vertex) = frontier.pop() {
        let next = neighbours.get(&vertex).into_iter().flatten();
        frontier.extend(next.filter(|&&vertex| reached.insert(vertex)));
    }
    match view.vertices().iter().find(|vertex| !reached.contains(vertex)) {
        Some(&vertex) => Err(Violation::NoPath { vertex }),
        None => Ok(()),
    }
}

/// I2: every shown edge and write belongs to elements of the graph. `[spec: INV-2]`
pub fn check_no_dangling(view: &View<'_>) -> Result<(), Violation> {
    let present: BTreeSet<VertexId> = view.vertices().iter().copied().collect();
    for shown in view.edges() {
        for vertex in [shown.edge.from, shown.edge.to] {
            if !present.contains(&vertex) {
                return Err(Violation::Dangling { edge: shown.id, vertex });
            }
        }
    }
    for &(write, record) in view.writes() {
        let target = record.target;
        let on_edge = || {
            let edge = view.state().edge(target);
            edge.is_some_and(|edge| present.contains(&edge.from) && present.contains(&edge.to))
        };
        if !present.contains(&VertexId(target)) && !on_edge() {
            return Err(Violation::DanglingWrite { write, target });
        }
    }
    Ok(())
}

/// I3: the shown `RT` edges and the reported detachments form one tree rooted at the root, with unique
/// parents and no cycle. `[spec: INV-3]`
pub fn check_tree(view: &View<'_>) -> Result<(), Violation> {
    let mut parents: BTreeMap<VertexId, (VertexId, EdgeId)> = BTreeMap::new();
    let mut in_tree = BTreeSet::from([VertexId::ROOT]);
    for shown in view.edges().iter().filter(|shown| shown.edge.is_rt()) {
        let Edge { from, to, .. } = *shown.edge;
        if let Some((_, first)) = parents.insert(to, (from, shown.id)) {
            return Err(Violation::TwoParents { child: to, first, second: shown.id });
        }
        in_tree.extend([from, to]);
    }
    let detached: BTreeSet<VertexId> = view
        .repairs()
        .iter()
        .filter_map(|repair| if let Repair::Detached { vertex } = repair { Some(*vertex) } else { None })
        .collect();
    for &vertex in view.vertices() {
        let expected = match parents.get(&vertex) {
            _ if vertex.is_root() => Placement::Root,
            Some(&(parent, edge)) => Placement::Child { parent, edge },
            None if detached.contains(&vertex) => Placement::Detached,
            None => Placement::Outside,
        };
        if view.placement(vertex) != Some(expected) {
            return Err(Violation::Misplaced { vertex });
        }
    }
    for &start in &in_tree {
        // A way up that is longer than there are vertices has met one twice.
        let top = core::iter::successors(Some(start), |at| parents.get(at).map(|&(parent, _)| parent))
            .take(view.vertices().len() + 1)
            .last();
        if !top.is_some_and(|top| !parents.contains_key(&top) && (top.is_root() || detached.contains(&top))) {
            return Err(Violation::NotRooted { vertex: start });
        }
    }
    Ok(())
}

/// I4: no edge joins a vertex to itself. `[spec: INV-4]`
pub fn check_no_self_loop(view: &View<'_>) -> Result<(), Violation> {
    match view.edges().iter().find(|shown| shown.edge.from == shown.edge.to) {
        Some(shown) => Err(Violation::SelfLoop { edge: shown.id, vertex: shown.edge.to }),
        None => Ok(()),
    }
}

/// I5: every shown attribute is declared, with the type of its value. `[spec: INV-5]`
pub fn check_attributes(view: &View<'_>) -> Result<(), Violation> {
    for (_, write) in view.writes() {
        let given = write.value.value_type();
        if !view.dictionary().allows_attribute(&write.name, given) {
            return Err(Violation::Undeclared { name: write.name.clone(), given });
        }
    }
    Ok(())
}

/// One edge per key, and one per functional label of a source. `[spec: INV-6]`
pub fn check_registers(view: &View<'_>) -> Result<(), Violation> {
    let mut seen: BTreeMap<(VertexId, &Name, Option<VertexId>), EdgeId> = BTreeMap::new();
    for shown in view.edges() {
        let Edge { from, to, label, .. } = shown.edge;
        let target = (!view.dictionary().is_functional(label)).then_some(*to);
        if let Some(first) = seen.insert((*from, label, target), shown.id) {
            return Err(Violation::TwoShown { key: shown.edge.key(), first, second: shown.id });
        }
    }
    Ok(())
}

/// V2: repairs are reported exactly where the live claims, taken as they are, break something.
/// `[spec: VIEW-9]` `[spec: VIEW-10]`
pub fn check_repairs(view: &View<'_>) -> Result<(), Violation> {
    match (broken_claim(view), view.repairs()) {
        (None, [repair, ..]) => Err(Violation::Needless { repair: repair.clone() }),
        (Some(what), []) => Err(Violation::Silent { what }),
        _ => Ok(()),
    }
}

/// What the live claims break when nothing is repaired, judged from the records alone.
fn broken_claim(view: &View<'_>) -> Option<&'static str> {
    let state = view.state();
    let lives = |vertex: VertexId| vertex.is_root() || state.vertex(vertex.0).is_some();
    let edges: Vec<&Edge> = state
        .records()
        .filter_map(|(_, record)| if let Record::Edge(edge) = record { Some(edge) } else { None })
        .filter(|edge| edge.from != edge.to && lives(edge.from) && lives(edge.to))
        .collect();
    let (kinematic, symbolic): (Vec<&Edge>, Vec<&Edge>) = edges.iter().partition(|edge| edge.is_rt());
    let mut registers = BTreeSet::new();
    for edge in &symbolic {
        let target = (!view.dictionary().is_functional(&edge.label)).then_some(edge.to);
        if !registers.insert((edge.from, &edge.label, target)) {
            return Some("one edge per register");
        }
    }
    let mut parents = BTreeMap::new();
    for edge in kinematic.iter().filter(|edge| !edge.to.is_root()) {
        if parents.insert(edge.to, edge.from).is_some() {
            return Some("one kinematic parent");
        }
    }
    for start in parents.keys() {
        let top = core::iter::successors(Some(*start), |at| parents.get(at).copied()).take(parents.len() + 2).last();
        if top != Some(VertexId::ROOT) {
            return Some("one kinematic tree");
        }
    }
    if unreached(state, &edges) {
        return Some("a path to the root");
    }
    let mut names = BTreeSet::new();
    let mut vertices = state.records().filter_map(|(dot, _)| state.vertex(dot));
    if !vertices.all(|vertex| names.insert(&vertex.name)) {
        return Some("one vertex per name");
    }
    let undeclared = state.records().filter_map(|(dot, _)| state.write(dot)).any(|write| {
        let on_edge = state.edge(write.target).is_some_and(|edge| lives(edge.from) && lives(edge.to));
        (lives(VertexId(write.target)) || on_edge)
            && !view.dictionary().allows_attribute(&write.name, write.value.value_type())
    });
    undeclared.then_some("declared attributes")
}

/// Whether some vertex has no path of live edges to the root.
fn unreached(state: &State, edges: &[&Edge]) -> bool {
    let mut reached = BTreeSet::from([VertexId::ROOT]);
    loop {
        let before = reached.len();
        for edge in edges {
            if reached.contains(&edge.from) || reached.contains(&edge.to) {
                reached.extend([edge.from, edge.to]);
            }
        }
        if reached.len() == before {
            break;
        }
    }
    state.records().any(|(dot, _)| state.vertex(dot).is_some() && !reached.contains(&VertexId(dot)))
}

/// Every record is live or pending, never dead: nothing is kept of what was removed. `[spec: STATE-6]`
pub fn check_no_remains(state: &State) -> Result<(), crate::Malformed> {
    crate::check_well_formed(state)
}

/// What is removed stays removed: no dot dead in `before` is held in `after`. `[spec: STATE-3]`
pub fn check_removal_is_final(before: &State, after: &State) -> Result<(), Dot> {
    match after.records().map(|(dot, _)| dot).find(|&dot| before.is_dead(dot)) {
        Some(dot) => Err(dot),
        None => Ok(()),
    }
}
