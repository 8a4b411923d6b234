//! Replicas for the tests of clauses: a state, an author and a dictionary, with short words for the six
//! mutations.

#![allow(dead_code, reason = "each chapter's tests use a part of it")]

use dsr_core::invariant::{check_repairs, check_view};
use dsr_core::{
    AttributeMap, AttributeUpdates, Author, Delta, Dictionary, Dot, EdgeId, EdgeKey, ElementId, Mutation,
    MutationError, NewVertex, RT, ReplicaId, State, Value, VertexId, VertexLink, View, check_well_formed,
    view,
};

pub(crate) const ROOT: VertexId = VertexId::ROOT;

/// One replica.
#[derive(Clone, Debug)]
pub(crate) struct Peer {
    pub(crate) state: State,
    pub(crate) author: Author,
    pub(crate) dictionary: Dictionary,
}

impl Peer {
    pub(crate) fn new(agent: u32) -> Self {
        let author = Author::new(ReplicaId::agent(agent));
        Self { state: State::new(), author, dictionary: Dictionary::open().with_functional("in") }
    }

    /// Another replica that has received everything.
    pub(crate) fn fork(&self, agent: u32) -> Self {
        Self { state: self.state.clone(), ..Self::new(agent) }
    }

    pub(crate) fn view(&self) -> View<'_> {
        view(&self.state, &self.dictionary)
    }

    /// The delta or error of a mutation; changes nothing.
    pub(crate) fn attempt(&self, mutation: &Mutation) -> Result<Delta, MutationError> {
        mutation.delta(&self.view(), self.author)
    }

    #[track_caller]
    pub(crate) fn apply(&mut self, mutation: &Mutation) -> Delta {
        let delta = self.attempt(mutation).unwrap();
        self.state.join(&delta);
        check(&self.state, &self.dictionary);
        delta
    }

    pub(crate) fn next(&self) -> Dot {
        self.state.next_dot(self.author.replica).unwrap()
    }

    /// Adds a vertex below a kinematic parent.
    #[track_caller]
    pub(crate) fn child(&mut self, parent: VertexId, name: &str) -> VertexId {
        let id = VertexId(self.next());
        self.apply(&child(parent, name));
        id
    }

    /// Adds a vertex that a symbolic edge links to another.
    #[track_caller]
    pub(crate) fn linked(&mut self, name: &str, label: &str, other: VertexId) -> VertexId {
        let id = VertexId(self.next());
        self.apply(&linked(name, label, other));
        id
    }

    #[track_caller]
    pub(crate) fn edge(&mut self, from: VertexId, label: &str, to: VertexId) -> EdgeId {
        let id = EdgeId(self.next());
        self.apply(&edge(from, label, to));
        id
    }

    pub(crate) fn shown(&self, from: VertexId, label: &str, to: VertexId) -> Option<EdgeId> {
        self.view().edge(from, label, to).map(|shown| shown.id)
    }

    pub(crate) fn shows(&self, from: VertexId, label: &str, to: VertexId) -> bool {
        self.shown(from, label, to).is_some()
    }

    pub(crate) fn value(&self, target: impl Into<Dot>, name: &str) -> Option<Value> {
        self.view().attribute(target, name).map(|(_, write)| write.value.clone())
    }

    /// The kinds of all repairs, in order.
    pub(crate) fn repairs(&self) -> Vec<&'static str> {
        self.view().repairs().iter().map(dsr_core::Repair::kind).collect()
    }
}

/// Well-formed, and a view that keeps every invariant and repairs exactly what is broken.
#[track_caller]
pub(crate) fn check(state: &State, dictionary: &Dictionary) {
    check_well_formed(state).unwrap();
    let view = view(state, dictionary);
    check_view(&view).unwrap();
    check_repairs(&view).unwrap();
}

/// Plays one mutation on r1 and the other on r2, both after `base`, joins both ways, and returns what both
/// then have. The claims of r2 are the greater.
#[track_caller]
pub(crate) fn concurrent(base: &Peer, first: &Mutation, second: &Mutation) -> Peer {
    let (mut one, mut two) = (base.fork(1), base.fork(2));
    let (left, right) = (one.apply(first), two.apply(second));
    one.state.join(&right);
    two.state.join(&left);
    assert_eq!(one.state, two.state, "both ways give one state");
    check(&one.state, &one.dictionary);
    one
}

