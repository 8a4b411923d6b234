//! What a replica holds, with the indexes that find it, and what it shows of it.

use super::held::{
    ClaimKey, Held, HeldEdge, HeldVertex, HeldWrite, Link, NONE, RegisterKey, WriteAt, WriteKey, mix,
};
use super::map::Map;
use super::names::{NameId, Names, RT_ID};
use super::settle::Came;
use crate::context::CausalContext;
use crate::dictionary::Dictionary;
use crate::dot::{Dot, VertexId};
use crate::record::{Edge, EdgeKey, Rank, Record, Vertex, Write};
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

/// A record taken out of all indexes, as it was shown.
#[derive(Debug)]
pub(super) struct Gone {
    pub(super) dot: Dot,
    pub(super) held: Held,
    pub(super) write: Option<HeldWrite>,
    pub(super) external: Option<u64>,
    /// The shown edge that began a vertex's way to the root, or [`NONE`].
    pub(super) up: Dot,
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

    /// Files a record in every index, shown as nothing yet.
    pub(super) fn file(&mut self, dot: Dot, record: &Record) -> Came {
        let (held, came) = match record {
            Record::Vertex(vertex) => (Held::Vertex(self.file_vertex(dot, vertex)), Came::Vertex),
            Record::Edge(edge) => (Held::Edge(self.file_edge(dot, edge)), Came::Edge),
            Record::Write(write) => {
                let at = self.file_write(dot, write);
                (Held::Write(at), Came::Write(at))
            }
        };
        self.records.insert(dot, held);
        for anchor in record.anchors() {
            if !self.is_element(anchor) {
                self.loose.insert((anchor, dot), ());
            }
        }
        if !matches!(record, Record::Write(_)) {
            self.settle_down(dot);
        }
        let stamp = record.stamp();
        if let Some(count) = self.stamps.insert(stamp, 1) {
            self.stamps.insert(stamp, count + 1);
        }
        came
    }

    /// Whether records can be anchored to a dot: the root, a vertex, an edge.
    fn is_element(&self, dot: Dot) -> bool {
        dot == NONE || matches!(self.records.get(&dot), Some(Held::Vertex(_) | Held::Edge(_)))
    }

    /// What waited for a dot has found it.
    fn settle_down(&mut self, dot: Dot) {
        if !self.loose.is_empty() {
            let waiting: alloc::vec::Vec<Dot> = self.loose_at(dot).collect();
            for other in waiting {
                self.loose.remove(&(dot, other));
            }
        }
    }

