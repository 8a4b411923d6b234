//! The suites: which runs `dsr check` makes by default, with `--deep`, and of a graph that it is given.

use crate::checked::alphabet::{ATTRIBUTE, Alphabet};
use crate::checked::{Act, Checked};
use crate::focus::{self, FocusError};
use crate::histories::{Bound, HistoryRun};
use crate::job::{Job, ReductionRun};
use crate::schedules::{Restricted, ScheduleBound, ScheduleRun};
use crate::semantics::Semantics;
use crate::twin::{Core, Twin};
use crate::verdict::RunReport;
use crate::walks::{Faults, Walk, WalkRun};
use dsr_core::{Dictionary, Mutation, MutationKind, MutationKind as K, RT, State};
use std::sync::Arc;

/// The vertices of the embedded flat that searches focus on: each focus is the first few of them.
pub const FLAT_FOCUS: [&str; 4] = ["bedroom", "person", "bed", "robot"];

/// A graph, and the vertices in it that replicas touch.
#[derive(Clone, Debug)]
pub struct Subject<'a> {
    /// The graph.
    pub state: &'a State,
    /// Its dictionary.
    pub dictionary: &'a Dictionary,
    /// Names of vertices, the focus being the first few.
    pub names: &'a [&'a str],
}

impl Subject<'_> {
    /// A run of L1 on the first `focus` vertices, with some kinds of mutation.
    pub fn histories(
        &self,
        focus: usize,
        bound: Bound,
        kinds: &[MutationKind],
    ) -> Result<HistoryRun<Checked>, FocusError> {
        let names = &self.names[..focus.min(self.names.len())];
        let cut = focus::cut(self.state, self.dictionary, names, ATTRIBUTE)?;
        let alphabet = Alphabet::of(kinds, cut.vertices);
        let semantics = Checked { dictionary: self.dictionary.clone(), initial: cut.state, alphabet };
        Ok(HistoryRun {
            name: format!("{} × {}, {}", bound.replicas, bound.mutations, kinds_name(kinds)),
            semantics: Arc::new(semantics),
            focus: names.len(),
            bound,
            symmetry: true,
            second_engine: true,
        })
    }

    /// The same, with mutations at the last vertex of the focus only.
    pub fn at_last(
        &self,
        focus: usize,
        bound: Bound,
        kinds: &[MutationKind],
    ) -> Result<HistoryRun<Checked>, FocusError> {
        let mut run = self.histories(focus, bound, kinds)?;
        let mut semantics = (*run.semantics).clone();
        semantics.alphabet.at_last = true;
        run.semantics = Arc::new(semantics);
        run.name.push_str(", at the last");
        Ok(run)
    }

    /// The default runs of L1. `[spec: CHECK-3]`
    pub fn default_histories(&self) -> Result<Vec<HistoryRun<Checked>>, FocusError> {
        let twice = Bound { replicas: 2, mutations: 2 };
        let mut runs = vec![
            self.histories(2, twice, &K::ALL)?,
            self.histories(4, Bound { replicas: 3, mutations: 1 }, &K::ALL)?,
        ];
        for pair in pairs() {
            runs.push(self.histories(3, twice, &pair)?);
        }
        for pair in pairs() {
            runs.push(self.at_last(2, Bound { replicas: 3, mutations: 2 }, &pair)?);
        }
        Ok(runs)
    }

    /// Small runs of L1, each of which asks everything of both cores and costs little. `[spec: CHECK-15]`
    pub fn compared_histories(&self) -> Result<Vec<HistoryRun<Checked>>, FocusError> {
        let mut runs = vec![
            self.histories(3, Bound { replicas: 2, mutations: 1 }, &K::ALL)?,
            self.histories(2, Bound { replicas: 3, mutations: 1 }, &K::ALL)?,
        ];
        for pair in pairs() {
            runs.push(self.at_last(2, Bound { replicas: 2, mutations: 2 }, &pair)?);
        }
        for run in &mut runs {
            run.name.push_str(", both cores");
        }
        Ok(runs)
    }

    /// The runs of L2: all six kinds, and four concrete mutations twice each. `[spec: CHECK-6]`
    pub fn schedules(&self, core: Core) -> Result<Vec<Box<dyn Job>>, FocusError> {
        let all = self.histories(SCHEDULE_FOCUS, Bound { replicas: 2, mutations: 1 }, &MutationKind::ALL)?;
        let (focus, checked) = (all.focus, Checked::clone(&all.semantics));
        let four = four_mutations(&checked);
        Ok(match core {
            Core::Reference => schedules_of(Arc::new(checked), four, focus),
            Core::Fast => schedules_of(Arc::new(Twin::alone(checked)), four, focus),
            Core::Both => schedules_of(Arc::new(Twin::beside(checked)), four, focus),
        })
    }

    /// The runs of L3: few replicas that do much, and many that do less; with `deep` longer ones.
    /// `[spec: CHECK-13]`
    pub fn walks(&self, seed: u64, walks: u64, deep: bool) -> Result<Vec<WalkRun<Checked>>, FocusError> {
        let whole = self.histories(self.names.len(), Bound { replicas: 2, mutations: 1 }, &K::ALL)?;
        let longer = if deep { 3 } else { 1 };
        let run = |(replicas, mutations_max): (usize, usize)| {
            let mutations_max = longer * mutations_max;
            let events_max = EVENTS_PER_COPY * replicas * replicas * mutations_max;
            let faults = Faults::ALL;
            WalkRun {
                name: format!("{replicas} × {mutations_max}, all six, seed {seed}"),
                semantics: whole.semantics.clone(),
                focus: whole.focus,
                walk: Walk { replicas, mutations_max, events_max, seed, faults },
                walks,
            }
        };
        Ok([(2, 12), (3, 8), (5, 5)].map(run).into())
    }

    /// The runs of `--deep`: all six kinds, then each pair of kinds three mutations deep, among four
    /// replicas, and both; at the last vertex where the whole focus is hopeless. `[spec: CHECK-3]`
    pub fn deep_histories(&self) -> Result<Vec<HistoryRun<Checked>>, FocusError> {
        let bound = |replicas, mutations| Bound { replicas, mutations };
        let mut runs = vec![self.histories(3, bound(2, 2), &K::ALL)?, self.at_last(2, bound(3, 2), &K::ALL)?];
        for pair in pairs() {
            runs.push(self.histories(2, bound(2, 3), &pair)?);
            runs.push(self.at_last(2, bound(4, 2), &pair)?);
            runs.push(self.at_last(2, bound(3, 3), &pair)?);
        }
        for pair in pairs() {
            runs.push(self.histories(2, bound(3, 2), &pair)?);
        }
        runs.push(self.histories(2, bound(3, 2), &K::ALL)?);
        Ok(runs)
    }
}

