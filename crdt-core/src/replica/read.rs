//! What readers ask of a graph.

use super::graph::Graph;
use super::held::{Exposure, Held, HeldEdge, NONE, Status};
use crate::context::CausalContext;
use crate::dictionary::Dictionary;
use crate::digest::{Digest, Fingerprint};
use crate::dot::{Dot, EdgeId, VertexId};
use crate::mutation::is_root_name;
use crate::record::{Edge, EdgeKey, Record, Vertex, Write};
use crate::state::{Delta, State};
use crate::view::{Placement, Repair};
use alloc::vec::Vec;

impl Graph {
    /// The dictionary that it is shown under.
    pub fn dictionary(&self) -> &Dictionary {
        &self.dictionary
    }

    /// Every dot that has been seen.
    pub fn context(&self) -> &CausalContext {
        &self.context
    }

    /// How many records are held, pending ones included.
    pub fn len(&self) -> usize {
        self.records.len()
    }

    /// Whether no record is held.
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// The record held under `dot`. Names and payloads are shared, not copied.
    pub fn get(&self, dot: Dot) -> Option<Record> {
        self.record(dot)
    }

    /// Every vertex in the graph, the root first, then by dot. O(records), all told.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        let held = self.records.iter().filter(|(_, held)| matches!(held, Held::Vertex(_)));
        core::iter::once(VertexId::ROOT).chain(held.map(|(&dot, _)| VertexId(dot)))
    }

    /// The vertices of a type, by dot.
    pub fn vertices_of_type(&self, vertex_type: &str) -> impl Iterator<Item = VertexId> + '_ {
        let id = self.names.find(vertex_type);
        let vertices = id.into_iter().flat_map(|id| {
            self.typed.range(&(id, NONE)).map(|(key, ())| *key).take_while(move |key| key.0 == id)
        });
        vertices.map(|(_, dot)| VertexId(dot))
    }

    /// Whether a vertex is in the graph. `[spec: VIEW-1.1]`
    pub fn has_vertex(&self, vertex: VertexId) -> bool {
        self.is_vertex(vertex.0)
    }

    /// A vertex's record; `None` for the root and for what is not in the graph.
    pub fn vertex(&self, vertex: VertexId) -> Option<Vertex> {
        if let Some(Record::Vertex(vertex)) = self.record(vertex.0) { Some(vertex) } else { None }
    }

    /// The vertex that a name finds. O(log n + vertices of that name). `[spec: VIEW-7]`
    pub fn vertex_by_name(&self, name: &str) -> Option<VertexId> {
        if is_root_name(name) {
            return Some(VertexId::ROOT);
        }
        self.namesakes(name).map(|(dot, vertex)| (vertex.stamp, dot)).min().map(|(_, dot)| VertexId(dot))
    }

    fn shown_edge(&self, dot: Dot) -> Option<&HeldEdge> {
        self.edge_held(dot).filter(|edge| edge.status == Status::Shown)
    }

    /// Every edge shown, by dot. O(records), all told.
    pub fn edges(&self) -> impl Iterator<Item = (EdgeId, Edge)> + '_ {
        self.records.iter().filter_map(|(&dot, held)| match held {
            Held::Edge(edge) if edge.status == Status::Shown => Some((EdgeId(dot), self.edge_of(edge))),
            _ => None,
        })
    }

    fn edge_of(&self, edge: &HeldEdge) -> Edge {
        let EdgeKey { from, to, label } = self.key_of(edge);
        Edge { from, to, label, stamp: edge.stamp }
    }

    /// An edge shown.
    pub fn edge(&self, id: EdgeId) -> Option<Edge> {
        self.shown_edge(id.0).map(|edge| self.edge_of(edge))
    }

    /// The instance shown under a key. O(log n + claims of its register).
    pub fn edge_by_key(&self, key: &EdgeKey) -> Option<EdgeId> {
        let label = self.names.find(&key.label)?;
        let claims = self.claims_on(self.register_at(key.from.0, label, key.to.0));
        let mut shown = claims.filter(|&dot| {
            self.shown_edge(dot).is_some_and(|edge| (edge.from, edge.to) == (key.from.0, key.to.0))
        });
        shown.next().map(EdgeId)
    }

    /// The edges shown of a label, by dot.
    pub fn edges_of_label(&self, label: &str) -> impl Iterator<Item = EdgeId> + '_ {
        let id = self.names.find(label);
        let claims = id.into_iter().flat_map(|id| {
            self.labelled.range(&(id, NONE)).map(|(key, ())| *key).take_while(move |key| key.0 == id)
        });
        claims.filter(|&(_, dot)| self.shown_edge(dot).is_some()).map(|(_, dot)| EdgeId(dot))
    }

    /// The edges shown that leave or enter a vertex, in no order to rely on.
    pub fn edges_at_vertex(&self, vertex: VertexId) -> impl Iterator<Item = (EdgeId, Edge)> + '_ {
        self.edges_at(vertex.0).filter_map(|dot| Some((EdgeId(dot), self.edge_of(self.shown_edge(dot)?))))
    }

    /// Where a vertex stands in the kinematic tree; `None` if it is not in the graph. `[spec: VIEW-4]`
    pub fn placement(&self, vertex: VertexId) -> Option<Placement> {
        if vertex.is_root() {
            return Some(Placement::Root);
        }
        let held = self.vertex_held(vertex.0)?;
        Some(match self.parent_edge(vertex.0) {
            Some((dot, edge)) => Placement::Child { parent: VertexId(edge.from), edge: EdgeId(dot) },
            None if held.children > 0 => Placement::Detached,
            None => Placement::Outside,
        })
    }

    /// Vertices that only a repair holds, in order. `[spec: VIEW-5]`
    pub fn stranded(&self) -> Vec<VertexId> {
        let detached = self.detached.iter().map(|(&dot, ())| dot);
        let mut stranded: Vec<VertexId> =
            detached.chain(self.strays.iter().map(|(&dot, _)| dot)).map(VertexId).collect();
        stranded.sort_unstable();
        stranded.dedup();
        stranded
    }

    /// The winning write of an attribute. `[spec: VIEW-8]`
    pub fn attribute(&self, target: impl Into<Dot>, name: &str) -> Option<(Dot, Write)> {
        self.attribute_writes(target, name).into_iter().next()
    }

    /// Every write shown of an attribute, the winner first. `[spec: VIEW-8]`
    pub fn attribute_writes(&self, target: impl Into<Dot>, name: &str) -> Vec<(Dot, Write)> {
        let target = target.into();
        let Some(id) = self.names.find(name) else { return Vec::new() };
        let shown = self.writes_of(target, id).filter(|(_, write)| write.exposure == Exposure::Shown);
        let mut writes: Vec<(Dot, Write)> = shown
            .map(|(dot, write)| {
                let (value, timestamp_ns, stamp) = (write.value.clone(), write.timestamp_ns, write.stamp);
                (dot, Write { target, name: self.names.name(id), value, timestamp_ns, stamp })
            })
            .collect();
        writes.sort_unstable_by_key(|(dot, write)| core::cmp::Reverse((write.stamp, *dot)));
        writes
    }

    /// What is repaired, in order. `[spec: VIEW-9]`
    pub fn repairs(&self) -> impl Iterator<Item = &Repair> + '_ {
        self.repairs.iter().map(|(repair, ())| repair)
    }

    /// The state: equal to the one that the readable reference has joined from the same deltas. O(records);
    /// payloads are shared.
    pub fn state(&self) -> State {
        let records =
            self.records.iter().filter_map(|(&dot, held)| Some((dot, self.record_from(dot, held)?)));
        State::assemble(records, self.context().clone())
    }

    /// The canonical bytes of the state. `[spec: ENC-1]`
    pub fn encode(&self) -> Vec<u8> {
        crate::codec::encode(&self.state())
    }

    /// The digest of the state. O(records + runs). `[spec: SYNC-1]`
    pub fn digest(&self) -> Digest {
        let live = crate::context::runs_of(self.records.iter().map(|(&dot, _)| dot));
        Digest { context: self.context().clone(), live: live.collect() }
    }

    /// The fingerprint of the state. O(records + runs). `[spec: SYNC-4]`
    pub fn fingerprint(&self) -> Fingerprint {
        self.digest().fingerprint()
    }

    /// The least delta that brings the owner of a digest up to date. O((what they lack + runs) · log n).
    /// `[spec: SYNC-3]`
    pub fn delta_for(&self, theirs: &Digest) -> Delta {
        let mut delta = Delta::new();
        for missed in self.context.unseen_runs_by(&theirs.context) {
            delta.observe(missed);
            for dot in self.held_in(missed) {
                if let Some(record) = self.record(dot) {
                    delta.insert(dot, record);
                }
            }
        }
        for live in &theirs.live {
            for seen in self.context.runs_within(*live) {
                for dead in seen.without(self.held_in(seen).map(|dot| (dot.sequence, dot.sequence))) {
                    delta.observe(dead);
                }
            }
        }
        delta
    }
}
