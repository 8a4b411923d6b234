//! What a replica holds, with the indexes that find it, and what it shows of it.

use super::held::{ClaimKey, Held, HeldEdge, HeldVertex, HeldWrite, NONE, RegisterKey, WriteKey, mix};
use super::map::Map;
use super::names::{NameId, Names, RT_ID};
use crate::context::CausalContext;
use crate::dictionary::Dictionary;
use crate::dot::{Dot, VertexId};
use crate::record::{EdgeKey, Rank};
use crate::view::Repair;
use alloc::sync::Arc;
use core::hash::Hasher;
use siphasher::sip::SipHasher13;

/// A replica's state and view at one moment: what a [`Replica`](super::Replica) is made of, and what its
/// readers get. Nobody can change one; to clone one is O(1), and a clone stays as it is.
///
/// Equal states have equal graphs to every reader. Names are kept once, records by value, payloads shared.
#[derive(Clone, Debug)]
pub struct Graph {
    pub(super) dictionary: Arc<Dictionary>,
    pub(super) context: Arc<CausalContext>,
    pub(super) names: Names,

    /// Every record held.
    pub(super) records: Map<Dot, Held>,
    /// The external ids of those vertices that have one.
    pub(super) external: Map<Dot, u64>,
    /// Every write, by its register.
    pub(super) writes: Map<WriteKey, HeldWrite>,
    /// Every edge claim, by its register; so by one of its ends, too.
    pub(super) claims: Map<ClaimKey, ()>,
    /// Every edge claim, by the other of its ends.
    pub(super) ends: Map<(Dot, Dot), ()>,
    /// Every record, by each anchor of it that is not held as a vertex or an edge: few, and mostly none.
    pub(super) loose: Map<(Dot, Dot), ()>,
    /// Every vertex, by the hash of its name.
    pub(super) named: Map<(u64, Dot), ()>,
    /// Every vertex, by its type.
    pub(super) typed: Map<(NameId, Dot), ()>,
    /// Every edge claim, by its label.
    pub(super) labelled: Map<(NameId, Dot), ()>,
    /// Every stamp held, and how often.
    pub(super) stamps: Map<u64, u32>,

    /// The kinematic claims that would close a cycle.
    pub(super) broken: Map<Rank, ()>,
    /// The edges that begin the ways to the root of vertices with another kinematic parent.
    pub(super) ways: Map<Dot, Dot>,
    /// The vertices that hang from the root by repair.
    pub(super) detached: Map<Dot, ()>,
    /// The vertices without a path to the root, each with the band that it is in.
    pub(super) strays: Map<Dot, Dot>,
    /// The components without the root, by their least vertex.
    pub(super) bands: Map<Dot, Band>,
    /// Everything repaired.
    pub(super) repairs: Map<Repair, ()>,
}

/// A component of shown edges that lacks the root.
#[derive(Clone, Debug)]
pub(super) struct Band {
    pub(super) members: Arc<[Dot]>,
    /// The vertex that a repair links to the root, unless a detached one hangs there.
    pub(super) reattached: Option<Dot>,
}

/// The hash of a name: the same on every machine. Names that collide are told apart by their texts.
pub(super) fn hash_of(name: &str) -> u64 {
    let mut hasher = SipHasher13::new_with_keys(0, 0);
    hasher.write(name.as_bytes());
    hasher.finish()
}

impl HeldEdge {
    pub(super) fn is_rt(&self) -> bool {
        self.label == RT_ID
    }

    pub(super) fn other_end(&self, end: Dot) -> Dot {
        if self.from == end { self.to } else { self.from }
    }
}

impl Graph {
    pub(super) fn new(dictionary: Dictionary) -> Self {
        Self {
            dictionary: Arc::new(dictionary),
            context: Arc::default(),
            names: Names::new(),
            records: Map::default(),
            external: Map::default(),
            writes: Map::default(),
            claims: Map::default(),
            ends: Map::default(),
            loose: Map::default(),
            named: Map::default(),
            typed: Map::default(),
            labelled: Map::default(),
            stamps: Map::default(),
            broken: Map::default(),
            ways: Map::default(),
            detached: Map::default(),
            strays: Map::default(),
            bands: Map::default(),
            repairs: Map::default(),
        }
    }

    /// What a claim competes on. `[spec: STAMP-4]`
    pub(super) fn register_of(&self, edge: &HeldEdge) -> RegisterKey {
        self.register_at(edge.from, edge.label, edge.to)
    }

    pub(super) fn register_at(&self, from: Dot, label: NameId, to: Dot) -> RegisterKey {
        if label == RT_ID {
            (to, label, NONE)
        } else if self.names.is_functional(label) {
            (from, label, NONE)
        } else {
            (from, label, to)
        }
    }

