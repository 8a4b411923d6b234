//! Less of a mutation, and of the graph that all start from. `[spec: CHECK-14]`

use dsr_core::{
    AttributeMap, AttributeUpdates, Dictionary, Dot, ElementId, Mutation, Name, NewVertex, Placement, Record,
    State, Value, VertexId, VertexLink, View, view,
};
use std::collections::BTreeSet;
use std::sync::Arc;

/// The mutation with an attribute less, with a smaller value, about an older vertex, or of a vertex without
/// external id or with a shorter name.
pub(super) fn mutations(mutation: &Mutation, focus: &[VertexId]) -> Vec<Mutation> {
    let about_older = about_older(&[mutation], focus).into_iter().flatten();
    about_older.chain(less(mutation)).collect()
}

fn less(mutation: &Mutation) -> Vec<Mutation> {
    match mutation {
        Mutation::AddVertex { vertex, link } => {
            let vertices = vertices(vertex).into_iter();
            let with_vertex = vertices.map(|vertex| Mutation::AddVertex { vertex, link: link.clone() });
            let with_link = maps(&link.attributes).into_iter().map(|attributes| Mutation::AddVertex {
                vertex: vertex.clone(),
                link: VertexLink { attributes, ..link.clone() },
            });
            with_vertex.chain(with_link).collect()
        }
        Mutation::AddEdge { key, attributes } => {
            let with = |attributes| Mutation::AddEdge { key: key.clone(), attributes };
            maps(attributes).into_iter().map(with).collect()
        }
        Mutation::MoveEdge { from, to, attributes } => {
            let with = |attributes| Mutation::MoveEdge { from: from.clone(), to: to.clone(), attributes };
            maps(attributes).into_iter().map(with).collect()
        }
        Mutation::UpdateAttributes { target, updates } => {
            let with = |updates| Mutation::UpdateAttributes { target: *target, updates };
            fewer_updates(updates).into_iter().map(with).collect()
        }
        Mutation::RemoveEdge { .. } | Mutation::RemoveVertex { .. } => Vec::new(),
    }
}

/// Mutations about the root or another vertex of the focus instead of a younger one, whichever name it: an older
/// dot is the smaller id, and what is there from the start need not be added first.
pub(super) fn about_older(mutations: &[&Mutation], focus: &[VertexId]) -> Vec<Vec<Mutation>> {
    let named: BTreeSet<VertexId> = mutations.iter().copied().flat_map(vertices_of).collect();
    let known: BTreeSet<VertexId> = focus.iter().copied().chain([VertexId::ROOT]).collect();
    let known = &known;
    let exchanged = named.into_iter().flat_map(|old| known.range(..old).map(move |&new| (old, new)));
    let together = exchanged
        .map(|(old, new)| mutations.iter().map(|mutation| mutation_about(mutation, old, new)).collect());
    together.collect()
}

/// The vertices that a mutation names.
fn vertices_of(mutation: &Mutation) -> Vec<VertexId> {
    match mutation {
        Mutation::AddVertex { link, .. } => vec![link.other],
        Mutation::AddEdge { key, .. } | Mutation::RemoveEdge { key } => vec![key.from, key.to],
        Mutation::MoveEdge { from, to, .. } => vec![from.from, from.to, to.from, to.to],
        Mutation::UpdateAttributes { target: ElementId::Vertex(vertex), .. }
        | Mutation::RemoveVertex { vertex } => vec![*vertex],
        Mutation::UpdateAttributes { target: ElementId::Edge(_), .. } => Vec::new(),
    }
}

/// The mutation with one vertex in the place of another.
fn mutation_about(mutation: &Mutation, old: VertexId, new: VertexId) -> Mutation {
    let mut mutation = mutation.clone();
    let exchange = |vertex: &mut VertexId| {
        if *vertex == old {
            *vertex = new;
        }
    };
    match &mut mutation {
        Mutation::AddVertex { link, .. } => exchange(&mut link.other),
        Mutation::AddEdge { key, .. } | Mutation::RemoveEdge { key } => {
            exchange(&mut key.from);
            exchange(&mut key.to);
        }
        Mutation::MoveEdge { from, to, .. } => {
            [&mut from.from, &mut from.to, &mut to.from, &mut to.to].into_iter().for_each(exchange);
        }
        Mutation::UpdateAttributes { target: ElementId::Vertex(vertex), .. }
        | Mutation::RemoveVertex { vertex } => exchange(vertex),
        Mutation::UpdateAttributes { target: ElementId::Edge(_), .. } => {}
    }
    mutation
}

fn vertices(vertex: &NewVertex) -> Vec<NewVertex> {
    let mut simpler = Vec::new();
    if vertex.external_id.is_some() {
        simpler.push(NewVertex { external_id: None, ..vertex.clone() });
    }
    simpler.extend(
        maps(&vertex.attributes).into_iter().map(|attributes| NewVertex { attributes, ..vertex.clone() }),
    );
    if vertex.name.chars().count() > 1 {
        // A name that another vertex has is refused: hence several.
        let names = ('v'..='z').map(|letter| Name::from(letter.to_string()));
        simpler.extend(names.map(|name| NewVertex { name, ..vertex.clone() }));
    }
    simpler
}

