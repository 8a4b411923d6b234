//! The schedules as a stateright model.

use super::ScheduleBound;
use super::space::{ScheduleFault, Schedules};
use super::state::{Event, Schedule};
use crate::progress::Progress;
use crate::semantics::Semantics;
use stateright::{Model, Property};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// L2 as stateright sees it: successors, and one property, the conjunction of all clauses.
#[derive(Debug)]
pub struct ScheduleModel<S: Semantics> {
    inner: Mutex<Inner<S>>,
    progress: Arc<Progress>,
}

#[derive(Debug)]
struct Inner<S: Semantics> {
    schedules: Schedules<S>,
    fault: Option<ScheduleFault>,
    cut: bool,
    generated: u64,
    expanded: u64,
}

impl<S: Semantics> ScheduleModel<S> {
    /// The model of a bound; it counts into `progress` and stops when that says so.
    pub fn new(semantics: Arc<S>, bound: ScheduleBound, progress: Arc<Progress>) -> Self {
        let schedules = Schedules::new(semantics, bound);
        Self {
            inner: Mutex::new(Inner { schedules, fault: None, cut: false, generated: 0, expanded: 0 }),
            progress,
        }
    }

    fn inner(&self) -> MutexGuard<'_, Inner<S>> {
        // A panic inside the semantics ends the run anyway.
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Schedules expanded, successors generated, and whether the search was cut short.
    pub fn counts(&self) -> (u64, u64, bool) {
        let inner = self.inner();
        (inner.expanded, inner.generated, inner.cut)
    }

    /// Looks at the space and the first fault.
    pub fn inspect<T>(&self, look: impl FnOnce(&mut Schedules<S>, Option<&ScheduleFault>) -> T) -> T {
        let inner = &mut *self.inner();
        look(&mut inner.schedules, inner.fault.as_ref())
    }
}

impl<S: Semantics + 'static> Model for ScheduleModel<S> {
    type State = Schedule;
    type Action = (Event, Schedule);

    fn init_states(&self) -> Vec<Schedule> {
        vec![self.inner().schedules.start()]
    }

    fn actions(&self, schedule: &Schedule, actions: &mut Vec<Self::Action>) {
        let inner = &mut *self.inner();
        if self.progress.must_stop() {
            inner.cut = true;
            return;
        }
        inner.expanded += 1;
        if inner.fault.is_some() {
            return;
        }
        match inner.schedules.successors(schedule, actions) {
            Ok(()) => {
                inner.generated += actions.len() as u64;
                let depth = schedule.pool().count();
                self.progress.note(inner.expanded, inner.generated, inner.schedules.judged().0, depth);
            }
            Err(fault) => {
                inner.fault = Some(fault);
                actions.clear();
            }
        }
    }

    fn next_state(&self, _: &Schedule, action: Self::Action) -> Option<Schedule> {
        Some(action.1)
    }

    fn properties(&self) -> Vec<Property<Self>> {
        vec![Property::always(
            "every clause holds, and from everywhere all can become equal",
            |model, schedule| {
                let inner = &mut *model.inner();
                if inner.fault.is_some() {
                    return false;
                }
                match inner.schedules.judge(schedule) {
                    Ok(()) => true,
                    Err(breach) => {
                        inner.fault = Some(ScheduleFault { breach, event: None });
                        false
                    }
                }
            },
        )]
    }
}
