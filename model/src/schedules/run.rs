//! One run of L2 and its report. `[spec: CHECK-6]` `[spec: CHECK-9]` `[spec: CHECK-10]`

use super::space::{HAPPENINGS, Schedules};
use super::{ScheduleBound, trace};
use crate::progress::Progress;
use crate::search::{COUNTEREXAMPLE_MAX, Findings, find_fault, search};
use crate::semantics::{Breach, Clause, Delivery, Semantics};
use crate::trace::{CannotHappen, Trace};
use crate::verdict::{RunReport, StateCounts};
use std::sync::Arc;

/// What this layer judges besides.
const QUIESCENCE: [Clause; 2] = [
    Clause {
        id: "JOIN-5",
        claim: "L3",
        what: "from every moment, delivering what is missing makes all equal",
    },
    Clause { id: "SYNC-5", claim: "L3", what: "from every moment, resynchronisation makes all equal" },
];

/// A run of L2.
#[derive(Clone, Debug)]
pub struct ScheduleRun<S> {
    /// Its name in reports.
    pub name: String,
    /// What is checked.
    pub semantics: Arc<S>,
    /// How many vertices are in focus, for the report.
    pub focus: usize,
    /// How far it goes.
    pub bound: ScheduleBound,
    /// Whether the second engine counts as well.
    pub second_engine: bool,
}

impl<S: Semantics> ScheduleRun<S> {
    /// Searches and reports.
    pub fn run(&self, progress: &Arc<Progress>) -> RunReport {
        let schedules = Schedules::new(self.semantics.clone(), self.bound);
        let (schedules, found) = search(schedules, self.second_engine, progress);
        let (judged, diamonds) = schedules.judged();
        let mut findings = Findings {
            nodes: "schedules",
            clauses: self.clauses(),
            seen: self.witnesses(schedules.happened),
            states: StateCounts { judged, diamonds, ..StateCounts::default() },
            breach: found.fault().map(|fault| fault.breach.clone()),
        };
        // The tables are large: let them go before a counterexample is sought.
        drop(schedules);
        let run = RunReport {
            replicas: self.bound.everybody(),
            mutations: self.bound.mutations,
            focus: self.focus,
            operations: self.semantics.steps(&self.semantics.initial(), 0).len(),
            ..RunReport::new(self.name.clone(), "L2", self.semantics.name(), progress.seconds())
        };
        let counterexample = findings.breach.as_ref().and_then(|_| self.counterexample());
        let (breach, trace) = counterexample.unzip();
        findings.breach = breach.or(findings.breach);
        let report = found.report(findings, run);
        report.with_trace(trace)
    }

    /// What is judged: what the semantics has judged, and what this layer adds.
    pub fn clauses(&self) -> Vec<Clause> {
        let own = QUIESCENCE.into_iter().filter(|clause| self.semantics.judges(clause.id));
        // In every order this layer delivers only where the order is free.
        let free = self.semantics.delivery() == Delivery::Any;
        let judged = self.semantics.clauses().into_iter().filter(|clause| free || clause.id != "JOIN-3");
        judged.chain(own).collect()
    }

    /// What must have happened, given the bound.
    fn witnesses(&self, happened: u32) -> Vec<(String, bool)> {
        let several = self.bound.everybody() > 1 && self.bound.mutations > 0;
        let restarts = self.bound.restarts > 0;
        let resynchronises = several && self.bound.resynchronisations > 0;
        let lossy = several && self.semantics.delivery() == Delivery::Any;
        let expected = [several, lossy, lossy, restarts, restarts, resynchronises];
        let named = HAPPENINGS.iter().enumerate().zip(expected).filter(|(_, expected)| *expected);
        named.map(|((bit, name), _)| ((*name).into(), happened >> bit & 1 == 1)).collect()
    }

    /// The shortest way to a violation.
    fn counterexample(&self) -> Option<(Breach, Result<Trace, CannotHappen>)> {
        let mut schedules = Schedules::new(self.semantics.clone(), self.bound);
        let found = find_fault(&mut schedules, COUNTEREXAMPLE_MAX)?;
        Some((found.fault.breach.clone(), trace::write(&mut schedules, &self.clauses(), &found)))
    }
}
