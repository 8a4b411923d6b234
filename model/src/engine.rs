//! The second engine: a plain breadth-first search of our own over the same successors. It must agree with
//! stateright on every count, and it finds shortest counterexamples. `[spec: CHECK-9]`
//!
//! It keeps whole histories, not fingerprints, so it cannot lose one to a hash collision.

use crate::histories::{Choice, Fault, FoundFault, Histories, History};
use crate::semantics::Semantics;
use rustc_hash::FxHashSet;

/// What a search has seen.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Counts {
    /// Different histories.
    pub unique: u64,
    /// Successors generated, repeated ones included.
    pub generated: u64,
    /// The longest history, in mutations.
    pub depth: usize,
}

/// Counts every history within the bound; `None` if there are more than `states_max` or a step is faulty.
pub fn count<S: Semantics>(histories: &mut Histories<S>, states_max: u64) -> Option<Counts> {
    let start = histories.start();
    let mut seen = FxHashSet::from_iter([start]);
    let mut level = vec![start];
    let mut counts = Counts { unique: 1, ..Counts::default() };
    let mut successors = Vec::new();
    while !level.is_empty() {
        let mut next_level = Vec::new();
        for history in level {
            successors.clear();
            histories.successors(&history, &mut successors).ok()?;
            counts.generated += successors.len() as u64;
            next_level.extend(successors.iter().map(|&(_, next)| next).filter(|next| seen.insert(*next)));
        }
        counts.unique = seen.len() as u64;
        if counts.unique > states_max {
            return None;
        }
        counts.depth += usize::from(!next_level.is_empty());
        level = next_level;
    }
    Some(counts)
}

/// A shortest way to a fault.
#[derive(Debug)]
pub struct Counterexample<S: Semantics> {
    /// The mutations that lead to it.
    pub choices: Vec<Choice>,
    /// What breaks after them.
    pub fault: FoundFault<S>,
}

/// The first fault in breadth-first order: with the fewest mutations. Judges every history.
///
/// `None` if there is none among the first `states_max` histories.
pub fn find_fault<S: Semantics>(
    histories: &mut Histories<S>,
    states_max: usize,
) -> Option<Counterexample<S>> {
    let start = histories.start();
    let mut seen = FxHashSet::from_iter([start]);
    let mut nodes: Vec<(History, Option<(usize, Choice)>)> = vec![(start, None)];
    let mut successors = Vec::new();
    let mut at = 0;
    while at < nodes.len().min(states_max) {
        let history = nodes[at].0;
        if let Err(fault) = histories.judge(&history) {
            return Some(Counterexample {
                choices: path(&nodes, at),
                fault: FoundFault::Delivered(shrink(histories, fault)),
            });
        }
        successors.clear();
        if let Err(fault) = histories.successors(&history, &mut successors) {
            return Some(Counterexample { choices: path(&nodes, at), fault: FoundFault::Step(fault) });
        }
        for &(choice, next) in &successors {
            if seen.insert(next) {
                nodes.push((next, Some((at, choice))));
            }
        }
        at += 1;
    }
    None
}

fn path(nodes: &[(History, Option<(usize, Choice)>)], mut at: usize) -> Vec<Choice> {
    let mut choices = Vec::new();
    while let Some((before, choice)) = nodes[at].1 {
        choices.push(choice);
        at = before;
    }
    choices.reverse();
    choices
}

/// Leaves out deliveries while the same clause still breaks in the delivered set.
fn shrink<S: Semantics>(histories: &mut Histories<S>, mut fault: Fault) -> Fault {
    let mut at = 0;
    while at < fault.delivered.len() {
        let mut fewer = fault.delivered.clone();
        fewer.remove(at);
        match histories.judge_set(&fewer) {
            Err(smaller) if smaller.breach.clause == fault.breach.clause => {
                fault = smaller;
                at = 0;
            }
            _ => at += 1,
        }
    }
    fault
}
