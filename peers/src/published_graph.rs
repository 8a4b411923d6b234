//! The graph in the published Deep State Representation, as the checker has it: [`dsr_model::published`] is written from
//! a description of what that implementation does, mistakes included.
//!
//! **Layout.** A vertex is a node; the root is a node that an agent loaded, who has left. A node has its attributes and the
//! edges that start at it. The published system writes attributes of its own, `parent` and `level` of nodes and `rt` of
//! kinematic edges; so users' names are kept apart from these by a prefix, and those of the system are not shown. Of the
//! fourteen types no rule of the published system looks into any: each value has a number.
//!
//! **Mutations** are calls, as a careful user makes them, who fills in who an element is from. `add_vertex` inserts a node, and
//! places it below its parent, or assigns the other edge. `update_attributes` gets a node, changes it and updates it; an edge
//! is assigned anew with all its attributes. `remove_edge` deletes an edge; `move_edge` deletes one and assigns or places
//! another. `remove_vertex` deletes a node, which deletes the edges that end at it.
//!
//! **Messages** are those that the calls send, in one piece and in their order; clocks are right. (The published network
//! splits and reorders them, which the checker's gallery explores.)  What another replica lacks is asked by the only means
//! that there is: the whole graph, as the server of a joiner sends it.
//!
//! **Reading** takes what the registers hold. A replica whose process would end, because an assertion fails, replies an
//! error from then on. `restart` is not announced: a replica has no storage. Nor is `dictionary`: labels and types are as they
//! come.

mod intern;

use crate::edit::{Edit, Target};
use crate::graph::{Attributes, Graph, Vertex};
use crate::replica::{Identity, Message, Replica};
use dsr_conformance::protocol::{EdgeName, Feature, Implementation, ROOT};
use dsr_core::{Dictionary, RT};
use dsr_model::published::suite::Held;
use dsr_model::published::{
    AgentId, Attribute, Crash, Key, Message as Sent, NOBODY, Operation, Replica as Published, Stamps, Value,
    Variant, Workers,
};
use intern::{name, node, number, text, value};
use std::collections::BTreeMap;

/// The agent that loaded the root, and has left.
const LOADER: AgentId = AgentId::MAX - 1;
/// What users' names of attributes begin with.
const PREFIX: &str = "user:";

/// Which of the published implementations.
pub trait Edition: std::fmt::Debug + Clone {
    /// Its name.
    const NAME: &'static str;
    /// How many threads apply what arrives.
    const WORKERS: Workers;
}

/// The published system.
#[derive(Clone, Copy, Debug)]
pub struct Upstream;

impl Edition for Upstream {
    const NAME: &'static str = "published";
    const WORKERS: Workers = Workers::Several;
}

/// Its fork.
#[derive(Clone, Copy, Debug)]
pub struct Fork;

impl Edition for Fork {
    const NAME: &'static str = "published-fork";
    const WORKERS: Workers = Workers::One;
}

/// A replica of the published system.
#[derive(Clone, Debug)]
pub struct PublishedGraph<E> {
    held: Held,
    agent: AgentId,
    edition: std::marker::PhantomData<E>,
}

/// What can go wrong.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum PublishedError {
    /// The process would end.
    #[error("the process ends: {0}")]
    Crash(Crash),
    /// A call returns false or throws.
    #[error("the call {0:?} is refused")]
    Refused(Operation),
}

impl<E: Edition> PublishedGraph<E> {
    fn call(&mut self, operation: Operation) -> Result<Vec<Sent>, PublishedError> {
        self.runs()?;
        let called = self.held.called(self.agent, &operation);
        let (sent, after) = match (called, operation) {
            (Some(called), _) => called,
            // What is as it should be already sends nothing.
            (None, Operation::Set { .. } | Operation::AssignEdge { .. } | Operation::Place { .. })
                if self.takes(&operation) =>
            {
                return Ok(Vec::new());
            }
            (None, _) => return Err(PublishedError::Refused(operation)),
        };
        self.held = after;
        self.runs().map(|()| sent)
    }

    /// Whether a call that sends nothing is not refused: it changes nothing.
    fn takes(&self, operation: &Operation) -> bool {
        let mut trial = self.held.clone();
        trial.replica.agent = self.agent;
        trial.replica.call(operation, self.held.clock + 1).is_ok_and(|sent| sent.is_some())
    }

    fn runs(&self) -> Result<(), PublishedError> {
        self.held.replica.crash.map_or(Ok(()), |crash| Err(PublishedError::Crash(crash)))
    }

    fn write_one(&mut self, edit: &Edit) -> Result<Vec<Sent>, PublishedError> {
        match edit {
            Edit::AddVertex { handle, vertex_type, name: called, attributes, link, link_attributes } => {
                let mut sent = self.call(Operation::InsertNode {
                    id: node(handle),
                    kind: name(vertex_type),
                    name: name(called),
                    attributes: numbers(attributes, &[]),
                })?;
                sent.extend(self.assign(link, link_attributes)?);
                Ok(sent)
            }
            Edit::AddEdge { edge, attributes } => self.assign(edge, attributes),
            Edit::Update { target: Target::Vertex(handle), updates } => {
                let mut sent = Vec::new();
                for (key, update) in updates {
                    let (node, key) = (node(handle), name(&format!("{PREFIX}{key}")));
                    sent.extend(self.call(match update {
                        Some(value) => Operation::Set { node, key, value: number(value) },
                        None => Operation::Remove { node, key },
                    })?);
                }
                Ok(sent)
            }
            Edit::Update { target: Target::Edge(edge), updates } => {
                let mut attributes = self.graph()?.edges.remove(edge).unwrap_or_default();
                for (key, update) in updates {
                    match update {
                        Some(value) => attributes.insert(key.clone(), value.clone()),
                        None => attributes.remove(key),
                    };
                }
                self.assign_as_is(edge, &attributes)
            }
            Edit::RemoveEdge { edge } => self.delete(edge),
            Edit::MoveEdge { old, new, attributes } => {
                let mut sent = self.delete(old)?;
                sent.extend(self.assign(new, attributes)?);
                Ok(sent)
            }
            Edit::RemoveVertex { handle } => self.call(Operation::DeleteNode { node: node(handle) }),
        }
    }

