//! Which of the two cores a run asks.

use super::Twin;
use crate::checked::Checked;
use crate::histories::HistoryRun;
use crate::job::{AlgebraRun, Job};
use crate::walks::WalkRun;
use std::sync::Arc;

/// Which core.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Core {
    /// The readable reference.
    Reference,
    /// The fast replica alone, judged itself.
    Fast,
    /// The fast replica beside the reference.
    Both,
}

/// A run that can be made on either core.
pub trait OnCore {
    /// The run on a core.
    fn on(self, core: Core) -> Box<dyn Job>;
}

/// The semantics of a run on a core, and the run with it.
macro_rules! on_core {
    ($run:ident) => {
        impl OnCore for $run<Checked> {
            fn on(self, core: Core) -> Box<dyn Job> {
                let checked = Checked::clone(&self.semantics);
                match core {
                    Core::Reference => Box::new(self),
                    Core::Fast => Box::new(self.with(Twin::alone(checked))),
                    Core::Both => Box::new(self.with(Twin::beside(checked))),
                }
            }
        }
    };
}

on_core!(HistoryRun);
on_core!(WalkRun);
on_core!(AlgebraRun);

impl<S> HistoryRun<S> {
    fn with<T>(self, semantics: T) -> HistoryRun<T> {
        let Self { name, focus, bound, symmetry, second_engine, .. } = self;
        HistoryRun { name, semantics: Arc::new(semantics), focus, bound, symmetry, second_engine }
    }
}

impl<S> WalkRun<S> {
    fn with<T>(self, semantics: T) -> WalkRun<T> {
        let Self { name, focus, walk, walks, .. } = self;
        WalkRun { name, semantics: Arc::new(semantics), focus, walk, walks }
    }
}

impl<S> AlgebraRun<S> {
    fn with<T>(self, semantics: T) -> AlgebraRun<T> {
        AlgebraRun { semantics: Arc::new(semantics), records: self.records }
    }
}
