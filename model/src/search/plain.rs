//! The second engine: a plain breadth-first search of our own over the same successors. It must agree with
//! stateright on every count, and it finds shortest counterexamples. `[spec: CHECK-9]`
//!
//! It keeps whole nodes, not fingerprints, so it cannot lose one to a hash collision.

use super::Space;
use crate::progress::Progress;
use rustc_hash::{FxBuildHasher, FxHashSet};

/// What a search has counted.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Counts {
    /// Different nodes.
    pub unique: u64,
    /// Successors generated, repeated ones included.
    pub generated: u64,
}

/// Counts every node; `None` if `progress` says to stop before the end. Room is made for `expected` nodes.
pub fn count<P: Space>(
    space: &mut P,
    expected: u64,
    progress: &Progress,
) -> Result<Option<Counts>, P::Fault> {
    let room = usize::try_from(expected).unwrap_or(0);
    let mut seen = FxHashSet::with_capacity_and_hasher(room, FxBuildHasher);
    seen.insert(space.start());
    let mut level: Vec<P::Node> = seen.iter().copied().collect();
    let mut counts = Counts::default();
    let mut successors = Vec::new();
    while !level.is_empty() {
        let mut next_level = Vec::new();
        for at in level {
            if progress.must_stop_recount(counts.unique) {
                return Ok(None);
            }
            counts.unique += 1;
            successors.clear();
            space.successors(&at, &mut successors)?;
            counts.generated += successors.len() as u64;
            next_level.extend(successors.iter().map(|&(_, next)| next).filter(|next| seen.insert(*next)));
        }
        level = next_level;
    }
    Ok(Some(counts))
}

/// Every node, in breadth-first order.
pub fn all<P: Space>(space: &mut P) -> Result<Vec<P::Node>, P::Fault> {
    let mut seen = FxHashSet::from_iter([space.start()]);
    let mut nodes: Vec<P::Node> = seen.iter().copied().collect();
    let mut successors = Vec::new();
    let mut next = 0;
    while let Some(at) = nodes.get(next).copied() {
        successors.clear();
        space.successors(&at, &mut successors)?;
        nodes.extend(successors.iter().map(|&(_, next)| next).filter(|next| seen.insert(*next)));
        next += 1;
    }
    Ok(nodes)
}

/// A shortest way to a fault.
#[derive(Debug)]
pub struct Counterexample<P: Space> {
    /// What leads to it, each event with the node before it.
    pub events: Vec<(P::Node, P::Event)>,
    /// The node that breaks a clause, or one of whose successors cannot be had without breaking one.
    pub end: P::Node,
    /// What breaks.
    pub fault: P::Fault,
}

/// The first fault in breadth-first order: after the fewest events. Judges every node.
///
/// `None` if there is none among the first `nodes_max` nodes.
pub fn find_fault<P: Space>(space: &mut P, nodes_max: usize) -> Option<Counterexample<P>> {
    let start = space.start();
    let mut seen = FxHashSet::from_iter([start]);
    let mut nodes: Vec<Reached<P>> = vec![(start, None)];
    let mut successors = Vec::new();
    let mut next = 0;
    while next < nodes.len().min(nodes_max) {
        let at = nodes[next].0;
        successors.clear();
        let judged = space.judge(&at).and_then(|()| space.successors(&at, &mut successors));
        if let Err(fault) = judged {
            return Some(Counterexample { events: path::<P>(&nodes, next), end: at, fault });
        }
        for &(event, after) in &successors {
            if seen.insert(after) {
                nodes.push((after, Some((next, event))));
            }
        }
        next += 1;
    }
    None
}

/// A node, and what led to it from which.
type Reached<P> = (<P as Space>::Node, Option<(usize, <P as Space>::Event)>);

fn path<P: Space>(nodes: &[Reached<P>], mut at: usize) -> Vec<(P::Node, P::Event)> {
    let mut events = Vec::new();
    while let Some((before, event)) = nodes[at].1 {
        events.push((nodes[before].0, event));
        at = before;
    }
    events.reverse();
    events
}
