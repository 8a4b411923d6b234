//! `dsr conform expect`.

use super::chosen::{Choice, Patience, ids};
use super::error::{ConformError, read_text, write};
use super::look::Bar;
use super::run::usable;
use crate::output::out;
use crate::status::Status;
use dsr_conformance::expect::{Expectations, update};
use dsr_conformance::run::run_watched;
use std::path::PathBuf;

const AFTER: &str = "\
Examples:
  dsr conform expect --update --to expected.json -- ./adapter
  dsr conform expect --check expected.json";

/// Writes or checks a file of failures that are expected
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
#[command(group(clap::ArgGroup::new("what").required(true).args(["update", "check"])))]
pub(super) struct Arguments {
    /// Run the cases, and write what does not pass; reasons that still hold are kept
    #[arg(long, requires = "to", requires = "command")]
    update: bool,
    /// Check a file: its form, that each entry has a reason and matches a case
    #[arg(long, value_name = "FILE")]
    check: Option<PathBuf>,
    /// The file to write
    #[arg(long, value_name = "FILE")]
    to: Option<PathBuf>,
    #[command(flatten)]
    choice: Choice,
    #[command(flatten)]
    patience: Patience,
    /// The adapter: a program and its arguments
    #[arg(last = true)]
    command: Vec<String>,
}

impl Arguments {
    /// `[spec: CONF-14]`
    pub(super) fn run(&self) -> Result<Status, ConformError> {
        if let Some(path) = &self.check {
            let known = usable(path)?;
            known.match_cases(&path.to_string_lossy(), &ids()?)?;
            out(&format!("{} expectations, each with a reason\n", known.expected.len()));
            return Ok(Status::Claimed);
        }
        let Some(path) = &self.to else { return Ok(Status::Usage) };
        let file = path.to_string_lossy();
        let old = if path.exists() { Some(Expectations::read(&file, &read_text(path)?)?) } else { None };
        let cases = self.choice.cases()?;
        let report =
            run_watched(&mut self.patience.program(&self.command), &cases, &mut Bar::new(cases.len()));
        if report.implementation.is_none() {
            let what =
                "the adapter never said what it is: nothing is written\n  remedy: try `dsr conform smoke`";
            return Err(ConformError::Usage(vec![what.into()]));
        }
        if report.results.len() < report.wanted {
            let what = "the run broke off: nothing is written\n  remedy: try `dsr conform smoke`";
            return Err(ConformError::Usage(vec![what.into()]));
        }
        let new = update(old.as_ref(), &report, &ids()?);
        write(path, &new.text()?)?;
        let without = new.expected.iter().filter(|entry| entry.reason.trim().is_empty()).count();
        out(&format!("{} expectations, {without} without a reason\n", new.expected.len()));
        if without > 0 {
            out(&format!("write a `reason` in each of these before `dsr conform run --expect {file}`\n"));
        }
        Ok(Status::Claimed)
    }
}
