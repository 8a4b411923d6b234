//! Ours.

use crate::error::{BenchError, Result, not_the_job};
use crate::scene::{Content, Link, Plan, Reconciles, Scene, Tree};
use dsr_core::{
    AttributeMap, AttributeUpdates, Delta, Dictionary, EdgeKey, ElementId, Mutation, Name, NewVertex, RT,
    Replica, ReplicaId, State, Value, VertexId, VertexLink, decode, decode_digest, encode, encode_digest,
};

/// A wall clock's reading, as writes carry it: it takes 9 bytes.
const CLOCK_NS: u64 = 1_764_075_600_123_456_789;

/// A replica of dsr-core.
#[derive(Debug)]
pub struct Dsr {
    replica: Replica,
    vertices: Vec<VertexId>,
    parents: Vec<Option<usize>>,
    attribute: Name,
}

/// A value as dsr-core has it; payloads are shared.
fn value(content: &Content) -> Value {
    match content {
        Content::Double(number) => Value::Double(*number),
        Content::Bytes(bytes) => Value::ByteVec(bytes.clone()),
    }
}

impl Dsr {
    fn mutate(&mut self, mutation: &Mutation) -> Result<Delta> {
        Ok(self.replica.mutate(mutation, CLOCK_NS)?.delta)
    }

    fn update(&self, vertex: usize, content: &Content) -> Mutation {
        let updates = AttributeUpdates::from([(self.attribute.clone(), Some(value(content)))]);
        Mutation::UpdateAttributes { target: ElementId::Vertex(self.vertices[vertex]), updates }
    }

    fn at(&self, parent: Option<usize>) -> VertexId {
        parent.map_or(VertexId::ROOT, |parent| self.vertices[parent])
    }

    fn addition(&self, name: &str, parent: Option<usize>) -> Mutation {
        let link = VertexLink::child_of(self.at(parent));
        Mutation::AddVertex { vertex: NewVertex::new("thing", name), link }
    }

    fn movement(&mut self, vertex: usize, parent: usize) -> Mutation {
        let child = self.vertices[vertex];
        let from = EdgeKey::new(self.at(self.parents[vertex]), RT, child);
        let to = EdgeKey::new(self.vertices[parent], RT, child);
        self.parents[vertex] = Some(parent);
        Mutation::MoveEdge { from, to, attributes: AttributeMap::new() }
    }

    fn add(&mut self, name: &str, parent: Option<usize>) -> Result<Delta> {
        let delta = self.mutate(&self.addition(name, parent))?;
        let Some((dot, _)) = delta.records().next() else {
            return not_the_job(Self::NAME, "a vertex to be in the delta that adds it");
        };
        self.vertices.push(VertexId(dot));
        self.parents.push(parent);
        Ok(delta)
    }

    fn key(&self, link: &Link) -> EdgeKey {
        EdgeKey::new(self.vertices[link.from], "near", self.vertices[link.to])
    }

    /// The replica itself.
    pub fn replica(&mut self) -> &mut Replica {
        &mut self.replica
    }

    /// Carries out any mutation; its delta as bytes.
    pub fn encoded(&mut self, mutation: &Mutation) -> Result<Vec<u8>> {
        Ok(encode(&self.mutate(mutation)?))
    }

    /// Sets an attribute without a clock's reading; the delta as bytes.
    pub fn set_without_clock(&mut self, vertex: usize, content: &Content) -> Result<Vec<u8>> {
        let mutation = self.update(vertex, content);
        Ok(encode(&self.replica.mutate(&mutation, 0)?.delta))
    }

    /// A vertex by its place.
    pub fn vertex(&self, vertex: usize) -> VertexId {
        self.vertices[vertex]
    }
}

impl Scene for Dsr {
    const NAME: &'static str = "dsr";
    const MAPPING: &'static str = "`Replica`: a vertex with type, name and an `RT` edge from its parent; attributes by \
        `update_attributes`; `encode` of the delta, and `decode` before `apply`. Each write carries a clock's reading, \
        and each apply tells what has changed in the view.";

    fn empty(replica: u16) -> Result<Self> {
        let dictionary = Dictionary::open().with_functional("in");
        let replica = Replica::new(ReplicaId::agent(u32::from(replica)), dictionary);
        Ok(Self { replica, vertices: Vec::new(), parents: Vec::new(), attribute: "level".into() })
    }

    fn populate(&mut self, plan: &Plan) -> Result<()> {
        for (name, parent) in plan.names.iter().zip(&plan.parents) {
            self.add(name, *parent)?;
        }
        Ok(())
    }

    fn save(&mut self) -> Result<Vec<u8>> {
        Ok(self.replica.encode())
    }

