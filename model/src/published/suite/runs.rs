//! What `dsr check --semantics published` runs. `[spec: CHECK-12]`

use super::{CLAUSES, CallKind, Compared, Published};
use crate::histories::{Bound, HistoryRun};
use crate::job::Job;
use crate::progress::Progress;
use crate::published::{NodeId, Operation, Variant};
use crate::schedules::{Restricted, ScheduleBound, ScheduleRun};
use crate::semantics::Clause;
use crate::verdict::{RunReport, StateCounts, Verdict};
use std::sync::Arc;

/// What of the suite of the checked semantics says nothing of this one, and why.
pub const NOT_APPLICABLE: [&str; 6] = [
    "L0: its laws speak of contexts and records of the checked semantics",
    "walks: they lose, repeat and reorder whatever they like, which the published semantics makes no claim to bear",
    "scenarios: their agents make mutations of the checked semantics",
    "L1 = L2: L1 stands for L2 only where deltas commute, which is violated here",
    "restarts, resynchronisation and joiners: they need the published exchange of whole graphs, which `dsr gallery` has",
    "INTENT-2 (who overwrites whom) and SYNC-5: they speak of more than one state and its deltas; `dsr gallery` has both",
];

const TWICE: Bound = Bound { replicas: 2, mutations: 2 };

/// A run of L1 with some kinds of calls, everything judged.
pub fn histories(variant: Variant, bound: Bound, kinds: &[CallKind]) -> HistoryRun<Published> {
    let semantics = Published { kinds: kinds.iter().copied().collect(), ..Published::new(variant) };
    HistoryRun {
        name: format!("{} × {}, {}", bound.replicas, bound.mutations, kinds_name(kinds)),
        focus: semantics.initial.replica.nodes.len(),
        semantics: Arc::new(semantics),
        bound,
        symmetry: false,
        second_engine: true,
    }
}

fn kinds_name(kinds: &[CallKind]) -> String {
    if kinds.len() == CallKind::ALL.len() {
        return "all seven".into();
    }
    kinds.iter().map(|kind| kind.name()).collect::<Vec<_>>().join(" + ")
}

fn pairs() -> impl Iterator<Item = [CallKind; 2]> {
    let all = CallKind::ALL;
    (0..all.len()).flat_map(move |left| (left + 1..all.len()).map(move |right| [all[left], all[right]]))
}

const fn once(replicas: usize, mutations: usize) -> ScheduleBound {
    ScheduleBound { replicas, readers: 0, mutations, restarts: 0, resynchronisations: 0 }
}

/// The runs of L1: all kinds twice by two and once by three, and every pair of kinds twice by two.
pub fn histories_suite(variant: Variant) -> Vec<HistoryRun<Published>> {
    let mut runs = vec![
        histories(variant, Bound { replicas: 2, mutations: 1 }, &CallKind::ALL),
        histories(variant, TWICE, &CallKind::ALL),
        histories(variant, Bound { replicas: 3, mutations: 1 }, &CallKind::ALL),
    ];
    runs.extend(pairs().map(|pair| histories(variant, TWICE, &pair)));
    runs
}

/// The runs of L2: all kinds, and four calls twice each.
pub fn schedules_suite(variant: Variant) -> Vec<Box<dyn Job>> {
    let whole = Arc::new(Published { compared: Compared::Shown, ..Published::new(variant) });
    let focus = whole.initial.replica.nodes.len();
    let four = Restricted { mutations: FOUR.to_vec(), whole: whole.clone() };
    vec![
        Box::new(schedule("2 × 1, all seven", whole, focus, once(2, 1))),
        Box::new(schedule("2 × 2, four calls", Arc::new(four), focus, once(2, 2))),
    ]
}

fn schedule<S>(name: &str, semantics: Arc<S>, focus: usize, bound: ScheduleBound) -> ScheduleRun<S> {
    ScheduleRun { name: name.into(), semantics, focus, bound, second_engine: true }
}

/// Four calls that meet: two places that together give two parents, a write, and a deletion.
const FOUR: [Operation; 4] = [
    Operation::Place { from: 2, to: 4, pose: 1 },
    Operation::Place { from: 3, to: 4, pose: 1 },
    Operation::Set { node: 3, key: "x", value: 1 },
    Operation::DeleteNode { node: 3 },
];

