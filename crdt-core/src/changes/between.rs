//! The changes between two views from scratch: the readable reference. `[spec: EVENT-1]`

use super::{Change, Changes};
use crate::dot::Dot;
use crate::record::Write;
use crate::view::{ShownEdge, Shows};
use alloc::vec::Vec;
use core::cmp::Ordering;

impl Changes {
    /// What differs between two views, whoever shows them. O(both).
    ///
    /// ```
    /// use dsr_core::{Author, Changes, Dictionary, Replica, ReplicaId, State, VertexId, VertexLink};
    /// use dsr_core::{NewVertex, add_vertex, view};
    ///
    /// let (dictionary, before) = (Dictionary::open(), State::new());
    /// let link = VertexLink::child_of(VertexId::ROOT);
    /// let author = Author::new(ReplicaId::agent(1));
    /// let delta = add_vertex(&view(&before, &dictionary), author, &NewVertex::new("room", "kitchen"), &link)?;
    /// let after = before.joined(&delta);
    /// let expected = Changes::between(&view(&before, &dictionary), &view(&after, &dictionary));
    /// assert_eq!(Replica::new(ReplicaId::agent(2), dictionary.clone()).apply(&delta), expected);
    /// # Ok::<(), dsr_core::AddVertexError>(())
    /// ```
    pub fn between(before: &impl Shows, after: &impl Shows) -> Self {
        let mut changes = Vec::new();
        vertices(before, after, &mut changes);
        edges(before, after, &mut changes);
        attributes(before, after, &mut changes);
        compare(before.repairs(), after.repairs(), Ord::cmp, |old, new| match (old, new) {
            (Some(old), None) => changes.push(Change::RepairGone(old.clone())),
            (None, Some(new)) => changes.push(Change::RepairMade(new.clone())),
            _ => {}
        });
        changes.into_iter().collect()
    }
}

/// `[spec: EVENT-2]`
fn vertices(before: &impl Shows, after: &impl Shows, changes: &mut Vec<Change>) {
    compare(before.vertices(), after.vertices(), Ord::cmp, |old, new| {
        let old = old.map(|&vertex| (vertex, before.state().vertex(vertex.0)));
        let new = new.map(|&vertex| (vertex, after.state().vertex(vertex.0)));
        if old != new {
            let removed = old.and_then(|(vertex, record)| Some((vertex, record?.name.clone())));
            changes.extend(removed.map(|(vertex, name)| Change::VertexRemoved { vertex, name }));
            changes.extend(new.map(|(vertex, _)| Change::VertexAdded { vertex }));
        }
    });
}

/// `[spec: EVENT-2]`
fn edges(before: &impl Shows, after: &impl Shows, changes: &mut Vec<Change>) {
    let by_key = |left: &ShownEdge<'_>, right: &ShownEdge<'_>| {
        let key = |shown: &ShownEdge<'_>| (shown.edge.from, shown.edge.to);
        key(left).cmp(&key(right)).then_with(|| left.edge.label.cmp(&right.edge.label))
    };
    compare(before.edges(), after.edges(), by_key, |old, new| {
        if old != new {
            let gone = old.map(|old| Change::EdgeHidden { edge: old.id, key: old.edge.key() });
            let come = new.map(|new| Change::EdgeShown { edge: new.id, key: new.edge.key() });
            changes.extend(gone.into_iter().chain(come));
        }
    });
}

/// The writes shown of one attribute, the winner first.
type Register<'w> = &'w [(Dot, &'w Write)];

/// `[spec: EVENT-3]`
fn attributes(before: &impl Shows, after: &impl Shows, changes: &mut Vec<Change>) {
    let (old, new) = (registers(before.writes()), registers(after.writes()));
    let by_place = |left: &Register<'_>, right: &Register<'_>| place(left).cmp(&place(right));
    compare(&old, &new, by_place, |old, new| {
        let (old, new) = (old.copied().unwrap_or_default(), new.copied().unwrap_or_default());
        if old == new {
            return;
        }
        let winner = |register: Register<'_>| register.first().map(|(dot, _)| *dot);
        let one = old.first().or(new.first());
        changes.extend(one.map(|(_, write)| Change::Attribute {
            target: write.target,
            name: write.name.clone(),
            before: winner(old),
            after: winner(new),
        }));
    });
}

fn registers<'w>(writes: &'w [(Dot, &'w Write)]) -> Vec<Register<'w>> {
    writes
        .chunk_by(|(_, left), (_, right)| (left.target, &left.name) == (right.target, &right.name))
        .collect()
}

fn place<'w>(register: &Register<'w>) -> Option<(Dot, &'w str)> {
    register.first().map(|(_, write)| (write.target, &*write.name))
}

/// Walks two ascending lists side by side: what is in one of them, or what in each stands at one place.
fn compare<T>(
    before: &[T],
    after: &[T],
    order: impl Fn(&T, &T) -> Ordering,
    mut see: impl FnMut(Option<&T>, Option<&T>),
) {
    let (mut before, mut after) = (before.iter().peekable(), after.iter().peekable());
    loop {
        let side = match (before.peek(), after.peek()) {
            (Some(old), Some(new)) => order(old, new),
            (Some(_), None) => Ordering::Less,
            (None, Some(_)) => Ordering::Greater,
            (None, None) => return,
        };
        let old = if side.is_le() { before.next() } else { None };
        let new = if side.is_ge() { after.next() } else { None };
        see(old, new);
    }
}