    fn load(replica: u16, bytes: &[u8]) -> Result<Self> {
        let mut loaded = Self::empty(replica)?;
        loaded.apply(bytes)?;
        Ok(loaded)
    }

    fn again(&mut self) -> Result<Self> {
        // A clone would share the nodes of its maps, and pay for it at its first writes.
        let mut again = Self::empty(0)?;
        again.replica = Replica::new(self.replica.id(), self.replica.dictionary().clone());
        again.replica.apply(&self.replica.state());
        (again.vertices, again.parents) = (self.vertices.clone(), self.parents.clone());
        Ok(again)
    }

    fn find(&mut self, plan: &Plan) -> Result<()> {
        for (name, parent) in plan.names.iter().zip(&plan.parents) {
            let found = self.replica.vertex_by_name(name);
            let missing =
                || BenchError::NotTheJob { library: Self::NAME, what: format!("{name} to have come") };
            self.vertices.push(found.ok_or_else(missing)?);
            self.parents.push(*parent);
        }
        Ok(())
    }

    fn count(&self) -> Result<usize> {
        // The root is none of the plan's.
        Ok(self.replica.vertices().count() - 1)
    }

    fn set(&mut self, vertex: usize, value: &Content) -> Result<Vec<u8>> {
        Ok(encode(&self.mutate(&self.update(vertex, value))?))
    }

    fn set_unencoded(&mut self, vertex: usize, value: &Content) -> Result<()> {
        std::hint::black_box(self.mutate(&self.update(vertex, value))?);
        Ok(())
    }

    fn read(&self, vertex: usize) -> Result<Option<Content>> {
        let found = self.replica.attribute(self.vertices[vertex], &self.attribute);
        Ok(found.and_then(|(_, write)| match write.value {
            Value::Double(number) => Some(Content::Double(number)),
            Value::ByteVec(bytes) => Some(Content::Bytes(bytes)),
            _ => None,
        }))
    }

    fn add_vertex(&mut self, name: &str, parent: usize) -> Result<Vec<u8>> {
        Ok(encode(&self.add(name, Some(parent))?))
    }

    fn remove_last_vertex(&mut self, _name: &str) -> Result<Vec<u8>> {
        self.parents.pop();
        let Some(vertex) = self.vertices.pop() else {
            return not_the_job(Self::NAME, "a vertex to remove");
        };
        Ok(encode(&self.mutate(&Mutation::RemoveVertex { vertex })?))
    }

    fn add_edge(&mut self, link: &Link) -> Result<Vec<u8>> {
        let mutation = Mutation::AddEdge { key: self.key(link), attributes: AttributeMap::new() };
        Ok(encode(&self.mutate(&mutation)?))
    }

    fn remove_edge(&mut self, link: &Link) -> Result<Vec<u8>> {
        Ok(encode(&self.mutate(&Mutation::RemoveEdge { key: self.key(link) })?))
    }

    fn has_edge(&self, link: &Link) -> Result<bool> {
        Ok(self.replica.edge_by_key(&self.key(link)).is_some())
    }

    fn apply(&mut self, message: &[u8]) -> Result<()> {
        std::hint::black_box(self.replica.apply(&decode(message)?));
        Ok(())
    }

    type Whole = State;

    fn whole(&mut self) -> Result<State> {
        Ok(self.replica.state())
    }

    fn merge(&mut self, other: State) -> Result<()> {
        std::hint::black_box(self.replica.apply(&other));
        Ok(())
    }
}

impl Reconciles for Dsr {
    fn digest(&mut self) -> Result<Vec<u8>> {
        Ok(encode_digest(&self.replica.digest()))
    }

    fn missing(&mut self, digest: &[u8]) -> Result<Vec<u8>> {
        Ok(encode(&self.replica.delta_for(&decode_digest(digest)?)))
    }
}

impl Tree for Dsr {
    fn move_below(&mut self, vertex: usize, parent: usize) -> Result<Vec<u8>> {
        let mutation = self.movement(vertex, parent);
        Ok(encode(&self.mutate(&mutation)?))
    }

    fn move_unencoded(&mut self, vertex: usize, parent: usize) -> Result<()> {
        let mutation = self.movement(vertex, parent);
        std::hint::black_box(self.mutate(&mutation)?);
        Ok(())
    }

    fn depth(&self, vertex: usize) -> Result<usize> {
        let (mut at, mut depth) = (self.vertices[vertex], 0);
        while let Some(dsr_core::Placement::Child { parent, .. }) = self.replica.placement(at) {
            (at, depth) = (parent, depth + 1);
        }
        // The root is none of the plan's.
        Ok(depth - 1)
    }
}
