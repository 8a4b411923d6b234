//! `dsr conform compare`.

use super::error::ConformError;
use super::report::{complete, named};
use crate::output::{add, out};
use crate::status::Status;
use dsr_conformance::log::compare;
use dsr_conformance::render::escape::terminal;
use std::path::PathBuf;

const AFTER: &str = "\
Examples:
  dsr conform compare yesterday.ndjson today.ndjson

Exit status: 0 nothing is worse, 1 something is, 2 a log is incomplete, 3 wrong usage.";

/// Tells what changed between two logs
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// The log before
    before: PathBuf,
    /// The log after
    after: PathBuf,
}

impl Arguments {
    /// `[spec: CONF-17]`
    pub(super) fn run(&self) -> Result<Status, ConformError> {
        let paths = [self.before.clone(), self.after.clone()];
        let logs = named(&paths)?;
        let [before, after] = logs.as_slice() else { return Ok(Status::Usage) };
        let comparison = compare(&before.log, &after.log);
        let mut text = String::new();
        for line in &comparison.headers {
            add(&mut text, format_args!("{}\n", terminal(line)));
        }
        let (mut worse, mut better) = (0, 0);
        for change in &comparison.changes {
            let name = |verdict: Option<dsr_conformance::report::Verdict>| {
                verdict.map_or("not there", |known| known.name())
            };
            let sign = if change.is_worse() {
                worse += 1;
                "worse "
            } else if change.is_better() {
                better += 1;
                "better"
            } else {
                "other "
            };
            let (from, to) = (name(change.before), name(change.after));
            add(&mut text, format_args!("{sign} {}: {from} → {to}\n", terminal(&change.id)));
            if change.is_worse() && !change.detail.is_empty() {
                add(
                    &mut text,
                    format_args!("         {}\n", terminal(change.detail.lines().next().unwrap_or_default())),
                );
            }
        }
        let others = comparison.changes.len() - worse - better;
        add(
            &mut text,
            format_args!(
                "{worse} worse, {better} better, {others} otherwise, {} as before\n",
                comparison.same
            ),
        );
        out(&text);
        let incomplete = complete(&paths, &logs);
        Ok(if comparison.is_worse() && incomplete == Status::Claimed { Status::Violated } else { incomplete })
    }
}
