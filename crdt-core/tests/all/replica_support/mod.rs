//! A replica beside the readable reference: whatever is done to one is done to both, and all that can be
//! seen of them is compared.

#![allow(dead_code, reason = "each test uses a part of it")]

use dsr_core::{
    Author, Change, Changes, Delta, Dictionary, Dot, Edge, EdgeId, Mutation, MutationError, Name, Repair,
    Replica, ReplicaId, Shows, State, Vertex, VertexId, View, Write, delta_for, digest, encode, fingerprint,
    invariant, view,
};
use std::collections::{BTreeMap, BTreeSet};

/// Both, and whose they are.
#[derive(Clone, Debug)]
pub(crate) struct Pair {
    pub(crate) replica: Replica,
    pub(crate) state: State,
    pub(crate) dictionary: Dictionary,
}

/// All that changes tell, of one view.
struct Facts {
    vertices: BTreeMap<VertexId, Vertex>,
    edges: BTreeMap<EdgeId, Edge>,
    registers: BTreeMap<(Dot, Name), Vec<(Dot, Write)>>,
    repairs: BTreeSet<Repair>,
}

fn facts(view: &View<'_>) -> Facts {
    let vertices = view.vertices().iter().filter_map(|&id| Some((id, view.vertex(id)?.clone())));
    let edges = view.edges().iter().map(|shown| (shown.id, shown.edge.clone()));
    let mut registers: BTreeMap<_, Vec<_>> = BTreeMap::new();
    for &(dot, write) in view.writes() {
        registers.entry((write.target, write.name.clone())).or_default().push((dot, write.clone()));
    }
    let repairs = view.repairs().iter().cloned().collect();
    Facts { vertices: vertices.collect(), edges: edges.collect(), registers, repairs }
}

/// The keys under which two maps differ.
fn differing<K: Ord + Clone, V: PartialEq>(l: &BTreeMap<K, V>, r: &BTreeMap<K, V>) -> BTreeSet<K> {
    l.keys().chain(r.keys()).filter(|key| l.get(key) != r.get(key)).cloned().collect()
}

/// The changes between two views, from scratch. `[spec: EVENT-1]` and following.
fn changes(before: &Facts, after: &Facts) -> Vec<Change> {
    let mut changes = Vec::new();
    for vertex in differing(&before.vertices, &after.vertices) {
        let removed = before.vertices.get(&vertex);
        changes.extend(removed.map(|old| Change::VertexRemoved { vertex, name: old.name.clone() }));
        changes.extend(after.vertices.get(&vertex).map(|_| Change::VertexAdded { vertex }));
    }
    for edge in differing(&before.edges, &after.edges) {
        changes.extend(before.edges.get(&edge).map(|old| Change::EdgeHidden { edge, key: old.key() }));
        changes.extend(after.edges.get(&edge).map(|new| Change::EdgeShown { edge, key: new.key() }));
    }
    for register in differing(&before.registers, &after.registers) {
        let winner = |facts: &Facts| facts.registers.get(&register).map(|writes| writes[0].0);
        let (before, after) = (winner(before), winner(after));
        let (target, name) = register;
        changes.push(Change::Attribute { target, name, before, after });
    }
    changes.extend(before.repairs.difference(&after.repairs).cloned().map(Change::RepairGone));
    changes.extend(after.repairs.difference(&before.repairs).cloned().map(Change::RepairMade));
    changes.sort();
    changes
}

impl Pair {
    pub(crate) fn new(agent: u32, dictionary: Dictionary) -> Self {
        let replica = Replica::new(ReplicaId::agent(agent), dictionary.clone());
        Self { replica, state: State::new(), dictionary }
    }

    pub(crate) fn of(agent: u32, state: &State, dictionary: Dictionary) -> Self {
        let mut pair = Self::new(agent, dictionary);
        pair.apply(state);
        pair
    }

    /// Goes on as the next incarnation, with the state or with nothing.
    pub(crate) fn restart(&mut self, keeps: bool) {
        let ReplicaId { agent, incarnation } = self.replica.id();
        let id = ReplicaId { agent, incarnation: incarnation + 1 };
        self.replica = Replica::new(id, self.dictionary.clone());
        let state = std::mem::take(&mut self.state);
        if keeps {
            self.apply(&state);
        }
    }

    /// Joins a delta on both sides.
    #[track_caller]
    pub(crate) fn apply(&mut self, delta: &Delta) -> usize {
        let state = self.state.joined(delta);
        let told = self.replica.apply(delta);
        self.advance(state, &told.into_iter().collect::<Vec<_>>())
    }

    /// Both go on to a state; the changes told must be the difference of the views.
    #[track_caller]
    fn advance(&mut self, state: State, told: &[Change]) -> usize {
        let (old, new) = (view(&self.state, &self.dictionary), view(&state, &self.dictionary));
        let expected = changes(&facts(&old), &facts(&new));
        assert_eq!(Changes::between(&old, &new).into_iter().collect::<Vec<_>>(), expected, "from scratch");
        assert_eq!(told, expected, "changes\nfrom {:#?}\nto {:#?}", self.state, state);
        assert_eq!(self.disagreement(&state, &new), None, "from {:#?}\nto {state:#?}", self.state);
        self.state = state;
        expected.len()
    }

