//! Sets of message numbers, as maximal runs.

use std::collections::BTreeMap;

/// A set of numbers from 1: first to last of each maximal run. Its size is that of its gaps.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Default)]
pub(crate) struct Runs(BTreeMap<u64, u64>);

impl Runs {
    pub(crate) fn contains(&self, number: u64) -> bool {
        self.0.range(..=number).next_back().is_some_and(|(_, &last)| number <= last)
    }

    /// Adds a number; whether it is new.
    pub(crate) fn insert(&mut self, number: u64) -> bool {
        if self.contains(number) {
            return false;
        }
        let before = number.checked_sub(1).filter(|&before| self.contains(before));
        let first =
            before.and_then(|before| self.0.range(..=before).next_back()).map_or(number, |run| *run.0);
        let after = number.checked_add(1);
        let last = after.and_then(|after| self.0.remove(&after)).unwrap_or(number);
        self.0.insert(first, last);
        true
    }

    /// How many runs there are.
    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// Forgets the lowest run; its first and last number.
    pub(crate) fn forget_lowest(&mut self) -> Option<(u64, u64)> {
        self.0.pop_first()
    }

    /// The first number from `from` on that is not in the set.
    pub(crate) fn first_gap(&self, from: u64) -> u64 {
        match self.0.range(..=from).next_back() {
            Some((_, &last)) if from <= last => last.saturating_add(1),
            _ => from,
        }
    }

    /// What is not in the set from `first` to `last`, as runs, lazily.
    pub(crate) fn gaps(&self, first: u64, last: u64) -> impl Iterator<Item = (u64, u64)> + '_ {
        let mut at = self.first_gap(first);
        std::iter::from_fn(move || {
            if at > last {
                return None;
            }
            let next = self.0.range(at..).next().map(|(&first, _)| first);
            let end = next.map_or(last, |next| (next - 1).min(last));
            let gap = (at, end);
            at = self.first_gap(end.saturating_add(1));
            Some(gap)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Runs;
    use std::collections::BTreeSet;

    /// Every order of five numbers out of seven against a plain set.
    #[test]
    fn oracle_runs_are_a_set() {
        for code in 0..7_usize.pow(5) {
            let (mut runs, mut set, mut rest) = (Runs::default(), BTreeSet::new(), code);
            for _ in 0..5 {
                let number = (rest % 7 + 1) as u64;
                rest /= 7;
                assert_eq!(runs.insert(number), set.insert(number));
            }
            for number in 0..9 {
                assert_eq!(runs.contains(number), set.contains(&number));
            }
            for (first, last) in [(1, 7), (3, 5), (1, 9), (4, 3)] {
                let gaps: Vec<u64> = runs.gaps(first, last).flat_map(|(first, last)| first..=last).collect();
                let missing: Vec<u64> = (first..=last).filter(|number| !set.contains(number)).collect();
                assert_eq!(gaps, missing, "{set:?}");
            }
            let runs_of = set.iter().filter(|&&number| !set.contains(&(number - 1))).count();
            assert_eq!(runs.len(), runs_of);
        }
    }
}