/// The node that runs with a focus touch.
const FOCUS: NodeId = 4;

/// One clause alone, at growing bounds until it breaks.
#[derive(Debug)]
pub struct ClauseRun {
    /// Which implementation.
    pub variant: Variant,
    /// The clause.
    pub clause: &'static str,
}

impl ClauseRun {
    /// The clauses that are judged, each alone.
    pub fn all(variant: Variant) -> Vec<Self> {
        let clauses = CLAUSES.iter().map(|clause| clause.id).chain(["JOIN-5"]);
        clauses.map(|clause| Self { variant, clause }).collect()
    }

    /// The runs, from the least bound on.
    fn rungs(&self) -> Vec<Box<dyn Job>> {
        let of = |kinds: &[CallKind], focus| {
            let kinds = kinds.iter().copied().collect();
            let compared = Compared::Shown;
            Arc::new(Published {
                kinds,
                focus,
                compared,
                only: Some(self.clause),
                ..Published::new(self.variant)
            })
        };
        let all = of(&CallKind::ALL, None);
        let nodes = all.initial.replica.nodes.len();
        if self.clause == "JOIN-3" {
            // Beyond one call each L1 builds on equality of whole states.
            let rung = |replicas| HistoryRun {
                name: format!("{replicas} × 1"),
                semantics: all.clone(),
                focus: nodes,
                bound: Bound { replicas, mutations: 1 },
                symmetry: false,
                second_engine: true,
            };
            return vec![Box::new(rung(2)), Box::new(rung(3))];
        }
        let at_focus = of(&CallKind::ALL, Some(FOCUS));
        vec![
            Box::new(schedule("2 × 1", all.clone(), nodes, once(2, 1))),
            Box::new(schedule("2 × 2 at one node", at_focus.clone(), 1, once(2, 2))),
            Box::new(schedule("3 × 1 at one node", at_focus, 1, once(3, 1))),
        ]
    }
}

impl Job for ClauseRun {
    fn name(&self) -> String {
        format!("{} alone", self.clause)
    }

    fn layer(&self) -> &'static str {
        if self.clause == "JOIN-3" { "L1" } else { "L2" }
    }

    fn clauses(&self) -> Vec<Clause> {
        let all = self.rungs().into_iter().next().map_or_else(Vec::new, |rung| rung.clauses());
        all.into_iter().filter(|clause| clause.id == self.clause).collect()
    }

    fn run(&self, progress: &Arc<Progress>) -> RunReport {
        let mut report = RunReport::new(self.name(), self.layer(), String::new(), progress.seconds());
        let mut held: Vec<RunReport> = Vec::new();
        for rung in self.rungs() {
            report = rung.run(progress);
            if report.verdict != Verdict::Exhaustive {
                let bounds = held.iter().map(|held| &*held.name).collect::<Vec<_>>().join("; ");
                report.notes.extend((!held.is_empty()).then(|| format!("holds at {bounds}")));
                report.name = format!("{}, {}", self.name(), report.name);
                return report;
            }
            held.push(report.clone());
        }
        let bounds = held.iter().map(|held| &*held.name).collect::<Vec<_>>().join("; ");
        let all = |of: fn(&StateCounts) -> u64| held.iter().map(|held| of(&held.states)).sum();
        report.states = StateCounts {
            unique: all(|states| states.unique),
            generated: all(|states| states.generated),
            judged: all(|states| states.judged),
            subsets: all(|states| states.subsets),
            sampled: all(|states| states.sampled),
            diamonds: all(|states| states.diamonds),
        };
        RunReport { name: format!("{}, {bounds}", self.name()), search_seconds: report.seconds, ..report }
    }
}

/// Every run; `is_wanted` says of which layers.
pub fn jobs(variant: Variant, is_wanted: impl Fn(&str) -> bool) -> Vec<Box<dyn Job>> {
    let mut jobs: Vec<Box<dyn Job>> = Vec::new();
    for clause in ClauseRun::all(variant) {
        if is_wanted(clause.layer()) {
            jobs.push(Box::new(clause));
        }
    }
    if is_wanted("L2") {
        jobs.extend(schedules_suite(variant));
    }
    if is_wanted("L1") {
        jobs.extend(histories_suite(variant).into_iter().map(|run| -> Box<dyn Job> { Box::new(run) }));
    }
    jobs
}
