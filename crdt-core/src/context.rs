//! The causal context: which dots a replica has seen.
//!
//! Meaning: a finite set of dots. Form: a version vector plus a *cloud* of dots beyond its gaps, kept
//! compact, so that equal sets have equal forms and the size is O(replicas) once gaps are filled.
//! `[spec: CTX-1]` `[spec: CTX-2]`

use crate::dot::{Dot, ReplicaId};
use alloc::collections::BTreeSet;
use alloc::vec::Vec;

/// A set of dots: a version vector and a cloud. `[spec: CTX-1]`
///
/// Invariants (clause CTX-2): no entry of the vector is 0; every dot of the cloud lies at least two beyond
/// its replica's entry (the next one would have been absorbed); no sequence is 0.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct CausalContext {
    /// Ascending by replica.
    vector: Vec<(ReplicaId, u64)>,
    cloud: BTreeSet<Dot>,
}

impl CausalContext {
    /// The empty set.
    pub const fn new() -> Self {
        Self { vector: Vec::new(), cloud: BTreeSet::new() }
    }

    /// Whether no dot has been seen.
    pub fn is_empty(&self) -> bool {
        self.vector.is_empty() && self.cloud.is_empty()
    }

    /// Whether `dot` has been seen. The root's dot never is: it is no event.
    pub fn contains(&self, dot: Dot) -> bool {
        dot.sequence != 0 && (dot.sequence <= self.prefix(dot.replica) || self.cloud.contains(&dot))
    }

    /// How many events of `replica` have been seen without a gap.
    pub fn prefix(&self, replica: ReplicaId) -> u64 {
        self.vector.binary_search_by_key(&replica, |entry| entry.0).map_or(0, |at| self.vector[at].1)
    }

    fn set_prefix(&mut self, replica: ReplicaId, sequence: u64) {
        match self.vector.binary_search_by_key(&replica, |entry| entry.0) {
            Ok(at) => self.vector[at].1 = sequence,
            Err(at) => self.vector.insert(at, (replica, sequence)),
        }
    }

    /// The greatest sequence seen of `replica`, beyond gaps too; 0 when none.
    pub fn greatest(&self, replica: ReplicaId) -> u64 {
        let first = Dot::new(replica, 0);
        let last = Dot::new(replica, u64::MAX);
        self.cloud.range(first..=last).next_back().map_or_else(|| self.prefix(replica), |dot| dot.sequence)
    }

    /// Adds one dot. Sequence 0 is no event and is ignored.
    pub fn insert(&mut self, dot: Dot) {
        if dot.sequence == 0 || self.contains(dot) {
            return;
        }
        if dot.sequence == self.prefix(dot.replica) + 1 {
            self.set_prefix(dot.replica, dot.sequence);
            self.absorb(dot.replica);
        } else {
            self.cloud.insert(dot);
        }
    }

    /// Adds every dot of `replica` up to `sequence`.
    pub fn insert_prefix(&mut self, replica: ReplicaId, sequence: u64) {
        if sequence > self.prefix(replica) {
            self.set_prefix(replica, sequence);
            self.absorb(replica);
        }
    }

    /// Unites with `other`. `[spec: CTX-3]`
    pub fn join(&mut self, other: &Self) {
        for &(replica, sequence) in &other.vector {
            self.insert_prefix(replica, sequence);
        }
        for &dot in &other.cloud {
            self.insert(dot);
        }
    }

    /// Whether every dot of `other` has been seen here.
    pub fn includes(&self, other: &Self) -> bool {
        other.vector.iter().all(|&(replica, sequence)| {
            let prefix = self.prefix(replica);
            // The cloud never closes the gap right above the prefix, so a longer prefix cannot be covered.
            sequence <= prefix
        }) && other.cloud.iter().all(|&dot| self.contains(dot))
    }

    /// The version vector: for each replica, how many events were seen without a gap.
    pub fn vector(&self) -> impl ExactSizeIterator<Item = (ReplicaId, u64)> + '_ {
        self.vector.iter().copied()
    }

    /// The dots seen beyond a gap, in order.
    pub fn cloud(&self) -> impl ExactSizeIterator<Item = Dot> + '_ {
        self.cloud.iter().copied()
    }

    /// The dots seen here that `other` has not seen, in no particular order; O(what is new + cloud).
    pub fn unseen_by<'c>(&'c self, other: &'c Self) -> impl Iterator<Item = Dot> + 'c {
        let prefixes = self.vector.iter().flat_map(move |&(replica, last)| {
            let known = other.prefix(replica);
            (known.saturating_add(1)..=last).map(move |sequence| Dot::new(replica, sequence))
        });
        prefixes.chain(self.cloud.iter().copied()).filter(move |&dot| !other.contains(dot))
    }

    /// Every dot as maximal runs `(replica, first, last)`, in order. `[spec: CTX-4]`
    pub fn runs(&self) -> impl Iterator<Item = Run> + '_ {
        let replicas: BTreeSet<ReplicaId> =
            self.vector.iter().map(|entry| entry.0).chain(self.cloud.iter().map(|dot| dot.replica)).collect();
        replicas.into_iter().flat_map(move |replica| {
            let prefix = self.prefix(replica);
            let head = (prefix > 0).then_some(Run { replica, first: 1, last: prefix });
            let cloud = self.cloud.range(Dot::new(replica, 0)..=Dot::new(replica, u64::MAX)).copied();
            head.into_iter().chain(runs_of(cloud))
        })
    }

    /// Adds a run of dots.
    pub fn insert_run(&mut self, run: Run) {
        if run.first <= self.prefix(run.replica).saturating_add(1) {
            self.insert_prefix(run.replica, run.last);
        } else {
            self.cloud.extend(run.dots());
        }
    }

    /// Moves cloud dots that have become contiguous into the vector.
    fn absorb(&mut self, replica: ReplicaId) {
        if self.cloud.is_empty() {
            return;
        }
        let mut prefix = self.prefix(replica);
        while let Some(&dot) = self.cloud.range(Dot::new(replica, 0)..=Dot::new(replica, u64::MAX)).next() {
            match prefix.checked_add(1) {
                Some(next) if dot.sequence == next => prefix = next,
                _ if dot.sequence <= prefix => {}
                _ => break,
            }
            self.cloud.remove(&dot);
        }
        self.set_prefix(replica, prefix);
    }
}

