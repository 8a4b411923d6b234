//! What is known of sets of deltas by their shapes. `[spec: CHECK-11]`

use super::shapes::{Grain, Shape};
use rustc_hash::FxHashMap;

/// Verdicts by shape.
#[derive(Debug, Default)]
pub(super) struct Known {
    entries: FxHashMap<Shape, Entry>,
    /// What sets of the sample look like.
    appearances: FxHashMap<Shape, u64>,
}

/// The grain at which what is asked of a set is known: that of the entry, or the next finer one, which says
/// only where to look.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Entry {
    /// That it is sound.
    pub(super) alone: Grain,
    /// That it and every part of it are.
    pub(super) with_parts: Grain,
}

/// Sets that one shape tells were found to need different grains: they are not alike.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Unlike;

impl Known {
    /// What is known of sets of a shape, or where to look for that.
    pub(super) fn at(&self, shape: &[u32]) -> Option<Entry> {
        self.entries.get(shape).copied()
    }

    /// Records what is known of sets of a shape, or where to look for that.
    pub(super) fn insert(&mut self, shape: &[u32], entry: Entry) -> Result<(), Unlike> {
        match self.entries.get(shape) {
            Some(known) if *known != entry => Err(Unlike),
            Some(_) => Ok(()),
            None => {
                self.entries.insert(shape.into(), entry);
                Ok(())
            }
        }
    }

    /// Compares what a set looks like with others of its shape.
    pub(super) fn compare(&mut self, shape: &[u32], appearance: u64) -> Result<(), Unlike> {
        match self.appearances.get(shape) {
            Some(&known) if known != appearance => Err(Unlike),
            Some(_) => Ok(()),
            None => {
                self.appearances.insert(shape.into(), appearance);
                Ok(())
            }
        }
    }
}