/// `[spec: CHECK-6]` `[spec: CHECK-7]`
fn schedules_of<S: Semantics<Mutation = Act>>(
    everything: Arc<S>,
    mutations: Vec<Act>,
    focus: usize,
) -> Vec<Box<dyn Job>> {
    let once = ScheduleBound { replicas: 2, readers: 0, mutations: 1, restarts: 1, resynchronisations: 1 };
    let (twice, reader) = (ScheduleBound { mutations: 2, ..once }, ScheduleBound { readers: 1, ..once });
    let four = Arc::new(Restricted { mutations, whole: everything.clone() });
    vec![
        Box::new(ScheduleRun {
            name: "2 × 1, all six".into(),
            semantics: everything.clone(),
            focus,
            bound: once,
            second_engine: true,
        }),
        Box::new(ScheduleRun {
            name: "2 × 2, four mutations".into(),
            semantics: four.clone(),
            focus,
            bound: twice,
            second_engine: true,
        }),
        Box::new(ReductionRun {
            name: "2 × 1 and a reader, all six".into(),
            semantics: everything,
            bound: reader,
        }),
        Box::new(ReductionRun { name: "2 × 2, four mutations".into(), semantics: four, bound: twice }),
    ]
}

/// A mutation goes to each replica, in the worst case with a duplicate or an answer for each.
const EVENTS_PER_COPY: usize = 2;

/// Schedules are many: L2 looks at this many vertices.
const SCHEDULE_FOCUS: usize = 2;

/// Four mutations that meet: two moves that together close a cycle, an update, and a removal.
fn four_mutations(semantics: &Checked) -> Vec<Act> {
    let initial = semantics.initial();
    let enabled = |mutation: &Act| semantics.mutate(&initial, 0, mutation).is_some();
    let mutations: Vec<Act> = semantics.mutations(&initial, 0).into_iter().filter(enabled).collect();
    let is_kinematic = |act: &&Act| matches!(&act.0, Mutation::MoveEdge { to, .. } if &*to.label == RT);
    let last = |kind: MutationKind| mutations.iter().rfind(move |act| act.0.kind() == kind);
    let moves = mutations.iter().filter(is_kinematic).take(2);
    moves.chain(last(K::UpdateAttributes)).chain(last(K::RemoveVertex)).cloned().collect()
}

/// What the runs of L1 must have seen together, whatever each of them is about: every repair that replicas
/// with one dictionary can come to, and every odd state that a network makes. `[spec: CHECK-10]`
const SEEN_TOGETHER: [&str; 10] = [
    "repair: same-key",
    "repair: functional",
    "repair: rt-parent",
    "repair: cycle-broken",
    "repair: detached",
    "repair: reattached",
    "repair: name-clash",
    "two live writes of one attribute",
    "a pending record",
    "a gap in a context",
];

/// What a suite had to see and did not.
pub fn unseen(runs: &[RunReport]) -> Vec<&'static str> {
    let properties = || runs.iter().filter(|run| run.layer == "L1").flat_map(|run| &run.properties);
    let seen = |witness: &str| properties().any(|property| property.clause == witness);
    SEEN_TOGETHER.into_iter().filter(|witness| !seen(witness)).collect()
}

/// Every pair of different kinds.
pub fn pairs() -> impl Iterator<Item = [MutationKind; 2]> {
    let all = MutationKind::ALL;
    (0..all.len()).flat_map(move |left| (left + 1..all.len()).map(move |right| [all[left], all[right]]))
}

fn kinds_name(kinds: &[MutationKind]) -> String {
    if kinds.len() == MutationKind::ALL.len() {
        return "all six".into();
    }
    kinds.iter().map(|kind| kind.name()).collect::<Vec<_>>().join(" + ")
}
