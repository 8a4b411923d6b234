//! `dsr gallery`: the known anomalies of the published semantics, found by search.

use crate::check::Format;
use crate::output::{add, err, out};
use crate::page;
use crate::status::Status;
use dsr_explorer::{Content, Origin, Shown, Side};
use dsr_model::gallery::{Found, RowReport, rows, run_row};
use dsr_model::render::{Target, render};
use dsr_model::trace::Trace;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

const ABOUT: &str = "\
Each row is one way in which replicas of the published system go wrong. A breadth-first search over everything that a \
small network may do finds a shortest schedule for it; the same schedule then runs on the checked semantics.";

const STATUS: &str = "\
Exit status: 0 every row was found, only with its cause, and the checked semantics holds; 1 otherwise; 3 wrong usage";

/// Arguments of `dsr gallery`.
#[derive(clap::Args, Debug)]
#[command(about = "Finds the known anomalies of the published semantics", long_about = ABOUT, after_help = STATUS)]
pub(crate) struct Arguments {
    /// Only this row, with its schedule, such as 1b
    #[arg(long)]
    row: Option<String>,
    /// A folder for the traces: of each row one of the published system and one of the checked semantics
    #[arg(long, value_name = "FOLDER")]
    traces: Option<PathBuf>,
    /// A page for a browser that shows the rows and steps through both runs of each
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// How the result is printed
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

impl Arguments {
    pub(crate) fn run(&self) -> Status {
        let wanted = |row: &str| self.row.as_ref().is_none_or(|wanted| wanted == row);
        let rows: Vec<_> = rows().into_iter().filter(|row| wanted(row.row)).collect();
        if rows.is_empty() {
            err("there is no such row; without --row all are listed");
            return Status::Usage;
        }
        let reports: Vec<RowReport> = rows.iter().map(run_row).collect();
        if let Some(folder) = &self.traces
            && let Err(error) = reports.iter().try_for_each(|report| write_traces(folder, report))
        {
            let folder = folder.display();
            err(format_args!(
                "{folder}: cannot write: {error}\n  remedy: check the path, the permissions and the space"
            ));
            return Status::Usage;
        }
        let all = json!({ "rows": reports.iter().map(row_json).collect::<Vec<_>>() });
        if let Some(path) = &self.report
            && let Err(refusal) = page::write(path, &content(&reports, &all))
        {
            err(refusal);
            return Status::Usage;
        }
        match self.format {
            Format::Text => out(&text(&reports, self.row.is_some())),
            Format::Json => {
                out(&format!("{}\n", serde_json::to_string_pretty(&all).unwrap_or_default()));
            }
        }
        if reports.iter().all(is_fine) { Status::Claimed } else { Status::Violated }
    }
}

fn is_fine(report: &RowReport) -> bool {
    let holds = report.checked.as_ref().is_some_and(|checked| checked.broken.is_none());
    let needs_its_cause = report.control.is_none_or(|control| control.ended && !control.found);
    report.found == Found::Search && holds && needs_its_cause
}

fn checked(report: &RowReport) -> Option<String> {
    report.checked.as_ref().map(dsr_model::gallery::Twin::verdict)
}

fn text(reports: &[RowReport], schedules: bool) -> String {
    let mut text = String::new();
    let widest = reports.iter().map(|report| report.bound.chars().count()).max().unwrap_or(0).max(5);
    let bound = "bound";
    add(
        &mut text,
        format_args!(
            "row  found   layer  {bound:<widest$}   states      s  steps  clause    checked  what goes wrong\n"
        ),
    );
    for report in reports {
        let clause = report.breach.as_ref().map_or("-", |breach| breach.clause);
        let checked = checked(report).unwrap_or_else(|| "-".into());
        let (row, found, title) = (report.row, report.found.word(), report.title);
        let RowReport { layer, bound, states, seconds, steps, .. } = report;
        add(
            &mut text,
            format_args!(
                "{row:<4} {found:<7} {layer:<5}  {bound:<widest$} {states:>8} {seconds:>6.2}  {steps:>5}  {clause:<9} \
                 {checked:<8} {title}\n"
            ),
        );
        if let Some(reason) = report.reason {
            add(&mut text, format_args!("     {reason}\n"));
        }
        if schedules {
            add_schedule(&mut text, report);
        }
    }
    let found = reports.iter().filter(|report| report.found == Found::Search).count();
    add(&mut text, format_args!("{found} of {} found by search\n", reports.len()));
    text
}

/// Both runs as diagrams, and what becomes of it without its cause.
fn add_schedule(text: &mut String, report: &RowReport) {
    for (_, trace) in traces(report) {
        let drawn = render(trace, Target::Text).unwrap_or_else(|error| format!("cannot be drawn: {error}\n"));
        add(text, format_args!("\n{drawn}"));
    }
    if let Some(control) = report.control {
        let found = if control.found { "found as well" } else { "nothing is found" };
        let (what, states) = (control.what, control.states);
        add(text, format_args!("\nWhere {what}, {found} in {states} states.\n\n"));
    }
}

/// A row's traces, each with what its file is called.
fn traces(report: &RowReport) -> impl Iterator<Item = (String, &Trace)> {
    let published = report.trace.iter().map(|trace| (format!("row-{}", report.row), trace));
    let checked = report.checked.iter();
    published.chain(checked.map(|twin| (format!("row-{}.checked", report.row), &twin.trace)))
}

/// What the page shows.
fn content(reports: &[RowReport], rows: &Value) -> Content {
    let shown = |report: &RowReport, side, trace: &Trace| {
        let origin = Origin::Row { row: report.row.into(), side };
        Shown { trace: trace.clone(), origin }
    };
    let traces = reports.iter().flat_map(|report| {
        let published = report.trace.iter().map(|trace| shown(report, Side::Published, trace));
        let checked = report.checked.iter().map(|twin| shown(report, Side::Checked, &twin.trace));
        published.chain(checked).collect::<Vec<_>>()
    });
    let title = "Anomalies of the published semantics".into();
    Content { title, report: None, gallery: Some(rows.clone()), traces: traces.collect() }
}

fn write_traces(folder: &Path, report: &RowReport) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    traces(report).try_for_each(|(name, trace)| {
        let json = serde_json::to_string_pretty(trace)?;
        std::fs::write(folder.join(format!("{name}.trace.json")), json + "\n")
    })
}

fn row_json(report: &RowReport) -> Value {
    json!({
        "row": report.row,
        "title": report.title,
        "found": report.found.word(),
        "reason": report.reason,
        "layer": report.layer,
        "bound": report.bound,
        "states": report.states,
        "steps": report.steps,
        "seconds": report.seconds,
        "clause": report.breach.as_ref().map(|breach| breach.clause),
        "detail": report.breach.as_ref().map(|breach| &breach.detail),
        "schedule": report.lines,
        "checked": checked(report),
        "control": report.control.map(|control| json!({
            "what": control.what, "found": control.found, "ended": control.ended, "states": control.states,
        })),
    })
}
