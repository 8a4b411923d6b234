//! Runs of every layer behind one face, so that a suite is a list. `[spec: CHECK-1]`

use crate::algebra::{self, Algebra};
use crate::histories::HistoryRun;
use crate::progress::Progress;
use crate::scenario::{self, Scenario};
use crate::schedules::{ScheduleBound, ScheduleRun, check_reduction};
use crate::semantics::{Clause, Semantics};
use crate::verdict::{Evidence, PropertyKind, PropertyReport, RunReport, RunTrace, StateCounts, Verdict};
use crate::walks::WalkRun;
use std::sync::Arc;

/// One run of a suite.
pub trait Job: Send + Sync {
    /// Its name in reports.
    fn name(&self) -> String;
    /// Its layer in reports.
    fn layer(&self) -> &'static str;
    /// What it judges, whatever it finds.
    fn clauses(&self) -> Vec<Clause>;
    /// Runs to the end or to a limit of `progress`.
    fn run(&self, progress: &Arc<Progress>) -> RunReport;
}

impl<S: Semantics> Job for HistoryRun<S> {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn layer(&self) -> &'static str {
        "L1"
    }

    fn clauses(&self) -> Vec<Clause> {
        Self::clauses(self)
    }

    fn run(&self, progress: &Arc<Progress>) -> RunReport {
        Self::run(self, progress)
    }
}

impl<S: Semantics> Job for ScheduleRun<S> {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn layer(&self) -> &'static str {
        "L2"
    }

    fn clauses(&self) -> Vec<Clause> {
        Self::clauses(self)
    }

    fn run(&self, progress: &Arc<Progress>) -> RunReport {
        Self::run(self, progress)
    }
}

impl<S: Semantics> Job for WalkRun<S> {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn layer(&self) -> &'static str {
        "L3"
    }

    fn clauses(&self) -> Vec<Clause> {
        Self::clauses(self)
    }

    fn run(&self, progress: &Arc<Progress>) -> RunReport {
        Self::run(self, progress)
    }
}

/// What histories against schedules decide.
const REDUCTION: Clause =
    Clause { id: "CHECK-7", claim: "", what: "histories reach what schedules do, and judge all of it" };

/// Histories against schedules: the reduction that L1 relies on. `[spec: CHECK-7]`
#[derive(Clone, Debug)]
pub struct ReductionRun<S> {
    /// Its name in reports.
    pub name: String,
    /// What is checked.
    pub semantics: Arc<S>,
    /// How far both layers go.
    pub bound: ScheduleBound,
}

impl<S: Semantics> Job for ReductionRun<S> {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn layer(&self) -> &'static str {
        "L1 = L2"
    }

    fn clauses(&self) -> Vec<Clause> {
        vec![REDUCTION]
    }

    fn run(&self, progress: &Arc<Progress>) -> RunReport {
        let outcome = check_reduction(&self.semantics, self.bound);
        let mut run = RunReport::new(self.name(), self.layer(), self.semantics.name(), progress.seconds());
        run.replicas = self.bound.everybody();
        run.mutations = self.bound.mutations;
        let mut property = PropertyReport::always(REDUCTION.id, REDUCTION.claim, REDUCTION.what);
        match outcome {
            Ok(reduction) => {
                run.states = StateCounts {
                    unique: reduction.schedules as u64,
                    generated: reduction.histories as u64,
                    judged: reduction.states as u64,
                    ..StateCounts::default()
                };
                run.notes.push(format!(
                    "{} pools in both; {} states of schedules among {} delivered subsets, {} of them read",
                    reduction.pools, reduction.states, reduction.subsets, reduction.read
                ));
                property.verdict = if reduction.states == 0 { Verdict::Vacuous } else { Verdict::Exhaustive };
            }
            Err(fault) => {
                run.notes.push(fault.to_string());
                property.verdict = Verdict::Violated;
            }
        }
        run.verdict = property.verdict;
        run.properties.push(property);
        run
    }
}

/// A run of L0. `[spec: CHECK-2]`
#[derive(Clone, Debug)]
pub struct AlgebraRun<S> {
    /// What is checked.
    pub semantics: Arc<S>,
    /// Records of each family.
    pub records: usize,
}

impl<S: Algebra> Job for AlgebraRun<S> {
    fn name(&self) -> String {
        format!("every state of {} records", self.records)
    }

    fn layer(&self) -> &'static str {
        "L0"
    }

    fn clauses(&self) -> Vec<Clause> {
        algebra::clauses::<S>()
    }

    fn run(&self, progress: &Arc<Progress>) -> RunReport {
        let report = algebra::run(&*self.semantics, self.records);
        let mut run = RunReport::new(self.name(), self.layer(), self.semantics.name(), progress.seconds());
        run.mutations = self.records;
        let states = report.states as u64;
        run.states = StateCounts {
            unique: states,
            generated: report.instances(),
            judged: states,
            ..StateCounts::default()
        };
        run.properties = report.laws.iter().map(law_report).collect();
        run.verdict = worst(&run.properties);
        run.notes.push(format!(
            "{} families, {} instances of {} laws",
            report.families,
            report.instances(),
            report.laws.len()
        ));
        if let Some(law) = report.violation() {
            let example = law.example.as_ref();
            run.notes.push(format!("[{}] {}", law.clause, law.law));
            run.traces.extend(example.map(|example| RunTrace {
                clause: law.clause.into(),
                detail: example.detail.clone(),
                steps: example.states.len(),
                text:
                    example.states.iter().fold(example.detail.clone(), |text, (name, state)| {
                        format!("{text}\n  {name}: {state}")
                    }),
                json: serde_json::to_value(example).unwrap_or_default(),
            }));
        }
        run
    }
}

