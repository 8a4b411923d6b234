//! One run of L1 and its report. `[spec: CHECK-3]` `[spec: CHECK-9]` `[spec: CHECK-10]`

use super::{Bound, Histories, HistoryModel};
use crate::engine;
use crate::progress::Progress;
use crate::semantics::{Breach, Semantics};
use crate::trace::{Trace, TraceWriter};
use crate::verdict::{
    Evidence, PropertyKind, PropertyReport, RunReport, RunTrace, StateCounts, Verdict, collision_bound,
};
use stateright::{Checker, Model};
use std::sync::Arc;

/// The most histories that the search for a shortest counterexample looks at.
const COUNTEREXAMPLE_MAX: usize = 2_000_000;

/// A run of L1.
#[derive(Clone, Debug)]
pub struct HistoryRun<S> {
    /// Its name in reports.
    pub name: String,
    /// What is checked.
    pub semantics: Arc<S>,
    /// How many vertices are in focus, for the report.
    pub focus: usize,
    /// How far it goes.
    pub bound: Bound,
    /// Whether histories that differ by renaming replicas are one, where that is sound.
    pub symmetry: bool,
    /// Whether the second engine counts as well.
    pub second_engine: bool,
}

/// What a search has left behind.
struct Outcome {
    counts: StateCounts,
    expanded: u64,
    cut: bool,
    breach: Option<Breach>,
    second: Option<StateCounts>,
    seen: Vec<(String, bool)>,
}

impl<S: Semantics + 'static> HistoryRun<S> {
    /// Searches, compares the engines, and reports.
    pub fn run(&self, progress: &Arc<Progress>) -> RunReport {
        let model = HistoryModel::new(self.semantics.clone(), self.bound, self.symmetry, progress.clone());
        let checker = model.checker().threads(1).spawn_dfs().join();
        let (expanded, generated, cut) = checker.model().counts();
        let mut outcome = checker
            .model()
            .inspect(|histories, fault| self.outcome(histories, fault.map(|f| f.breach().clone())));
        outcome.counts.unique = checker.unique_state_count() as u64;
        outcome.counts.generated = generated;
        outcome.expanded = expanded;
        outcome.cut = cut;
        if self.second_engine && !cut && outcome.breach.is_none() {
            outcome.second = checker.model().inspect(|histories, _| {
                let counts = engine::count(histories, u64::MAX)?;
                Some(StateCounts {
                    unique: counts.unique,
                    generated: counts.generated,
                    ..StateCounts::default()
                })
            });
        }
        // The tables are large: let them go before a counterexample is sought.
        drop(checker);
        self.report(outcome, progress)
    }

    fn outcome(&self, histories: &Histories<S>, breach: Option<Breach>) -> Outcome {
        let (judged, diamonds) = histories.judged();
        let counts = StateCounts { judged, diamonds, ..StateCounts::default() };
        Outcome { counts, expanded: 0, cut: false, breach, second: None, seen: self.witnesses(histories) }
    }

    /// What a run of these kinds must see: each kind done, each pair of kinds concurrent.
    fn witnesses(&self, histories: &Histories<S>) -> Vec<(String, bool)> {
        let kinds = self.semantics.kinds();
        let expected = self.semantics.kinds_in_use();
        let done = histories.kinds_done();
        let concurrent: Vec<(usize, usize)> = histories.concurrent().collect();
        let mut seen: Vec<(String, bool)> = expected
            .iter()
            .map(|&kind| (format!("{} is done", kinds[kind]), done >> kind & 1 == 1))
            .collect();
        if self.bound.replicas > 1 {
            for (at, &left) in expected.iter().enumerate() {
                for &right in &expected[at..] {
                    let pair = (left.min(right), left.max(right));
                    seen.push((
                        format!("{} beside {}", kinds[pair.0], kinds[pair.1]),
                        concurrent.contains(&pair),
                    ));
                }
            }
        }
        let names = self.semantics.witnesses();
        let bits = histories.tables().witnesses;
        seen.extend(
            names
                .iter()
                .enumerate()
                .filter(|(bit, _)| bits.has(*bit))
                .map(|(_, name)| ((*name).into(), true)),
        );
        seen
    }

    fn report(&self, outcome: Outcome, progress: &Progress) -> RunReport {
        let mut notes = Vec::new();
        let mut breach = outcome.breach;
        if let Some(second) = outcome.second
            && (second.unique, second.generated) != (outcome.counts.unique, outcome.counts.generated)
        {
            let detail = format!(
                "stateright counts {} unique, {} generated; the second engine {} and {}",
                outcome.counts.unique, outcome.counts.generated, second.unique, second.generated
            );
            breach = breach.or(Some(Breach::new("CHECK-9", detail)));
        }
        if outcome.cut {
            notes.push(format!(
                "stopped after {} histories and {:.0} s, before its end",
                outcome.expanded,
                progress.seconds()
            ));
        }
        let evidence = Evidence {
            violated: breach.is_some(),
            cut: outcome.cut,
            unique: outcome.counts.unique,
            expanded: outcome.expanded,
            unseen: outcome.seen.iter().filter(|(_, seen)| !seen).count(),
        };
        let traces: Vec<RunTrace> =
            breach.iter().filter_map(|_| self.counterexample()).map(RunTrace::from).collect();
        if let Some(breach) = &breach {
            notes.push(format!("[{}] {}", breach.clause, breach.detail));
        }
        RunReport {
            replicas: self.bound.replicas,
            mutations: self.bound.mutations,
            focus: self.focus,
            operations: self.operations(),
            states: outcome.counts,
            verdict: Verdict::of(evidence),
            properties: self.properties(evidence, breach.as_ref(), &outcome.seen),
            second_engine: outcome.second,
            collision_bound: collision_bound(outcome.counts.unique),
            notes,
            traces,
            ..RunReport::new(self.name.clone(), "L1", self.semantics.name(), progress.seconds())
        }
    }

    fn properties(
        &self,
        evidence: Evidence,
        breach: Option<&Breach>,
        seen: &[(String, bool)],
    ) -> Vec<PropertyReport> {
        let complete = evidence.complete() && breach.is_none();
        let always = self.semantics.clauses().into_iter().map(|clause| {
            let violated = breach.is_some_and(|breach| breach.clause == clause.id);
            let verdict = Verdict::of(Evidence { violated, cut: !complete, unseen: 0, ..evidence });
            PropertyReport { verdict, ..PropertyReport::always(clause.id, clause.claim, clause.what) }
        });
        let sometimes = seen.iter().map(|(witness, seen)| PropertyReport {
            kind: PropertyKind::Sometimes,
            verdict: match (seen, complete) {
                (true, _) => Verdict::Exhaustive,
                (false, true) => Verdict::Vacuous,
                (false, false) => Verdict::Bounded,
            },
            ..PropertyReport::always(witness, "", "")
        });
        always.chain(sometimes).collect()
    }

    fn operations(&self) -> usize {
        let initial = self.semantics.initial();
        let mutations = self.semantics.mutations(&initial, 0);
        mutations.iter().filter(|mutation| self.semantics.mutate(&initial, 0, mutation).is_some()).count()
    }

    /// The shortest way to a violation, sought without symmetry.
    fn counterexample(&self) -> Option<Trace> {
        for mutations in 1..=self.bound.mutations {
            let bound = Bound { mutations, ..self.bound };
            let mut histories = Histories::new(self.semantics.clone(), bound, false);
            if let Some(found) = engine::find_fault(&mut histories, COUNTEREXAMPLE_MAX) {
                return Some(TraceWriter::write(&*self.semantics, &mut histories, &found));
            }
        }
        None
    }
}
