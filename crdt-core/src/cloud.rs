//! The runs of a causal context beyond its gaps, by their first dots.
//!
//! Almost always none or a few: those lie in one sorted list, which is cheap to clone and to search. From
//! very many, which a hostile peer can cause, a tree is made, so that adding one stays O(log n). Which of
//! the two is decided by their number alone, so equal sets have equal forms. `[spec: CTX-2]`

use crate::context::Run;
use crate::dot::Dot;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::ops::RangeInclusive;

/// The most runs that stand in a list.
const FEW: usize = 16;

/// Runs in order; their owner keeps them apart from each other.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(crate) enum Cloud {
    /// At most [`FEW`].
    Few(Vec<Run>),
    /// More: from the first dot to the last sequence.
    Many(BTreeMap<Dot, u64>),
}

impl Default for Cloud {
    fn default() -> Self {
        Self::new()
    }
}

impl Cloud {
    pub(crate) const fn new() -> Self {
        Self::Few(Vec::new())
    }

    pub(crate) fn is_empty(&self) -> bool {
        matches!(self, Self::Few(list) if list.is_empty())
    }

    /// Whether `dot` lies in a run.
    #[inline]
    pub(crate) fn contains(&self, dot: Dot) -> bool {
        match self {
            Self::Few(list) => list.iter().any(|run| run.contains(dot)),
            Self::Many(tree) => is_in_tree(tree, dot),
        }
    }

    /// Whether all of `run`, which is not empty, lies in one run.
    pub(crate) fn covers(&self, run: Run) -> bool {
        match self {
            Self::Few(list) => list.iter().any(|known| known.covers(run)),
            Self::Many(_) => self.run_at(run.start()).is_some_and(|known| known.covers(run)),
        }
    }

    /// The run in which `dot` lies.
    pub(crate) fn run_at(&self, dot: Dot) -> Option<Run> {
        self.last_by(dot).filter(|run| run.contains(dot))
    }

    /// The last run that begins at `dot` or before.
    pub(crate) fn last_by(&self, dot: Dot) -> Option<Run> {
        match self {
            Self::Few(list) => list.iter().rev().copied().find(|run| run.start() <= dot),
            Self::Many(tree) => tree.range(..=dot).next_back().map(run_of),
        }
    }

    /// The first run that begins at `dot` or after.
    pub(crate) fn first_from(&self, dot: Dot) -> Option<Run> {
        match self {
            Self::Few(list) => list.iter().copied().find(|run| run.start() >= dot),
            Self::Many(tree) => tree.range(dot..).next().map(run_of),
        }
    }

    /// The runs that begin within `bounds`, which must not be empty.
    pub(crate) fn within(&self, bounds: RangeInclusive<Dot>) -> impl Iterator<Item = Run> + '_ {
        let (list, tree) = match self {
            Self::Few(list) => {
                let start = list.partition_point(|run| run.start() < *bounds.start());
                let end = list.partition_point(|run| run.start() <= *bounds.end());
                (&list[start..end], None)
            }
            Self::Many(tree) => (&[][..], Some(tree.range(bounds))),
        };
        list.iter().copied().chain(tree.into_iter().flatten().map(run_of))
    }

    /// All runs.
    pub(crate) fn iter(&self) -> impl Iterator<Item = Run> + Clone + '_ {
        let (list, tree) = match self {
            Self::Few(list) => (&list[..], None),
            Self::Many(tree) => (&[][..], Some(tree)),
        };
        list.iter().copied().chain(tree.into_iter().flatten().map(run_of))
    }

    /// Adds a run, in place of one that begins with the same dot.
    pub(crate) fn insert(&mut self, run: Run) {
        match self {
            Self::Few(list) => match list.binary_search_by_key(&run.start(), |known| known.start()) {
                Ok(at) => list[at] = run,
                Err(at) if list.len() < FEW => {
                    if list.capacity() == 0 {
                        list.reserve_exact(FEW / 2);
                    }
                    list.insert(at, run);
                }
                Err(_) => {
                    let all = list.iter().copied().chain([run]);
                    *self = Self::Many(all.map(|run| (run.start(), run.last)).collect());
                }
            },
            Self::Many(tree) => {
                tree.insert(run.start(), run.last);
            }
        }
    }

    /// Removes a run.
    pub(crate) fn remove(&mut self, run: Run) {
        match self {
            Self::Few(list) => list.retain(|known| *known != run),
            Self::Many(tree) => {
                tree.remove(&run.start());
                if tree.len() <= FEW {
                    *self = Self::Few(tree.iter().map(run_of).collect());
                }
            }
        }
    }
}

/// Apart, so that the usual case stays small where it is inlined.
#[cold]
fn is_in_tree(tree: &BTreeMap<Dot, u64>, dot: Dot) -> bool {
    tree.range(..=dot).next_back().map(run_of).is_some_and(|run| run.contains(dot))
}

fn run_of((start, &last): (&Dot, &u64)) -> Run {
    Run { replica: start.replica, first: start.sequence, last }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ReplicaId;

    fn cloud(runs: &[Run]) -> Cloud {
        let mut cloud = Cloud::new();
        for &run in runs {
            cloud.insert(run);
        }
        cloud
    }

    /// The two forms keep one promise: growing or shrinking, forwards or backwards, equal sets have equal forms.
    #[test]
    fn law_the_form_follows_from_the_number_alone() {
        let run = |at: u64| Run { replica: ReplicaId::agent(1), first: 3 * at, last: 3 * at + 1 };
        let runs: Vec<Run> = (1..=3 * FEW as u64).map(run).collect();
        for count in 0..=runs.len() {
            let (kept, rest) = runs.split_at(count);
            let grown = cloud(kept);
            let backwards: Vec<Run> = kept.iter().rev().copied().collect();
            let mut shrunk = cloud(&runs);
            for &run in rest {
                shrunk.remove(run);
            }
            assert_eq!(matches!(grown, Cloud::Many(_)), count > FEW, "{count} runs");
            assert_eq!(grown, cloud(&backwards));
            assert_eq!(grown, shrunk);
            assert_eq!(grown.iter().collect::<Vec<_>>(), kept);
            assert_eq!(grown.is_empty(), kept.is_empty());
        }
    }
}
