//! `docs/published.md` has every row of the gallery, with its paragraph, its diagram and its numbers.

#![expect(clippy::expect_used, reason = "helpers of tests: what they expect is what they test")]

use dsr_model::gallery::{RowReport, rows, run_row};
use dsr_model::render::{Target, render};
use dsr_model::trace::Trace;
use std::path::Path;

const END: &str = "<!-- end -->";

/// The table of all rows, without times.
fn table(reports: &[RowReport]) -> String {
    let lines = reports.iter().map(|report| {
        let clause = report.breach.as_ref().map_or("-", |breach| breach.clause);
        let RowReport { row, title, steps, states, bound, .. } = report;
        format!("| {row} | {title} | {clause} | {steps} | {states} | {bound} |\n")
    });
    let head = "| row | what goes wrong | clause | steps | states | bound |\n|---|---|---|---:|---:|---|\n";
    format!("<!-- rows -->\n{head}{}{END}", lines.collect::<String>())
}

/// A row's diagram, and what the checked semantics does.
fn diagram(report: &RowReport) -> String {
    let trace: &Trace = report.trace.as_ref().expect("a trace");
    let drawn = render(trace, Target::MermaidBrief).expect("a sound trace");
    let twin = report.checked.as_ref().expect("a twin");
    let steps = twin.trace.steps.len();
    let how = match (twin.refused, twin.resynchronised) {
        (0, true) => "after resynchronisation all replicas are equal",
        (0, false) => "all replicas end equal",
        (_, _) => "what would break it is refused",
    };
    let row = report.row;
    format!(
        "<details><summary>Row {row} in {} steps</summary>\n\n```mermaid\n{drawn}```\n\nThe same schedule on the \
         checked semantics: {steps} steps, {how}. `dsr gallery --row {row}` shows both.\n\n</details>\n",
        trace.steps.len()
    )
}

/// The rows that a paragraph is about: `**1, 1b.** …`.
fn rows_of(paragraph: &str) -> Vec<&str> {
    let head = paragraph.strip_prefix("**").and_then(|rest| rest.split_once(".**"));
    let names: Vec<&str> = head.map(|(names, _)| names.split(", ").collect()).unwrap_or_default();
    let is_row = |name: &&str| name.starts_with(|letter: char| letter.is_ascii_digit());
    if names.iter().all(is_row) { names } else { Vec::new() }
}

/// The text with what is generated in it: in the place of the table, and below each paragraph about rows.
fn generated(text: &str, reports: &[RowReport]) -> String {
    let mut bare = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("<!-- ") {
        let (name, after) = after.split_once(" -->").expect("the end of a mark");
        let (_, after) = after.split_once(END).expect("the end of what is generated");
        bare += before.trim_end_matches('\n');
        bare += if name == "rows" { "\n\n@rows\n" } else { "\n" };
        rest = after.strip_prefix('\n').unwrap_or(after);
    }
    bare += rest;
    let mut blocks = Vec::new();
    for paragraph in bare.trim_end().split("\n\n") {
        let paragraph = paragraph.trim_matches('\n');
        blocks.push(if paragraph == "@rows" { table(reports) } else { paragraph.to_owned() });
        let own = rows_of(paragraph);
        if !own.is_empty() {
            let of = |row: &&str| reports.iter().find(|report| report.row == *row).map(diagram);
            let drawn: String = own.iter().filter_map(of).collect();
            blocks.push(format!("<!-- diagrams -->\n{drawn}{END}"));
        }
    }
    blocks.join("\n\n") + "\n"
}

/// Set `DSR_WRITE=1` to write the file anew.
#[test]
fn law_every_row_has_a_paragraph_a_cause_a_remedy_and_its_diagram() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/published.md");
    let text = std::fs::read_to_string(&file).expect("the file");
    let reports: Vec<RowReport> = rows().iter().map(run_row).collect();
    let wanted = generated(&text, &reports);
    if std::env::var_os("DSR_WRITE").is_some() {
        std::fs::write(&file, &wanted).expect("a file that can be written");
    }
    let written = std::fs::read_to_string(&file).expect("the file");
    assert!(written == wanted, "docs/published.md is out of date: run this test with DSR_WRITE=1");
    let mut told: Vec<&str> = Vec::new();
    for paragraph in written.split("\n\n") {
        let own = rows_of(paragraph);
        let (lower, is_row) = (paragraph.to_lowercase(), !own.is_empty());
        assert!(!is_row || lower.contains("*cause") && lower.contains("remedy:*"), "{paragraph}");
        told.extend(own);
    }
    for report in &reports {
        assert_eq!(told.iter().filter(|row| **row == report.row).count(), 1, "row {}", report.row);
        assert!(written.contains(&format!("<summary>Row {} in ", report.row)), "row {}", report.row);
    }
    assert_eq!(told.len(), reports.len());
}
