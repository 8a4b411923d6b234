//! Symmetry: replicas start alike, so histories that differ by renaming them are one. `[spec: CHECK-5]`
//!
//! Renaming is not free: ties between claims are broken by dots, so who wins depends on the replicas'
//! order. A state whose view has nothing to break (no repair, no two live writes of one attribute) is
//! *order-free*: there, what replicas may do commutes with renaming. A history all of whose mutations were
//! made in order-free states stands for all its images; from the first that was not, each image goes
//! its own way. Counts over the orbits must equal those without symmetry, and do.

use super::{Histories, History};
use crate::semantics::Semantics;

/// All permutations of the replicas; the identity is number 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Permutations(Vec<Vec<usize>>);

impl Permutations {
    /// All permutations of `replicas`.
    pub fn of(replicas: usize) -> Self {
        let mut all = vec![vec![]];
        for next in 0..replicas {
            let longer = |shorter: &Vec<usize>| {
                let shorter = shorter.clone();
                (0..=shorter.len()).rev().map(move |at| {
                    let mut permutation = shorter.clone();
                    permutation.insert(at, next);
                    permutation
                })
            };
            all = all.iter().flat_map(longer).collect();
        }
        Self(all)
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Never: the identity is always there.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The one that takes back what a permutation does.
    pub fn inverse(&self, permutation: usize) -> usize {
        let to = self.get(permutation);
        let back = |candidate: &Vec<usize>| to.iter().enumerate().all(|(from, &to)| candidate[to] == from);
        self.0.iter().position(back).unwrap_or(0)
    }

    /// Where a replica goes; without symmetry there is only the identity, which says nothing of any.
    pub fn image(&self, replica: usize, permutation: usize) -> usize {
        self.get(permutation).get(replica).copied().unwrap_or(replica)
    }

    /// Where each replica goes.
    pub fn get(&self, permutation: usize) -> &[usize] {
        &self.0[permutation]
    }
}

impl<S: Semantics> Histories<S> {
    /// The history with its replicas renamed.
    pub(super) fn image(&mut self, history: &History, permutation: usize) -> History {
        if permutation == 0 {
            return *history;
        }
        let mut image = *history;
        for replica in 0..self.bound.replicas {
            let to = self.permutations.get(permutation);
            let target = to[replica];
            for (made, &delta) in history.deltas[replica].iter().enumerate() {
                image.deltas[target][made] =
                    self.tables.rename_delta(&self.semantics, delta, permutation, to);
            }
            image.last[target] = self.rename_state(history.last[replica], permutation);
        }
        image
    }

    /// The least image: one history for each orbit.
    pub(super) fn canonical(&mut self, history: &History) -> History {
        (1..self.permutations.len())
            .fold(*history, |least, permutation| least.min(self.image(history, permutation)))
    }

    /// Every history that this one stands for.
    pub fn orbit(&mut self, history: &History) -> Vec<History> {
        let permutations = if history.concrete { 1 } else { self.permutations.len() };
        let mut orbit: Vec<History> = (0..permutations)
            .map(|permutation| History { concrete: true, ..self.image(history, permutation) })
            .collect();
        orbit.sort_unstable();
        orbit.dedup();
        orbit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `[spec: CHECK-5]`
    #[test]
    fn law_permutations_are_all_and_have_inverses() {
        for replicas in 1..=4 {
            let all = Permutations::of(replicas);
            assert_eq!(all.len(), (1..=replicas).product::<usize>());
            assert_eq!(all.get(0), (0..replicas).collect::<Vec<_>>());
            for permutation in 0..all.len() {
                let back = all.inverse(permutation);
                assert!((0..replicas).all(|r| all.image(all.image(r, permutation), back) == r));
            }
        }
    }
}