    pub(super) fn vertex_held(&self, dot: Dot) -> Option<&HeldVertex> {
        if let Some(Held::Vertex(vertex)) = self.records.get(&dot) { Some(vertex) } else { None }
    }

    pub(super) fn edge_held(&self, dot: Dot) -> Option<&HeldEdge> {
        if let Some(Held::Edge(edge)) = self.records.get(&dot) { Some(edge) } else { None }
    }

    pub(super) fn vertex_mut(&mut self, dot: Dot) -> Option<&mut HeldVertex> {
        if let Some(Held::Vertex(vertex)) = self.records.get_mut(&dot) { Some(vertex) } else { None }
    }

    pub(super) fn edge_mut(&mut self, dot: Dot) -> Option<&mut HeldEdge> {
        if let Some(Held::Edge(edge)) = self.records.get_mut(&dot) { Some(edge) } else { None }
    }

    /// Whether a vertex is in the graph. `[spec: VIEW-1.1]`
    pub(super) fn is_vertex(&self, dot: Dot) -> bool {
        dot == VertexId::ROOT.0 || self.vertex_held(dot).is_some()
    }

    /// Whether both ends are in the graph. `[spec: VIEW-1.1]`
    pub(super) fn is_visible(&self, edge: &HeldEdge) -> bool {
        edge.from != edge.to && self.is_vertex(edge.from) && self.is_vertex(edge.to)
    }

    /// The claims on a register, shown, hidden or pending, by their dots.
    pub(super) fn claims_on(&self, key: RegisterKey) -> impl Iterator<Item = Dot> + '_ {
        let (end, label, other) = key;
        let all_compete = label == RT_ID || self.names.is_functional(label);
        let mixed = (end, label, mix(other));
        let from = self.claims.range(&(end, label, mixed.2, NONE)).map(|(claim, ())| *claim);
        let claims = from.take_while(move |claim| (claim.0, claim.1, claim.2) == mixed).map(|claim| claim.3);
        // Others can have the same mix.
        claims.filter(move |&dot| {
            all_compete || self.edge_held(dot).is_some_and(|edge| edge.other_end(end) == other)
        })
    }

    /// The edge claims that end at a dot, pending ones included; a loop twice. Claims on its kinematic parent
    /// come first.
    pub(super) fn edges_at(&self, end: Dot) -> impl Iterator<Item = Dot> + '_ {
        let near = self.claims.range(&(end, 0, 0, NONE)).map(|(claim, ())| *claim);
        let far = self.ends.range(&(end, NONE)).map(|(claim, ())| *claim);
        let near = near.take_while(move |claim| claim.0 == end).map(|claim| claim.3);
        near.chain(far.take_while(move |claim| claim.0 == end).map(|claim| claim.1))
    }

    /// The writes on a target, by register.
    pub(super) fn writes_on(&self, target: Dot) -> impl Iterator<Item = (&WriteKey, &HeldWrite)> + '_ {
        self.writes.range(&(target, 0, NONE)).take_while(move |(key, _)| key.0 == target)
    }

    /// The writes of one register, by their dots.
    pub(super) fn writes_of(
        &self,
        target: Dot,
        name: NameId,
    ) -> impl Iterator<Item = (Dot, &HeldWrite)> + '_ {
        let writes = self.writes.range(&(target, name, NONE));
        writes.take_while(move |(key, _)| (key.0, key.1) == (target, name)).map(|(key, write)| (key.2, write))
    }

    /// Whether any vertex may have this name: one that has its hash.
    pub(super) fn is_named(&self, name: &str) -> bool {
        let hash = hash_of(name);
        self.named.range(&(hash, NONE)).next().is_some_and(|(key, ())| key.0 == hash)
    }

    /// The vertices of a name, by their dots.
    pub(super) fn namesakes<'g>(&'g self, name: &'g str) -> impl Iterator<Item = (Dot, &'g HeldVertex)> + 'g {
        let hash = hash_of(name);
        let vertices = self.named.range(&(hash, NONE)).take_while(move |(key, ())| key.0 == hash);
        let vertices = vertices.filter_map(|(key, ())| Some((key.1, self.vertex_held(key.1)?)));
        vertices.filter(move |(_, vertex)| &*vertex.name == name)
    }

    /// The accepted kinematic edge into a vertex.
    pub(super) fn parent_edge(&self, child: Dot) -> Option<(Dot, &HeldEdge)> {
        let parent = self.vertex_held(child)?.parent();
        if parent == NONE { None } else { Some((parent, self.edge_held(parent)?)) }
    }

    pub(super) fn key_of(&self, edge: &HeldEdge) -> EdgeKey {
        EdgeKey { from: VertexId(edge.from), to: VertexId(edge.to), label: self.names.name(edge.label) }
    }
}
