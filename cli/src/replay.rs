//! `dsr replay`: a trace is run again, and whatever differs is told.

use crate::output::{err, out};
use crate::status::Status;
use crate::trace::{self, Refusal};
use dsr_model::replay::{ReplayError, replay};
use std::fmt::Write;

const ABOUT: &str = "\
Runs each trace again, step by step, by the semantics that it names, and compares everything: mutations, messages, \
deltas, what each replica shows, its whole state, and what is found at the end. The first difference is told with its \
step.";

const AFTER: &str = "\
Examples:
  dsr replay dsr-traces/01-JOIN-3.trace.json
  dsr gallery --traces gallery && dsr replay gallery/*.trace.json

Exit status: 0 every trace came out as it is written, 1 one did not, 3 one could not be read or run.";

/// Arguments of `dsr replay`.
#[derive(clap::Args, Debug)]
#[command(about = "Runs traces again, and tells what differs", long_about = ABOUT, after_help = AFTER)]
pub(crate) struct Arguments {
    /// Trace files, or `-` for standard input
    #[arg(required = true)]
    files: Vec<String>,
}

impl Arguments {
    pub(crate) fn run(&self) -> Status {
        let statuses = self.files.iter().map(|file| run_again(file));
        statuses.max().unwrap_or_default()
    }
}

fn run_again(file: &str) -> Status {
    let trace = match trace::read_form(file) {
        Ok(trace) => trace,
        Err(refusal) => return refuse(file, &refusal),
    };
    match replay(&trace) {
        Ok(replayed) => {
            let steps = if replayed.steps == 1 { "step" } else { "steps" };
            let mut line = format!("{file}: {} {steps} came out as written; ", replayed.steps);
            let _ = match replayed.judged {
                Ok(()) => writeln!(line, "{} {}", trace.finding.kind.sign(), trace.finding),
                Err(why) => writeln!(line, "what is found was not judged again: {why}"),
            };
            out(&line);
            Status::Claimed
        }
        Err(error @ (ReplayError::NoSemantics { .. } | ReplayError::Setup { .. })) => {
            err(format_args!(
                "{file}: {error}\n  remedy: a semantics of your own is replayed by dsr_model::replay::replay_with"
            ));
            Status::Usage
        }
        Err(error) => {
            err(format_args!("{file}: {error}"));
            Status::Violated
        }
    }
}

fn refuse(file: &str, refusal: &Refusal) -> Status {
    err(format_args!("{file}: {refusal}\n  remedy: {}", refusal.remedy()));
    Status::Usage
}
