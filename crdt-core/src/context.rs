//! The causal context: which dots a replica has seen.
//!
//! Meaning: a finite set of dots. Form: a version vector plus a *cloud* of the runs beyond its gaps, kept
//! maximal, so that equal sets have equal forms and the size is O(replicas + gaps), however many dots there
//! are. Nothing here walks a run dot by dot. `[spec: CTX-1]` `[spec: CTX-2]`

use crate::cloud::Cloud;
use crate::dot::{Dot, ReplicaId};
use alloc::vec::Vec;
use core::iter;
use core::ops::RangeInclusive;

/// A set of dots: a version vector and a cloud. `[spec: CTX-1]`
///
/// Invariants (clause CTX-2): no entry of the vector is 0; every run of the cloud begins at least two beyond
/// its replica's entry (else it would have been absorbed) and at least two beyond the run before it (else
/// both were one); no sequence is 0.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct CausalContext {
    /// Ascending by replica.
    vector: Vec<(ReplicaId, u64)>,
    cloud: Cloud,
}

impl CausalContext {
    /// The empty set.
    pub const fn new() -> Self {
        Self { vector: Vec::new(), cloud: Cloud::new() }
    }

    /// Whether no dot has been seen.
    pub fn is_empty(&self) -> bool {
        self.vector.is_empty() && self.cloud.is_empty()
    }

    /// Whether `dot` has been seen. The root's dot never is: it is no event.
    pub fn contains(&self, dot: Dot) -> bool {
        dot.sequence != 0 && (dot.sequence <= self.prefix(dot.replica) || self.cloud.contains(dot))
    }

    /// Whether every dot of the run has been seen. O(log n).
    pub fn contains_run(&self, run: Run) -> bool {
        let Run { replica, first, last } = run;
        // No run of the cloud touches the prefix, so what begins within it ends within it or has a gap.
        first > last || first != 0 && (last <= self.prefix(replica) || self.cloud.covers(run))
    }

    /// How many events of `replica` have been seen without a gap.
    pub fn prefix(&self, replica: ReplicaId) -> u64 {
        self.vector.binary_search_by_key(&replica, |entry| entry.0).map_or(0, |at| self.vector[at].1)
    }

    /// The greatest sequence seen of `replica`, beyond gaps too; 0 when none.
    pub fn greatest(&self, replica: ReplicaId) -> u64 {
        let last = self.cloud.last_by(Dot::new(replica, u64::MAX)).filter(|run| run.replica == replica);
        last.map_or_else(|| self.prefix(replica), |run| run.last)
    }

    /// Adds one dot. Sequence 0 is no event and is ignored.
    pub fn insert(&mut self, dot: Dot) {
        self.insert_run(Run { replica: dot.replica, first: dot.sequence, last: dot.sequence });
    }

    /// Adds every dot of `replica` up to `sequence`.
    pub fn insert_prefix(&mut self, replica: ReplicaId, sequence: u64) {
        self.insert_run(Run { replica, first: 1, last: sequence });
    }

    /// Adds a run of dots, however long. O(log n), and for each run of the cloud that it swallows again.
    pub fn insert_run(&mut self, run: Run) {
        let Run { replica, first, last } = run;
        let entry = self.vector.binary_search_by_key(&replica, |entry| entry.0);
        let prefix = entry.map_or(0, |at| self.vector[at].1);
        if last <= prefix || first > last {
            return;
        }
        if first > prefix.saturating_add(1) {
            return self.insert_beyond(run);
        }
        match entry {
            Ok(at) => self.vector[at].1 = last,
            Err(at) => self.vector.insert(at, (replica, last)),
        }
        self.absorb(replica);
    }

    /// Adds a run that begins at least two beyond the prefix to the cloud, in place of those that it overlaps
    /// or touches.
    fn insert_beyond(&mut self, run: Run) {
        let Run { replica, mut first, mut last } = run;
        let end = Dot::new(replica, last.saturating_add(1));
        while let Some(known) = self.cloud.last_by(end)
            && known.replica == replica
            && first - 1 <= known.last
        {
            last = last.max(known.last);
            if known.first <= first {
                first = known.first;
                break;
            }
            self.cloud.remove(known);
        }
        self.cloud.insert(Run { replica, first, last });
    }

    /// Unites with `other`. O(vectors + runs of the other · log n). `[spec: CTX-3]`
    pub fn join(&mut self, other: &Self) {
        let known = self.vector.len();
        for &(replica, sequence) in &other.vector {
            match self.vector[..known].binary_search_by_key(&replica, |entry| entry.0) {
                Ok(at) => self.vector[at].1 = self.vector[at].1.max(sequence),
                Err(_) => self.vector.push((replica, sequence)),
            }
        }
        if self.vector.len() > known {
            // Two ascending runs, which a stable sort merges.
            self.vector.sort_by_key(|entry| entry.0);
        }
        if !self.cloud.is_empty() {
            for &(replica, _) in &other.vector {
                self.absorb(replica);
            }
        }
        for run in other.cloud_runs() {
            self.insert_run(run);
        }
    }

