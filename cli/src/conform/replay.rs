//! `dsr conform replay`.

use super::chosen::{Patience, case};
use super::error::{ConformError, read};
use super::look::{status_of, text};
use crate::output::out;
use crate::status::Status;
use dsr_conformance::case::Step;
use dsr_conformance::log;
use dsr_conformance::render::{escape::terminal, words};
use dsr_conformance::report::CaseResult;
use dsr_conformance::run::{Watch, run_watched};
use std::path::PathBuf;

const AFTER: &str = "\
Examples:
  dsr conform replay universal/delivery/twice -- ./adapter
  dsr conform replay universal/delivery/twice --log run.ndjson";

/// Runs one case and prints every request, every reply and each step of the judgement
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// The case
    id: String,
    /// Run the command that this log names
    #[arg(long, value_name = "FILE", conflicts_with = "command", required_unless_present = "command")]
    log: Option<PathBuf>,
    #[command(flatten)]
    patience: Patience,
    /// The adapter: a program and its arguments
    #[arg(last = true)]
    command: Vec<String>,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, ConformError> {
        let case = case(&self.id)?;
        let command = match &self.log {
            Some(path) => log::read(&path.to_string_lossy(), &read(path)?)?.header.command,
            None => self.command.clone(),
        };
        if command.is_empty() {
            let what = "the log names no command\n  remedy: name it: `dsr conform replay ID -- COMMAND…`";
            return Err(ConformError::Usage(vec![what.into()]));
        }
        let mut program = self.patience.program(&command);
        let cases = [case];
        let report = run_watched(&mut program, &cases, &mut Transcript::default());
        out(&format!("\n{}", text(&report, (&cases, &command, &command.join(" ")), &|_| None)));
        Ok(status_of(report.outcome()))
    }
}

/// Prints what goes to and fro.
#[derive(Default)]
pub(super) struct Transcript {
    open: bool,
}

impl Watch for Transcript {
    fn step(&mut self, number: usize, step: &Step) {
        if self.open {
            out("  as expected\n");
        }
        self.open = step.expects();
        out(&format!("step {number}: {}\n", words(step)));
    }

    fn sent(&mut self, line: &str) {
        out(&format!("  → {}\n", terminal(line)));
    }

    fn came(&mut self, line: &str) {
        out(&format!("  ← {}\n", terminal(line)));
    }

    fn ends(&mut self, result: &CaseResult) {
        if self.open && result.verdict == dsr_conformance::report::Verdict::Pass {
            out("  as expected\n");
        }
        out(&format!("{}\n", result.verdict.name()));
    }
}
