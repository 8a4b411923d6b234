//! `dsr check`: what happens to a graph when several agents edit it at once.

mod about;
mod live;
mod page;
mod plan;
mod report;

use crate::output::{err, out};
use crate::status::Status;
use dsr_core::MutationKind;
use dsr_model::progress::Limits;
use dsr_model::suite;
use dsr_model::twin::Core;
use dsr_model::verdict::{RunReport, Verdict};
use serde_json::json;
use std::path::{Path, PathBuf};

const ABOUT: &str = "\
Without FILE, checks the checked semantics on the embedded flat: the algebra of states (L0), histories of concurrent \
mutations (L1), schedules of a lossy network (L2) and every shipped scenario. Long random walks (L3) are made only when \
asked for: they are a sample, so their verdict is never more than bounded.

With --semantics published, the same layers run on the published semantics, rebuilt from a description of what the \
published system does, on a small graph of their own; each clause that it can be held to is also run alone, at growing \
bounds until it breaks.

With FILE, a scene is checked by L1 on some of its vertices, and a scenario is explored in all its interleavings and \
deliveries.";

const EXAMPLES: &str = "\
Examples:
  dsr check                                          the default suite
  dsr check --layer scenario                         the shipped scenarios only
  dsr check @tiny --focus robot,cup --mutations 1    two replicas on two vertices of a scene
  dsr check my.scenario.json                         a scenario of your own
  dsr check --report result.html                     a page to look at the result in a browser
  dsr check --semantics published                    the published semantics, and the shortest way to break each clause
  dsr check --semantics published --variant fork --agent-id distinct
  dsr check --deep --seconds-max 1800                as far as it goes in half an hour a run
  dsr check --core both --layer l1                   the fast replica beside the reference in every run of L1
  dsr check --layer walks --seed 7                   long random walks; a failure is shrunk before it is shown

Verdicts:
  exhaustive  every state within the bound was judged, and all is well
  bounded     all is well as far as the run went; it stopped before its bound
  vacuous     complete, but something that had to be seen never occurred
  violated    a clause does not hold; a trace shows the shortest way there

Exit status: 0 exhaustive, 1 violated, 2 bounded or vacuous, 3 wrong usage or input";

/// Arguments of `dsr check`.
#[derive(clap::Args, Debug)]
#[command(about = "Checks what concurrent agents can do to a graph", long_about = ABOUT, after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Scenes or scenarios: files, `@flat` or `@tiny`
    files: Vec<String>,
    /// The vertices that replicas touch, by name, separated by commas; for scenes
    #[arg(long, value_delimiter = ',')]
    focus: Vec<String>,
    /// Replicas, 1 to 4; for scenes
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u8).range(1..=4))]
    replicas: u8,
    /// Mutations of each replica, 1 to 4; for scenes
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=4))]
    mutations: u8,
    /// Kinds of mutation, separated by commas, or `all`; for scenes
    #[arg(long, value_delimiter = ',', default_value = "all", value_parser = kind)]
    alphabet: Vec<Kinds>,
    /// Whose semantics is checked
    #[arg(long, value_enum, default_value_t = Whose::Checked)]
    semantics: Whose,
    /// Which core is asked; if not said, the reference, and both in L0, in L2 and in small runs of L1
    #[arg(long, value_enum)]
    core: Option<CoreName>,
    /// Which implementation of the published semantics; `upstream` if not said
    #[arg(long, value_enum)]
    variant: Option<VariantName>,
    /// Which agent new things say they are from in the published semantics; `zero`, as its constructors do, if
    /// not said
    #[arg(long, value_enum)]
    agent_id: Option<AgentIds>,
    /// Layers of the suite, separated by commas
    #[arg(long, value_delimiter = ',', value_enum)]
    layer: Vec<Layer>,
    /// Larger bounds instead of the default ones: takes long
    #[arg(long)]
    deep: bool,
    /// What decides random walks, for `--layer walks`
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Random walks of each run, for `--layer walks`: 1000, with --deep 100000
    #[arg(long)]
    walks: Option<u64>,
    /// The dictionary of the scenes: a file, `published`, `aal` or `open`
    #[arg(long, default_value = "open")]
    dictionary: String,
    /// How the result is printed
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Where counterexamples are written; the directory is made when there is one
    #[arg(long, default_value = "dsr-traces")]
    traces: PathBuf,
    /// A page for a browser that shows the result and steps through its counterexamples
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Stops a run after this many seconds; its verdict is then `bounded`
    #[arg(long, default_value_t = f64::INFINITY)]
    seconds_max: f64,
    /// Stops whatever still runs after this many seconds in all; what had not begun is `bounded` as well
    #[arg(long, default_value_t = f64::INFINITY)]
    total_seconds_max: f64,
    /// Stops a run after this many states; its verdict is then `bounded`
    #[arg(long, default_value_t = u64::MAX, hide_default_value = true)]
    states_max: u64,
    /// Runs at a time; each uses one core
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u8).range(1..=64))]
    jobs: u8,
}

/// A layer of the checker.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub(crate) enum Layer {
    /// Every law over every small state
    L0,
    /// Histories of concurrent mutations
    L1,
    /// Schedules of a lossy network
    L2,
    /// Long random walks (L3): only when asked for, a sample and no proof
    Walks,
    /// Scenarios of agents
    Scenario,
}