impl Extend<Dot> for CausalContext {
    fn extend<I: IntoIterator<Item = Dot>>(&mut self, dots: I) {
        for dot in dots {
            self.insert(dot);
        }
    }
}

impl FromIterator<Dot> for CausalContext {
    fn from_iter<I: IntoIterator<Item = Dot>>(dots: I) -> Self {
        let mut context = Self::new();
        context.extend(dots);
        context
    }
}

/// Consecutive dots of one replica, `first..=last`, both counted.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Run {
    /// Whose.
    pub replica: ReplicaId,
    /// The first sequence, at least 1.
    pub first: u64,
    /// The last sequence, at least `first`.
    pub last: u64,
}

impl Run {
    /// The dots of the run.
    pub fn dots(self) -> impl Iterator<Item = Dot> {
        (self.first..=self.last).map(move |sequence| Dot::new(self.replica, sequence))
    }
}

/// Joins ascending dots into maximal runs.
pub fn runs_of(dots: impl Iterator<Item = Dot>) -> impl Iterator<Item = Run> {
    let mut dots = dots.peekable();
    core::iter::from_fn(move || {
        let start = dots.next()?;
        let mut run = Run { replica: start.replica, first: start.sequence, last: start.sequence };
        while let Some(next) =
            dots.next_if(|dot| dot.replica == run.replica && Some(dot.sequence) == run.last.checked_add(1))
        {
            run.last = next.sequence;
        }
        Some(run)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    fn dot(agent: u32, sequence: u64) -> Dot {
        Dot::new(ReplicaId::agent(agent), sequence)
    }

    /// All subsets of six dots of two replicas, by bit mask.
    fn universe() -> Vec<BTreeSet<Dot>> {
        let dots: Vec<Dot> = (0..2).flat_map(|agent| (1..=3).map(move |n| dot(agent, n))).collect();
        (0u32..64)
            .map(|mask| {
                dots.iter().enumerate().filter(|(i, _)| mask >> i & 1 == 1).map(|(_, &dot)| dot).collect()
            })
            .collect()
    }

    #[test]
    fn oracle_context_is_a_set_of_dots() {
        for set in universe() {
            let context: CausalContext = set.iter().copied().collect();
            let reversed: CausalContext = set.iter().rev().copied().collect();
            assert_eq!(context, reversed, "one form for one set, whatever the order of insertion");
            assert_eq!(context.runs().flat_map(Run::dots).collect::<BTreeSet<_>>(), set);
            let by_runs = context.runs().fold(CausalContext::new(), |mut built, run| {
                built.insert_run(run);
                built
            });
            assert_eq!(by_runs, context);
            for agent in 0..2 {
                for n in 0..5 {
                    assert_eq!(context.contains(dot(agent, n)), set.contains(&dot(agent, n)));
                }
                let greatest = set.iter().filter(|d| d.replica.agent == agent).map(|d| d.sequence).max();
                assert_eq!(context.greatest(ReplicaId::agent(agent)), greatest.unwrap_or(0));
            }
        }
    }

    #[test]
    fn oracle_join_and_inclusion_are_those_of_sets() {
        let sets = universe();
        for left in &sets {
            for right in &sets {
                let mut joined: CausalContext = left.iter().copied().collect();
                let other: CausalContext = right.iter().copied().collect();
                assert_eq!(joined.includes(&other), left.is_superset(right));
                joined.join(&other);
                assert_eq!(joined, left.union(right).copied().collect());
            }
        }
    }

    #[test]
    fn regress_greatest_sequence_does_not_overflow() {
        let mut context = CausalContext::new();
        context.insert_prefix(ReplicaId::agent(1), u64::MAX);
        context.insert(dot(1, u64::MAX));
        assert_eq!(context.greatest(ReplicaId::agent(1)), u64::MAX);
        let mut edge = CausalContext::new();
        edge.insert(dot(1, u64::MAX));
        edge.insert_prefix(ReplicaId::agent(1), u64::MAX - 1);
        assert_eq!(edge.vector().collect::<Vec<_>>(), [(ReplicaId::agent(1), u64::MAX)]);
    }
}
