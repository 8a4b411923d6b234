//! `dsr conform run`.

use super::chosen::{Choice, Command, Format, Printed, ids};
use super::error::{ConformError, read_text};
use super::look::{Bar, Both, status_of, text};
use crate::output::out;
use crate::status::Status;
use dsr_conformance::expect::{ExpectError, Expectations, Surprise};
use dsr_conformance::log::LogWriter;
use dsr_conformance::render::escape::terminal;
use dsr_conformance::report::{Outcome, Report};
use dsr_conformance::run::run_watched;
use std::fs::File;
use std::path::{Path, PathBuf};

const AFTER: &str = "\
Examples:
  dsr conform run -- python3 adapter.py
  dsr conform run --profile observe --only 'universal/*' -- ./adapter
  dsr conform run --log run.ndjson --expect expected.json -- ./adapter

Exit status: 0 as expected, 1 something is not, 2 a case was skipped or not run, or none passed, 3 wrong usage.";

/// Runs the cases against an adapter
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    #[command(flatten)]
    choice: Choice,
    #[command(flatten)]
    printed: Printed,
    /// Write what comes of each case to this file, a line of JSON each
    #[arg(long, value_name = "FILE")]
    log: Option<PathBuf>,
    /// Failures that are expected; a pass that is not fails the run
    #[arg(long, value_name = "FILE")]
    expect: Option<PathBuf>,
    #[command(flatten)]
    adapter: Command,
}

impl Arguments {
    /// `[spec: CONF-14]`
    pub(super) fn run(&self) -> Result<Status, ConformError> {
        let cases = self.choice.cases()?;
        let expectations = self.expect.as_deref().map(usable).transpose()?;
        let expectations = expectations.as_ref();
        let mut bar = Bar::new(cases.len());
        let command = &self.adapter.command;
        let mut program = self.adapter.program();
        let failed = |path: &Path, why| ConformError::File { path: path.into(), why };
        let report;
        let outcome;
        let surprises;
        if let Some(path) = &self.log {
            let file = File::create(path).map_err(|why| failed(path, why))?;
            let filter = (self.choice.only.as_str(), self.choice.profile());
            let mut log = LogWriter::new(file, command, filter, cases.len(), expectations);
            report = run_watched(&mut program, &cases, &mut Both(&mut bar, &mut log));
            (outcome, surprises) = judged(&report, expectations)?;
            log.finish(&report, outcome).map_err(|why| failed(path, why))?;
        } else {
            report = run_watched(&mut program, &cases, &mut bar);
            (outcome, surprises) = judged(&report, expectations)?;
        }
        drop(bar);
        if let (Some(path), Some(known)) = (&self.expect, expectations) {
            is_about(path, known, &report)?;
        }
        match self.printed.format {
            Format::Text => {
                let excuse = |result: &_| excuse_of(expectations, result);
                out(&text(&report, (&cases, command, &command.join(" ")), &excuse));
                for surprise in &surprises {
                    out(&format!("not as expected: {}\n", terminal(&surprise.to_string())));
                }
            }
            Format::Json => {
                let mut summary = report.summary();
                summary.verdict = outcome;
                out(&(serde_json::to_string(&summary)? + "\n"));
            }
        }
        Ok(status_of(outcome))
    }
}

fn excuse_of(known: Option<&Expectations>, result: &dsr_conformance::report::CaseResult) -> Option<String> {
    Some(known?.excuse(&result.id, result.verdict)?.reason.clone())
}

fn judged(
    report: &Report,
    expectations: Option<&Expectations>,
) -> Result<(Outcome, Vec<Surprise>), ConformError> {
    let Some(known) = expectations else { return Ok((report.outcome(), Vec::new())) };
    let surprises = known.surprises(report, &ids()?);
    let outcome = report.outcome_but(&|result| known.excuses(result));
    Ok((if surprises.is_empty() { outcome } else { Outcome::Unexpected }, surprises))
}

/// Expectations that a run can use: each with a reason.
pub(super) fn usable(path: &Path) -> Result<Expectations, ConformError> {
    let file = path.to_string_lossy();
    let read = Expectations::read(&file, &read_text(path)?)?;
    read.have_reasons(&file)?;
    Ok(read)
}

fn is_about(path: &Path, known: &Expectations, report: &Report) -> Result<(), ConformError> {
    match &report.implementation {
        Some(found) if found.name != known.implementation => Err(ExpectError::Implementation {
            file: path.to_string_lossy().into_owned(),
            expected: known.implementation.clone(),
            found: found.name.clone(),
        }
        .into()),
        _ => Ok(()),
    }
}
