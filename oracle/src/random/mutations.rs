//! What a replica tries: what its view has, and what it has not.

use super::vocabulary::{
    attribute, attribute_and_value, label, name, once_in, pick, time, value, vertex_type,
};
use dsr_core::{
    AttributeMap, AttributeUpdates, Author, Dot, EdgeId, EdgeKey, ElementId, Mutation, MutationKind,
    NewVertex, RT, ReplicaId, Value, VertexId, VertexLink, View, limits,
};
use dsr_model::walks::Dice;

/// One in so many sets of attributes is larger than is allowed.
const TOO_MANY: usize = 1500;

/// How often a refused mutation is drawn anew, at most.
const AGAIN_MAX: usize = 4;

/// How often each kind is tried, of all.
const WEIGHTS: [usize; 6] = [6, 6, 6, 4, 8, 3];

/// A kind of mutation.
pub(super) fn kind(dice: &mut Dice) -> MutationKind {
    let at = dice.weighted(&WEIGHTS).unwrap_or(0);
    MutationKind::ALL[at.min(WEIGHTS.len() - 1)]
}

/// A mutation of a kind. Many are refused; then another one is drawn, more often than not.
pub(super) fn mutation(dice: &mut Dice, view: &View<'_>, author: Author, kind: MutationKind) -> Mutation {
    let mut drawn = once(dice, view, kind);
    for _ in 0..AGAIN_MAX {
        if drawn.delta(view, author).is_ok() || once_in(dice, 3) {
            break;
        }
        drawn = once(dice, view, kind);
    }
    drawn
}

fn once(dice: &mut Dice, view: &View<'_>, kind: MutationKind) -> Mutation {
    match kind {
        MutationKind::AddVertex => add_vertex(dice, view),
        MutationKind::AddEdge => Mutation::AddEdge { key: new_key(dice, view), attributes: attributes(dice) },
        MutationKind::UpdateAttributes => update(dice, view),
        MutationKind::RemoveEdge => Mutation::RemoveEdge { key: shown_key(dice, view) },
        MutationKind::MoveEdge => move_edge(dice, view),
        MutationKind::RemoveVertex => Mutation::RemoveVertex { vertex: vertex(dice, view) },
    }
}

fn add_vertex(dice: &mut Dice, view: &View<'_>) -> Mutation {
    let external_id = once_in(dice, 8).then(|| time(dice));
    let (vertex_type, name) = (vertex_type(dice), name(dice));
    let new = NewVertex { vertex_type, name, external_id, attributes: attributes(dice) };
    let label = label(dice);
    let outgoing = if &*label == RT { once_in(dice, 10) } else { once_in(dice, 2) };
    let link = VertexLink { other: vertex(dice, view), label, outgoing, attributes: attributes(dice) };
    Mutation::AddVertex { vertex: new, link }
}

fn update(dice: &mut Dice, view: &View<'_>) -> Mutation {
    let target = element(dice, view);
    let mut updates = AttributeUpdates::new();
    if once_in(dice, TOO_MANY) {
        updates.extend((0..=limits::ATTRIBUTES_MAX).map(|at| (format!("n{at}").as_str().into(), None)));
        return Mutation::UpdateAttributes { target, updates };
    }
    let count = if once_in(dice, 30) { 0 } else { 1 + dice.below(2) };
    for _ in 0..count {
        if once_in(dice, 4) {
            let set = view.attributes_of(target.dot()).next().map(|(_, write)| write.name.clone());
            let unset = if once_in(dice, 3) { None } else { set };
            updates.insert(unset.unwrap_or_else(|| attribute(dice)), None);
        } else {
            let (name, value) = attribute_and_value(dice);
            updates.insert(name, Some(value));
        }
    }
    Mutation::UpdateAttributes { target, updates }
}

/// The edge shown, and a new key for it that differs in something.
fn move_edge(dice: &mut Dice, view: &View<'_>) -> Mutation {
    let from = shown_key(dice, view);
    let mut to = if once_in(dice, 12) { new_key(dice, view) } else { from.clone() };
    match dice.below(10) {
        0 => to.label = label(dice),
        1..=3 => to.to = vertex(dice, view),
        4..=8 => to.from = vertex(dice, view),
        _ => {}
    }
    Mutation::MoveEdge { from, to, attributes: attributes(dice) }
}

fn attributes(dice: &mut Dice) -> AttributeMap {
    if once_in(dice, TOO_MANY) {
        let many =
            (0..=limits::ATTRIBUTES_MAX).map(|at| (format!("n{at}").as_str().into(), Value::Bool(true)));
        return many.collect();
    }
    let count = dice.below(8).saturating_sub(5);
    (0..count)
        .map(|_| if once_in(dice, 6) { (attribute(dice), value(dice)) } else { attribute_and_value(dice) })
        .collect()
}

/// A vertex of the view, mostly; or what it does not show.
fn vertex(dice: &mut Dice, view: &View<'_>) -> VertexId {
    match dice.below(30) {
        0 => VertexId(Dot::new(
            ReplicaId::agent(1 + u32::try_from(dice.below(5)).unwrap_or(0)),
            1 + dice.below(9) as u64,
        )),
        1 => held(dice, view).map_or(VertexId::ROOT, VertexId),
        2 | 3 => pick(dice, view.stranded()).copied().unwrap_or(VertexId::ROOT),
        4 => VertexId::ROOT,
        _ => pick(dice, view.vertices()).copied().unwrap_or(VertexId::ROOT),
    }
}

/// A dot that is held, whatever it is.
fn held(dice: &mut Dice, view: &View<'_>) -> Option<Dot> {
    let count = view.state().len();
    view.state().records().nth(dice.below(count)).map(|(dot, _)| dot)
}

fn element(dice: &mut Dice, view: &View<'_>) -> ElementId {
    if once_in(dice, 2) {
        return ElementId::Vertex(vertex(dice, view));
    }
    let shown = pick(dice, view.edges()).map(|shown| shown.id);
    let other = held(dice, view).filter(|_| once_in(dice, 8)).map(EdgeId);
    other.or(shown).map_or(ElementId::Vertex(VertexId::ROOT), ElementId::Edge)
}

fn new_key(dice: &mut Dice, view: &View<'_>) -> EdgeKey {
    let from = vertex(dice, view);
    let mut to = vertex(dice, view);
    if to == from && !once_in(dice, 4) {
        to = vertex(dice, view);
    }
    EdgeKey { from, to, label: label(dice) }
}

/// The key of an edge that is shown, mostly.
fn shown_key(dice: &mut Dice, view: &View<'_>) -> EdgeKey {
    let shown = pick(dice, view.edges()).map(|shown| shown.edge.key());
    let other = once_in(dice, 12).then(|| new_key(dice, view));
    other.or(shown).unwrap_or_else(|| new_key(dice, view))
}