    /// Whether every dot of `other` has been seen here.
    pub fn includes(&self, other: &Self) -> bool {
        // The cloud never closes the gap right above the prefix, so a longer prefix cannot be covered.
        other.vector.iter().all(|&(replica, sequence)| sequence <= self.prefix(replica))
            && other.cloud_runs().all(|run| self.contains_run(run))
    }

    /// The version vector: for each replica, how many events were seen without a gap.
    pub fn vector(&self) -> impl ExactSizeIterator<Item = (ReplicaId, u64)> + '_ {
        self.vector.iter().copied()
    }

    /// The maximal runs seen beyond a gap, in order.
    pub fn cloud_runs(&self) -> impl Iterator<Item = Run> + '_ {
        self.cloud.iter()
    }

    /// The dots seen here that `other` has not seen, as ascending, maximal runs.
    /// O((own runs + other's runs) · log n).
    pub fn unseen_runs_by<'c>(&'c self, other: &'c Self) -> impl Iterator<Item = Run> + 'c {
        self.runs()
            .flat_map(move |run| run.without(other.runs_within(run).map(|seen| (seen.first, seen.last))))
    }

    /// The dots of `run` that have been seen, as ascending, maximal runs. O(log n + runs).
    pub(crate) fn runs_within(&self, run: Run) -> impl Iterator<Item = Run> + '_ {
        let Run { replica, last, .. } = run;
        let first = run.first.max(1);
        let prefix = self.prefix(replica).min(last);
        let head = (first <= prefix).then_some(Run { replica, first, last: prefix });
        let across = self.cloud.run_at(Dot::new(replica, first)).filter(|_| first <= last);
        let across = across.map(|known| Run { first, ..known });
        let rest = Dot::new(replica, first.saturating_add(1))..=Dot::new(replica, last);
        let beyond = (first < last).then(|| self.cloud.within(rest)).into_iter().flatten();
        let clip = move |known: Run| Run { last: known.last.min(last), ..known };
        head.into_iter().chain(across.into_iter().chain(beyond).map(clip))
    }

    /// Every dot as maximal runs `(replica, first, last)`, in order. `[spec: CTX-4]`
    pub fn runs(&self) -> impl Iterator<Item = Run> + Clone + '_ {
        let mut prefixes = self.vector.iter().peekable();
        let mut cloud = self.cloud.iter().peekable();
        iter::from_fn(move || {
            let comes_next =
                |entry: &&(ReplicaId, u64)| cloud.peek().is_none_or(|run| entry.0 <= run.replica);
            match prefixes.next_if(comes_next) {
                Some(&(replica, last)) => Some(Run { replica, first: 1, last }),
                None => cloud.next(),
            }
        })
    }

    /// Moves what has become contiguous from the cloud into the vector.
    fn absorb(&mut self, replica: ReplicaId) {
        if self.cloud.is_empty() {
            return;
        }
        let Ok(at) = self.vector.binary_search_by_key(&replica, |entry| entry.0) else { return };
        let prefix = &mut self.vector[at].1;
        while let Some(run) = self.cloud.first_from(Dot::new(replica, 0))
            && run.replica == replica
            && run.first <= prefix.saturating_add(1)
        {
            self.cloud.remove(run);
            *prefix = run.last.max(*prefix);
        }
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

impl Extend<Run> for CausalContext {
    fn extend<I: IntoIterator<Item = Run>>(&mut self, runs: I) {
        for run in runs {
            self.insert_run(run);
        }
    }
}

impl FromIterator<Run> for CausalContext {
    fn from_iter<I: IntoIterator<Item = Run>>(runs: I) -> Self {
        let mut context = Self::new();
        context.extend(runs);
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
    /// The dots of the run, one by one: a run can be very long.
    pub fn dots(self) -> impl Iterator<Item = Dot> {
        (self.first..=self.last).map(move |sequence| Dot::new(self.replica, sequence))
    }

    /// Whether all of another run lies in this one.
    pub(crate) fn covers(self, other: Self) -> bool {
        other.replica == self.replica && self.first <= other.first && other.last <= self.last
    }

    /// Whether a dot lies in the run.
    pub fn contains(self, dot: Dot) -> bool {
        dot.replica == self.replica && self.first <= dot.sequence && dot.sequence <= self.last
    }

    /// The first dot.
    pub(crate) fn start(self) -> Dot {
        Dot::new(self.replica, self.first)
    }

    /// The first dot and the last.
    pub(crate) fn bounds(self) -> RangeInclusive<Dot> {
        Dot::new(self.replica, self.first)..=Dot::new(self.replica, self.last)
    }

    /// What is left of the run without `covered`: ascending intervals of it that do not overlap. No step is
    /// taken dot by dot.
    pub(crate) fn without(self, covered: impl Iterator<Item = (u64, u64)>) -> impl Iterator<Item = Self> {
        let mut covered = covered.fuse();
        let mut rest = (self.first <= self.last).then_some(self);
        iter::from_fn(move || {
            while let Some(left) = rest {
                let Some((first, last)) = covered.next() else { return rest.take() };
                rest = last
                    .checked_add(1)
                    .filter(|&first| first <= left.last)
                    .map(|first| Self { first, ..left });
                if first > left.first {
                    return Some(Self { last: first - 1, ..left });
                }
            }
            None
        })
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
    use alloc::collections::BTreeSet;
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
            assert_eq!(context.is_empty(), set.is_empty());
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

    /// Runs at random, so many that the cloud changes its form and back.
    #[test]
    fn oracle_runs_beyond_gaps_are_sets_of_dots() {
        let mut noise = 1_u64;
        let mut below = move |n: u64| {
            noise = noise.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (noise >> 33) % n
        };
        let mut pair = [(CausalContext::new(), BTreeSet::new()), (CausalContext::new(), BTreeSet::new())];
        for round in 0..6000 {
            let (context, set) = &mut pair[round % 2];
            let replica = ReplicaId::agent(u32::from(below(2) == 0));
            let first = 1 + below(120);
            let length = if below(40) == 0 { below(60) } else { below(3) };
            let run = Run { replica, first, last: first + length };
            context.insert_run(run);
            set.extend(run.dots());
            check_equal(context, set);
            assert!(context.contains_run(run));
            let [left, right] = &pair;
            let unseen: Vec<Run> = left.0.unseen_runs_by(&right.0).collect();
            assert_eq!(unseen, runs_of(left.1.difference(&right.1).copied()).collect::<Vec<_>>());
            let within: Vec<Dot> = left.0.runs_within(run).flat_map(Run::dots).collect();
            assert_eq!(within, left.1.iter().copied().filter(|&dot| run.contains(dot)).collect::<Vec<_>>());
            assert_eq!(left.0.contains_run(run), within.len() as u64 == length + 1);
            for at in run.first - 1..=run.last + 1 {
                let dot = Dot::new(replica, at);
                assert_eq!(left.0.contains(dot), left.1.contains(&dot));
            }
            assert_eq!(left.0.includes(&right.0), left.1.is_superset(&right.1));
            if round % 50 == 0 {
                let mut joined = left.0.clone();
                joined.join(&right.0);
                check_equal(&joined, &left.1.union(&right.1).copied().collect());
            }
            if set_is_full(&pair[round % 2].1) {
                pair[round % 2] = (CausalContext::new(), BTreeSet::new());
            }
        }
    }

    /// Starting anew before few gaps are left.
    fn set_is_full(set: &BTreeSet<Dot>) -> bool {
        set.len() > 150
    }

    fn check_equal(context: &CausalContext, set: &BTreeSet<Dot>) {
        let runs: Vec<Run> = runs_of(set.iter().copied()).collect();
        assert_eq!(context.runs().collect::<Vec<_>>(), runs);
        assert_eq!(*context, set.iter().rev().copied().collect(), "one form for one set");
        let beyond: Vec<Run> = runs.into_iter().filter(|run| run.first > 1).collect();
        assert_eq!(context.cloud_runs().collect::<Vec<_>>(), beyond);
    }

    /// No step is taken dot by dot, or this would not end.
    #[test]
    fn regress_runs_of_many_dots_are_not_walked() {
        let replica = ReplicaId::agent(1);
        let run = |first, last| Run { replica, first, last };
        let long: CausalContext = [run(3, 1 << 52), run((1 << 52) + 2, u64::MAX)].into_iter().collect();
        assert_eq!(long.cloud_runs().count(), 2);
        let mut other: CausalContext = [run(1, 1), run(1 << 40, 1 << 60)].into_iter().collect();
        assert!(!long.includes(&other) && !other.includes(&long) && long.contains_run(run(5, 1 << 50)));
        let unseen: Vec<Run> = long.unseen_runs_by(&other).collect();
        assert_eq!(unseen, [run(3, (1 << 40) - 1), run((1 << 60) + 1, u64::MAX)]);
        other.join(&long);
        assert_eq!(other.runs().collect::<Vec<_>>(), [run(1, 1), run(3, u64::MAX)]);
        other.insert(dot(1, 2));
        assert_eq!(other.vector().collect::<Vec<_>>(), [(replica, u64::MAX)]);
        assert_eq!(other.unseen_runs_by(&CausalContext::new()).collect::<Vec<_>>(), [run(1, u64::MAX)]);
        other.insert_run(Run { replica, first: 9, last: 4 });
        other.insert(Dot::new(ReplicaId::agent(2), 0));
        assert_eq!(other.runs().collect::<Vec<_>>(), [run(1, u64::MAX)]);
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
