//! The view: a total, deterministic function from states to graphs. `[spec: VIEW-1]`
//!
//! Concurrent legal mutations can together break what each of them kept. The view repairs, purely and the
//! same on every replica, and says what it repaired: it never writes. Every state has one, reachable or
//! not, and it keeps the invariants I1 to I5 (see [`crate::invariant`]).
//!
//! | room | repairs |
//! |---|---|
//! | [`registers`] | symbolic edges: one shown per key, one per functional label |
//! | [`tree`] | kinematic claims: a forest by greedy acceptance; tops that hang from the root |
//! | [`paths`] | components without a path to the root |
//! | [`attributes`] | multi-value registers of attribute writes |

mod attributes;
mod paths;
mod registers;
mod repair;
mod shows;
mod tree;
mod union_find;

pub use repair::{Repair, Rule};
pub use shows::Shows;
pub use tree::Placement;

use crate::dictionary::Dictionary;
use crate::dot::{Dot, EdgeId, VertexId};
use crate::mutation::is_root_name;
use crate::record::{Edge, EdgeKey, Name, Record, Vertex, Write};
use crate::state::State;
use alloc::vec::Vec;
use attributes::Attributes;

/// What users see of a state: a graph that keeps the invariants, and the repairs that made it so.
///
/// Borrows the state and copies no payload. Look-ups are by binary search.
#[derive(Clone, Debug)]
pub struct View<'s> {
    state: &'s State,
    dictionary: &'s Dictionary,
    /// The root first, then by dot.
    vertices: Vec<VertexId>,
    /// By key; both ends live.
    edges: Vec<ShownEdge<'s>>,
    /// Beside `vertices`.
    placements: Vec<Placement>,
    /// In order.
    stranded: Vec<VertexId>,
    attributes: Attributes<'s>,
    /// By name, then oldest first.
    names: Vec<(&'s Name, u64, VertexId)>,
    /// In order.
    repairs: Vec<Repair>,
}

/// An edge that the view shows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ShownEdge<'s> {
    /// Which instance.
    pub id: EdgeId,
    /// Its record.
    pub edge: &'s Edge,
}

/// The view of `state` under `dictionary`. `[spec: VIEW-1]`
///
/// O(n log n) in the records held.
pub fn view<'s>(state: &'s State, dictionary: &'s Dictionary) -> View<'s> {
    let mut repairs = Vec::new();
    let vertices = live_vertices(state);
    let candidates = visible_edges(state, &vertices);
    let mut edges = registers::shown(&candidates, dictionary, &mut repairs);
    let tree = tree::grow(&candidates, &vertices, &mut repairs);
    edges.extend(tree.accepted);
    edges.sort_unstable_by(|l, r| key_of(l).cmp(&key_of(r)));
    let stranded = paths::stranded(state, &vertices, &edges, &tree.placements, &mut repairs);
    let attributes = Attributes::of(state, dictionary, &vertices, &candidates, &mut repairs);
    let names = names_of(state, &vertices, &mut repairs);
    repairs.sort_unstable();
    View {
        state,
        dictionary,
        vertices,
        edges,
        placements: tree.placements,
        stranded,
        attributes,
        names,
        repairs,
    }
}

fn key_of<'a>(shown: &ShownEdge<'a>) -> (VertexId, VertexId, &'a str) {
    (shown.edge.from, shown.edge.to, &shown.edge.label)
}

/// The root, then every vertex held. `[spec: VIEW-1.1]`
fn live_vertices(state: &State) -> Vec<VertexId> {
    let held = state.records().filter(|(_, record)| matches!(record, Record::Vertex(_)));
    let mut vertices = Vec::with_capacity(state.len() + 1);
    vertices.push(VertexId::ROOT);
    vertices.extend(held.map(|(dot, _)| VertexId(dot)));
    vertices
}

/// Every edge claim whose ends live, by dot: what is pending, or anchored to no vertex, is invisible.
/// No dictionary hides a label. `[spec: VIEW-1.1]` `[spec: DICT-4]` `[spec: INV-2]` `[spec: INV-4]`
fn visible_edges<'s>(state: &'s State, vertices: &[VertexId]) -> Vec<ShownEdge<'s>> {
    let lives = |vertex: VertexId| vertices.binary_search(&vertex).is_ok();
    let visible = state.records().filter_map(|(dot, record)| match record {
        Record::Edge(edge) if edge.from != edge.to && lives(edge.from) && lives(edge.to) => {
            Some(ShownEdge { id: EdgeId(dot), edge })
        }
        _ => None,
    });
    let mut edges = Vec::with_capacity(state.len());
    edges.extend(visible);
    edges
}

/// All names, and a repair for each vertex that its name does not find. `[spec: VIEW-7]`
fn names_of<'s>(
    state: &'s State,
    vertices: &[VertexId],
    repairs: &mut Vec<Repair>,
) -> Vec<(&'s Name, u64, VertexId)> {
    let mut names = Vec::with_capacity(vertices.len());
    names.extend(vertices.iter().filter_map(|&id| state.vertex(id.0).map(|v| (&v.name, v.stamp, id))));
    names.sort_unstable();
    for namesakes in names.chunk_by(|l, r| l.0 == r.0) {
        let [(name, _, oldest), younger @ ..] = namesakes else { continue };
        // No mutation makes a vertex of the root's name, but a record from outside can have it.
        let (shown, hidden) =
            if is_root_name(name) { (VertexId::ROOT, namesakes) } else { (*oldest, younger) };
        repairs.extend(hidden.iter().map(|&(_, _, hidden)| Repair::NameClash {
            name: (*name).clone(),
            shown,
            hidden,
        }));
    }
    names
}

