//! What joining a delta removes and adds, found without changing anything. `[spec: JOIN-3]`

use super::graph::Graph;
use super::held::NONE;
use crate::context::Run;
use crate::dot::Dot;
use crate::record::Record;
use crate::state::Delta;
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

/// The edits of one join. A dot that is replaced, having been used twice, is only added.
#[derive(Debug, Default)]
pub(super) struct Plan<'d> {
    /// Held here, and dead after.
    pub(super) removed: BTreeSet<Dot>,
    /// Held after, and not here, or not so.
    pub(super) added: BTreeMap<Dot, &'d Record>,
}

impl Plan<'_> {
    /// Removes what is anchored to the dead, unless its record is replaced by one that may not be; whether it
    /// was not removed before.
    fn loses(&mut self, dot: Dot) -> bool {
        !self.added.contains_key(&dot) && self.removed.insert(dot)
    }
}

impl Graph {
    /// The edits of joining a well-formed delta: O(delta and what it changes, · log n), however deep anchors go.
    pub(super) fn plan<'d>(&self, delta: &'d Delta) -> Plan<'d> {
        let mut plan = self.merge(delta);
        // What has died, or was never held and is dead, and has not been asked what is anchored to it.
        let mut dead: Vec<Dot> = plan.removed.iter().copied().collect();
        let waits = !self.loose.is_empty();
        for run in delta.context().unseen_runs_by(&self.context).take_while(|_| waits) {
            for run in delta.dead_within(run) {
                dead.extend(self.waiting_for(run).filter(|dot| plan.loses(*dot)));
            }
        }
        let is_dead = |anchor: Dot| {
            // What is held here has been seen here.
            let is_seen = self.context.contains(anchor);
            let is_held = || is_seen && self.records.contains(&anchor) || plan.added.contains_key(&anchor);
            (is_seen || delta.context().contains(anchor)) && !is_held()
        };
        let lost = plan.added.iter().filter(|(_, record)| record.anchors().any(is_dead));
        let lost: Vec<Dot> = lost.map(|(&dot, _)| dot).collect();
        if dead.is_empty() && lost.is_empty() {
            return plan;
        }
        let mut anchored: Vec<(Dot, Dot)> = Vec::new();
        for (&dot, record) in &plan.added {
            anchored.extend(record.anchors().map(|anchor| (anchor, dot)));
        }
        anchored.sort_unstable();
        dead.extend(lost.into_iter().filter(|dot| self.gives_up(&mut plan, *dot)));
        while let Some(dot) = dead.pop() {
            dead.extend(self.anchored_to(dot).filter(|dot| plan.loses(*dot)));
            let start = anchored.partition_point(|(anchor, _)| *anchor < dot);
            let here = anchored[start..].iter().take_while(|(anchor, _)| *anchor == dot);
            dead.extend(here.map(|(_, dot)| *dot).filter(|dot| self.gives_up(&mut plan, *dot)));
        }
        plan
    }

    /// Adds no record that is anchored to the dead, nor leaves the one that it would have replaced; whether it was
    /// to be added.
    fn gives_up(&self, plan: &mut Plan<'_>, dot: Dot) -> bool {
        let given_up = plan.added.remove(&dot).is_some();
        if given_up && self.records.contains(&dot) {
            plan.removed.insert(dot);
        }
        given_up
    }

    /// The pointwise maximum, as edits. `[spec: JOIN-1]` `[spec: JOIN-2]`
    fn merge<'d>(&self, delta: &'d Delta) -> Plan<'d> {
        let mut plan = Plan::default();
        for run in delta.context().runs() {
            if run.first == run.last {
                let dot = run.start();
                if !delta.holds(dot) && self.records.contains(&dot) {
                    plan.removed.insert(dot);
                }
                continue;
            }
            let held = self.held_in(run).filter(|&dot| !delta.holds(dot));
            plan.removed.extend(held);
        }
        let is_new = |&(dot, theirs): &(Dot, &Record)| {
            !self.context.contains(dot) || self.record(dot).is_some_and(|ours| ours < *theirs)
        };
        plan.added = delta.records().filter(is_new).collect();
        plan
    }

    /// The dots of a run that are held here.
    pub(super) fn held_in(&self, run: Run) -> impl Iterator<Item = Dot> + '_ {
        let last = *run.bounds().end();
        self.records.range(&run.start()).map(|(&dot, _)| dot).take_while(move |&dot| dot <= last)
    }

    /// The records here that are anchored to dots of a run, none of which is held here.
    fn waiting_for(&self, run: Run) -> impl Iterator<Item = Dot> + '_ {
        let last = *run.bounds().end();
        let loose = self.loose.range(&(run.start(), NONE)).map(|(key, ())| *key);
        loose.take_while(move |key| key.0 <= last).map(|key| key.1)
    }
}
