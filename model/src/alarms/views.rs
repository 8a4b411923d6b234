//! Flaws of the view.

use super::broken::Flaw;
use super::shown::Shown;
use crate::checked::replica_id;
use dsr_core::{EdgeId, Record, Repair, Rule, View};

/// Kinematic claims are shown without looking for cycles.
#[derive(Debug)]
pub(super) struct NoCycleCheck;

impl Flaw for NoCycleCheck {
    fn show(&self, view: &View<'_>, _here: usize) -> Shown {
        let mut shown = Shown::of(view);
        for repair in view.repairs() {
            if let Repair::CycleBroken { hidden } = repair {
                shown.unhide(view.state(), *hidden);
            }
        }
        shown
    }
}

/// A name that several vertices have finds the newest of them.
#[derive(Debug)]
pub(super) struct NewestName;

impl Flaw for NewestName {
    fn show(&self, view: &View<'_>, _here: usize) -> Shown {
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
    fn show(&self, view: &View<'_>, _here: usize) -> Shown {
        let mut shown = Shown::of(view);
        for (hidden, _) in functional(view) {
            shown.unhide(view.state(), hidden);
        }
        shown
    }
}

/// Of claims under a functional label, each replica shows its own.
#[derive(Debug)]
pub(super) struct OwnClaimWins;

impl Flaw for OwnClaimWins {
    fn show(&self, view: &View<'_>, here: usize) -> Shown {
        let mut shown = Shown::of(view);
        let own = functional(view).filter(|(hidden, _)| hidden.0.replica == replica_id(here));
        for (hidden, winner) in own {
            shown.hide(winner);
            shown.unhide(view.state(), hidden);
        }
        shown
    }
}

/// Edges are shown before their ends have arrived.
#[derive(Debug)]
pub(super) struct PendingShown;

impl Flaw for PendingShown {
    fn show(&self, view: &View<'_>, _here: usize) -> Shown {
        let mut shown = Shown::of(view);
        for (dot, record) in view.state().records() {
            if let Record::Edge(edge) = record
                && !(view.has_vertex(edge.from) && view.has_vertex(edge.to))
            {
                shown.edges.insert(EdgeId(dot), edge.clone());
            }
        }
        shown
    }
}

/// What has lost its last path to the root is left hanging in the air.
#[derive(Debug)]
pub(super) struct NotReattached;

impl Flaw for NotReattached {
    fn show(&self, view: &View<'_>, _here: usize) -> Shown {
        let mut shown = Shown::of(view);
        for repair in view.repairs() {
            if let Repair::Reattached { vertex } = repair {
                shown.hung.remove(vertex);
            }
        }
        shown
    }
}

/// Of several live writes, the first in the order of dots is shown.
#[derive(Debug)]
pub(super) struct FirstWrite;

impl Flaw for FirstWrite {
    fn show(&self, view: &View<'_>, _here: usize) -> Shown {
        let mut shown = Shown::of(view);
        for ((target, name), winner) in &mut shown.attributes {
            let writes = view.attribute_writes(*target, name);
            *winner = writes.iter().map(|(dot, _)| *dot).min().unwrap_or(*winner);
        }
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
