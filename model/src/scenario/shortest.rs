//! A second search, breadth first by mutations: the shortest counterexamples and witnesses. `[spec: SCEN-13]`
//!
//! It shares the successors with the first, not the engine: its count of histories must be the same.

use super::explore::Replicated;
use super::memo::{DeltaId, MoveKind};
use super::reduce::reduced;
use super::space::{Broken, Choice, Node, SUBSET_DELTAS_MAX, Space, subset};
use super::trace::{Last, Sought, Trace};
use rustc_hash::FxHashMap;
use std::collections::VecDeque;

/// The search, with the way to each history.
#[derive(Debug)]
pub(super) struct Shortest<'s, S> {
    space: &'s mut Space<S>,
    found: Vec<Found>,
    by_node: FxHashMap<Node, usize>,
}

#[derive(Debug)]
struct Found {
    node: Node,
    from: Option<(usize, Choice)>,
    mutations: usize,
    closed: bool,
}

impl<'s, S: Replicated> Shortest<'s, S> {
    pub(super) fn new(space: &'s mut Space<S>) -> Self {
        Self { space, found: Vec::new(), by_node: FxHashMap::default() }
    }

    /// Visits histories by their number of mutations, until `visit` is content or all are visited; how many.
    fn search(&mut self, mut visit: impl FnMut(&mut Self, usize, Option<Broken>) -> bool) -> usize {
        self.found.clear();
        self.by_node.clear();
        let start = self.space.start();
        self.by_node.insert(start.clone(), 0);
        self.found.push(Found { node: start, from: None, mutations: 0, closed: false });
        let mut queue = VecDeque::from([0]);
        let mut visited = 0;
        while let Some(at) = queue.pop_front() {
            if std::mem::replace(&mut self.found[at].closed, true) {
                continue;
            }
            visited += 1;
            let node = self.found[at].node.clone();
            let mut successors = Vec::new();
            let broken = self.space.successors(&node, &mut successors).err();
            if visit(self, at, broken) || self.found.len() as u64 > self.space.options.histories_max {
                break;
            }
            for (choice, next) in successors {
                self.reach(at, choice, next, &mut queue);
            }
        }
        visited
    }

    /// A history was reached: steps without a mutation cost nothing.
    fn reach(&mut self, from: usize, choice: Choice, next: Node, queue: &mut VecDeque<usize>) {
        let cost = usize::from(choice.step.kind == MoveKind::Mutates);
        let mutations = self.found[from].mutations + cost;
        let at = match self.by_node.get(&next) {
            Some(&at) if self.found[at].closed || self.found[at].mutations <= mutations => return,
            Some(&at) => {
                (self.found[at].from, self.found[at].mutations) = (Some((from, choice)), mutations);
                at
            }
            None => {
                let at = self.found.len();
                self.by_node.insert(next.clone(), at);
                self.found.push(Found { node: next, from: Some((from, choice)), mutations, closed: false });
                at
            }
        };
        if cost == 0 { queue.push_front(at) } else { queue.push_back(at) }
    }

    /// The steps to a history.
    fn way(&self, mut at: usize) -> Vec<Choice> {
        let mut way = Vec::new();
        while let Some((from, choice)) = &self.found[at].from {
            way.push(choice.clone());
            at = *from;
        }
        way.reverse();
        way
    }

    /// The shortest trace for each of these properties that can be decided.
    pub(super) fn properties(&mut self, mut wanted: Vec<usize>) -> Vec<(usize, Trace)> {
        let mut traces = Vec::new();
        if wanted.is_empty() {
            return traces;
        }
        self.search(|this, at, _| {
            let decided = this.decided_at(at, &wanted);
            for (property, last) in decided {
                wanted.retain(|known| *known != property);
                let way = this.way(at);
                traces.push((property, reduced(this.space, &way, last, Sought::Property(property))));
            }
            wanted.is_empty()
        });
        traces
    }

    /// Which properties this history decides, and by what.
    fn decided_at(&mut self, at: usize, wanted: &[usize]) -> Vec<(usize, Last)> {
        let scenario = self.space.memo.scenario.clone();
        let node = self.found[at].node.clone();
        let (of_ends, of_views): (Vec<usize>, Vec<usize>) =
            wanted.iter().partition(|property| scenario.properties[**property].kind.is_of_ends());
        let mut decided = Vec::new();
        if let (false, Ok(Some((state, done)))) = (of_ends.is_empty(), self.space.end(&node)) {
            let answers = self.space.memo.answers(state);
            for at in of_ends {
                let property = &scenario.properties[at];
                if property.is_decided_by(property.predicate.holds(answers, done)) {
                    decided.push((at, Last::End(state)));
                }
            }
        }
        if of_views.is_empty() {
            return decided;
        }
        for (state, received) in self.views(&node) {
            let answers = self.space.memo.answers(state);
            for &at in &of_views {
                let property = &scenario.properties[at];
                let is_new = decided.iter().all(|(known, _)| *known != at);
                if is_new && property.is_decided_by(property.predicate.holds(answers, 0)) {
                    decided.push((at, Last::View(state, received.clone())));
                }
            }
        }
        decided
    }

    /// Every view of some of a history's deltas, the fewest deltas first; of very many deltas, that of all.
    fn views(&mut self, node: &Node) -> Vec<(u32, Vec<DeltaId>)> {
        if node.pool.len() > SUBSET_DELTAS_MAX {
            return vec![(self.space.everything(node), node.pool.to_vec())];
        }
        let Ok(states) = self.space.states_of(&node.pool) else { return Vec::new() };
        let mut views: Vec<(u32, Vec<DeltaId>)> =
            states.into_iter().enumerate().map(|(mask, state)| (state, subset(&node.pool, mask))).collect();
        views.sort_by_key(|(_, received)| received.len());
        views
    }

    /// The shortest way to a broken clause.
    pub(super) fn breach(&mut self) -> Option<Trace> {
        let mut trace = None;
        self.search(|this, at, broken| {
            let node = this.found[at].node.clone();
            let broken = broken.or_else(|| {
                if node.pool.len() > SUBSET_DELTAS_MAX {
                    return None;
                }
                this.space.states_of(&node.pool).err()
            });
            trace = broken.map(|broken| {
                let (way, finding) = (this.way(at), Sought::Breach(broken.breach.clause));
                reduced(this.space, &way, Last::Broken(broken), finding)
            });
            trace.is_some()
        });
        trace
    }

    /// How many histories there are, by this engine.
    #[cfg(test)]
    fn count(&mut self) -> usize {
        self.search(|_, _, _| false)
    }
}

#[cfg(test)]
mod tests {
    use super::super::memo::Memo;
    use super::super::{Options, Scenario, shipped};
    use super::*;
    use crate::checked::alphabet::Alphabet;
    use std::sync::Arc;

    fn space(scenario: &Scenario) -> Space<crate::checked::Checked> {
        let semantics = scenario.checked(Alphabet::of(&[], Vec::new()));
        Space::new(Memo::new(Arc::new(scenario.clone()), semantics), Options::default())
    }

    /// Two engines agree on the number of histories. `[spec: SCEN-9]`
    #[test]
    fn differential_two_engines_count_the_same_histories() {
        for (file, text) in &shipped()[3..] {
            let scenario = Scenario::read(text, file).unwrap();
            let report = scenario.check(Options { traces: false, ..Options::default() });
            let count = Shortest::new(&mut space(&scenario)).count();
            assert_eq!(report.histories, count as u64, "{file}");
        }
    }
}
