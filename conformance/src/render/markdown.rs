//! Markdown, for summaries of jobs and for issues.

use super::diagram::diagram;
use super::escape::{fenced, markdown as plain};
use super::tally::{Named, Tally, clauses, families};
use crate::case::Case;
use crate::log::CaseLine;
use std::fmt::Write;

/// Tables by family and clause, an implementation a column; then each failure.
pub fn markdown(logs: &[Named], cases: &[Case]) -> String {
    let mut text = String::from("# Conformance\n\n");
    for Named { name, log } in logs {
        let header = &log.header;
        let _ = writeln!(
            text,
            "- {}: {}; protocol {}, corpus {}, specification {}{}",
            plain(name),
            Tally::of(&log.cases).text(),
            header.protocol,
            plain(&header.corpus),
            plain(&header.spec),
            log.incomplete
                .as_ref()
                .map(|why| format!("; **incomplete**: {}", plain(why)))
                .unwrap_or_default()
        );
    }
    let all = || logs.iter().flat_map(|named| &named.log.cases);
    table(&mut text, "family", logs, &families(all()), |case, family| case.family() == family);
    table(&mut text, "clause", logs, &clauses(all()), |case, clause| {
        case.clauses.iter().any(|cited| cited == clause)
    });
    for Named { name, log } in logs {
        for line in log.cases.iter().filter(|case| case.verdict.is_bad()) {
            let case = cases.iter().find(|case| case.id == line.id);
            let _ = writeln!(
                text,
                "\n## {}: {}\n\n{}: {}\n",
                plain(name),
                plain(&line.id),
                line.verdict.name(),
                plain(&line.clauses.join(", "))
            );
            let mut body = case
                .map(|case| format!("{}\n{}\n", case.title, diagram(case, line.step)))
                .unwrap_or_default();
            body += &line.detail;
            body.extend(line.expected.iter().map(|row| format!("\n- expected {row}")));
            body.extend(line.got.iter().map(|row| format!("\n+ got      {row}")));
            text += &fenced(&body);
            if let Some(excuse) = &line.excuse {
                let _ = writeln!(text, "\nExpected: {}", plain(excuse));
            }
        }
    }
    text
}

fn table(
    text: &mut String,
    what: &str,
    logs: &[Named],
    rows: &[String],
    is_in: impl Fn(&CaseLine, &str) -> bool,
) {
    let names: Vec<String> = logs.iter().map(|named| plain(&named.name)).collect();
    let _ = writeln!(text, "\n| {what} | {} |\n|---|{}", names.join(" | "), "---|".repeat(logs.len()));
    for row in rows {
        let cells = logs.iter().map(|named| {
            let tally = Tally::of(named.log.cases.iter().filter(|case| is_in(case, row)));
            if tally.bad > 0 { format!("**{}**", tally.text()) } else { tally.text() }
        });
        let _ = writeln!(text, "| {} | {} |", plain(row), cells.collect::<Vec<_>>().join(" | "));
    }
}
