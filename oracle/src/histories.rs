//! Every canonical history of L1, beside the program. `[spec: ORACLE-4]`

mod beside;

pub use beside::Beside;

use crate::compare::Disagreement;
use crate::desk::{Desk, Stop};
use crate::fact::Kind;
use crate::program::{Start, Trouble};
use crate::verdict::Verdict;
use dsr_core::scene::{FLAT, Scene, Strictness};
use dsr_core::{Dictionary, MutationKind};
use dsr_model::checked::Checked;
use dsr_model::histories::{Bound, HistoryRun};
use dsr_model::progress::{Limits, Progress};
use dsr_model::suite::{FLAT_FOCUS, Subject, pairs};
use dsr_model::verdict::Verdict as SearchVerdict;
use std::collections::BTreeMap;
use std::sync::Arc;

/// How far the histories go.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Extent {
    /// Seconds: one mutation of each replica, and pairs of kinds at one vertex.
    Small,
    /// The default runs of L1. `[spec: CHECK-3]`
    Default,
    /// The runs of `dsr check --deep`.
    Deep,
}

/// Why there are no histories.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum NoHistories {
    /// The embedded scene is broken.
    #[error("the embedded scene cannot be read: {why}")]
    Scene {
        /// Why.
        why: String,
    },
    /// The program cannot be asked.
    #[error("{0}")]
    Trouble(#[from] Trouble),
}

/// The runs of an extent, on the embedded flat.
pub fn runs(extent: Extent) -> Result<Vec<HistoryRun<Checked>>, NoHistories> {
    let scene = |why: String| NoHistories::Scene { why };
    let dictionary = Dictionary::aal();
    let flat =
        Scene::read(FLAT, &dictionary, Strictness::Strict).map_err(|error| scene(error.to_string()))?;
    let state = &flat.scene.state;
    let subject = Subject { state, dictionary: &dictionary, names: &FLAT_FOCUS };
    let runs = match extent {
        Extent::Small => small(&subject),
        Extent::Default => subject.default_histories(),
        Extent::Deep => subject.deep_histories(),
    };
    runs.map_err(|error| scene(error.to_string()))
}

fn small(subject: &Subject<'_>) -> Result<Vec<HistoryRun<Checked>>, dsr_model::focus::FocusError> {
    let once = |replicas| Bound { replicas, mutations: 1 };
    let mut runs = vec![
        subject.histories(3, once(2), &MutationKind::ALL)?,
        subject.histories(2, once(3), &MutationKind::ALL)?,
    ];
    for pair in pairs() {
        runs.push(subject.at_last(2, Bound { replicas: 2, mutations: 2 }, &pair)?);
    }
    Ok(runs)
}

/// What one run has shown.
#[derive(Clone, Debug)]
pub struct RunFound {
    /// Its name.
    pub name: String,
    /// Different histories.
    pub histories: u64,
    /// Delivered subsets of them.
    pub subsets: u64,
    /// States judged, one of each shape.
    pub states: u64,
    /// Facts asked, by kind.
    pub facts: BTreeMap<Kind, u64>,
    /// Facts on which the program says something else, of those asked before the search ended.
    pub disagreeing: u64,
    /// How long it took.
    pub seconds: f64,
    /// Whether the search came to its end.
    pub complete: bool,
    /// What is wrong, and the shortest history that shows it.
    pub counterexample: Option<Counterexample>,
}

/// A disagreement, and how it comes about.
#[derive(Clone, Debug)]
pub struct Counterexample {
    /// Both answers.
    pub disagreement: String,
    /// The shortest history, step by step; none if the program did not say it again.
    pub trace: Option<String>,
}

impl RunFound {
    /// Facts asked.
    pub fn asked(&self) -> u64 {
        self.facts.values().sum()
    }

    /// The verdict.
    pub fn verdict(&self) -> Verdict {
        Verdict::of(self.counterexample.is_some(), !self.complete)
    }
}

/// Searches one run while all that it computes is asked. When the program says something else, the search begins anew and
/// asks before it goes on, so that it ends at the first disagreement, and shows the shortest history.
/// `[spec: ORACLE-4]` `[spec: ORACLE-5]`
pub fn run(
    run: &HistoryRun<Checked>,
    start: &Start,
    jobs: usize,
    progress: &Arc<Progress>,
) -> Result<RunFound, Trouble> {
    let desk = Arc::new(Desk::new(start.clone(), jobs, run.semantics.dictionary.clone()));
    let beside = beside_of(run, &desk);
    let mut report = beside.run(progress);
    let (histories, subsets, states) = (report.states.unique, report.states.subsets, report.states.judged);
    let mut seen: Option<Disagreement> = None;
    match desk.settle() {
        Ok(()) => {}
        Err(Stop::Trouble(trouble)) => return Err(trouble),
        Err(Stop::Disagreement(first)) => {
            if report.traces.is_empty() {
                report = beside.run(&Arc::new(Progress::new(Limits::default())));
            }
            seen = Some(*first);
        }
    }
    if let Some(trouble) = desk.compared().trouble() {
        return Err(trouble);
    }
    let broken = report.verdict == SearchVerdict::Violated;
    let counterexample = (seen.is_some() || broken).then(|| Counterexample {
        disagreement: seen.map(|first| first.to_string()).unwrap_or_default(),
        trace: report.traces.first().map(|trace| trace.text.clone()),
    });
    let compared = desk.compared();
    Ok(RunFound {
        name: run.name.clone(),
        histories,
        subsets,
        states,
        facts: Kind::ALL.into_iter().map(|kind| (kind, compared.tally.of(kind))).collect(),
        disagreeing: compared.disagreeing.load(std::sync::atomic::Ordering::Relaxed),
        seconds: progress.seconds(),
        complete: matches!(report.verdict, SearchVerdict::Exhaustive | SearchVerdict::Vacuous),
        counterexample,
    })
}

fn beside_of(run: &HistoryRun<Checked>, desk: &Arc<Desk>) -> HistoryRun<Beside> {
    HistoryRun {
        name: run.name.clone(),
        semantics: Arc::new(Beside::new((*run.semantics).clone(), Arc::clone(desk), run.bound.replicas)),
        focus: run.focus,
        bound: run.bound,
        symmetry: run.symmetry,
        // Its counts say nothing of the program.
        second_engine: false,
    }
}