fn maps(attributes: &AttributeMap) -> Vec<AttributeMap> {
    let without = attributes.keys().map(|name| {
        let mut fewer = attributes.clone();
        fewer.remove(name);
        fewer
    });
    let smaller = attributes.iter().flat_map(|(name, value)| {
        values(value).into_iter().map(move |value| {
            let mut smaller = attributes.clone();
            smaller.insert(name.clone(), value);
            smaller
        })
    });
    without.chain(smaller).collect()
}

/// An update of nothing is refused: the last one stays.
fn fewer_updates(updates: &AttributeUpdates) -> Vec<AttributeUpdates> {
    let without = updates.keys().filter(|_| updates.len() > 1).map(|name| {
        let mut fewer = updates.clone();
        fewer.remove(name);
        fewer
    });
    let smaller = updates.iter().flat_map(|(name, value)| {
        value.iter().flat_map(values).map(move |value| {
            let mut smaller = updates.clone();
            smaller.insert(name.clone(), Some(value));
            smaller
        })
    });
    without.chain(smaller).collect()
}

/// Smaller values of the same type: nearer to nought, or shorter.
fn values(value: &Value) -> Vec<Value> {
    fn halves<T: Clone>(items: &Arc<[T]>) -> Vec<Arc<[T]>> {
        let lengths = [0, items.len() / 2].into_iter().filter(|&length| length < items.len());
        let mut shorter: Vec<Arc<[T]>> = lengths.map(|length| items[..length].into()).collect();
        shorter.dedup_by_key(|items| items.len());
        shorter
    }
    let nought = match value {
        Value::Int(number) if *number > 1 => return vec![Value::Int(0), Value::Int(number / 2)],
        Value::UInt(number) if *number > 1 => return vec![Value::UInt(0), Value::UInt(number / 2)],
        Value::UInt64(number) if *number > 1 => return vec![Value::UInt64(0), Value::UInt64(number / 2)],
        Value::String(text) => {
            let half = text.chars().take(text.chars().count() / 2).collect::<String>();
            let shorter = [String::new(), half].into_iter().filter(|shorter| shorter.len() < text.len());
            return shorter.map(|text| Value::String(text.into())).collect();
        }
        Value::FloatVec(items) => return halves(items).into_iter().map(Value::FloatVec).collect(),
        Value::ByteVec(bytes) => return halves(bytes).into_iter().map(Value::ByteVec).collect(),
        Value::U64Vec(items) => return halves(items).into_iter().map(Value::U64Vec).collect(),
        Value::Int(_) => Value::Int(0),
        Value::UInt(_) => Value::UInt(0),
        Value::UInt64(_) => Value::UInt64(0),
        Value::Float(_) => Value::Float(0.0),
        Value::Double(_) => Value::Double(0.0),
        Value::Bool(_) => Value::Bool(false),
        Value::Vec2(_) => Value::Vec2([0.0; 2]),
        Value::Vec3(_) => Value::Vec3([0.0; 3]),
        Value::Vec4(_) => Value::Vec4([0.0; 4]),
        Value::Vec6(_) => Value::Vec6([0.0; 6]),
    };
    if nought == *value { Vec::new() } else { vec![nought] }
}

/// The graph without a vertex and all that hangs from it in the tree, then without a vertex alone, an edge or
/// a write; only graphs that are shown as they are, without a repair. What goes counts as removed: its dots
/// stay seen.
pub(super) fn initial(state: &State, dictionary: &Dictionary) -> Vec<State> {
    let graph = view(state, dictionary);
    let vertices = graph.vertices().iter().copied().filter(|vertex| !vertex.is_root());
    let alone = vertices.map(|vertex| BTreeSet::from([vertex.0]));
    let mut cuts: Vec<BTreeSet<Dot>> = alone.clone().map(|cut| with_descendants(&graph, cut)).collect();
    cuts.sort_by_key(|cut| std::cmp::Reverse(cut.len()));
    cuts.extend(alone);
    let parts = state.records().filter(|(_, record)| !matches!(record, Record::Vertex(_)));
    cuts.extend(parts.map(|(dot, _)| BTreeSet::from([dot])));
    let smaller = cuts.into_iter().map(|cut| without(state, &cut));
    smaller.filter(|smaller| view(smaller, dictionary).repairs().is_empty()).collect()
}

fn with_descendants(graph: &View<'_>, mut cut: BTreeSet<Dot>) -> BTreeSet<Dot> {
    loop {
        let below = graph.vertices().iter().filter(|vertex| match graph.placement(**vertex) {
            Some(Placement::Child { parent, .. }) => cut.contains(&parent.0),
            _ => false,
        });
        let before = cut.len();
        cut.extend(below.map(|vertex| vertex.0).collect::<Vec<_>>());
        if cut.len() == before {
            return cut;
        }
    }
}

fn without(state: &State, cut: &BTreeSet<Dot>) -> State {
    let kept = state.records().filter(|(dot, _)| !cut.contains(dot));
    let mut smaller =
        State::assemble(kept.map(|(dot, record)| (dot, record.clone())), state.context().clone());
    // What is anchored to it goes with it.
    smaller.close();
    smaller
}
