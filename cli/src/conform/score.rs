//! `dsr conform score`: which case finds which of the checker's broken cores.

use super::chosen::{Format, Printed};
use super::error::ConformError;
use crate::output::{add, out};
use crate::status::Status;
use dsr_conformance::corpus;
use dsr_conformance::score::{Scores, score};

const ABOUT: &str = "\
Runs the cores that the checker has broken on purpose, one flaw each, on the whole corpus, and shows how many cases each fails and \
the shortest of these. Exit status: 0 each is found, 1 one is missed.";

/// Runs cores broken on purpose: which case finds which
#[derive(clap::Args, Debug)]
#[command(long_about = ABOUT)]
pub(super) struct Arguments {
    #[command(flatten)]
    printed: Printed,
}

impl Arguments {
    /// Runs every broken core on the whole corpus. `[spec: CONF-19]`
    pub(super) fn run(&self) -> Result<Status, ConformError> {
        let scores = score(&corpus::cases()?);
        match self.printed.format {
            Format::Text => out(&text(&scores)),
            Format::Json => out(&(serde_json::to_string(&scores)? + "\n")),
        }
        Ok(if scores.is_full() { Status::Claimed } else { Status::Violated })
    }
}

fn text(scores: &Scores) -> String {
    let mut text = String::new();
    add(
        &mut text,
        format_args!("{:<24} {:<9} {:>6}  {}\n", "broken core", "clause", "fails", "the shortest case"),
    );
    for core in &scores.cores {
        let shortest = core.shortest.as_deref().unwrap_or("MISSED");
        add(&mut text, format_args!("{:<24} {:<9} {:>6}  {shortest}\n", core.flaw, core.clause, core.failed));
    }
    let (found, all) = (scores.found, scores.cores.len());
    let percent = found * 100 / all.max(1);
    add(&mut text, format_args!("{found} of {all} found by {} cases: {percent} %\n", scores.cases));
    text
}
