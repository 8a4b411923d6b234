//! crdts (rust-crdt).

use crate::error::{Result, not_the_job};
use crate::scene::{Content, Link, Plan, Scene};
use crdts::{CmRDT, CvRDT, MVReg, Map, Orswot};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::Arc;

/// What registers hold.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
enum Held {
    Vertex { name: Arc<str>, parent: Option<Id> },
    Double(f64),
    Bytes(#[serde(with = "payload")] Arc<[u8]>),
}

/// Bytes as bytes, not one by one.
mod payload {
    use serde::{Deserializer, Serializer};
    use std::sync::Arc;

    pub(super) fn serialize<S: Serializer>(bytes: &Arc<[u8]>, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(bytes)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Arc<[u8]>, D::Error> {
        serde_bytes::deserialize::<&[u8], D>(deserializer).map(Arc::from)
    }
}

/// Who has added a vertex, and the how manyth of theirs it is.
type Id = (u16, u32);
type Vertex = Map<u8, MVReg<Held, u16>, u16>;
type Vertices = Map<Id, Vertex, u16>;
type Edges = Orswot<(Id, Id), u16>;

/// The registers of a vertex.
const SELF: u8 = 0;
const LEVEL: u8 = 1;

#[derive(Serialize, Deserialize)]
enum Operation {
    Vertices(<Vertices as CmRDT>::Op),
    Edges(<Edges as CmRDT>::Op),
}

/// The state of a replica.
#[derive(Clone, Default, Debug, Serialize, Deserialize)]
pub struct Whole {
    vertices: Vertices,
    edges: Edges,
}

/// A replica made of parts of crdts.
#[derive(Debug)]
pub struct Crdts {
    replica: u16,
    whole: Whole,
    vertices: Vec<Id>,
    added: u32,
}

impl Crdts {
    fn put(&self, vertex: Id, register: u8, held: Held) -> <Vertices as CmRDT>::Op {
        let vertices = &self.whole.vertices;
        let context = vertices.read_ctx().derive_add_ctx(self.replica);
        vertices.update(vertex, context, |vertex, context| {
            vertex.update(register, context, |register, context| register.write(held, context))
        })
    }

    fn level(&self, vertex: usize, value: &Content) -> <Vertices as CmRDT>::Op {
        let held = match value {
            Content::Double(number) => Held::Double(*number),
            Content::Bytes(bytes) => Held::Bytes(bytes.clone()),
        };
        self.put(self.vertices[vertex], LEVEL, held)
    }

    /// Carries out an operation; its bytes.
    fn encoded(&mut self, operation: Operation) -> Result<Vec<u8>> {
        let bytes = postcard::to_allocvec(&operation)?;
        self.carry_out(operation);
        Ok(bytes)
    }

    fn carry_out(&mut self, operation: Operation) {
        match operation {
            Operation::Vertices(operation) => self.whole.vertices.apply(operation),
            Operation::Edges(operation) => self.whole.edges.apply(operation),
        }
    }

    /// A vertex of the next id; it is told by the next place.
    fn addition(&mut self, name: &str, parent: Option<usize>) -> Operation {
        let vertex = (self.replica, self.added);
        let parent = parent.map(|parent| self.vertices[parent]);
        self.added += 1;
        self.vertices.push(vertex);
        Operation::Vertices(self.put(vertex, SELF, Held::Vertex { name: name.into(), parent }))
    }
}

impl Scene for Crdts {
    const NAME: &'static str = "crdts";
    const MAPPING: &'static str = "`Map` by id of `Map` of `MVReg`: one register for name and parent, one for the \
        attribute; edges as an `Orswot` of pairs. The crate encodes nothing; operations are encoded by postcard, the \
        fastest serde format that we know. No tree, no graph, no delivery out of order: operations of one replica must \
        come in order, once.";

    fn empty(replica: u16) -> Result<Self> {
        Ok(Self { replica, whole: Whole::default(), vertices: Vec::new(), added: 0 })
    }

    fn populate(&mut self, plan: &Plan) -> Result<()> {
        for (name, parent) in plan.names.iter().zip(&plan.parents) {
            let operation = self.addition(name, *parent);
            self.carry_out(operation);
        }
        Ok(())
    }

