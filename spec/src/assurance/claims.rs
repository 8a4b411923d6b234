//! The tables of claims, long and short.

use super::{cell, counted, shown};
use crate::claim::{Claim, claims};
use crate::evidence::{Evidence, Grade};
use crate::list::collapsed;
use crate::{ClauseId, Theorem};
use std::fmt::Write as _;

/// For the README: claim, status, command.
pub(super) fn short(evidence: &Evidence) -> String {
    let mut text = String::from("| claim | | status | how to see it |\n|---|---|---|---|\n");
    for claim in claims(evidence) {
        let status = [status(&claim, evidence), checked(&claim, evidence), tested(&claim, evidence)];
        let status: Vec<String> = status.into_iter().filter(|part| !part.is_empty()).collect();
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} |",
            claim.name(),
            claim.sentence,
            status.join("; "),
            claim.commands(evidence)
        );
    }
    text
}

/// For the account: with clauses, assumptions and theorems.
pub(super) fn long(evidence: &Evidence) -> String {
    let mut text = String::from(
        "| claim | says | status, by its weakest clause | clauses | the claim as a theorem | judged by the checker | tests, \
         cases |\n|---|---|---|---|---|---|---|\n",
    );
    for claim in claims(evidence) {
        let under = if claim.assumed.is_empty() {
            String::new()
        } else {
            format!("; assuming {}", collapsed(&claim.assumed))
        };
        let _ = writeln!(
            text,
            "| {} | {} | {} | {}{under} | {} | {} | {} |",
            claim.name(),
            claim.sentence,
            claim.status(evidence),
            collapsed(&claim.clauses),
            cell(theorems(&claim, evidence)),
            cell(checked(&claim, evidence).trim_start_matches("checked exhaustively in ").to_owned()),
            tested(&claim, evidence)
        );
    }
    text
}

/// Status, and the theorems that are the claim itself.
fn status(claim: &Claim, evidence: &Evidence) -> String {
    let (status, theorems) = (claim.status(evidence), theorems(claim, evidence));
    match (theorems.is_empty(), claim.grade(evidence)) {
        (true, _) => status,
        (false, Grade::Proved) => format!("{status} ({theorems})"),
        (false, _) if theorems.starts_with("`Claims.") => {
            format!("{status}; the sentence itself is proved ({theorems})")
        }
        (false, _) => format!("{status}; theorems on it: {theorems}"),
    }
}

/// The theorems that cite the claim: those of the file on claims, or else others.
fn theorems(claim: &Claim, evidence: &Evidence) -> String {
    let is_about = |theorem: &&Theorem| !theorem.is_example && theorem.clauses.contains(&claim.id);
    let about = evidence.theorems.iter().filter(is_about);
    let (own, others): (Vec<_>, Vec<_>) = about.partition(|theorem| theorem.name.starts_with("Claims."));
    let theorems = if own.is_empty() { others } else { own };
    theorems.iter().map(|theorem| format!("`{}`", theorem.name)).collect::<Vec<_>>().join(", ")
}

/// In which layers, and which clauses unless it is all of them.
fn checked(claim: &Claim, evidence: &Evidence) -> String {
    let layers = claim.layers(evidence);
    let is_judged =
        |id: &&ClauseId| evidence.grounds.get(*id).is_some_and(|grounds| !grounds.layers.is_empty());
    let judged: Vec<&ClauseId> = claim.clauses.iter().filter(is_judged).collect();
    match judged.len() {
        0 => String::new(),
        all if all == claim.clauses.len() => format!("checked exhaustively in {}", shown(&layers)),
        _ => format!("checked exhaustively in {}: {}", shown(&layers), collapsed(judged)),
    }
}

fn tested(claim: &Claim, evidence: &Evidence) -> String {
    let grounds = || claim.clauses.iter().filter_map(|id| evidence.grounds.get(id));
    let tests: usize = grounds().map(|grounds| grounds.tests + grounds.samples).sum();
    let cases: usize = grounds().map(|grounds| grounds.cases).sum();
    [(tests, "test", "tests"), (cases, "case", "cases")]
        .into_iter()
        .filter(|(count, ..)| *count > 0)
        .map(|(count, one, many)| counted(count, one, many))
        .collect::<Vec<_>>()
        .join(", ")
}
