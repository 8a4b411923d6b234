//! The search space of a scenario as a stateright model. `[spec: SCEN-9]`

use super::explore::Replicated;
use super::space::{Broken, Node, Space};
use stateright::{Model, Property};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A scenario as stateright sees it: successors, and one property, that no clause is broken.
///
/// The scenario's own properties do not end the search: each is to have its verdict. One property only: with
/// several, stateright 0.31 no longer reports the first violation that it met.
#[derive(Debug)]
pub(super) struct ScenarioModel<S> {
    inner: Mutex<Inner<S>>,
}

#[derive(Debug)]
pub(super) struct Inner<S> {
    pub(super) space: Space<S>,
    /// Successors of the history that was judged last.
    expanded: Option<(Node, Vec<Node>)>,
    pub(super) counts: Counts,
    pub(super) broken: Option<Broken>,
}

/// What was done.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(super) struct Counts {
    /// Histories whose successors were generated.
    pub(super) expanded: u64,
    /// Successors generated.
    pub(super) generated: u64,
    /// Histories that have ended.
    pub(super) ends: u64,
}

impl<S: Replicated> ScenarioModel<S> {
    pub(super) fn new(space: Space<S>) -> Self {
        let inner = Inner { space, expanded: None, counts: Counts::default(), broken: None };
        Self { inner: Mutex::new(inner) }
    }

    pub(super) fn inner(&self) -> MutexGuard<'_, Inner<S>> {
        // A panic inside the semantics ends the run anyway.
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<S: Replicated> Inner<S> {
    /// Judges a history and finds its successors.
    fn expand(&mut self, node: &Node) -> Result<Vec<Node>, Broken> {
        let options = self.space.options;
        if self.space.memo.states() > options.states_max || self.counts.expanded > options.histories_max {
            self.space.is_bounded = true;
            return Ok(Vec::new());
        }
        let mut successors = Vec::new();
        self.space.successors(node, &mut successors)?;
        self.counts.ends += u64::from(self.space.judge_end(node)?);
        if successors.is_empty() {
            self.space.judge_subsets(node)?;
        }
        Ok(successors.into_iter().map(|(_, next)| next).collect())
    }
}

impl<S: Replicated> Model for ScenarioModel<S> {
    type State = Node;
    type Action = Node;

    fn init_states(&self) -> Vec<Node> {
        vec![self.inner().space.start()]
    }

    fn actions(&self, node: &Node, actions: &mut Vec<Node>) {
        let inner = &mut *self.inner();
        // The property is asked first, of the same history; it has done the work.
        let known =
            inner.expanded.take().filter(|(known, _)| known == node).map(|(_, successors)| successors);
        let successors = match known {
            Some(successors) => successors,
            None if inner.broken.is_some() => return,
            None => inner.expand(node).unwrap_or_default(),
        };
        inner.counts.expanded += 1;
        inner.counts.generated += successors.len() as u64;
        actions.extend(successors);
    }

    fn next_state(&self, _: &Node, action: Node) -> Option<Node> {
        Some(action)
    }

    fn properties(&self) -> Vec<Property<Self>> {
        vec![Property::always("no clause is broken", |model, node| {
            let inner = &mut *model.inner();
            if inner.broken.is_some() {
                return false;
            }
            match inner.expand(node) {
                Ok(successors) => {
                    inner.expanded = Some((node.clone(), successors));
                    true
                }
                Err(broken) => {
                    inner.broken = Some(broken);
                    false
                }
            }
        })]
    }
}
