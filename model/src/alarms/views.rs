//! Flaws of the view.

use super::broken::Flaw;
use super::shown::Shown;
use crate::checked::replica_id;
use dsr_core::{EdgeId, Record, Repair, Rule, ShownEdge, View};

/// Kinematic claims are shown without looking for cycles.
#[derive(Debug)]
pub(super) struct NoCycleCheck;

impl Flaw for NoCycleCheck {
    fn show<'s>(&self, view: &View<'s>, _here: usize) -> Shown<'s> {
        let mut shown = Shown::of(view);
        for repair in view.repairs() {
            if let Repair::CycleBroken { hidden } = repair {
                shown.unhide(*hidden);
            }
        }
        shown
    }
}

/// A name that several vertices have finds the newest of them.
#[derive(Debug)]
pub(super) struct NewestName;

impl Flaw for NewestName {
    fn show<'s>(&self, view: &View<'s>, _here: usize) -> Shown<'s> {
        let mut shown = Shown::of(view);
        for (name, found) in &mut shown.names {
            let holders = view
                .vertices()
                .iter()
                .filter(|&&id| view.vertex(id).is_some_and(|vertex| vertex.name == *name));
            if let Some(newest) = holders.max_by_key(|id| view.state().rank(id.0)) {
                *found = *newest;
            }
        }
        shown
    }
}

/// Every claim under a functional label is shown.
#[derive(Debug)]
pub(super) struct FunctionalNotRepaired;

impl Flaw for FunctionalNotRepaired {
    fn show<'s>(&self, view: &View<'s>, _here: usize) -> Shown<'s> {
        let mut shown = Shown::of(view);
        for (hidden, _) in functional(view) {
            shown.unhide(hidden);
        }
        shown
    }
}

/// Of claims under a functional label, each replica shows its own.
#[derive(Debug)]
pub(super) struct OwnClaimWins;

impl Flaw for OwnClaimWins {
    fn show<'s>(&self, view: &View<'s>, here: usize) -> Shown<'s> {
        let mut shown = Shown::of(view);
        let own = functional(view).filter(|(hidden, _)| hidden.0.replica == replica_id(here));
        for (hidden, winner) in own {
            shown.hide(winner);
            shown.unhide(hidden);
        }
        shown
    }
}

/// Edges are shown before their ends have arrived.
#[derive(Debug)]
pub(super) struct PendingShown;

impl Flaw for PendingShown {
    fn show<'s>(&self, view: &View<'s>, _here: usize) -> Shown<'s> {
        let mut shown = Shown::of(view);
        for (dot, record) in view.state().records() {
            if let Record::Edge(edge) = record
                && !(view.has_vertex(edge.from) && view.has_vertex(edge.to))
            {
                shown.edges.push(ShownEdge { id: EdgeId(dot), edge });
            }
        }
        shown
    }
}

/// What has lost its last path to the root is left hanging in the air.
#[derive(Debug)]
pub(super) struct NotReattached;

impl Flaw for NotReattached {
    fn show<'s>(&self, view: &View<'s>, _here: usize) -> Shown<'s> {
        let mut shown = Shown::of(view);
        shown.repairs.retain(|repair| !matches!(repair, Repair::Reattached { .. }));
        shown
    }
}

/// Of several live writes, the first in the order of dots is shown.
#[derive(Debug)]
pub(super) struct FirstWrite;

impl Flaw for FirstWrite {
    fn show<'s>(&self, view: &View<'s>, _here: usize) -> Shown<'s> {
        let mut shown = Shown::of(view);
        shown.writes.sort_by_key(|(dot, write)| (write.target, write.name.clone(), *dot));
        shown
    }
}

/// Hidden claims under functional labels, each with the one shown.
fn functional<'v>(view: &'v View<'_>) -> impl Iterator<Item = (EdgeId, EdgeId)> + 'v {
    view.repairs().iter().filter_map(|repair| match repair {
        Repair::Superseded { hidden, shown, rule: Rule::Functional } => Some((*hidden, *shown)),
        _ => None,
    })
}
