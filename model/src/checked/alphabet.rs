//! Alphabets: which concrete mutations replicas may do in a view.

use super::Sight;
use super::renaming::fresh_name;
use super::replica_id;
use dsr_core::{
    AttributeMap, Edge, EdgeKey, ElementId, Mutation, MutationKind, NewVertex, Placement, RT, ReplicaId,
    Value, VertexId, VertexLink,
};
use std::collections::BTreeSet;

/// The name that several new vertices share, so that names clash.
const SHARED_NAME: &str = "twin";
/// The type of new vertices.
const NEW_TYPE: &str = "object";
/// The functional label that edges are added under.
pub const FUNCTIONAL: &str = "in";
/// The plain label that edges are added under.
pub const PLAIN: &str = "has";
/// The attribute that is updated.
pub const ATTRIBUTE: &str = "level";

/// The mutations of the chosen kinds on the vertices in focus, on the edges between them, and on whatever
/// replicas add. Below the root there are kinematic edges only: a symbolic edge to it says nothing.
///
/// Values are not varied: the semantics never looks into them (it compares the writes' ranks), so one
/// value stands for all. New vertices take a name of their own, or a shared one that can clash.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Alphabet {
    /// Which kinds.
    pub kinds: BTreeSet<MutationKind>,
    /// The vertices besides the root that replicas touch; what replicas add is always in focus.
    pub focus: Vec<VertexId>,
    /// Whether only mutations of the last vertex of the focus are tried, one or two of each kind: its
    /// attribute is set, a child is added to it, its own edges are added, moved and removed, it is removed.
    /// For bounds at which the whole focus is too much.
    pub at_last: bool,
}

impl Alphabet {
    /// All six kinds on a focus.
    pub fn all(focus: Vec<VertexId>) -> Self {
        Self { kinds: MutationKind::ALL.into(), focus, at_last: false }
    }

    /// Some kinds on a focus.
    pub fn of(kinds: &[MutationKind], focus: Vec<VertexId>) -> Self {
        Self { kinds: kinds.iter().copied().collect(), focus, at_last: false }
    }

    /// The mutations that replica `replica` may try, whether or not the core accepts them.
    pub(super) fn enabled(&self, view: &impl Sight, replica: usize) -> Vec<Mutation> {
        let focus: Vec<VertexId> = view.vertices().iter().copied().filter(|&id| self.in_focus(id)).collect();
        let mut mutations = Vec::new();
        for kind in &self.kinds {
            match kind {
                MutationKind::AddVertex => self.add_vertex(view, replica, &focus, &mut mutations),
                MutationKind::AddEdge => self.add_edge(view, &focus, &mut mutations),
                MutationKind::UpdateAttributes => self.update_attributes(view, &focus, &mut mutations),
                MutationKind::RemoveEdge => self.remove_edge(view, &mut mutations),
                MutationKind::MoveEdge => self.move_edge(view, &focus, &mut mutations),
                MutationKind::RemoveVertex => {
                    let removable = focus.iter().filter(|vertex| !vertex.is_root() && self.at(**vertex));
                    mutations.extend(removable.map(|&vertex| Mutation::RemoveVertex { vertex }));
                }
            }
        }
        mutations
    }

    /// Whether mutations at this vertex are tried.
    fn at(&self, vertex: VertexId) -> bool {
        !self.at_last || self.focus.last() == Some(&vertex)
    }

    fn in_focus(&self, vertex: VertexId) -> bool {
        let is_added = vertex.0.replica != ReplicaId::SCENE;
        vertex.is_root() || self.focus.contains(&vertex) || (is_added && !self.at_last)
    }

    fn update_attributes(&self, view: &impl Sight, focus: &[VertexId], mutations: &mut Vec<Mutation>) {
        let targets = focus.iter().filter(|vertex| !vertex.is_root() && self.at(**vertex));
        let vertices = targets.map(|&vertex| ElementId::Vertex(vertex));
        let symbolic = self.edges_in_focus(view).filter(|shown| !shown.edge.is_rt() && !self.at_last);
        let edges = symbolic.map(|shown| ElementId::Edge(shown.id));
        for target in vertices.chain(edges) {
            let update =
                |value| Mutation::UpdateAttributes { target, updates: [(ATTRIBUTE.into(), value)].into() };
            mutations.push(update(Some(Value::Int(1))));
            if !self.at_last && !view.attribute_writes(target, ATTRIBUTE).is_empty() {
                mutations.push(update(None));
            }
        }
    }