    /// The records that wait for a dot, or are anchored to a write.
    fn loose_at(&self, anchor: Dot) -> impl Iterator<Item = Dot> + '_ {
        let loose = self.loose.range(&(anchor, NONE)).map(|(key, ())| *key);
        loose.take_while(move |key| key.0 == anchor).map(|key| key.1)
    }

    /// The records that are anchored to a dot.
    pub(super) fn anchored_to(&self, anchor: Dot) -> impl Iterator<Item = Dot> + '_ {
        let element = self.is_element(anchor).then_some(anchor).into_iter();
        let firm = element
            .flat_map(|anchor| self.edges_at(anchor).chain(self.writes_on(anchor).map(|(key, _)| key.2)));
        let loose = (!self.loose.is_empty()).then_some(anchor).into_iter();
        firm.chain(loose.flat_map(|anchor| self.loose_at(anchor)))
    }

    /// A vertex or edge has been replaced by a write: what was anchored to it is so to a write now.
    pub(super) fn let_loose(&mut self, dot: Dot) {
        let edges = self.edges_at(dot).chain(self.writes_on(dot).map(|(key, _)| key.2));
        let left: alloc::vec::Vec<Dot> = edges.collect();
        for other in left {
            self.loose.insert((dot, other), ());
        }
    }

    fn file_vertex(&mut self, dot: Dot, vertex: &Vertex) -> HeldVertex {
        let vertex_type = self.names.hold(&vertex.vertex_type, false);
        self.named.insert((hash_of(&vertex.name), dot), ());
        self.typed.insert((vertex_type, dot), ());
        if let Some(id) = vertex.external_id {
            self.external.insert(dot, id);
        }
        let (name, stamp) = (vertex.name.clone(), vertex.stamp);
        HeldVertex { name, vertex_type, children: 0, stamp, link: Link::None, linked_by: NONE }
    }

    fn file_edge(&mut self, dot: Dot, edge: &Edge) -> HeldEdge {
        let functional = self.dictionary.is_functional(&edge.label);
        let label = self.names.hold(&edge.label, functional);
        let (from, to, stamp) = (edge.from.0, edge.to.0, edge.stamp);
        let held = HeldEdge { from, to, label, status: super::held::Status::Invisible, stamp };
        let register = self.register_of(&held);
        self.claims.insert((register.0, register.1, mix(register.2), dot), ());
        self.ends.insert((held.other_end(register.0), dot), ());
        self.labelled.insert((label, dot), ());
        held
    }

    fn file_write(&mut self, dot: Dot, write: &Write) -> WriteAt {
        let name = self.names.hold(&write.name, false);
        let held = HeldWrite {
            value: write.value.clone(),
            timestamp_ns: write.timestamp_ns,
            stamp: write.stamp,
            exposure: super::held::Exposure::Invisible,
        };
        self.writes.insert((write.target, name, dot), held);
        WriteAt { target: write.target, name }
    }

    /// Takes a record out of every index. Its names stay in use until [`release`](Self::release), so that no
    /// other gets their numbers meanwhile.
    pub(super) fn withdraw(&mut self, dot: Dot) -> Option<Gone> {
        let held = self.records.remove(&dot)?;
        let up = match &held {
            Held::Vertex(vertex) => match vertex.link {
                Link::None | Link::Parent => NONE,
                Link::Up | Link::ParentUp => vertex.linked_by,
                Link::ParentAndWay => self.ways.remove(&dot).unwrap_or(NONE),
            },
            _ => NONE,
        };
        let mut gone = Gone { dot, held, write: None, external: None, up };
        let stamp = match &gone.held {
            Held::Vertex(vertex) => {
                self.named.remove(&(hash_of(&vertex.name), dot));
                self.typed.remove(&(vertex.vertex_type, dot));
                if !self.external.is_empty() {
                    gone.external = self.external.remove(&dot);
                }
                vertex.stamp
            }
            Held::Edge(edge) => {
                let register = self.register_of(edge);
                self.claims.remove(&(register.0, register.1, mix(register.2), dot));
                self.ends.remove(&(edge.other_end(register.0), dot));
                self.labelled.remove(&(edge.label, dot));
                edge.stamp
            }
            Held::Write(at) => {
                gone.write = self.writes.remove(&(at.target, at.name, dot));
                gone.write.as_ref().map_or(0, |write| write.stamp)
            }
        };
        if !self.loose.is_empty() {
            let anchors = match &gone.held {
                Held::Vertex(_) => [NONE; 2],
                Held::Edge(edge) => [edge.from, edge.to],
                Held::Write(at) => [at.target, NONE],
            };
            for anchor in anchors {
                self.loose.remove(&(anchor, dot));
            }
        }
        if let Some(count) = self.stamps.remove(&stamp).filter(|count| *count > 1) {
            self.stamps.insert(stamp, count - 1);
        }
        Some(gone)
    }

    pub(super) fn release(&mut self, gone: &Gone) {
        self.names.release(match &gone.held {
            Held::Vertex(vertex) => vertex.vertex_type,
            Held::Edge(edge) => edge.label,
            Held::Write(at) => at.name,
        });
    }

    /// The record that was withdrawn, while its names are in use.
    pub(super) fn record_of(&self, gone: &Gone) -> Option<Record> {
        self.assemble(&gone.held, gone.write.as_ref(), gone.external)
    }

    /// The record held under a dot.
    pub(super) fn record(&self, dot: Dot) -> Option<Record> {
        self.record_from(dot, self.records.get(&dot)?)
    }

    pub(super) fn record_from(&self, dot: Dot, held: &Held) -> Option<Record> {
        let write = match held {
            Held::Write(at) => self.writes.get(&(at.target, at.name, dot)),
            _ => None,
        };
        self.assemble(held, write, self.external.get(&dot).copied())
    }

    fn assemble(&self, held: &Held, write: Option<&HeldWrite>, external_id: Option<u64>) -> Option<Record> {
        Some(match held {
            Held::Vertex(vertex) => Record::Vertex(Vertex {
                vertex_type: self.names.name(vertex.vertex_type),
                name: vertex.name.clone(),
                external_id,
                stamp: vertex.stamp,
            }),
            Held::Edge(edge) => Record::Edge(Edge {
                from: VertexId(edge.from),
                to: VertexId(edge.to),
                label: self.names.name(edge.label),
                stamp: edge.stamp,
            }),
            Held::Write(at) => {
                let HeldWrite { value, timestamp_ns, stamp, .. } = write?.clone();
                Record::Write(Write {
                    target: at.target,
                    name: self.names.name(at.name),
                    value,
                    timestamp_ns,
                    stamp,
                })
            }
        })
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

    /// The shown edge that begins a vertex's way to the root, or [`NONE`].
    pub(super) fn up_of(&self, vertex: Dot) -> Dot {
        let Some(held) = self.vertex_held(vertex) else { return NONE };
        match held.link {
            Link::None | Link::Parent => NONE,
            Link::Up | Link::ParentUp => held.linked_by,
            Link::ParentAndWay => self.ways.get(&vertex).copied().unwrap_or(NONE),
        }
    }

    pub(super) fn set_up(&mut self, vertex: Dot, up: Dot) {
        if let Some(parent) = self.vertex_held(vertex).map(HeldVertex::parent) {
            self.set_link(vertex, parent, up);
        }
    }

    pub(super) fn set_parent(&mut self, vertex: Dot, parent: Dot) {
        let up = self.up_of(vertex);
        self.set_link(vertex, parent, up);
    }

    pub(super) fn set_link(&mut self, vertex: Dot, parent: Dot, up: Dot) {
        let link = match (parent, up) {
            (NONE, NONE) => Link::None,
            (NONE, _) => Link::Up,
            (_, NONE) => Link::Parent,
            _ if parent == up => Link::ParentUp,
            _ => Link::ParentAndWay,
        };
        let Some(held) = self.vertex_mut(vertex) else { return };
        let had_way = held.link == Link::ParentAndWay;
        held.link = link;
        held.linked_by = if link == Link::Up { up } else { parent };
        if link == Link::ParentAndWay {
            self.ways.insert(vertex, up);
        } else if had_way {
            self.ways.remove(&vertex);
        }
    }

    pub(super) fn key_of(&self, edge: &HeldEdge) -> EdgeKey {
        EdgeKey { from: VertexId(edge.from), to: VertexId(edge.to), label: self.names.name(edge.label) }
    }
}
