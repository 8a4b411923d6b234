//! Symmetry: replicas start alike, so histories that differ by renaming them are one. `[spec: CHECK-5]`
//!
//! Renaming is not free: ties between claims are broken by dots, so who wins depends on the replicas'
//! order. A state whose view has nothing to break (no repair, no two live writes of one attribute) is
//! *order-free*: there, what replicas may do commutes with renaming. A history all of whose mutations were
//! made in order-free states stands for all its images; from the first that was not, each image goes
//! its own way. Counts over the orbits must equal those without symmetry, and do.

use super::{Histories, History, MUTATIONS_MAX, REPLICAS_MAX};
use crate::semantics::Semantics;
use crate::tables::{DeltaId, NONE};

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
        let to = self.permutations.get(permutation).to_vec();
        let mut image = *history;
        for (replica, &target) in to.iter().enumerate() {
            for made in 0..MUTATIONS_MAX {
                let delta = history.deltas[replica][made];
                image.deltas[target][made] =
                    self.tables.rename_delta(&self.semantics, delta, permutation, &to);
            }
            let last = history.last[replica];
            image.last[target] = self.tables.rename_state(&self.semantics, last, permutation, &to);
        }
        image
    }

    /// The least image: one history for each orbit.
    pub(super) fn canonical(&mut self, history: &History) -> History {
        let images = (0..self.permutations.len()).map(|permutation| self.image(history, permutation));
        images.min().unwrap_or(*history)
    }

    /// The least image of a set of deltas.
    pub(super) fn canonical_set(&mut self, set: &[DeltaId]) -> DeltaSet {
        let mut least = delta_set(set.iter().copied());
        for permutation in 1..self.permutations.len() {
            let to = self.permutations.get(permutation).to_vec();
            let image =
                set.iter().map(|&delta| self.tables.rename_delta(&self.semantics, delta, permutation, &to));
            least = least.min(delta_set(image));
        }
        least
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

/// Deltas sorted and padded: a set of them.
pub(super) type DeltaSet = [u32; REPLICAS_MAX * MUTATIONS_MAX];

/// The set of some deltas.
pub(super) fn delta_set(deltas: impl Iterator<Item = u32>) -> DeltaSet {
    let mut set = [NONE; REPLICAS_MAX * MUTATIONS_MAX];
    for (slot, delta) in set.iter_mut().zip(deltas) {
        *slot = delta;
    }
    set.sort_unstable();
    set
}