    /// Mutates on both sides; the delta, if it is allowed.
    #[track_caller]
    pub(crate) fn mutate(&mut self, mutation: &Mutation) -> Result<Delta, MutationError> {
        let timestamp_ns = 7;
        let author = Author { replica: self.replica.id(), timestamp_ns };
        let expected = mutation.delta(&view(&self.state, &self.dictionary), author);
        let made = self.replica.mutate(mutation, timestamp_ns);
        assert_eq!(
            made.as_ref().map(|made| &made.delta),
            expected.as_ref(),
            "{mutation:?}\n{:#?}",
            self.state
        );
        match made {
            Ok(made) => {
                self.advance(self.state.joined(&made.delta), &made.changes.into_iter().collect::<Vec<_>>());
                Ok(made.delta)
            }
            Err(error) => {
                self.check();
                Err(error)
            }
        }
    }

    #[track_caller]
    pub(crate) fn check(&self) {
        let shown = view(&self.state, &self.dictionary);
        assert_eq!(self.disagreement(&self.state, &shown), None, "{:#?}", self.state);
    }

    /// What the replica shows otherwise than the reference.
    pub(crate) fn disagreement(&self, state: &State, expected: &View<'_>) -> Option<&'static str> {
        let found = self.replica.state();
        let shown = self.replica.shown(&found);
        let names =
            expected.vertices().iter().filter_map(|&id| expected.vertex(id)).map(|vertex| &*vertex.name);
        let names: BTreeSet<&str> = names.chain(["root", "world", "nobody"]).collect();
        let replica = &self.replica;
        let is_equal = [
            ("state", found == *state),
            ("context", replica.context() == state.context()),
            ("vertices", shown.vertices() == expected.vertices()),
            ("edges", shown.edges() == expected.edges()),
            ("writes", shown.writes() == expected.writes()),
            ("repairs", shown.repairs() == expected.repairs()),
            ("stranded", replica.stranded() == expected.stranded()),
            ("names", names.iter().all(|name| replica.vertex_by_name(name) == expected.vertex_by_name(name))),
            (
                "placements",
                expected.vertices().iter().all(|&v| replica.placement(v) == expected.placement(v)),
            ),
        ];
        let differs = is_equal.into_iter().find(|(_, is_equal)| !is_equal).map(|(what, _)| what);
        differs.or_else(|| self.look_ups(expected))
    }

    fn look_ups(&self, expected: &View<'_>) -> Option<&'static str> {
        let replica = &self.replica;
        for shown in expected.edges() {
            if replica.edge_by_key(&shown.edge.key()) != Some(shown.id)
                || replica.edge(shown.id).as_ref() != Some(shown.edge)
            {
                return Some("edge by key");
            }
        }
        for &(_, write) in expected.writes() {
            let all = replica.attribute_writes(write.target, &write.name);
            let all: Vec<(Dot, &Write)> = all.iter().map(|(dot, write)| (*dot, write)).collect();
            if all != expected.attribute_writes(write.target, &write.name) {
                return Some("writes of a register");
            }
        }
        None
    }

    /// The rest that can be asked: bytes, digests, indexes by type and label, edges at a vertex, the judges.
    #[track_caller]
    pub(crate) fn check_thoroughly(&self, other: &State) {
        self.check();
        let (replica, state) = (&self.replica, &self.state);
        assert_eq!(replica.encode(), encode(state));
        assert_eq!(replica.digest(), digest(state));
        assert_eq!(replica.fingerprint(), fingerprint(state));
        assert_eq!(replica.delta_for(&digest(other)), delta_for(state, &digest(other)));
        assert_eq!((replica.len(), replica.is_empty()), (state.len(), state.is_empty()));
        let found = replica.state();
        assert_eq!(invariant::check_view(&replica.shown(&found)), Ok(()));
        assert_eq!(invariant::check_repairs(&replica.shown(&found)), Ok(()));
        let expected = view(state, &self.dictionary);
        let ids: Vec<EdgeId> =
            expected.edges().iter().map(|shown| shown.id).collect::<BTreeSet<_>>().into_iter().collect();
        assert_eq!(replica.edges().map(|(id, _)| id).collect::<Vec<_>>(), ids);
        for label in ["RT", "in", "near"] {
            let of: Vec<EdgeId> = ids
                .iter()
                .copied()
                .filter(|id| state.edge(id.0).is_some_and(|edge| &*edge.label == label))
                .collect();
            assert_eq!(replica.edges_of_label(label).collect::<Vec<_>>(), of);
        }
        for vertex_type in ["a", "b", "thing", "room"] {
            let is_of = |id: &VertexId| {
                expected.vertex(*id).is_some_and(|vertex| &*vertex.vertex_type == vertex_type)
            };
            let of: Vec<VertexId> = expected.vertices().iter().copied().filter(is_of).collect();
            assert_eq!(replica.vertices_of_type(vertex_type).collect::<Vec<_>>(), of);
        }
        for &vertex in expected.vertices() {
            let at: BTreeSet<EdgeId> = replica.edges_at_vertex(vertex).map(|(id, _)| id).collect();
            let touches =
                |edge: &&dsr_core::ShownEdge<'_>| edge.edge.from == vertex || edge.edge.to == vertex;
            assert_eq!(at, expected.edges().iter().filter(touches).map(|shown| shown.id).collect());
            assert_eq!(replica.vertex(vertex).as_ref(), expected.vertex(vertex));
        }
    }
}
