//! `dsr conform score`: which case finds which of the checker's broken cores.

use super::chosen::{Format, Printed};
use super::error::ConformError;
use crate::output::{add, out};
use crate::status::Status;
use dsr_conformance::corpus;
use dsr_conformance::score::{Extent, Scores, score};

const ABOUT: &str = "\
Runs the cores that the checker has broken on purpose, one flaw each, on the corpus, and shows the shortest case that each fails; \
with --all it runs every case and counts those that fail. Exit status: 0 each is found, 1 one is missed.";

/// Runs cores broken on purpose: which case finds which
#[derive(clap::Args, Debug)]
#[command(long_about = ABOUT)]
pub(super) struct Arguments {
    #[command(flatten)]
    printed: Printed,
    /// Runs every case, and counts those that each core fails
    #[arg(long)]
    all: bool,
}

impl Arguments {
    /// Runs every broken core on the corpus. `[spec: CONF-19]`
    pub(super) fn run(&self) -> Result<Status, ConformError> {
        let extent = if self.all { Extent::All } else { Extent::UntilFound };
        let scores = score(&corpus::cases()?, extent);
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
        let failed = core.failed.map_or_else(|| "-".into(), |failed| failed.to_string());
        add(&mut text, format_args!("{:<24} {:<9} {failed:>6}  {shortest}\n", core.flaw, core.clause));
    }
    for case in &scores.control {
        add(&mut text, format_args!("{:<24} {:<9} {:>6}  {case}\n", "none: THE HARNESS ERRS", "", "-"));
    }
    let (found, all) = (scores.found, scores.cores.len());
    let percent = found * 100 / all.max(1);
    add(&mut text, format_args!("{found} of {all} found by {} cases: {percent} %\n", scores.cases));
    text
}
