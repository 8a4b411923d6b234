//! Depth-first search by stateright.

use super::Space;
use crate::progress::Progress;
use stateright::{Checker, Model, Property};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// What a search has seen.
#[derive(Debug)]
pub struct Explored<F> {
    /// Different nodes.
    pub unique: u64,
    /// Nodes whose successors were generated.
    pub expanded: u64,
    /// Successors generated, repeated ones included.
    pub generated: u64,
    /// Whether the search was told to stop before its end.
    pub cut: bool,
    /// How long it took.
    pub seconds: f64,
    /// The first fault met.
    pub fault: Option<F>,
}

/// Searches the space to its end, to the first fault, or to a limit of `progress`; returns the space as well,
/// with all that it has computed.
pub fn explore<P: Space>(space: P, progress: &Arc<Progress>) -> (P, Explored<P::Fault>) {
    let inner = Inner { space, explored: Explored::new() };
    let model = SpaceModel { inner: Arc::new(Mutex::new(inner)), progress: progress.clone() };
    let shared = model.inner.clone();
    let checker = model.checker().threads(1).spawn_dfs().join();
    let unique = checker.unique_state_count() as u64;
    drop(checker);
    let mut inner = take(shared);
    inner.explored.unique = unique;
    inner.explored.seconds = progress.seconds();
    (inner.space, inner.explored)
}

/// The search is over: nobody else holds what it shared.
fn take<P: Space>(mut shared: Arc<Mutex<Inner<P>>>) -> Inner<P> {
    loop {
        match Arc::try_unwrap(shared) {
            Ok(inner) => return inner.into_inner().unwrap_or_else(PoisonError::into_inner),
            // stateright's thread may take a moment to let go.
            Err(again) => shared = again,
        }
        std::thread::yield_now();
    }
}

impl<F> Explored<F> {
    const fn new() -> Self {
        Self { unique: 0, expanded: 0, generated: 0, cut: false, seconds: 0.0, fault: None }
    }
}

/// A space as stateright sees it: successors and one property, the conjunction of all clauses.
///
/// One property only: with several, stateright 0.31 no longer reports the first violation that it met.
struct SpaceModel<P: Space> {
    inner: Arc<Mutex<Inner<P>>>,
    progress: Arc<Progress>,
}

struct Inner<P: Space> {
    space: P,
    explored: Explored<P::Fault>,
}

impl<P: Space> SpaceModel<P> {
    fn inner(&self) -> MutexGuard<'_, Inner<P>> {
        // A panic inside the space ends the run anyway.
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<P: Space> Model for SpaceModel<P> {
    type State = P::Node;
    type Action = (P::Event, P::Node);

    fn init_states(&self) -> Vec<P::Node> {
        vec![self.inner().space.start()]
    }

    fn actions(&self, at: &P::Node, actions: &mut Vec<Self::Action>) {
        let Inner { space, explored } = &mut *self.inner();
        if self.progress.must_stop() {
            explored.cut = true;
            return;
        }
        explored.expanded += 1;
        if explored.fault.is_some() {
            return;
        }
        match space.successors(at, actions) {
            Ok(()) => {
                explored.generated += actions.len() as u64;
                self.progress.note(explored.expanded, explored.generated, space.depth(at));
                self.progress.note_seen(space.states_judged(), space.witnessed());
            }
            Err(fault) => {
                explored.fault = Some(fault);
                actions.clear();
            }
        }
    }

    fn next_state(&self, _: &P::Node, action: Self::Action) -> Option<P::Node> {
        Some(action.1)
    }

    fn properties(&self) -> Vec<Property<Self>> {
        vec![Property::always("every clause holds", |model, at| {
            let Inner { space, explored } = &mut *model.inner();
            if explored.fault.is_some() {
                return false;
            }
            if space.is_covered(at) {
                return true;
            }
            explored.fault = space.judge(at).err();
            explored.fault.is_none()
        })]
    }
}