    fn remove_edge(&self, view: &impl Sight, mutations: &mut Vec<Mutation>) {
        mutations
            .extend(self.edges_in_focus(view).map(|shown| Mutation::RemoveEdge { key: shown.edge.key() }));
    }

    /// Kinematic edges to other parents, symbolic ones to other targets.
    fn move_edge(&self, view: &impl Sight, focus: &[VertexId], mutations: &mut Vec<Mutation>) {
        for shown in self.edges_in_focus(view) {
            let from = shown.edge.key();
            for &end in focus {
                let mut to = from.clone();
                if shown.edge.is_rt() {
                    to.from = end;
                } else {
                    to.to = end;
                }
                let symbolic_to_root = to.to.is_root();
                if to != from && !symbolic_to_root {
                    mutations.push(Mutation::MoveEdge {
                        from: from.clone(),
                        to,
                        attributes: AttributeMap::new(),
                    });
                }
            }
        }
    }

    fn edges_in_focus<'v>(&self, view: &'v impl Sight) -> impl Iterator<Item = dsr_core::ShownEdge<'v>> {
        let inside = |shown: &&dsr_core::ShownEdge<'v>| {
            let (from, to) = (shown.edge.from, shown.edge.to);
            let between = self.in_focus(from) && self.in_focus(to) && self.at(owner(shown.edge));
            between && !to.is_root() && (!from.is_root() || shown.edge.is_rt())
        };
        view.edges().iter().filter(inside).copied()
    }

    /// Below each vertex of the tree, and *in* each vertex but the root; one more with a shared name below
    /// the root.
    fn add_vertex(
        &self,
        view: &impl Sight,
        replica: usize,
        focus: &[VertexId],
        mutations: &mut Vec<Mutation>,
    ) {
        let Some(dot) = view.state().next_dot(replica_id(replica)) else { return };
        let fresh = NewVertex::new(NEW_TYPE, &fresh_name(dot));
        let twin = NewVertex::new(NEW_TYPE, SHARED_NAME);
        if let (true, Some(&last)) = (self.at_last, self.focus.last()) {
            // The shared name as long as it is free, so that names clash; then a fresh one.
            let vertex = if view.vertex_by_name(SHARED_NAME).is_none() { twin } else { fresh };
            mutations.push(Mutation::AddVertex { vertex, link: VertexLink::child_of(last) });
            return;
        }
        for &other in focus {
            let inside = (!other.is_root()).then(|| VertexLink::to(FUNCTIONAL, other));
            let links = core::iter::once(VertexLink::child_of(other)).chain(inside);
            mutations.extend(links.map(|link| Mutation::AddVertex { vertex: fresh.clone(), link }));
        }
        mutations.push(Mutation::AddVertex { vertex: twin, link: VertexLink::child_of(VertexId::ROOT) });
    }

    /// Between each two vertices besides the root a functional edge, and a plain one to what is not older; a
    /// kinematic one to each vertex that has no parent.
    fn add_edge(&self, view: &impl Sight, focus: &[VertexId], mutations: &mut Vec<Mutation>) {
        for &from in focus {
            for &to in focus.iter().filter(|&&to| to != from) {
                let orphan = matches!(view.placement(to), Some(Placement::Outside | Placement::Detached));
                let symbolic = !from.is_root() && !to.is_root() && self.at(from);
                let plain = symbolic && (!is_older(to, from) || self.at_last);
                let labels = [(FUNCTIONAL, symbolic), (PLAIN, plain), (RT, orphan && self.at(to))];
                let labels = labels.into_iter().filter(|(_, wanted)| *wanted);
                mutations.extend(labels.map(|(label, _)| Mutation::AddEdge {
                    key: EdgeKey::new(from, label, to),
                    attributes: AttributeMap::new(),
                }));
            }
        }
    }
}

/// Whether one vertex is older than another, whatever replicas are called: of two that different replicas
/// added neither is.
fn is_older(left: VertexId, right: VertexId) -> bool {
    let (left, right) = (left.0, right.0);
    left < right && (left.replica == right.replica || left.replica == ReplicaId::SCENE)
}

/// Whose edge it is: the child's for a kinematic one, else the source's.
fn owner(edge: &Edge) -> VertexId {
    if edge.is_rt() { edge.to } else { edge.from }
}
