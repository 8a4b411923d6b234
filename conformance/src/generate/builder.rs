//! A case, written while the core carries it out.

use crate::case::Step;
use crate::core_adapter::{Handles, shown};
use crate::protocol::{EdgeName, Link, Mutation, ROOT, ReplicaName, Tagged, Unique, View};
use dsr_core::{
    AttributeMap, Author, Delta, Dictionary, EdgeKey, ElementId, Mutation as CoreMutation, MutationError,
    ReplicaId, State, VertexId, VertexLink, delta_for, digest, view,
};
use std::collections::BTreeMap;

/// Why a step cannot be written.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum CannotWrite {
    /// The core refuses it.
    #[error("{replica} refuses: {why}")]
    Refused {
        /// Who.
        replica: String,
        /// Why.
        why: MutationError,
    },
    /// A mutation names a vertex that no step has made.
    #[error("no step makes the vertex {vertex}")]
    Vertex {
        /// The vertex.
        vertex: VertexId,
    },
    /// A mutation names an edge that its author does not hold.
    #[error("no edge {edge} is held")]
    Edge {
        /// The edge.
        edge: ElementId,
    },
    /// A replica has no dots left, or no incarnation.
    #[error("{replica} can make nothing any more")]
    Exhausted {
        /// Who.
        replica: String,
    },
    /// The checker does not enumerate histories as it should.
    #[error("the checker fails: {what}")]
    History {
        /// How.
        what: String,
    },
    /// No step has named this delta.
    #[error("no step makes the delta {delta:?}")]
    Delta {
        /// Its name.
        delta: String,
    },
}

/// The steps of a case, and the replicas as the core has them after these.
#[derive(Clone, Debug)]
pub struct Builder {
    dictionary: Dictionary,
    replicas: Vec<Replica>,
    handles: Handles,
    deltas: BTreeMap<String, Delta>,
    /// What has been written.
    pub steps: Vec<Step>,
}

#[derive(Clone, Debug)]
struct Replica {
    name: ReplicaName,
    id: ReplicaId,
    state: State,
}

impl Builder {
    /// Empty replicas with these identities, named `a`, `b` and so on in their order; they share a dictionary.
    pub fn new(replicas: &[ReplicaId], dictionary: Dictionary) -> Self {
        let named = replicas.iter().zip('a'..='z');
        let replica =
            |(&id, name): (&ReplicaId, char)| Replica { name: name.into(), id, state: State::new() };
        Self {
            dictionary,
            replicas: named.map(replica).collect(),
            handles: Handles::default(),
            deltas: BTreeMap::new(),
            steps: Vec::new(),
        }
    }

    /// The replicas' names.
    pub fn names(&self) -> Vec<ReplicaName> {
        self.replicas.iter().map(|replica| replica.name.clone()).collect()
    }

    /// A replica's name.
    pub fn name(&self, replica: usize) -> ReplicaName {
        self.replicas[replica].name.clone()
    }

    /// A replica's state.
    pub fn state(&self, replica: usize) -> &State {
        &self.replicas[replica].state
    }

