//! Flaws of mutations: deltas that say too much, too little, or the wrong thing.

use super::broken::{Flaw, Sound};
use super::parts::{Parts, with_stamp};
use crate::checked::INCARNATION;
use dsr_core::{Author, CausalContext, Delta, Dot, Mutation, Record, State, View};

/// A delta's context covers everything that its author ever did.
#[derive(Debug)]
pub(super) struct FullContext;

impl Flaw for FullContext {
    fn delta(&self, before: &View<'_>, author: Author, mutation: &Mutation) -> Option<Delta> {
        let mut parts = Parts::of(&Sound.delta(before, author, mutation)?);
        let own = before.state().context().runs().filter(|run| run.replica == author.replica);
        own.for_each(|run| parts.context.extend(run.dots()));
        Some(parts.build())
    }

    fn after(&self, before: &View<'_>, author: Author, mutation: &Mutation, delta: &Delta) -> State {
        // The author applies what it meant, not what it sends.
        Sound
            .delta(before, author, mutation)
            .map_or_else(|| before.state().joined(delta), |meant| before.state().joined(&meant))
    }
}

/// A removal also kills the next event of whoever made what it removes, before anybody has seen it.
#[derive(Debug)]
pub(super) struct KillsUnseen;

impl Flaw for KillsUnseen {
    fn delta(&self, before: &View<'_>, author: Author, mutation: &Mutation) -> Option<Delta> {
        let delta = Sound.delta(before, author, mutation)?;
        let mut parts = Parts::of(&delta);
        if matches!(mutation, Mutation::RemoveEdge { .. } | Mutation::RemoveVertex { .. }) {
            let authors = delta.context().runs().map(|run| run.replica);
            parts.context.extend(authors.filter_map(|replica| before.state().next_dot(replica)));
        }
        Some(parts.build())
    }
}

/// A new stamp is one above the author's own, whatever it has received.
#[derive(Debug)]
pub(super) struct StampNotAdvanced;

impl Flaw for StampNotAdvanced {
    fn delta(&self, before: &View<'_>, author: Author, mutation: &Mutation) -> Option<Delta> {
        let mut parts = Parts::of(&Sound.delta(before, author, mutation)?);
        let own = before.state().records().filter(|(dot, _)| dot.replica == author.replica);
        let stamp = 1 + own.map(|(_, record)| record.stamp()).max().unwrap_or(0);
        for record in parts.records.values_mut() {
            *record = with_stamp(record.clone(), stamp);
        }
        Some(parts.build())
    }
}

/// After a restart that lost everything, a replica goes on under its old id.
#[derive(Debug)]
pub(super) struct ReusedDot;

impl Flaw for ReusedDot {
    fn identity(&self, replica: usize) -> usize {
        replica % INCARNATION
    }
}

/// Removing an edge kills the instance shown, and leaves the claims that it hides.
#[derive(Debug)]
pub(super) struct LosersKept;

impl Flaw for LosersKept {
    fn delta(&self, before: &View<'_>, author: Author, mutation: &Mutation) -> Option<Delta> {
        let delta = Sound.delta(before, author, mutation)?;
        let Mutation::RemoveEdge { key } = mutation else { return Some(delta) };
        let shown = before.edge_by_key(key)?;
        Some(State::assemble([], CausalContext::from_iter([shown.id.0])))
    }
}

/// An edge is removed though somebody then hangs in the air.
#[derive(Debug)]
pub(super) struct StrandingRemoval;

impl Flaw for StrandingRemoval {
    fn delta(&self, before: &View<'_>, author: Author, mutation: &Mutation) -> Option<Delta> {
        let refused = || {
            let Mutation::RemoveEdge { key } = mutation else { return None };
            Some(State::assemble([], CausalContext::from_iter([before.edge_by_key(key)?.id.0])))
        };
        Sound.delta(before, author, mutation).or_else(refused)
    }
}

/// A mutation that is refused uses up a dot all the same.
#[derive(Debug)]
pub(super) struct RefusalConsumes;

impl Flaw for RefusalConsumes {
    fn delta(&self, before: &View<'_>, author: Author, mutation: &Mutation) -> Option<Delta> {
        let consumed = || {
            Some(State::assemble([], CausalContext::from_iter([before.state().next_dot(author.replica)?])))
        };
        Sound.delta(before, author, mutation).or_else(consumed)
    }
}

/// An update leaves the writes that it replaces.
#[derive(Debug)]
pub(super) struct UpdateKeepsOld;

impl Flaw for UpdateKeepsOld {
    fn delta(&self, before: &View<'_>, author: Author, mutation: &Mutation) -> Option<Delta> {
        let delta = Sound.delta(before, author, mutation)?;
        if matches!(mutation, Mutation::UpdateAttributes { .. }) {
            Some(without_kills(&delta))
        } else {
            Some(delta)
        }
    }
}

/// Moving an edge leaves it where it was as well.
#[derive(Debug)]
pub(super) struct MoveCopies;

impl Flaw for MoveCopies {
    fn delta(&self, before: &View<'_>, author: Author, mutation: &Mutation) -> Option<Delta> {
        let delta = Sound.delta(before, author, mutation)?;
        if matches!(mutation, Mutation::MoveEdge { .. }) { Some(without_kills(&delta)) } else { Some(delta) }
    }
}

/// The vertex and its link are two deltas, and the second one may be lost.
#[derive(Debug)]
pub(super) struct LinkApart;

impl Flaw for LinkApart {
    fn delta(&self, before: &View<'_>, author: Author, mutation: &Mutation) -> Option<Delta> {
        let delta = Sound.delta(before, author, mutation)?;
        // The second one is lost here.
        if !matches!(mutation, Mutation::AddVertex { .. }) {
            return Some(delta);
        }
        let vertices = delta.records().filter(|(_, record)| matches!(record, Record::Vertex(_)));
        let vertices: Vec<(Dot, Record)> = vertices.map(|(dot, record)| (dot, record.clone())).collect();
        let context = vertices.iter().map(|(dot, _)| *dot).collect();
        Some(State::assemble(vertices, context))
    }
}

/// The delta with its new records alone.
fn without_kills(delta: &Delta) -> Delta {
    let mut parts = Parts::of(delta);
    parts.context = parts.records.keys().copied().collect();
    parts.build()
}
