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
        /// The node that breaks a clause.
        broken: Option<u64>,
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

        fn judge(&mut self, at: &u64) -> Result<(), Breach> {
            if self.broken == Some(*at) { Err(Breach::new("A", format!("at {at}"))) } else { Ok(()) }
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
        let (_, found) = search(Path { asked: 0, second_sees, broken: None }, true, &progress);
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

    const CLAUSES: [Clause; 2] =
        [Clause { id: "A", claim: "L1", what: "one" }, Clause { id: "B", claim: "L3", what: "two" }];

    /// The report on a search that has to see a hare and a hedgehog, and that judges two clauses.
    fn report(broken: Option<u64>, seconds_max: f64, second_engine: bool, hare: bool) -> RunReport {
        report_of(Path { asked: 0, second_sees: 10, broken }, seconds_max, second_engine, hare)
    }

    fn report_of(path: Path, seconds_max: f64, second_engine: bool, hare: bool) -> RunReport {
        let broken = path.broken;
        let limits = crate::progress::Limits { seconds_max, ..crate::progress::Limits::default() };
        let progress = Arc::new(Progress::new(limits));
        let (_, found) = search(path, second_engine, &progress);
        let breach = found.fault().cloned();
        assert_eq!(breach.is_some(), broken.is_some());
        let seen = vec![("a hare".into(), hare), ("a hedgehog".into(), true)];
        let states = StateCounts { judged: 5, ..StateCounts::default() };
        let findings = Findings { nodes: "nodes", clauses: CLAUSES.to_vec(), seen, states, breach };
        let mut run = RunReport::new("path".into(), "L1", "none".into(), 1e6);
        run.notes.push("noted before".into());
        found.report(findings, run)
    }

    /// The verdicts on both clauses, then on both witnesses.
    fn verdicts(report: &RunReport) -> Vec<Verdict> {
        let kinds: Vec<PropertyKind> = report.properties.iter().map(|property| property.kind).collect();
        let (always, sometimes) = (PropertyKind::Always, PropertyKind::Sometimes);
        assert_eq!(kinds, [always, always, sometimes, sometimes]);
        let names: Vec<&str> = report.properties.iter().map(|property| property.clause.as_str()).collect();
        assert_eq!(names, ["A", "B", "a hare", "a hedgehog"]);
        report.properties.iter().map(|property| property.verdict).collect()
    }

    /// What is shown of each property, by what became of the run. `[spec: CHECK-1]` `[spec: CHECK-10]`
    #[test]
    fn oracle_a_report_says_no_more_than_the_run_has_shown() {
        use Verdict::{Bounded, Exhaustive, Vacuous, Violated};
        let without_limit = f64::INFINITY;
        let sound = report(None, without_limit, true, true);
        assert_eq!((sound.verdict, verdicts(&sound)), (Exhaustive, vec![Exhaustive; 4]));
        assert_eq!(sound.notes, ["noted before"]);
        let vacuous = report(None, without_limit, true, false);
        assert_eq!(
            (vacuous.verdict, verdicts(&vacuous)),
            (Vacuous, vec![Exhaustive, Exhaustive, Vacuous, Exhaustive])
        );
        let cut = report(None, 0.0, true, false);
        assert_eq!((cut.verdict, verdicts(&cut)), (Bounded, vec![Bounded, Bounded, Bounded, Exhaustive]));
        assert_eq!(cut.notes.len(), 2);
        assert!(cut.notes[1].starts_with("stopped after 0 nodes"), "{:?}", cut.notes);
        for hare in [true, false] {
            let broken = report(Some(5), without_limit, true, hare);
            let seen = if hare { Exhaustive } else { Bounded };
            assert_eq!(
                (broken.verdict, verdicts(&broken)),
                (Violated, vec![Violated, Bounded, seen, Exhaustive])
            );
            assert_eq!(broken.notes.last().map(String::as_str), Some("[A] at 5"));
        }
    }

    /// Both engines' counts are in the report, and the second is asked only where the first came to its end and found
    /// nothing. `[spec: CHECK-9]`
    #[test]
    fn oracle_a_report_has_the_counts_of_the_engines_that_were_asked() {
        let counted =
            |report: &RunReport| report.second_engine.map(|counts| (counts.unique, counts.generated));
        let both = report(None, f64::INFINITY, true, true);
        assert_eq!((both.states.unique, both.states.generated, both.states.judged), (10, 9, 5));
        assert_eq!(counted(&both), Some((10, 9)));
        assert_eq!(both.collision_bound.to_bits(), collision_bound(10).to_bits());
        assert!(both.search_seconds < both.seconds);
        assert_eq!(counted(&report(None, f64::INFINITY, false, true)), None);
        assert_eq!(counted(&report(Some(5), f64::INFINITY, true, true)), None);
        assert_eq!(counted(&report(None, 0.0, true, true)), None);
    }

    /// If the engines disagree, nobody knows whether all was judged: no clause is shown. `[spec: CHECK-9]`
    #[test]
    fn oracle_engines_that_disagree_show_no_clause() {
        use Verdict::{Bounded, Exhaustive, Violated};
        let path = Path { asked: 0, second_sees: 9, broken: None };
        let report = report_of(path, f64::INFINITY, true, false);
        assert_eq!(
            (report.verdict, verdicts(&report)),
            (Violated, vec![Bounded, Bounded, Bounded, Exhaustive])
        );
    }
}