    /// Inserts an edge; a kinematic one by the call that keeps `parent` and `level`.
    fn assign(&mut self, edge: &EdgeName, attributes: &Attributes) -> Result<Vec<Sent>, PublishedError> {
        if edge.label != RT {
            return self.assign_as_is(edge, attributes);
        }
        let (from, to) = (node(&edge.from), node(&edge.to));
        let mut sent = self.call(Operation::Place { from, to, pose: 0 })?;
        if !attributes.is_empty() {
            sent.extend(self.assign_as_is(edge, attributes)?);
        }
        Ok(sent)
    }

    fn assign_as_is(
        &mut self,
        edge: &EdgeName,
        attributes: &Attributes,
    ) -> Result<Vec<Sent>, PublishedError> {
        let own: &[(Key, i64)] = if edge.label == RT { &[("rt", 0)] } else { &[] };
        let (from, to, kind) = (node(&edge.from), node(&edge.to), name(&edge.label));
        self.call(Operation::AssignEdge { from, to, kind, attributes: numbers(attributes, own) })
    }

    fn delete(&mut self, edge: &EdgeName) -> Result<Vec<Sent>, PublishedError> {
        let (from, to, kind) = (node(&edge.from), node(&edge.to), name(&edge.label));
        self.call(Operation::DeleteEdge { from, to, kind })
    }
}

fn numbers(attributes: &Attributes, own: &[(Key, i64)]) -> &'static [(Key, i64)] {
    let users = attributes.iter().map(|(key, value)| (name(&format!("{PREFIX}{key}")), number(value)));
    intern::list(users.chain(own.iter().copied()).collect())
}

/// Users' attributes, of those whose registers hold something.
fn attributes(held: BTreeMap<Key, Option<Attribute>>) -> Attributes {
    let user = held.into_iter().filter_map(|(key, attribute)| {
        let key = key.strip_prefix(PREFIX)?;
        match attribute?.value {
            Value::Number(number) => Some((key.to_owned(), value(number)?)),
            Value::Node(_) => None,
        }
    });
    user.collect()
}

impl<E: Edition> Replica for PublishedGraph<E> {
    type Error = PublishedError;
    type Update = Sent;
    const FEATURES: &'static [Feature] =
        &[Feature::ErrorKinds, Feature::Grouping, Feature::Resynchronisation];

    fn implementation() -> Implementation {
        Implementation {
            name: E::NAME.into(),
            version: "as described".into(),
            language: "C++, modelled in Rust".into(),
            source: "model/src/published".into(),
        }
    }

    fn new(identity: Identity, _: &Dictionary) -> Result<Self, PublishedError> {
        let variant = Variant { workers: E::WORKERS, stamps: Stamps::Author };
        let nobody = Held { replica: Published::new(NOBODY, variant, [].into()), clock: 0 };
        let mut this = Self { held: nobody, agent: LOADER, edition: std::marker::PhantomData };
        this.call(Operation::InsertNode {
            id: node(ROOT),
            kind: "root",
            name: "world",
            attributes: &[("level", 0)],
        })?;
        this.held = this.held.of_nobody();
        this.agent = identity.position;
        Ok(this)
    }

    fn graph(&self) -> Result<Graph, PublishedError> {
        self.runs()?;
        let shown = self.held.replica.shown();
        let mut graph = Graph::default();
        let mut edges = Vec::new();
        for (id, node) in shown {
            let (Some(handle), Some(node)) = (text(id), node) else { continue };
            for ((to, label), edge) in node.edges {
                if let (Some(to), Some(edge)) = (text(to), edge) {
                    let name = EdgeName { from: handle.into(), label: label.into(), to: to.into() };
                    edges.push((name, attributes(edge.attributes)));
                }
            }
            if handle == ROOT {
                graph.root = attributes(node.attributes);
            } else {
                let (vertex_type, name) = (node.kind.to_owned(), node.name.to_string());
                let vertex = Vertex { vertex_type, name, attributes: attributes(node.attributes) };
                graph.vertices.insert(handle.into(), vertex);
            }
        }
        for (edge, attributes) in edges {
            graph.show(edge, attributes);
        }
        Ok(graph)
    }

    fn trial(&self) -> Result<Self, PublishedError> {
        Ok(self.clone())
    }

    fn write(&mut self, edits: &[Edit]) -> Result<Message<Sent>, PublishedError> {
        let sent = edits.iter().map(|edit| self.write_one(edit)).collect::<Result<Vec<_>, _>>()?;
        Ok(sent.into_iter().flatten().collect())
    }

    fn deliver(&mut self, message: &Message<Sent>) -> Result<(), PublishedError> {
        self.held = self.held.received(message);
        Ok(())
    }

    fn missing(&self, _: &Self) -> Result<Message<Sent>, PublishedError> {
        self.runs()?;
        Ok(vec![self.held.replica.snapshot(self.held.clock)])
    }

    /// Not announced.
    fn restart(&mut self, identity: Identity, _: bool) -> Result<(), PublishedError> {
        *self = Self::new(identity, &Dictionary::default())?;
        Ok(())
    }

    fn refuses(error: &PublishedError) -> bool {
        matches!(error, PublishedError::Refused(_))
    }
}