impl<'s> View<'s> {
    /// The state that is viewed.
    pub fn state(&self) -> &'s State {
        self.state
    }

    /// The dictionary that it is viewed under.
    pub fn dictionary(&self) -> &'s Dictionary {
        self.dictionary
    }

    /// Every live vertex, the root first, then by dot.
    pub fn vertices(&self) -> &[VertexId] {
        &self.vertices
    }

    /// Whether the vertex is in the graph.
    pub fn has_vertex(&self, vertex: VertexId) -> bool {
        self.vertices.binary_search(&vertex).is_ok()
    }

    /// A vertex's record; `None` for the root and for what is not in the graph.
    pub fn vertex(&self, vertex: VertexId) -> Option<&'s Vertex> {
        self.state.vertex(vertex.0)
    }

    /// The vertex that a name finds: the oldest of that name; `root` and `world` find the root.
    /// `[spec: VIEW-7]`
    pub fn vertex_by_name(&self, name: &str) -> Option<VertexId> {
        if is_root_name(name) {
            return Some(VertexId::ROOT);
        }
        let at = self.names.partition_point(|(known, ..)| &***known < name);
        self.names.get(at).filter(|(known, ..)| &***known == name).map(|&(_, _, id)| id)
    }

    /// Every edge shown, by source, target and label; the links that repairs make are not edges.
    pub fn edges(&self) -> &[ShownEdge<'s>] {
        &self.edges
    }

    /// The edge shown under a key.
    pub fn edge(&self, from: VertexId, label: &str, to: VertexId) -> Option<ShownEdge<'s>> {
        let key = (from, to, label);
        self.edges.binary_search_by(|shown| key_of(shown).cmp(&key)).ok().map(|at| self.edges[at])
    }

    /// The edge shown under a key.
    pub fn edge_by_key(&self, key: &EdgeKey) -> Option<ShownEdge<'s>> {
        self.edge(key.from, &key.label, key.to)
    }

    /// Whether this instance is shown.
    pub fn shows_edge(&self, id: EdgeId) -> bool {
        let edge = self.state.edge(id.0);
        edge.and_then(|edge| self.edge(edge.from, &edge.label, edge.to)).is_some_and(|shown| shown.id == id)
    }

    /// The shown edges out of a vertex.
    pub fn edges_from(&self, from: VertexId) -> &[ShownEdge<'s>] {
        let start = self.edges.partition_point(|shown| shown.edge.from < from);
        let end = self.edges.partition_point(|shown| shown.edge.from <= from);
        &self.edges[start..end]
    }

    /// Where a vertex stands in the kinematic tree; `None` if it is not in the graph. `[spec: VIEW-4]`
    pub fn placement(&self, vertex: VertexId) -> Option<Placement> {
        self.vertices.binary_search(&vertex).ok().map(|at| self.placements[at])
    }

    /// Whether a vertex has a place in the kinematic tree, detached or not.
    pub fn in_tree(&self, vertex: VertexId) -> bool {
        !matches!(self.placement(vertex), None | Some(Placement::Outside))
    }

    /// The vertices on the way up the kinematic tree, from `vertex` itself to the root or to where a
    /// detached tree ends. Empty if it has no place there.
    pub fn ancestors(&self, vertex: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        let start = self.in_tree(vertex).then_some(vertex);
        core::iter::successors(start, move |&at| match self.placement(at) {
            Some(Placement::Child { parent, .. }) => Some(parent),
            _ => None,
        })
    }

    /// Vertices that only a repair holds: without a path of shown edges to the root, or detached.
    /// Mutations 4 to 6 may not add to them; a vertex linked to one shares its lot. `[spec: VIEW-5]`
    /// `[spec: MUT-4.2]` `[spec: MUT-1.7]`
    pub fn stranded(&self) -> &[VertexId] {
        &self.stranded
    }

    /// The winning write of an attribute. `[spec: VIEW-8]`
    pub fn attribute(&self, target: impl Into<Dot>, name: &str) -> Option<(Dot, &'s Write)> {
        self.attributes.register(target.into(), name).first().copied()
    }

    /// Every live write of an attribute, the winner first: more than one after concurrent writes.
    /// `[spec: VIEW-8]`
    pub fn attribute_writes(&self, target: impl Into<Dot>, name: &str) -> &[(Dot, &'s Write)] {
        self.attributes.register(target.into(), name)
    }

    /// The winning writes of one element, by name.
    pub fn attributes_of(&self, target: impl Into<Dot>) -> impl Iterator<Item = (Dot, &'s Write)> + '_ {
        self.attributes.winners_of(target.into())
    }

    /// Every shown write, losers included: by target, name, and the winner first.
    pub fn writes(&self) -> &[(Dot, &'s Write)] {
        self.attributes.all()
    }

    /// What was repaired, in order; empty where nothing was broken. `[spec: VIEW-9]` `[spec: VIEW-10]`
    pub fn repairs(&self) -> &[Repair] {
        &self.repairs
    }
}
