//! `dsr conform report`.

use super::error::{ConformError, read};
use crate::output::{err, out};
use crate::status::Status;
use dsr_conformance::render::{Named, badge, html, junit, markdown, matrix};
use dsr_conformance::{corpus, log};
use std::path::PathBuf;

const AFTER: &str = "\
Examples:
  dsr conform report run.ndjson --to markdown >> \"$GITHUB_STEP_SUMMARY\"
  dsr conform report one.ndjson other.ndjson --to html > matrix.html

Exit status: 0 written, 2 a log is incomplete, 3 wrong usage.";

/// Reports on logs of runs
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// Logs, as `run --log` writes them
    #[arg(required = true, value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// In which form
    #[arg(long, value_enum)]
    to: Form,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
enum Form {
    /// A page that needs nothing else, an implementation a column
    Html,
    /// `JUnit` XML, with clauses as properties
    Junit,
    /// Tables by family and clause, and each failure
    Markdown,
    /// Tables of what each implementation keeps, with the shortest failing case behind each cell
    Matrix,
    /// JSON for shields.io; takes one log
    Badge,
}

impl Arguments {
    /// `[spec: CONF-16]`
    pub(super) fn run(&self) -> Result<Status, ConformError> {
        let logs = named(&self.logs)?;
        match (self.to, logs.as_slice()) {
            (Form::Html, logs) => out(&html(logs, &corpus::cases()?)),
            (Form::Junit, logs) => out(&junit(logs)),
            (Form::Markdown, logs) => out(&markdown(logs, &corpus::cases()?)),
            (Form::Matrix, logs) => out(&matrix(logs, &corpus::cases()?)),
            (Form::Badge, [one]) => out(&badge(one)),
            (Form::Badge, logs) => {
                let what = format!("a badge is of one log, not of {}\n  remedy: write one each", logs.len());
                return Err(ConformError::Usage(vec![what]));
            }
        }
        Ok(complete(&self.logs, &logs))
    }
}

pub(super) fn named(paths: &[PathBuf]) -> Result<Vec<Named>, ConformError> {
    let read = |path: &PathBuf| {
        let file = path.to_string_lossy();
        Ok(Named::of(&file, log::read(&file, &read(path)?)?))
    };
    paths.iter().map(read).collect()
}

/// Says which logs are incomplete.
pub(super) fn complete(paths: &[PathBuf], logs: &[Named]) -> Status {
    let mut status = Status::Claimed;
    for (path, named) in paths.iter().zip(logs) {
        if let Some(why) = &named.log.incomplete {
            err(format!("{}: incomplete: {why}", path.display()));
            status = Status::Incomplete;
        }
    }
    status
}
