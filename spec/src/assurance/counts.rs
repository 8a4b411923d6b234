//! How many clauses have what.

use super::counted;
use crate::Marker;
use crate::evidence::{Evidence, Grade};
use std::fmt::Write as _;

pub(super) fn counts(evidence: &Evidence) -> String {
    let clauses = evidence.trace.clauses.all();
    let binding = evidence.binding().count();
    let examples = evidence.theorems.iter().filter(|theorem| theorem.is_example).count();
    let mut text = format!(
        "{} theorems, {examples} of them examples and counterexamples; {}, {} of the suite's runs exhaustive; {} \
         conformance cases; {}.\n\n{} clauses, of which {binding} bind. By the best evidence of each:\n\n| the best evidence \
         | clauses |\n|---|---|\n",
        evidence.theorems.len(),
        counted(evidence.layers.len(), "layer", "layers"),
        evidence
            .layers
            .iter()
            .filter(|layer| layer.is_exhaustive())
            .map(|layer| layer.runs.len())
            .sum::<usize>(),
        evidence.cases.total,
        match evidence.fuzz_targets {
            0 => "no fuzz targets".into(),
            count => counted(count, "fuzz target", "fuzz targets"),
        },
        clauses.len(),
    );
    for grade in Grade::ALL {
        let count = evidence.binding().filter(|clause| evidence.grade(&clause.id) == grade).count();
        let _ = writeln!(text, "| {} | {count} |", grade.words());
    }
    for marker in [Marker::Definition, Marker::Assumption, Marker::Informative] {
        let count = clauses.iter().filter(|clause| clause.marker == Some(marker)).count();
        let _ = writeln!(text, "| none needed: {marker} | {count} |");
    }
    let has = |of: &dyn Fn(&crate::Clause) -> bool| evidence.binding().filter(|clause| of(clause)).count();
    let grounds = |clause: &crate::Clause| evidence.grounds.get(&clause.id).cloned().unwrap_or_default();
    let _ = write!(
        text,
        "\nOf those that bind, {} are judged exhaustively by the checker, {} have tests, {} have random samples or walks, \
         and {} have conformance cases.\n",
        has(&|clause| !grounds(clause).layers.is_empty()),
        has(&|clause| grounds(clause).tests > 0),
        has(&|clause| grounds(clause).walked || grounds(clause).samples + grounds(clause).fuzzed > 0),
        has(&|clause| grounds(clause).cases > 0),
    );
    text
}