fn law_report(law: &algebra::LawReport) -> PropertyReport {
    let (kind, good) = match law.quantifier {
        algebra::Quantifier::All => (PropertyKind::Always, Verdict::Exhaustive),
        algebra::Quantifier::Some => (PropertyKind::Sometimes, Verdict::Exhaustive),
    };
    let verdict = match (law.is_violated(), law.is_vacuous()) {
        (true, _) => Verdict::Violated,
        (_, true) => Verdict::Vacuous,
        _ => good,
    };
    PropertyReport { kind, verdict, ..PropertyReport::always(law.clause, "", law.law) }
}

/// The worst verdict of some properties.
fn worst(properties: &[PropertyReport]) -> Verdict {
    properties.iter().map(|property| property.verdict).max().unwrap_or(Verdict::Vacuous)
}

/// The most histories of a scenario; beyond it the verdict is *bounded*.
const SCENARIO_HISTORIES_MAX: u64 = 10_000_000;

/// A scenario to explore. `[spec: SCEN-9]`
#[derive(Clone, Debug)]
pub struct ScenarioRun {
    /// The scenario.
    pub scenario: Scenario,
}

impl Job for ScenarioRun {
    fn name(&self) -> String {
        self.scenario.name().into()
    }

    fn layer(&self) -> &'static str {
        "scenario"
    }

    fn clauses(&self) -> Vec<Clause> {
        scenario::clauses()
    }

    fn run(&self, progress: &Arc<Progress>) -> RunReport {
        let options = scenario::Options {
            histories_max: progress.limits().states_max.min(SCENARIO_HISTORIES_MAX),
            ..scenario::Options::default()
        };
        let report = self.scenario.check(options);
        let mut run = RunReport::new(self.name(), self.layer(), "checked".into(), report.seconds);
        run.replicas = report.replicas.len();
        run.mutations = report.mutations;
        run.states = StateCounts {
            unique: report.histories,
            generated: report.generated,
            judged: report.states,
            diamonds: report.deliveries,
            ..StateCounts::default()
        };
        run.properties = scenario_properties(&report);
        let evidence = Evidence {
            violated: run.properties.iter().any(|property| property.verdict == Verdict::Violated),
            cut: !report.complete,
            unique: report.histories.max(1),
            expanded: report.histories.max(1),
            unseen: report.idle.len()
                + run.properties.iter().filter(|property| property.verdict == Verdict::Vacuous).count(),
        };
        run.verdict = Verdict::of(evidence);
        run.notes.extend(
            report.idle.iter().map(|step| format!("{} never takes its step {}", step.replica, step.step)),
        );
        if let scenario::Coverage::ReachedOnly { histories } = report.coverage {
            run.notes.push(format!(
                "{histories} sets of deltas are too large to judge every subset: states reached only"
            ));
        }
        run.traces = scenario_traces(&report);
        run.witnesses = property_traces(&report, scenario::Verdict::Witnessed).map(run_trace).collect();
        run
    }
}

fn scenario_properties(report: &scenario::Report) -> Vec<PropertyReport> {
    let own = Verdict::of(Evidence {
        violated: report.breach.is_some(),
        cut: !report.complete,
        unique: 1,
        expanded: 1,
        unseen: 0,
    });
    let clause = report.breach.as_ref().map_or("clauses of L1", |breach| breach.clause);
    let judged = PropertyReport {
        verdict: own,
        ..PropertyReport::always(
            clause,
            "",
            "convergence, invariants, repairs, intent; not resynchronisation",
        )
    };
    let properties = report.properties.iter().map(|property| {
        let (kind, verdict) = match property.verdict {
            scenario::Verdict::Holds => (PropertyKind::Always, Verdict::Exhaustive),
            scenario::Verdict::Violated => (PropertyKind::Always, Verdict::Violated),
            scenario::Verdict::Witnessed => (PropertyKind::Sometimes, Verdict::Exhaustive),
            scenario::Verdict::NotWitnessed => (PropertyKind::Sometimes, Verdict::Vacuous),
            scenario::Verdict::Undecided => (PropertyKind::Always, Verdict::Bounded),
        };
        PropertyReport { kind, verdict, ..PropertyReport::always(&property.name, "", &property.why) }
    });
    core::iter::once(judged).chain(properties).collect()
}

fn scenario_traces(report: &scenario::Report) -> Vec<RunTrace> {
    let breach =
        report.breach.iter().filter_map(|breach| Some((breach.clause.to_string(), breach.trace.as_ref()?)));
    breach.chain(property_traces(report, scenario::Verdict::Violated)).map(run_trace).collect()
}

/// The traces of the properties with a verdict.
fn property_traces(
    report: &scenario::Report,
    verdict: scenario::Verdict,
) -> impl Iterator<Item = (String, &scenario::Trace)> {
    let decided = report.properties.iter().filter(move |property| property.verdict == verdict);
    decided.filter_map(|property| Some((property.name.clone(), property.trace.as_ref()?)))
}

/// As a trace that can be drawn and replayed, or else as steps of the scenario.
fn run_trace((clause, trace): (String, &scenario::Trace)) -> RunTrace {
    let json = match &trace.run {
        Some(run) => serde_json::to_value(run),
        None => serde_json::to_value(trace),
    };
    RunTrace {
        detail: clause.clone(),
        steps: trace.steps.len(),
        text: trace.to_string(),
        json: json.unwrap_or_default(),
        clause,
    }
}
