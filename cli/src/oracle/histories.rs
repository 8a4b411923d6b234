//! `dsr oracle histories`.

use super::OracleError;
use super::whom::{Format, Whom, mention};
use crate::output::{add, out};
use dsr_model::progress::{Limits, Progress};
use dsr_oracle::fact::Kind;
use dsr_oracle::histories::{Extent, RunFound, run, runs};
use dsr_oracle::verdict::Verdict;
use serde_json::json;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Instant;

const AFTER: &str = "\
All that the search of L1 computes is asked: each state's view and digest, each mutation of the alphabet with its delta and \
the state after it or the name of its error, each join, each answer to a digest; each once a run.

Exit status: 0 agree, 1 disagree, 2 stopped before the end, 3 the program cannot be asked";

/// Every canonical history of L1, state by state
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// How far the histories go
    #[arg(long, value_enum, default_value_t = How::Default)]
    extent: How,
    /// Stops a run after this many seconds
    #[arg(long, default_value_t = f64::INFINITY, hide_default_value = true)]
    seconds_max: f64,
    #[command(flatten)]
    whom: Whom,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
enum How {
    /// One mutation of each replica, and pairs of kinds at one vertex: seconds
    Small,
    /// The default runs of L1
    Default,
    /// The runs of `dsr check --deep`: days
    Deep,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Verdict, OracleError> {
        let extent = match self.extent {
            How::Small => Extent::Small,
            How::Default => Extent::Default,
            How::Deep => Extent::Deep,
        };
        let runs = runs(extent)?;
        let started = Instant::now();
        let (facts, count) = (self.whom.facts(), runs.len());
        let mut found: Vec<RunFound> = Vec::new();
        for (at, each) in runs.iter().enumerate() {
            let limits = Limits { seconds_max: self.seconds_max, ..Limits::default() };
            let one = run(each, &facts, self.whom.jobs(), &Arc::new(Progress::new(limits)))?;
            let (states, asked, seconds) = (one.states, one.asked(), one.seconds);
            mention(&format!(
                "[{}/{count}] {}: {} · {states} states · {asked} facts · {seconds:.1} s",
                at + 1,
                one.name,
                one.verdict()
            ));
            let ends = one.verdict() == Verdict::Disagree;
            found.push(one);
            if ends {
                break;
            }
        }
        let verdict = found.iter().map(RunFound::verdict).max().unwrap_or(Verdict::Vacuous);
        out(&match self.whom.format {
            Format::Text => text(&found, verdict, started),
            Format::Json => json(&found, verdict, started),
        });
        Ok(verdict)
    }
}

fn by_kind(found: &[RunFound]) -> BTreeMap<&'static str, u64> {
    let of = |kind: Kind| found.iter().map(|run| run.facts.get(&kind).copied().unwrap_or(0)).sum();
    Kind::ALL.into_iter().filter(|kind| *kind != Kind::Accepts).map(|kind| (kind.name(), of(kind))).collect()
}

fn sum(found: &[RunFound], of: impl Fn(&RunFound) -> u64) -> u64 {
    found.iter().map(of).sum()
}

#[expect(clippy::cast_precision_loss, reason = "a rate to look at")]
fn text(found: &[RunFound], verdict: Verdict, started: Instant) -> String {
    let mut text = String::new();
    let (asked, seconds) = (sum(found, RunFound::asked), started.elapsed().as_secs_f64());
    add(
        &mut text,
        format_args!(
            "{} histories in {} runs, {} delivered subsets\n",
            sum(found, |run| run.histories),
            found.len(),
            sum(found, |run| run.subsets)
        ),
    );
    add(&mut text, format_args!("{} states judged\n", sum(found, |run| run.states)));
    add(&mut text, format_args!("{asked} facts, {:.0} a second:", asked as f64 / seconds.max(0.001)));
    for (kind, count) in by_kind(found) {
        add(&mut text, format_args!(" {count} {kind}"));
    }
    add(&mut text, "\n");
    for run in found {
        let Some(example) = &run.counterexample else { continue };
        add(&mut text, format_args!("\n{}: {} facts disagree", run.name, run.disagreeing));
        match &example.trace {
            Some(trace) => add(&mut text, format_args!("; the shortest history:\n{trace}\n")),
            None => {
                add(
                    &mut text,
                    format_args!("; asked again, the program agrees:\n{}\n", example.disagreement),
                );
            }
        }
    }
    add(&mut text, format_args!("{verdict}, {seconds:.1} s\n"));
    text
}

fn json(found: &[RunFound], verdict: Verdict, started: Instant) -> String {
    let runs = found.iter().map(|run| {
        let example = run.counterexample.as_ref();
        json!({
            "name": run.name, "verdict": run.verdict(), "histories": run.histories, "subsets": run.subsets,
            "states": run.states, "facts": run.asked(), "disagreeing": run.disagreeing, "seconds": run.seconds,
            "disagreement": example.map(|example| &example.disagreement),
            "trace": example.and_then(|example| example.trace.as_ref()),
        })
    });
    let whole = json!({
        "verdict": verdict,
        "histories": sum(found, |run| run.histories),
        "subsets": sum(found, |run| run.subsets),
        "states": sum(found, |run| run.states),
        "facts": sum(found, RunFound::asked),
        "kinds": by_kind(found),
        "disagreeing": sum(found, |run| run.disagreeing),
        "seconds": started.elapsed().as_secs_f64(),
        "runs": runs.collect::<Vec<_>>(),
    });
    whole.to_string() + "\n"
}
