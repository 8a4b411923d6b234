//! The matrix of clauses, code and witnesses, as Markdown.

use crate::{Clause, Marker, Trace};
use std::fmt::Write as _;

/// Where the matrix is kept, from the workspace root.
pub const MATRIX_PATH: &str = "spec/MATRIX.md";

const HEAD: &str = "# Clauses, code and witnesses

Generated: `cargo run -p dsr-spec` writes it, and `cargo test -p dsr-spec` fails when it is stale. A witness is
a test, or a property that tests, checker and fuzzers call. How to read clauses and markers:
[README](README.md).
";

/// The whole file. It names no line numbers, so that it changes only when a tie does.
pub fn matrix(trace: &Trace) -> String {
    let mut text = String::from(HEAD);
    let mut file = "";
    for clause in trace.clauses.all() {
        if clause.place.path != file {
            file = &clause.place.path;
            let name = file.rsplit('/').next().unwrap_or(file);
            let _ = write!(text, "\n## [{name}]({name})\n\n| clause | code | witnesses |\n|---|---|---|\n");
        }
        push_row(&mut text, trace, clause);
    }
    push_exemptions(&mut text, trace);
    text
}

fn push_row(text: &mut String, trace: &Trace, clause: &Clause) {
    let code = trace.code.get(&clause.id).into_iter().flatten().map(|path| format!("`{path}`"));
    let witnesses = trace.witnesses.get(&clause.id).into_iter().flatten();
    let witnesses = witnesses.map(|(path, function)| format!("`{path}` `{function}`"));
    let marker = clause.marker.map(|marker| format!(" ({marker})")).unwrap_or_default();
    let code = cell(code, clause.needs_code());
    let witnesses = cell(witnesses, clause.needs_witness());
    let _ = writeln!(text, "| {}{marker} | {code} | {witnesses} |", clause.id);
}

fn cell(items: impl Iterator<Item = String>, needed: bool) -> String {
    let items: Vec<String> = items.collect();
    match (items.is_empty(), needed) {
        (false, _) => items.join("<br>"),
        (true, true) => "**none**".into(),
        (true, false) => "–".into(),
    }
}

fn push_exemptions(text: &mut String, trace: &Trace) {
    text.push_str("\n## Exempt\n\n");
    for marker in Marker::ALL {
        let ids: Vec<String> = trace
            .clauses
            .all()
            .iter()
            .filter(|clause| clause.marker == Some(marker))
            .map(|clause| clause.id.to_string())
            .collect();
        if !ids.is_empty() {
            let from = if marker == Marker::Derived { "from code" } else { "from code and witness" };
            let _ = writeln!(text, "- {marker}, {from} ({}): {}", ids.len(), ids.join(", "));
        }
    }
}
