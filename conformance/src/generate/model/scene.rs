//! What the histories begin with, and what they are about. `[spec: CONF-20]`

use crate::generate::CannotWrite;
use dsr_core::{
    AttributeMap, Author, Delta, Dictionary, EdgeKey, Mutation, MutationKind, NewVertex, ReplicaId, State,
    Value, VertexId, VertexLink, view,
};
use dsr_model::checked::Checked;
use dsr_model::checked::alphabet::{ATTRIBUTE, Alphabet, FUNCTIONAL};
use dsr_model::histories::Bound;

/// Histories of some kinds of mutation within a bound.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Group {
    /// The kinds, one or two; or all six, of which then three meet.
    pub kinds: Vec<MutationKind>,
    /// How far.
    pub bound: Bound,
}

impl Group {
    /// The 21 pairs of kinds, a kind with itself included, at 2 replicas × 2 mutations; and all six at 3 × 1.
    pub fn all() -> Vec<Self> {
        let kinds = MutationKind::ALL;
        let twice = Bound { replicas: 2, mutations: 2 };
        let pair = |left: usize, right: usize| {
            if left == right { vec![kinds[left]] } else { vec![kinds[left], kinds[right]] }
        };
        let pairs = (0..kinds.len()).flat_map(|left| (left..kinds.len()).map(move |right| (left, right)));
        let pairs = pairs.map(|(left, right)| Self { kinds: pair(left, right), bound: twice });
        pairs.chain([Self { kinds: kinds.into(), bound: Bound { replicas: 3, mutations: 1 } }]).collect()
    }

    /// The topic of its files.
    pub fn topic(&self) -> String {
        if self.is_of_three() {
            return "model-three".into();
        }
        let kinds: Vec<String> = self.kinds.iter().map(|kind| kind.name().replace('_', "-")).collect();
        format!("model-{}", kinds.join("-"))
    }

    /// The bound, in words.
    pub fn bound_name(&self) -> String {
        format!("{} x {}", self.bound.replicas, self.bound.mutations)
    }

    /// Whether a history of these kinds, in order, is this group's and no other's: a pair has both its kinds, and in
    /// the group of all six every replica mutates.
    pub fn has(&self, kinds: &[MutationKind]) -> bool {
        if self.is_of_three() {
            kinds.len() == self.bound.replicas
        } else {
            !kinds.is_empty() && self.kinds.iter().all(|kind| kinds.contains(kind))
        }
    }

    /// Whether three replicas meet.
    pub const fn is_of_three(&self) -> bool {
        self.bound.replicas == 3
    }

    /// The checked semantics on the scene. Replicas touch both its vertices; where pairs add vertices, which all are
    /// touched, only the last of the scene's.
    pub fn semantics(&self) -> Result<Checked, CannotWrite> {
        let scene = Scene::new()?;
        let adds = self.kinds.contains(&MutationKind::AddVertex) && !self.is_of_three();
        let focus = if adds { vec![scene.vertices[1]] } else { scene.vertices.to_vec() };
        Ok(Checked {
            dictionary: dictionary(),
            initial: scene.state,
            alphabet: Alphabet::of(&self.kinds, focus),
        })
    }
}

/// The scene: vertices `a` and `b` below the root, `b` is `in` `a`, and has the attribute `level`.
#[derive(Clone, Debug)]
pub(super) struct Scene {
    /// What replicas start from.
    pub(super) state: State,
    /// The mutations of its author, the replica of the least identity.
    pub(super) mutations: Vec<Mutation>,
    vertices: [VertexId; 2],
}

/// The labels of the alphabet, one of them functional.
pub(super) fn dictionary() -> Dictionary {
    Dictionary::open().with_functional(FUNCTIONAL)
}

impl Scene {
    /// The scene.
    pub(super) fn new() -> Result<Self, CannotWrite> {
        let vertex = |sequence| VertexId(dsr_core::Dot::new(ReplicaId::SCENE, sequence));
        let (a, b) = (vertex(1), vertex(3));
        let add = |name: &str, attributes: AttributeMap| Mutation::AddVertex {
            vertex: NewVertex { attributes, ..NewVertex::new("object", name) },
            link: VertexLink::child_of(VertexId::ROOT),
        };
        let level = [(ATTRIBUTE.into(), Value::Int(1))].into();
        let edge = Mutation::AddEdge { key: EdgeKey::new(b, FUNCTIONAL, a), attributes: AttributeMap::new() };
        let mutations = vec![add("a", AttributeMap::new()), add("b", level), edge];
        let mut state = State::new();
        for mutation in &mutations {
            let made: Delta = mutation
                .delta(&view(&state, &dictionary()), Author::new(ReplicaId::SCENE))
                .map_err(|why| CannotWrite::Refused { replica: "the scene".into(), why })?;
            state.join(&made);
        }
        Ok(Self { state, mutations, vertices: [a, b] })
    }
}