/// Whose semantics.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub(crate) enum Whose {
    /// This implementation's own
    Checked,
    /// The published one
    Published,
}

/// A core of the checked semantics.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub(crate) enum CoreName {
    /// The readable reference
    Reference,
    /// The fast replica alone
    Fast,
    /// The fast replica beside the reference, and all that can be seen of both compared: L1 takes between three and
    /// four times as long as with the reference
    Both,
}

impl CoreName {
    fn core(self) -> Core {
        match self {
            Self::Reference => Core::Reference,
            Self::Fast => Core::Fast,
            Self::Both => Core::Both,
        }
    }
}

/// An implementation of the published semantics.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub(crate) enum VariantName {
    /// Several threads take in what arrives
    Upstream,
    /// One thread does
    Fork,
}

/// Which agent new nodes, edges and attributes say they are from.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub(crate) enum AgentIds {
    /// Agent 0, whoever made them
    Zero,
    /// Their author
    Distinct,
}

/// The layers in the order of reports.
const LAYERS: [&str; 6] = ["L0", "L1", "L1 = L2", "L2", "L3", "scenario"];

/// How a result is printed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub(crate) enum Format {
    /// For people
    Text,
    /// For programs
    Json,
}

/// A kind of mutation, or all.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Kinds(Vec<MutationKind>);

fn kind(text: &str) -> Result<Kinds, String> {
    if text == "all" {
        return Ok(Kinds(MutationKind::ALL.into()));
    }
    MutationKind::from_name(text).map(|kind| Kinds(vec![kind])).ok_or_else(|| {
        let names: Vec<&str> = MutationKind::ALL.into_iter().map(MutationKind::name).collect();
        format!("expected `all` or some of {}", names.join(", "))
    })
}

impl Arguments {
    /// Plans, runs and reports.
    pub(crate) fn run(&self) -> Status {
        let jobs = match plan::jobs(self) {
            Ok(jobs) => jobs,
            Err(error) => {
                err(error);
                return Status::Usage;
            }
        };
        let limits = Limits { states_max: self.states_max, seconds_max: self.seconds_max };
        let started = std::time::Instant::now();
        let mut runs = live::run_all(&jobs, limits, self.total_seconds_max, usize::from(self.jobs));
        runs.sort_by_key(|run| LAYERS.iter().position(|layer| *layer == run.layer));
        let traces = write_traces(&mut runs, &self.traces, !self.files.is_empty());
        let worst = runs.iter().map(|run| run.verdict).max().unwrap_or(Verdict::Vacuous);
        let unseen = if self.is_whole_suite() { suite::unseen(&runs) } else { Vec::new() };
        let verdict = if unseen.is_empty() { worst } else { worst.max(Verdict::Vacuous) };
        for witness in unseen {
            err(format!("no run of L1 has seen {witness:?}: the suite proves less than it says"));
        }
        let seconds = started.elapsed().as_secs_f64();
        let written = self
            .report
            .as_ref()
            .map(|path| page::write(path, &runs, verdict, seconds, about::of(self.semantics)));
        match self.format {
            Format::Json => {
                let about = about::of(self.semantics);
                let json =
                    json!({ "verdict": verdict, "runs": runs, "not_applicable": about.not_applicable });
                let text = serde_json::to_string_pretty(&json);
                out(&format!("{}\n", text.unwrap_or_default()));
            }
            Format::Text => out(&report::text(&runs, verdict, seconds, about::of(self.semantics))),
        }
        if let Some(Err(refusal)) = written {
            err(refusal);
            return Status::Usage;
        }
        match (traces, verdict) {
            (Err(error), _) => {
                err(error);
                Status::Usage
            }
            (_, Verdict::Exhaustive) => Status::Claimed,
            (_, Verdict::Violated) => Status::Violated,
            _ => Status::Incomplete,
        }
    }
}

impl Arguments {
    /// Whether what the runs see together can be asked for.
    fn is_whole_suite(&self) -> bool {
        let own = self.semantics == Whose::Checked && self.files.is_empty();
        own && !self.deep && (self.layer.is_empty() || self.layer.contains(&Layer::L1))
    }
}

/// Writes each counterexample to a file of its own and names it in the report; and if asked for, what a scenario had
/// to see.
fn write_traces(runs: &mut [RunReport], directory: &Path, witnesses: bool) -> Result<(), String> {
    let mut number = 0;
    for run in runs {
        let seen = run.witnesses.clone().into_iter().filter(|_| witnesses);
        for trace in run.traces.clone().into_iter().chain(seen) {
            number += 1;
            // A property's name may hold what a file's may not.
            let plain = |letter: char| if letter.is_alphanumeric() || letter == '-' { letter } else { '_' };
            let name: String = trace.clause.chars().map(plain).collect();
            let file = directory.join(format!("{number:02}-{name}.trace.json"));
            let text = serde_json::to_string_pretty(&trace.json).unwrap_or_default();
            let written = std::fs::create_dir_all(directory).and_then(|()| std::fs::write(&file, text));
            written.map_err(|error| {
                format!("cannot write {}: {error}; name another directory with --traces", file.display())
            })?;
            for property in run.properties.iter_mut().filter(|property| property.clause == trace.clause) {
                property.trace = Some(file.display().to_string());
            }
        }
    }
    Ok(())
}
