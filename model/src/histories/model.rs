//! The search space of L1 as a stateright model.

use super::{Bound, Choice, Fault, Histories, History};
use crate::progress::Progress;
use crate::semantics::{Breach, Semantics};
use crate::tables::StepFault;
use stateright::{Model, Property};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// L1 as stateright sees it: successors and one property, the conjunction of all clauses.
///
/// One property only: with several, stateright 0.31 no longer reports the first violation that it met.
#[derive(Debug)]
pub struct HistoryModel<S: Semantics> {
    inner: Mutex<Inner<S>>,
    progress: Arc<Progress>,
}

#[derive(Debug)]
struct Inner<S: Semantics> {
    histories: Histories<S>,
    fault: Option<FoundFault<S>>,
    /// Whether the search was told to stop before its end.
    cut: bool,
    /// Successors generated.
    generated: u64,
    /// Histories whose successors were generated.
    expanded: u64,
}

/// What broke.
#[derive(Debug)]
pub enum FoundFault<S: Semantics> {
    /// A delivered set.
    Delivered(Fault),
    /// A local step.
    Step(StepFault<S>),
}

impl<S: Semantics> FoundFault<S> {
    /// The clause.
    pub fn breach(&self) -> &Breach {
        match self {
            Self::Delivered(fault) => &fault.breach,
            Self::Step(fault) => &fault.breach,
        }
    }
}

impl<S: Semantics> HistoryModel<S> {
    /// The model of a bound; it counts into `progress` and stops when that says so.
    pub fn new(semantics: Arc<S>, bound: Bound, symmetry: bool, progress: Arc<Progress>) -> Self {
        let histories = Histories::new(semantics, bound, symmetry);
        Self {
            inner: Mutex::new(Inner { histories, fault: None, cut: false, generated: 0, expanded: 0 }),
            progress,
        }
    }

    fn inner(&self) -> MutexGuard<'_, Inner<S>> {
        // A panic inside the semantics ends the run anyway.
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Histories expanded, successors generated, and whether the search was cut short.
    pub fn counts(&self) -> (u64, u64, bool) {
        let inner = self.inner();
        (inner.expanded, inner.generated, inner.cut)
    }

    /// Looks at the space and the first fault.
    pub fn inspect<T>(&self, look: impl FnOnce(&mut Histories<S>, Option<&FoundFault<S>>) -> T) -> T {
        let inner = &mut *self.inner();
        look(&mut inner.histories, inner.fault.as_ref())
    }
}

impl<S: Semantics + 'static> Model for HistoryModel<S> {
    type State = History;
    type Action = (Choice, History);

    fn init_states(&self) -> Vec<History> {
        vec![self.inner().histories.start()]
    }

    fn actions(&self, history: &History, actions: &mut Vec<Self::Action>) {
        let inner = &mut *self.inner();
        if self.progress.must_stop() {
            inner.cut = true;
            return;
        }
        inner.expanded += 1;
        if inner.fault.is_some() {
            return;
        }
        match inner.histories.successors(history, actions) {
            Ok(()) => {
                inner.generated += actions.len() as u64;
                self.progress.note(
                    inner.expanded,
                    inner.generated,
                    inner.histories.judged().0,
                    history.depth(),
                );
            }
            Err(fault) => {
                inner.fault = Some(FoundFault::Step(fault));
                actions.clear();
            }
        }
    }

    fn next_state(&self, _: &History, action: Self::Action) -> Option<History> {
        Some(action.1)
    }

    fn properties(&self) -> Vec<Property<Self>> {
        vec![Property::always("every clause holds in every delivered subset", |model, history| {
            let inner = &mut *model.inner();
            if inner.fault.is_some() {
                return false;
            }
            // What is delivered in a history that goes on is judged as part of a longer one.
            if inner.histories.is_extended(history) {
                return true;
            }
            match inner.histories.judge(history) {
                Ok(()) => true,
                Err(fault) => {
                    inner.fault = Some(FoundFault::Delivered(fault));
                    false
                }
            }
        })]
    }
}
