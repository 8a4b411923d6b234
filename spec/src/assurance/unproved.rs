//! The clauses without a proof, by reason, and those without anything.

use crate::ClauseId;
use crate::evidence::{Evidence, Grade};
use crate::list::collapsed;
use std::fmt::Write as _;

pub(super) fn unproved(evidence: &Evidence) -> String {
    let is_unproved =
        |id: &&ClauseId| evidence.grounds.get(*id).is_some_and(|grounds| grounds.theorems.is_empty());
    let mut text = String::from("| clauses | how many | why there is no proof |\n|---|---|---|\n");
    for (why, ids, _) in &evidence.left_out.reasons {
        let ids: Vec<&ClauseId> = ids.iter().filter(is_unproved).collect();
        let count = ids.len();
        let _ = writeln!(text, "| {} | {count} | {why} |", collapsed(ids));
    }
    let nothing = evidence.binding().filter(|clause| evidence.grade(&clause.id) == Grade::Nothing);
    let nothing = collapsed(nothing.map(|clause| &clause.id));
    let nothing = if nothing.is_empty() { "none" } else { &nothing };
    let _ = write!(text, "\nClauses that bind and have nothing of any kind: {nothing}.\n");
    text
}
