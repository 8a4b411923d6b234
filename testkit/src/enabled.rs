//! Concrete mutations in a view.

use dsr_core::{
    AttributeMap, AttributeUpdates, Author, Dictionary, EdgeKey, ElementId, Mutation, MutationKind,
    NewVertex, ValueType, VertexId, VertexLink, View,
};

/// The names of added vertices: few, so that replicas choose the same ones.
pub const NAMES: [&str; 4] = ["a", "b", "c", "d"];

/// The labels of added edges: kinematic, functional, plain.
const LABELS: [&str; 3] = ["RT", "in", "near"];

/// The dictionary of tests: open, `in` functional, `level` an int.
pub fn dictionary() -> Dictionary {
    let mut dictionary = Dictionary::open().with_functional("in");
    dictionary.attributes.insert("level".into(), ValueType::Int);
    dictionary
}

/// Every mutation of a kind over the vertices and edges of a view and the small pools; many are refused.
pub fn candidates(view: &View<'_>, kind: MutationKind) -> Vec<Mutation> {
    let keys = || view.edges().iter().map(|shown| shown.edge.key());
    match kind {
        MutationKind::AddVertex => additions(view),
        MutationKind::AddEdge => {
            all_keys(view).map(|key| Mutation::AddEdge { key, attributes: level(1) }).collect()
        }
        MutationKind::UpdateAttributes => updates(view),
        MutationKind::RemoveEdge => keys().map(|key| Mutation::RemoveEdge { key }).collect(),
        MutationKind::MoveEdge => keys()
            .flat_map(|from| all_keys(view).map(move |to| (from.clone(), to)))
            .map(|(from, to)| Mutation::MoveEdge { from, to, attributes: AttributeMap::new() })
            .collect(),
        MutationKind::RemoveVertex => {
            view.vertices().iter().map(|&vertex| Mutation::RemoveVertex { vertex }).collect()
        }
    }
}

/// An enabled mutation of a kind, the `choice`-th candidate or the next one that is; `None` if none is.
pub fn pick(view: &View<'_>, author: Author, kind: MutationKind, choice: usize) -> Option<Mutation> {
    let mut candidates = candidates(view, kind);
    let middle = choice % candidates.len().max(1);
    candidates.rotate_left(middle);
    candidates.into_iter().find(|mutation| mutation.delta(view, author).is_ok())
}

/// The `choice`-th candidate of a kind, allowed or not; `None` if there is none.
pub fn attempt(view: &View<'_>, kind: MutationKind, choice: usize) -> Option<Mutation> {
    let mut candidates = candidates(view, kind);
    let at = choice % candidates.len().max(1);
    (at < candidates.len()).then(|| candidates.swap_remove(at))
}

fn level(number: i32) -> AttributeMap {
    AttributeMap::from([("level".into(), number.into())])
}

/// Every key over the vertices and labels.
fn all_keys<'v>(view: &'v View<'_>) -> impl Iterator<Item = EdgeKey> + 'v {
    let vertices = view.vertices();
    vertices.iter().flat_map(move |&from| {
        vertices.iter().flat_map(move |&to| LABELS.iter().map(move |label| EdgeKey::new(from, label, to)))
    })
}

fn additions(view: &View<'_>) -> Vec<Mutation> {
    let mut additions = Vec::new();
    for (at, &other) in view.vertices().iter().enumerate() {
        for name in NAMES {
            let mut vertex = NewVertex::new("thing", name);
            if at % 2 == 0 {
                vertex.attributes = level(0);
            }
            for link in links(other) {
                additions.push(Mutation::AddVertex { vertex: vertex.clone(), link });
            }
        }
    }
    additions
}

fn links(other: VertexId) -> [VertexLink; 3] {
    let towards_new = VertexLink { outgoing: false, ..VertexLink::to("near", other) };
    [VertexLink::child_of(other), VertexLink::to("in", other), towards_new]
}

fn updates(view: &View<'_>) -> Vec<Mutation> {
    let vertices = view.vertices().iter().map(|&vertex| ElementId::Vertex(vertex));
    let edges = view.edges().iter().map(|shown| ElementId::Edge(shown.id));
    let values = [Some(1.into()), Some(2.into()), None];
    vertices
        .chain(edges)
        .flat_map(|target| values.iter().map(move |value| (target, value.clone())))
        .map(|(target, value)| Mutation::UpdateAttributes {
            target,
            updates: AttributeUpdates::from([("level".into(), value)]),
        })
        .collect()
}
