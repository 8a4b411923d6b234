//! A search by both engines, and its report. `[spec: CHECK-1]` `[spec: CHECK-9]` `[spec: CHECK-10]`

use super::{Counts, Explored, Space, count, explore};
use crate::progress::Progress;
use crate::semantics::{Breach, Clause};
use crate::verdict::{
    Evidence, PropertyKind, PropertyReport, RunReport, StateCounts, Verdict, collision_bound,
};
use std::sync::Arc;

/// The most nodes that a search for a shortest counterexample looks at.
pub(crate) const COUNTEREXAMPLE_MAX: usize = 2_000_000;

/// What a search by one engine or both has found.
pub(crate) struct Found<F> {
    explored: Explored<F>,
    /// What the second engine counted, if it was asked and came to its end.
    second: Option<Counts>,
    /// Whether it was asked and did not.
    second_cut: bool,
}

/// Searches the space, and if asked once more by the second engine.
pub(crate) fn search<P: Space>(
    space: P,
    second_engine: bool,
    progress: &Arc<Progress>,
) -> (P, Found<P::Fault>) {
    let (mut space, mut explored) = explore(space, progress);
    let (mut second, mut second_cut) = (None, false);
    if second_engine && !explored.cut && explored.fault.is_none() {
        match count(&mut space, explored.unique, progress) {
            Ok(counts) => (second, second_cut) = (counts, counts.is_none()),
            Err(fault) => explored.fault = Some(fault),
        }
    }
    (space, Found { explored, second, second_cut })
}

/// What a layer judges, and what it has to see.
pub(crate) struct Findings {
    /// What is counted: *node* in words.
    pub(crate) nodes: &'static str,
    /// The clauses judged.
    pub(crate) clauses: Vec<Clause>,
    /// What had to be seen, and whether it was.
    pub(crate) seen: Vec<(String, bool)>,
    /// Of the counts, what the space knows.
    pub(crate) states: StateCounts,
    /// The clause that broke.
    pub(crate) breach: Option<Breach>,
}

impl<F> Found<F> {
    /// The first fault.
    pub(crate) fn fault(&self) -> Option<&F> {
        self.explored.fault.as_ref()
    }

    /// Fills in what a run has shown.
    pub(crate) fn report(self, findings: Findings, run: RunReport) -> RunReport {
        let Findings { nodes, clauses, seen, states, breach } = findings;
        let Explored { unique, expanded, generated, cut, seconds: search_seconds, .. } = self.explored;
        let states = StateCounts { unique, generated, ..states };
        let second = self.second.map(|second| StateCounts {
            unique: second.unique,
            generated: second.generated,
            ..StateCounts::default()
        });
        let breach = breach.or_else(|| disagreement(&states, second.as_ref()));
        let cut = cut || self.second_cut;
        let evidence = Evidence {
            violated: breach.is_some(),
            cut,
            unique,
            expanded,
            unseen: seen.iter().filter(|(_, seen)| !seen).count(),
        };
        let mut notes = run.notes;
        if self.second_cut {
            notes.push("stopped before the second engine had counted to the end".into());
        } else if cut {
            let seconds = run.seconds;
            notes.push(format!("stopped after {expanded} {nodes} and {seconds:.0} s, before its end"));
        }
        notes.extend(breach.iter().map(|breach| format!("[{}] {}", breach.clause, breach.detail)));
        RunReport {
            states,
            verdict: Verdict::of(evidence),
            properties: properties(evidence, breach.as_ref(), clauses, &seen),
            second_engine: second,
            collision_bound: collision_bound(unique),
            search_seconds,
            notes,
            ..run
        }
    }
}

fn disagreement(first: &StateCounts, second: Option<&StateCounts>) -> Option<Breach> {
    let second = second?;
    if (first.unique, first.generated) == (second.unique, second.generated) {
        return None;
    }
    let detail = format!(
        "stateright counts {} unique, {} generated; the second engine {} and {}",
        first.unique, first.generated, second.unique, second.generated
    );
    Some(Breach::new("CHECK-9", detail))
}

fn properties(
    evidence: Evidence,
    breach: Option<&Breach>,
    clauses: Vec<Clause>,
    seen: &[(String, bool)],
) -> Vec<PropertyReport> {
    let complete = evidence.complete() && breach.is_none();
    let always = clauses.into_iter().map(|clause| {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A path of ten nodes; `second_sees` of them for whoever asks after the first search.
    struct Path {
        asked: u64,
        second_sees: u64,
    }

    impl Space for Path {
        type Node = u64;
        type Event = ();
        type Fault = Breach;

        fn start(&self) -> u64 {
            0
        }

        fn successors(&mut self, at: &u64, out: &mut Vec<((), u64)>) -> Result<(), Breach> {
            self.asked += 1;
            let end = if self.asked > 10 { self.second_sees } else { 10 };
            out.extend((at + 1 < end).then_some(((), at + 1)));
            Ok(())
        }

        fn judge(&mut self, _: &u64) -> Result<(), Breach> {
            Ok(())
        }

        fn depth(&self, at: &u64) -> usize {
            usize::try_from(*at).unwrap_or(0)
        }

        fn states_judged(&self) -> u64 {
            0
        }

        fn witnessed(&self) -> usize {
            0
        }
    }

    fn verdict(second_sees: u64, seconds_max: f64) -> (Verdict, Vec<String>) {
        let limits = crate::progress::Limits { seconds_max, ..crate::progress::Limits::default() };
        let progress = Arc::new(Progress::new(limits));
        let (_, found) = search(Path { asked: 0, second_sees }, true, &progress);
        let (clauses, seen, states) = (Vec::new(), Vec::new(), StateCounts::default());
        let findings = Findings { nodes: "nodes", clauses, seen, states, breach: None };
        let run = found.report(findings, RunReport::new("path".into(), "L1", "none".into(), 0.0));
        (run.verdict, run.notes)
    }

    /// `[spec: CHECK-9]` `[spec: CHECK-1]`
    #[test]
    fn canary_engines_that_disagree_are_a_violation() {
        assert_eq!(verdict(10, f64::INFINITY), (Verdict::Exhaustive, vec![]));
        let (broken, notes) = verdict(9, f64::INFINITY);
        assert_eq!(broken, Verdict::Violated);
        assert!(notes[0].starts_with("[CHECK-9] stateright counts 10 unique"), "{notes:?}");
        assert_eq!(verdict(10, 0.0).0, Verdict::Bounded);
    }
}
