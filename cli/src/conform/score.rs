//! `dsr conform score`: which case finds which of the checker's broken cores.

use super::ConformError;
use crate::output::{add, out};
use crate::status::Status;
use dsr_conformance::corpus;
use dsr_conformance::score::{Scores, score};

/// Runs every broken core on the whole corpus. `[spec: CONF-13]`
pub(super) fn run(json: bool) -> Result<Status, ConformError> {
    let scores = score(&corpus::cases()?);
    if json {
        out(&(serde_json::to_string(&scores).map_err(ConformError::Summary)? + "\n"));
    } else {
        out(&text(&scores));
    }
    Ok(if scores.is_full() { Status::Claimed } else { Status::Violated })
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
