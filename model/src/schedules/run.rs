//! One run of L2 and its report. `[spec: CHECK-6]` `[spec: CHECK-9]` `[spec: CHECK-10]`

use super::space::{HAPPENINGS, Schedules};
use super::{ScheduleBound, ScheduleModel, engine, trace};
use crate::progress::Progress;
use crate::semantics::{Breach, Clause, Semantics};
use crate::trace::Trace;
use crate::verdict::{
    Evidence, PropertyKind, PropertyReport, RunReport, RunTrace, StateCounts, Verdict, collision_bound,
};
use stateright::{Checker, Model};
use std::sync::Arc;

/// The most schedules that the search for a shortest counterexample looks at.
const COUNTEREXAMPLE_MAX: usize = 2_000_000;

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
}

impl<S: Semantics + 'static> ScheduleRun<S> {
    /// Searches and reports.
    pub fn run(&self, progress: &Arc<Progress>) -> RunReport {
        let model = ScheduleModel::new(self.semantics.clone(), self.bound, progress.clone());
        let checker = model.checker().threads(1).spawn_dfs().join();
        let (expanded, generated, cut) = checker.model().counts();
        let unique = checker.unique_state_count() as u64;
        let (breach, counts, happened) = checker.model().inspect(|schedules, fault| {
            let (judged, diamonds) = schedules.judged();
            let counts = StateCounts { unique, generated, judged, diamonds };
            (fault.map(|fault| fault.breach.clone()), counts, schedules.happened)
        });
        // The tables are large: let them go before a counterexample is sought.
        drop(checker);
        let seen = self.witnesses(happened);
        let evidence = Evidence {
            violated: breach.is_some(),
            cut,
            unique,
            expanded,
            unseen: seen.iter().filter(|(_, seen)| !seen).count(),
        };
        let mut notes: Vec<String> =
            breach.iter().map(|breach| format!("[{}] {}", breach.clause, breach.detail)).collect();
        if cut {
            notes.push(format!(
                "stopped after {expanded} schedules and {:.0} s, before its end",
                progress.seconds()
            ));
        }
        let traces: Vec<RunTrace> =
            breach.iter().filter_map(|_| self.counterexample()).map(RunTrace::from).collect();
        RunReport {
            replicas: self.bound.everybody(),
            mutations: self.bound.mutations,
            focus: self.focus,
            operations: self.operations(),
            states: counts,
            verdict: Verdict::of(evidence),
            properties: self.properties(evidence, breach.as_ref(), &seen),
            collision_bound: collision_bound(unique),
            notes,
            traces,
            ..RunReport::new(self.name.clone(), "L2", self.semantics.name(), progress.seconds())
        }
    }

    /// What must have happened, given the bound.
    fn witnesses(&self, happened: u32) -> Vec<(String, bool)> {
        let several = self.bound.everybody() > 1 && self.bound.mutations > 0;
        let restarts = self.bound.restarts > 0;
        let resynchronises = several && self.bound.resynchronisations > 0;
        let expected = [several, several, several, restarts, restarts, resynchronises];
        let named = HAPPENINGS.iter().enumerate().zip(expected).filter(|(_, expected)| *expected);
        named.map(|((bit, name), _)| ((*name).into(), happened >> bit & 1 == 1)).collect()
    }

    fn properties(
        &self,
        evidence: Evidence,
        breach: Option<&Breach>,
        seen: &[(String, bool)],
    ) -> Vec<PropertyReport> {
        let complete = evidence.complete() && breach.is_none();
        let property = |clause: String, kind, verdict, claim: &str, what: &str| PropertyReport {
            clause,
            kind,
            verdict,
            claim: claim.into(),
            what: what.into(),
            trace: None,
        };
        let always = self.semantics.clauses().into_iter().chain(QUIESCENCE).map(|clause| {
            let violated = breach.is_some_and(|breach| breach.clause == clause.id);
            let verdict = Verdict::of(Evidence { violated, cut: !complete, unseen: 0, ..evidence });
            property(clause.id.into(), PropertyKind::Always, verdict, clause.claim, clause.what)
        });
        let sometimes = seen.iter().map(|(witness, seen)| {
            let verdict = match (seen, complete) {
                (true, _) => Verdict::Exhaustive,
                (false, true) => Verdict::Vacuous,
                (false, false) => Verdict::Bounded,
            };
            property(witness.clone(), PropertyKind::Sometimes, verdict, "", "")
        });
        always.chain(sometimes).collect()
    }

    fn operations(&self) -> usize {
        let initial = self.semantics.initial();
        let mutations = self.semantics.mutations(&initial, 0);
        mutations.iter().filter(|mutation| self.semantics.mutate(&initial, 0, mutation).is_some()).count()
    }

    /// The shortest way to a violation.
    fn counterexample(&self) -> Option<Trace> {
        let mut schedules = Schedules::new(self.semantics.clone(), self.bound);
        let found = engine::find_fault(&mut schedules, COUNTEREXAMPLE_MAX)?;
        Some(trace::write(&mut schedules, &found))
    }
}