    fn save(&mut self) -> Result<Vec<u8>> {
        Ok(postcard::to_allocvec(&self.whole)?)
    }

    fn load(replica: u16, bytes: &[u8]) -> Result<Self> {
        let whole: Whole = postcard::from_bytes(bytes)?;
        Ok(Self { replica, whole, vertices: Vec::new(), added: 0 })
    }

    fn again(&mut self) -> Result<Self> {
        let Self { replica, added, .. } = *self;
        Ok(Self { replica, whole: self.whole.clone(), vertices: self.vertices.clone(), added })
    }

    fn find(&mut self, plan: &Plan) -> Result<()> {
        let mut found = BTreeMap::new();
        for entry in self.whole.vertices.iter() {
            let (id, vertex) = entry.val;
            let registers = vertex.get(&SELF).val.map(|register| register.read().val);
            if let Some([Held::Vertex { name, .. }]) = registers.as_deref() {
                found.insert(name.clone(), *id);
            }
        }
        for name in &plan.names {
            let Some(id) = found.get(name.as_str()) else {
                return not_the_job(Self::NAME, format!("{name} to have come"));
            };
            self.vertices.push(*id);
        }
        Ok(())
    }

    fn count(&self) -> Result<usize> {
        Ok(self.whole.vertices.len().val)
    }

    fn set(&mut self, vertex: usize, value: &Content) -> Result<Vec<u8>> {
        let operation = self.level(vertex, value);
        self.encoded(Operation::Vertices(operation))
    }

    fn set_unencoded(&mut self, vertex: usize, value: &Content) -> Result<()> {
        // The operation that is kept is what would be sent.
        let operation = self.level(vertex, value);
        self.whole.vertices.apply(std::hint::black_box(operation.clone()));
        std::hint::black_box(operation);
        Ok(())
    }

    fn read(&self, vertex: usize) -> Result<Option<Content>> {
        let found = self.whole.vertices.get(&self.vertices[vertex]).val;
        let held = found.and_then(|vertex| vertex.get(&LEVEL).val).map(|register| register.read().val);
        Ok(match held.as_deref() {
            Some([Held::Double(number)]) => Some(Content::Double(*number)),
            Some([Held::Bytes(bytes)]) => Some(Content::Bytes(bytes.clone())),
            _ => None,
        })
    }

    fn add_vertex(&mut self, name: &str, parent: usize) -> Result<Vec<u8>> {
        let operation = self.addition(name, Some(parent));
        self.encoded(operation)
    }

    fn remove_last_vertex(&mut self, _name: &str) -> Result<Vec<u8>> {
        let Some(vertex) = self.vertices.pop() else { return not_the_job(Self::NAME, "a vertex to remove") };
        // As its guide has it: the clock of the entry that was read.
        let context = self.whole.vertices.get(&vertex).derive_rm_ctx();
        let operation = self.whole.vertices.rm(vertex, context);
        self.encoded(Operation::Vertices(operation))
    }

    fn add_edge(&mut self, link: &Link) -> Result<Vec<u8>> {
        let edges = &self.whole.edges;
        let context = edges.read_ctx().derive_add_ctx(self.replica);
        let operation = edges.add((self.vertices[link.from], self.vertices[link.to]), context);
        self.encoded(Operation::Edges(operation))
    }

    fn remove_edge(&mut self, link: &Link) -> Result<Vec<u8>> {
        let (edges, pair) = (&self.whole.edges, (self.vertices[link.from], self.vertices[link.to]));
        let operation = edges.rm(pair, edges.contains(&pair).derive_rm_ctx());
        self.encoded(Operation::Edges(operation))
    }

    fn has_edge(&self, link: &Link) -> Result<bool> {
        Ok(self.whole.edges.contains(&(self.vertices[link.from], self.vertices[link.to])).val)
    }

    fn apply(&mut self, message: &[u8]) -> Result<()> {
        self.carry_out(postcard::from_bytes(message)?);
        Ok(())
    }

    type Whole = Whole;

    fn whole(&mut self) -> Result<Whole> {
        Ok(self.whole.clone())
    }

    fn merge(&mut self, other: Whole) -> Result<()> {
        self.whole.vertices.merge(other.vertices);
        self.whole.edges.merge(other.edges);
        Ok(())
    }
}
