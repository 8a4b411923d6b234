//! A table for each chapter: every clause and what speaks for it.

use super::{cell, counted, oracle, shown};
use crate::evidence::{Evidence, Grounds};
use crate::{Clause, Marker};
use std::fmt::Write as _;

/// So many theorems are named; of the others the count.
const NAMED: usize = 2;

pub(super) fn chapters(evidence: &Evidence) -> String {
    let mut text = String::new();
    let cases = if oracle::is_here(evidence) { "cases, by core and oracle" } else { "cases" };
    for source in &evidence.texts {
        let of_file = |clause: &&Clause| clause.place.path == source.path && clause.id.chapter() != "CLAIM";
        let clauses: Vec<&Clause> = evidence.trace.clauses.all().iter().filter(of_file).collect();
        if clauses.is_empty() {
            continue;
        }
        let name = source.path.rsplit('/').next().unwrap_or(&source.path);
        let title = source.text.lines().next().unwrap_or(name).trim_start_matches("# ");
        let _ = write!(
            text,
            "### {title} ([{name}](../{}))\n\n| clause | proved, of the model | checked exhaustively | tests | sampled | \
             {cases} |\n|---|---|---|---|---|---|\n",
            source.path
        );
        for clause in clauses {
            text += &row(clause, evidence);
        }
        text += "\n";
    }
    text
}

fn row(clause: &Clause, evidence: &Evidence) -> String {
    let none = Grounds::default();
    let grounds = evidence.grounds.get(&clause.id).unwrap_or(&none);
    let marker = clause.marker.map(|marker| format!(" ({marker})")).unwrap_or_default();
    let count = |count: usize| if count == 0 { "–".into() } else { count.to_string() };
    format!(
        "| {}{marker} | {} | {} | {} | {} | {} |\n",
        clause.id,
        cell(proofs(grounds, clause.marker)),
        cell(shown(&grounds.layers)),
        count(grounds.tests),
        cell(samples(grounds)),
        count(grounds.cases)
    )
}

fn proofs(grounds: &Grounds, marker: Option<Marker>) -> String {
    let names = |names: &[String]| {
        let shown = names.iter().take(NAMED).map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        match names.len().saturating_sub(NAMED) {
            0 => shown,
            more => format!("{shown} and {more} more"),
        }
    };
    let mut parts = Vec::new();
    if !grounds.theorems.is_empty() {
        let theorems = names(&grounds.theorems);
        parts.push(match (marker, &grounds.left_out) {
            (Some(Marker::Assumption), _) => format!("assumed by {theorems}"),
            (_, Some(part)) => format!("in part: {theorems}; not: {part}"),
            _ => theorems,
        });
    }
    if !grounds.examples.is_empty() {
        parts.push(format!("example: {}", names(&grounds.examples)));
    }
    parts.join("; ")
}

fn samples(grounds: &Grounds) -> String {
    let mut parts = Vec::new();
    if grounds.walked {
        parts.push("walks".into());
    }
    for (count, one, many) in [
        (grounds.samples, "property test", "property tests"),
        (grounds.fuzzed, "fuzz target", "fuzz targets"),
    ] {
        if count > 0 {
            parts.push(counted(count, one, many));
        }
    }
    parts.join(", ")
}
