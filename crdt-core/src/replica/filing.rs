//! Records go into every index and out of every index, and come back as they were. `[spec: STATE-6]`

use super::graph::{Graph, hash_of};
use super::held::{Exposure, Held, HeldEdge, HeldVertex, HeldWrite, Link, NONE, Status, WriteAt, mix};
use super::settle::Came;
use crate::dot::{Dot, VertexId};
use crate::mutation::is_root_name;
use crate::record::{Edge, Record, Vertex, Write};
use alloc::vec::Vec;

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

impl Graph {
    /// Files a record in every index, shown as nothing yet.
    pub(super) fn file(&mut self, dot: Dot, record: &Record) -> Came {
        let (held, came) = match record {
            Record::Vertex(vertex) => {
                // Beside the filing of the name, which looks at the same place.
                let is_alone = !is_root_name(&vertex.name) && !self.is_named(&vertex.name);
                (Held::Vertex(self.file_vertex(dot, vertex)), Came::Vertex { is_alone })
            }
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
        self.count_stamp(record.stamp());
        came
    }

    /// One more record of a stamp.
    pub(super) fn count_stamp(&mut self, stamp: u64) {
        self.stamps.upsert(stamp, 1, |count| *count += 1);
    }

    /// One record less of a stamp.
    pub(super) fn discount_stamp(&mut self, stamp: u64) {
        self.stamps.remove_if(&stamp, |count| {
            *count -= 1;
            *count == 0
        });
    }

    /// Whether records can be anchored to a dot: the root, a vertex, an edge.
    fn is_element(&self, dot: Dot) -> bool {
        dot == NONE || matches!(self.records.get(&dot), Some(Held::Vertex(_) | Held::Edge(_)))
    }

    /// What waited for a dot has found it.
    fn settle_down(&mut self, dot: Dot) {
        if !self.loose.is_empty() {
            let waiting: Vec<Dot> = self.loose_at(dot).collect();
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
        let left: Vec<Dot> = edges.collect();
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
        let held = HeldEdge { from, to, label, status: Status::Invisible, stamp };
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
            exposure: Exposure::Invisible,
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
        self.discount_stamp(stamp);
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
}
