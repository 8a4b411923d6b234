//! One run of L1 and its report. `[spec: CHECK-3]` `[spec: CHECK-9]` `[spec: CHECK-10]`

use super::trace;
use super::{Bound, Histories};
use crate::progress::Progress;
use crate::search::{COUNTEREXAMPLE_MAX, Findings, find_fault, search};
use crate::semantics::{Breach, Clause, Semantics};
use crate::trace::{CannotHappen, Trace};
use crate::verdict::{RunReport, StateCounts};
use std::sync::Arc;

/// Among so many histories a counterexample is sought that people see, before any will do.
const PLAIN_MAX: usize = 10_000;

/// What this layer judges besides: its own conclusions.
const SHAPES: Clause = Clause {
    id: "CHECK-11",
    claim: "",
    what: "sets of deltas that are judged as one are alike, where tried",
};

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

impl<S: Semantics> HistoryRun<S> {
    /// Searches, compares the engines, and reports.
    pub fn run(&self, progress: &Arc<Progress>) -> RunReport {
        let histories = Histories::new(self.semantics.clone(), self.bound, self.symmetry);
        let (histories, found) = search(histories, self.second_engine, progress);
        let judged = histories.judged();
        let mut findings = Findings {
            nodes: "histories",
            clauses: self.clauses(),
            seen: self.witnesses(&histories),
            states: StateCounts {
                judged: judged.states,
                subsets: judged.subsets,
                diamonds: judged.diamonds,
                sampled: judged.sampled,
                ..StateCounts::default()
            },
            breach: found.fault().map(|fault| fault.breach().clone()),
        };
        let run = RunReport {
            replicas: self.bound.replicas,
            mutations: self.bound.mutations,
            focus: self.focus,
            operations: self.semantics.steps(&self.semantics.initial(), 0).len(),
            ..RunReport::new(self.name.clone(), "L1", self.semantics.name(), progress.seconds())
        };
        // The tables are large: let them go before a counterexample is sought.
        drop(histories);
        let counterexample = findings.breach.as_ref().and_then(|_| self.counterexample());
        let (breach, trace) = counterexample.unzip();
        findings.breach = breach.or(findings.breach);
        found.report(findings, run).with_trace(trace)
    }

    /// What is judged: what the semantics has judged, and what this layer adds.
    pub fn clauses(&self) -> Vec<Clause> {
        self.semantics.clauses().into_iter().chain([SHAPES]).collect()
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

    /// The shortest way to a violation; to one that people see, if there is any.
    fn counterexample(&self) -> Option<(Breach, Result<Trace, CannotHappen>)> {
        let plain = self.semantics.plain().map(Arc::new);
        let plain = plain.and_then(|plain| self.shortest(&plain, PLAIN_MAX));
        plain.or_else(|| self.shortest(&self.semantics, COUNTEREXAMPLE_MAX))
    }

    /// The shortest way to a violation, sought without symmetry; without shapes if there is one without.
    fn shortest(
        &self,
        semantics: &Arc<S>,
        nodes_max: usize,
    ) -> Option<(Breach, Result<Trace, CannotHappen>)> {
        for mutations in 1..=self.bound.mutations {
            let bound = Bound { mutations, ..self.bound };
            for shapes in [false, true] {
                let mut histories = Histories::new(semantics.clone(), bound, false);
                histories.set_shapes(shapes, 1);
                if let Some(mut found) = find_fault(&mut histories, nodes_max) {
                    found.fault = histories.shrunk(found.fault);
                    let breach = found.fault.breach().clone();
                    let trace = trace::write(&**semantics, &mut histories, &self.clauses(), &found);
                    return Some((breach, trace));
                }
            }
        }
        None
    }
}