/// Two replicas that have each done more than one mutation.
#[track_caller]
pub(crate) fn met(one: &Peer, two: &Peer) -> Peer {
    let joined = one.state.joined(&two.state);
    assert_eq!(joined, two.state.joined(&one.state), "both ways give one state");
    check(&joined, &one.dictionary);
    Peer { state: joined, ..one.clone() }
}

pub(crate) fn child(parent: VertexId, name: &str) -> Mutation {
    Mutation::AddVertex { vertex: NewVertex::new("thing", name), link: VertexLink::child_of(parent) }
}

pub(crate) fn linked(name: &str, label: &str, other: VertexId) -> Mutation {
    Mutation::AddVertex { vertex: NewVertex::new("thing", name), link: VertexLink::to(label, other) }
}

/// `source -label-> new`.
pub(crate) fn entered(name: &str, label: &str, source: VertexId) -> Mutation {
    let link = VertexLink { outgoing: false, ..VertexLink::to(label, source) };
    Mutation::AddVertex { vertex: NewVertex::new("thing", name), link }
}

pub(crate) fn key(from: VertexId, label: &str, to: VertexId) -> EdgeKey {
    EdgeKey::new(from, label, to)
}

pub(crate) fn edge(from: VertexId, label: &str, to: VertexId) -> Mutation {
    Mutation::AddEdge { key: key(from, label, to), attributes: AttributeMap::new() }
}

pub(crate) fn parent(parent: VertexId, child: VertexId) -> EdgeKey {
    key(parent, RT, child)
}

pub(crate) fn remove(key: EdgeKey) -> Mutation {
    Mutation::RemoveEdge { key }
}

pub(crate) fn relocate(from: EdgeKey, to: EdgeKey) -> Mutation {
    Mutation::MoveEdge { from, to, attributes: AttributeMap::new() }
}

pub(crate) fn destroy(vertex: VertexId) -> Mutation {
    Mutation::RemoveVertex { vertex }
}

pub(crate) fn set(target: ElementId, name: &str, value: impl Into<Value>) -> Mutation {
    let updates = AttributeUpdates::from([(name.into(), Some(value.into()))]);
    Mutation::UpdateAttributes { target, updates }
}

pub(crate) fn unset(target: ElementId, name: &str) -> Mutation {
    Mutation::UpdateAttributes { target, updates: AttributeUpdates::from([(name.into(), None)]) }
}

pub(crate) fn of(vertex: VertexId) -> ElementId {
    ElementId::Vertex(vertex)
}

pub(crate) fn on(edge: EdgeId) -> ElementId {
    ElementId::Edge(edge)
}

/// A small flat, made by r1.
///
/// ```text
/// ROOT ⇒ kitchen ⇒ table ⇒ bowl ⇒ spoon     ROOT ⇒ hall     ROOT ⇒ pole     ROOT ⇒ post
/// ROOT ⇒ lamp, lamp −near→ kitchen            ROOT ⇒ shelf ⇒ cup, cup −near→ kitchen
/// robot −in→ kitchen                          drone −near→ kitchen, drone −sees→ hall
/// ```
pub(crate) struct Flat {
    pub(crate) base: Peer,
    pub(crate) kitchen: VertexId,
    pub(crate) hall: VertexId,
    pub(crate) table: VertexId,
    pub(crate) bowl: VertexId,
    pub(crate) spoon: VertexId,
    pub(crate) pole: VertexId,
    pub(crate) post: VertexId,
    pub(crate) lamp: VertexId,
    pub(crate) shelf: VertexId,
    pub(crate) cup: VertexId,
    pub(crate) robot: VertexId,
    pub(crate) drone: VertexId,
    pub(crate) sees: EdgeId,
}

pub(crate) fn flat() -> Flat {
    let mut base = Peer::new(1);
    let kitchen = base.child(ROOT, "kitchen");
    let hall = base.child(ROOT, "hall");
    let pole = base.child(ROOT, "pole");
    let post = base.child(ROOT, "post");
    let table = base.child(kitchen, "table");
    let bowl = base.child(table, "bowl");
    let spoon = base.child(bowl, "spoon");
    let lamp = base.child(ROOT, "lamp");
    base.edge(lamp, "near", kitchen);
    let shelf = base.child(ROOT, "shelf");
    let cup = base.child(shelf, "cup");
    base.edge(cup, "near", kitchen);
    let robot = base.linked("robot", "in", kitchen);
    let drone = base.linked("drone", "near", kitchen);
    let sees = base.edge(drone, "sees", hall);
    Flat { base, kitchen, hall, table, bowl, spoon, pole, post, lamp, shelf, cup, robot, drone, sees }
}

pub(crate) mod history;
