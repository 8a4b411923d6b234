//! Flaws of resynchronisation.

use super::broken::{Flaw, Sound};
use super::parts::{Parts, dictionary};
use dsr_core::{CausalContext, Delta, Dot, Repair, State, view};

/// The digest is the context alone: who has seen the same dots is taken to hold the same records.
#[derive(Debug)]
pub(super) struct ContextDigest;

impl Flaw for ContextDigest {
    fn repair(&self, ours: &State, theirs: &State) -> Delta {
        let unseen = |dot: &Dot| !theirs.context().contains(*dot);
        let records =
            ours.records().filter(|(dot, _)| unseen(dot)).map(|(dot, record)| (dot, record.clone()));
        let context: CausalContext =
            ours.context().runs().flat_map(dsr_core::Run::dots).filter(unseen).collect();
        State::assemble(records, context)
    }
}

/// What is sent is the view, not the state: claims that the view hides are not.
#[derive(Debug)]
pub(super) struct SendsTheView;

impl Flaw for SendsTheView {
    fn repair(&self, ours: &State, theirs: &State) -> Delta {
        let mut delta = Parts::of(&Sound.repair(ours, theirs));
        for repair in view(ours, &dictionary()).repairs() {
            if let Repair::Superseded { hidden, .. } | Repair::CycleBroken { hidden } = repair {
                delta.records.remove(&hidden.0);
            }
        }
        delta.build()
    }
}
