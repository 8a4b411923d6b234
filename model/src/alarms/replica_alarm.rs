//! A fast replica broken on purpose.

use super::flawed::{Flawed, ReplicaFlaw};
use super::run::{LayerReport, layers};
use super::subject::subject;
use crate::checked::Checked;
use crate::histories::{Bound, HistoryRun};
use crate::job::Job;
use crate::replay::{ReplayError, Replayed, replay_with};
use crate::trace::Trace;
use crate::twin::Twin;
use std::sync::Arc;

/// The vertices of [`subject`] that replicas touch.
const FOCUS: usize = 2;

/// A fast replica broken on purpose, beside the sound reference.
#[derive(Clone, Copy, Debug)]
pub struct ReplicaAlarm {
    /// Its name.
    pub name: &'static str,
    /// The clause that it offends, at its root. What a layer reports may be a consequence.
    pub clause: &'static str,
    /// What is broken, in a sentence.
    pub broken: &'static str,
    run: fn(&'static str, bool) -> Vec<LayerReport>,
    histories: fn(&'static str, Checked, Bound) -> Box<dyn Job>,
    replay: fn(&'static str, Checked, &Trace) -> Result<Replayed, ReplayError>,
}

impl ReplicaAlarm {
    /// The alarm of a flaw.
    pub(super) fn of<X: ReplicaFlaw>(name: &'static str, clause: &'static str, broken: &'static str) -> Self {
        Self {
            name,
            clause,
            broken,
            run: |name, all| layers(&|kinds, focus| Twin::<Flawed<X>>::of(name, subject(kinds, focus)), all),
            histories: |name, core, bound| {
                let semantics = Arc::new(Twin::<Flawed<X>>::of(name, core));
                let (name, focus) = (name.into(), FOCUS);
                Box::new(HistoryRun { name, semantics, focus, bound, symmetry: false, second_engine: false })
            },
            replay: |name, core, trace| replay_with(&Twin::<Flawed<X>>::of(name, core), trace),
        }
    }

    /// Tries every layer, the cheapest first; with `all_layers` also those after the first that finds it.
    pub fn run(&self, all_layers: bool) -> Vec<LayerReport> {
        (self.run)(self.name, all_layers)
    }

    /// A run of L1 on it, beside the reference of `core`.
    pub fn histories(&self, core: Checked, bound: Bound) -> Box<dyn Job> {
        (self.histories)(self.name, core, bound)
    }

    /// Carries out a trace of it again.
    pub(crate) fn replay(&self, core: Checked, trace: &Trace) -> Result<Replayed, ReplayError> {
        (self.replay)(self.name, core, trace)
    }
}
