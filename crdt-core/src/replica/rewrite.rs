//! The commonest delta, by a way of its own: one write in place of the only one of its register.
//!
//! Streams of poses and of measurements are made of these. Its register, the stamps and the dots are all that it
//! touches, so nothing else is looked at; what comes of it is what [`plan`](super::plan) and
//! [`settle`](super::settle) would make of it.

use super::graph::Graph;
use super::held::{Exposure, Held, NONE, WriteAt, WriteKey};
use crate::changes::{Change, Changes};
use crate::context::{CausalContext, Run};
use crate::dot::Dot;
use crate::record::Record;
use crate::state::Delta;
use alloc::sync::Arc;

impl Graph {
    /// Joins a well-formed delta if it is a rewrite; `None` if it is another, or its register has to be looked at
    /// more closely: nothing has changed then. O(log n). `[spec: JOIN-3]` `[spec: EVENT-1]`
    pub(super) fn rewrite(&mut self, delta: &Delta) -> Option<Changes> {
        let mut records = delta.records();
        let (Some((dot, Record::Write(write))), None) = (records.next(), records.next()) else { return None };
        let old = the_other(delta.context(), dot)?;
        let is_declared = self.dictionary.allows_attribute(&write.name, write.value.value_type());
        if self.context.contains(dot) || !self.loose.is_empty() || !is_declared {
            return None;
        }
        let (target, name) = (write.target, self.names.find(&write.name)?);
        let is_of_register = |key: &WriteKey| (key.0, key.1) == (target, name);
        let (key, held) = self.writes.only_of(&(target, name, NONE), is_of_register)?;
        if key.2 != old || held.exposure != Exposure::Shown {
            return None;
        }
        // Where a write is shown, its target is in the graph; and this delta does not remove it.
        key.2 = dot;
        held.value.clone_from(&write.value);
        held.timestamp_ns = write.timestamp_ns;
        let stamp = core::mem::replace(&mut held.stamp, write.stamp);
        self.records.remove(&old);
        self.records.insert(dot, Held::Write(WriteAt { target, name }));
        self.count_stamp(write.stamp);
        self.discount_stamp(stamp);
        Arc::make_mut(&mut self.context).insert(dot);
        // The name that is held, not one of its own that the delta has brought.
        let name = self.names.name(name);
        Some(Changes::one(Change::Attribute { target, name, before: Some(old), after: Some(dot) }))
    }
}

/// The dot beside `dot` in a context of these two.
fn the_other(context: &CausalContext, dot: Dot) -> Option<Dot> {
    let prefixes = context.vector().map(|(replica, last)| Run { replica, first: 1, last });
    let mut other = None;
    for run in prefixes.chain(context.cloud_runs()) {
        if run.last - run.first > 1 {
            return None;
        }
        for seen in run.dots().filter(|&seen| seen != dot) {
            if other.replace(seen).is_some() {
                return None;
            }
        }
    }
    other
}