    /// Makes mutations as one group, whose delta gets a name.
    pub fn mutate(
        &mut self,
        replica: usize,
        mutations: &[CoreMutation],
        delta: &str,
    ) -> Result<(), CannotWrite> {
        let Replica { name, id, state } = self.replicas[replica].clone();
        let (mut after, mut whole, mut written) = (state, Delta::new(), Vec::new());
        let mut handles = self.handles.clone();
        for mutation in mutations {
            let seen = view(&after, &self.dictionary);
            let made = mutation.delta(&seen, Author::new(id));
            let made = made.map_err(|why| CannotWrite::Refused { replica: name.clone(), why })?;
            if let CoreMutation::AddVertex { vertex, .. } = mutation {
                let exhausted = || CannotWrite::Exhausted { replica: name.clone() };
                let dot = after.next_dot(id).ok_or_else(exhausted)?;
                handles.name_after(&vertex.name, VertexId(dot));
            }
            written.push(Words { handles: &handles, state: &after, next: after.next_dot(id) }.of(mutation)?);
            after.join(&made);
            whole.join(&made);
        }
        self.handles = handles;
        self.replicas[replica].state = after;
        self.deltas.insert(delta.into(), whole);
        self.steps.push(Step::Mutate { replica: name, mutations: written, r#as: Some(delta.into()) });
        Ok(())
    }

    /// A delta arrives.
    pub fn deliver(&mut self, replica: usize, delta: &str) -> Result<(), CannotWrite> {
        let Some(made) = self.deltas.get(delta) else {
            return Err(CannotWrite::Delta { delta: delta.into() });
        };
        self.replicas[replica].state.join(made);
        self.steps.push(Step::Deliver { replica: self.name(replica), delta: delta.into() });
        Ok(())
    }

    /// A replica makes the delta that another lacks.
    pub fn answer(&mut self, from: usize, to: usize, delta: &str) {
        let made = delta_for(self.state(from), &digest(self.state(to)));
        self.deltas.insert(delta.into(), made);
        self.steps.push(Step::Answer { from: self.name(from), to: self.name(to), r#as: delta.into() });
    }

    /// A replica restarts.
    pub fn restart(&mut self, replica: usize, keeps: bool) -> Result<(), CannotWrite> {
        let name = self.name(replica);
        let this = &mut self.replicas[replica];
        this.id = this.id.next_incarnation().ok_or(CannotWrite::Exhausted { replica: name.clone() })?;
        if !keeps {
            this.state = State::new();
        }
        self.steps.push(Step::Restart { replica: name, keeps });
        Ok(())
    }

    /// What a replica shows.
    pub fn shown(&self, replica: usize) -> View {
        shown(&view(self.state(replica), &self.dictionary), &self.handles)
    }

    /// A replica must show what the core does.
    pub fn expect_view(&mut self, replica: usize) {
        let view = self.shown(replica).canonical();
        self.steps.push(Step::Expect { replica: self.name(replica), view });
    }

    /// Replicas must show the same.
    pub fn expect_equal(&mut self, replicas: &[usize]) {
        let replicas = replicas.iter().map(|&replica| self.name(replica)).collect();
        self.steps.push(Step::ExpectEqual { replicas });
    }
}

/// Mutations with handles in the place of dots.
struct Words<'w> {
    handles: &'w Handles,
    state: &'w State,
    next: Option<dsr_core::Dot>,
}

impl Words<'_> {
    fn vertex(&self, vertex: VertexId) -> Result<String, CannotWrite> {
        self.handles.given(vertex).ok_or(CannotWrite::Vertex { vertex })
    }

    fn edge(&self, key: &EdgeKey) -> Result<EdgeName, CannotWrite> {
        let (from, to) = (self.vertex(key.from)?, self.vertex(key.to)?);
        Ok(EdgeName { from, label: key.label.to_string(), to })
    }

    fn of(&self, mutation: &CoreMutation) -> Result<Mutation, CannotWrite> {
        Ok(match mutation {
            CoreMutation::AddVertex { vertex, link } => Mutation::AddVertex {
                r#as: self.next.map_or_else(|| Ok(ROOT.into()), |dot| self.vertex(VertexId(dot)))?,
                r#type: vertex.vertex_type.to_string(),
                name: vertex.name.to_string(),
                attributes: tagged(&vertex.attributes),
                link: self.link(link)?,
            },
            CoreMutation::AddEdge { key, attributes } => {
                let EdgeName { from, label, to } = self.edge(key)?;
                Mutation::AddEdge { from, label, to, attributes: tagged(attributes) }
            }
            CoreMutation::UpdateAttributes { target, updates } => {
                let (vertex, edge) = match *target {
                    ElementId::Vertex(vertex) => (Some(self.vertex(vertex)?), None),
                    ElementId::Edge(edge) => {
                        let held = self.state.edge(edge.0).ok_or(CannotWrite::Edge { edge: *target })?;
                        (None, Some(self.edge(&EdgeKey::new(held.from, &held.label, held.to))?))
                    }
                };
                let update = |(name, value): (&dsr_core::Name, &Option<dsr_core::Value>)| {
                    (name.to_string(), value.clone().map(Tagged))
                };
                Mutation::UpdateAttributes {
                    vertex,
                    edge,
                    attributes: Unique(updates.iter().map(update).collect()),
                }
            }
            CoreMutation::RemoveEdge { key } => {
                let EdgeName { from, label, to } = self.edge(key)?;
                Mutation::RemoveEdge { from, label, to }
            }
            CoreMutation::MoveEdge { from, to, attributes } => Mutation::MoveEdge {
                old: self.edge(from)?,
                new: self.edge(to)?,
                attributes: tagged(attributes),
            },
            CoreMutation::RemoveVertex { vertex } => Mutation::RemoveVertex { vertex: self.vertex(*vertex)? },
        })
    }

    fn link(&self, link: &VertexLink) -> Result<Link, CannotWrite> {
        let other = Some(self.vertex(link.other)?);
        let (from, to) = if link.outgoing { (None, other) } else { (other, None) };
        Ok(Link { from, label: link.label.to_string(), to, attributes: tagged(&link.attributes) })
    }
}

fn tagged(attributes: &AttributeMap) -> Unique<Tagged> {
    Unique(attributes.iter().map(|(name, value)| (name.to_string(), Tagged(value.clone()))).collect())
}
