//! The scene that all libraries hold, and what each must be able to do with it to take part.

use crate::error::Result;
use std::sync::Arc;

/// A scene to build: vertex 0 is at the top, every other one has an earlier one as its parent.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The names, by vertex.
    pub names: Vec<String>,
    /// The parents, by vertex.
    pub parents: Vec<Option<usize>>,
}

impl Plan {
    /// A tree of `n` vertices, each with up to `fan` children.
    pub fn tree(prefix: &str, n: usize, fan: usize) -> Self {
        Self::of(prefix, n, |at| (at - 1) / fan)
    }

    /// Vertices with the parent that `parent` tells of each but the first.
    pub fn of(prefix: &str, n: usize, parent: impl Fn(usize) -> usize) -> Self {
        let names = (0..n).map(|at| format!("{prefix}{at}")).collect();
        let parents = (0..n).map(|at| (at > 0).then(|| parent(at))).collect();
        Self { names, parents }
    }
}

/// A value of an attribute.
#[derive(Clone, PartialEq, Debug)]
pub enum Content {
    /// One number.
    Double(f64),
    /// A payload, as a sensor hands it over.
    Bytes(Arc<[u8]>),
}

impl Content {
    /// A payload of `n` bytes that no encoding shrinks, another one for each `seed`.
    pub fn payload(n: usize, seed: u64) -> Self {
        let mut noise = crate::noise::Noise::new(seed);
        Self::Bytes((0..n).map(|_| noise.byte()).collect())
    }
}

/// A symbolic edge, with what a library without edges calls it.
#[derive(Clone, Debug)]
pub struct Link {
    /// Where it leaves.
    pub from: usize,
    /// Where it enters.
    pub to: usize,
    /// A key that is its own.
    pub key: String,
}

impl Link {
    /// An edge between two vertices of a plan.
    pub fn new(plan: &Plan, from: usize, to: usize) -> Self {
        Self { from, to, key: format!("{} near {}", plan.names[from], plan.names[to]) }
    }
}

/// A replica of a scene in one library. Vertices are told by their place in the [`Plan`].
pub trait Scene: Sized {
    /// The library.
    const NAME: &'static str;
    /// How the scene is laid out in it, and what of it is used.
    const MAPPING: &'static str;

    /// One that has seen nothing.
    fn empty(replica: u16) -> Result<Self>;
    /// Adds all vertices of a plan, in as few transactions as the library likes best.
    fn populate(&mut self, plan: &Plan) -> Result<()>;
    /// Everything, as bytes for one who joins late.
    fn save(&mut self) -> Result<Vec<u8>>;
    /// One who joins late.
    fn load(replica: u16, bytes: &[u8]) -> Result<Self>;
    /// The same replica once more; the two share nothing.
    fn again(&mut self) -> Result<Self>;
    /// Finds the vertices of a plan that another replica has added, so that they can be told by their place.
    fn find(&mut self, plan: &Plan) -> Result<()>;
    /// How many vertices there are.
    fn count(&self) -> Result<usize>;

    /// Sets an attribute of a vertex; the delta as bytes.
    fn set(&mut self, vertex: usize, value: &Content) -> Result<Vec<u8>>;
    /// Sets an attribute, without making bytes of the delta.
    fn set_unencoded(&mut self, vertex: usize, value: &Content) -> Result<()>;
    /// The attribute.
    fn read(&self, vertex: usize) -> Result<Option<Content>>;
    /// Adds a vertex, to be told by the next place; the delta as bytes.
    fn add_vertex(&mut self, name: &str, parent: usize) -> Result<Vec<u8>>;
    /// Removes the vertex of the last place; the delta as bytes.
    fn remove_last_vertex(&mut self, name: &str) -> Result<Vec<u8>>;
    /// Adds an edge; the delta as bytes.
    fn add_edge(&mut self, link: &Link) -> Result<Vec<u8>>;
    /// Removes an edge; the delta as bytes.
    fn remove_edge(&mut self, link: &Link) -> Result<Vec<u8>>;
    /// Whether an edge is there.
    fn has_edge(&self, link: &Link) -> Result<bool>;

    /// Joins one delta of another replica.
    fn apply(&mut self, message: &[u8]) -> Result<()>;

    /// What is handed to [`merge`](Self::merge): the other replica as the library likes it best.
    type Whole;
    /// The whole of this replica, to be merged elsewhere.
    fn whole(&mut self) -> Result<Self::Whole>;
    /// Joins a whole replica.
    fn merge(&mut self, other: Self::Whole) -> Result<()>;
}

/// A library that finds out what another replica lacks.
pub trait Reconciles: Scene {
    /// What a replica has, as bytes.
    fn digest(&mut self) -> Result<Vec<u8>>;
    /// What one with this digest lacks, as bytes; [`apply`](Scene::apply) takes them.
    fn missing(&mut self, digest: &[u8]) -> Result<Vec<u8>>;
}

/// A library with a tree whose moves are safe: no vertex below itself, whatever is moved concurrently.
pub trait Tree: Scene {
    /// Moves a vertex below another parent; the delta as bytes.
    fn move_below(&mut self, vertex: usize, parent: usize) -> Result<Vec<u8>>;
    /// Moves a vertex below another parent, without making bytes of the delta.
    fn move_unencoded(&mut self, vertex: usize, parent: usize) -> Result<()>;
    /// How many vertices are above one.
    fn depth(&self, vertex: usize) -> Result<usize>;
}
