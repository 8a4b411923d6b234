//! `dsr scene check`.

use super::{Reading, report};
use crate::input::{FILE_HELP, InputError, Loaded};
use crate::output::{add, err, out};
use crate::status::Status;
use dsr_core::scene::Fault;
use dsr_core::view;
use serde_json::{Value, json};

pub(super) const AFTER: &str = "\
A scene is sound if nothing in it is unknown, out of range or dangling, its RT links form one tree that hangs \
from the root, every symbol has a path to the root, and the dictionary declares its names. Every fault is \
named with file, line, column, symbol, link and attribute.

Exit status: 0 all sound (with --lenient: all readable), 1 one is refused, 3 one cannot be read at all.
Scenes are limited to 64 MiB, states to 1 GiB.";

#[derive(clap::Args, Debug)]
pub(crate) struct Arguments {
    #[arg(required = true, value_name = "FILE", help = FILE_HELP)]
    files: Vec<String>,
    #[command(flatten)]
    reading: Reading,
    /// How the report is written
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Format {
    /// One line per file on standard output, faults on standard error
    Text,
    /// One JSON object on standard output
    Json,
}

pub(super) fn run(arguments: &Arguments) -> Result<Status, Status> {
    let dictionary = arguments.reading.dictionary()?;
    let mut status = Status::Claimed;
    let mut reports = Vec::new();
    for file in &arguments.files {
        let outcome = arguments.reading.load(file, &dictionary).map(|loaded| {
            let repairs = view(&loaded.scene.state, &dictionary).repairs().len();
            (loaded, repairs)
        });
        status = status.max(match &outcome {
            Ok((_, 0)) => Status::Claimed,
            Err(error) if error.is_unreadable() => Status::Usage,
            Ok(_) | Err(_) => Status::Violated,
        });
        match arguments.format {
            Format::Text => tell(file, &outcome),
            Format::Json => reports.push(report_of(file, &outcome)),
        }
    }
    if let Format::Json = arguments.format {
        out(&format!("{:#}\n", json!({ "status": status as u8, "files": reports })));
    }
    Ok(status)
}

type Outcome = Result<(Loaded, usize), InputError>;

/// Vertices with the root, edges, attributes.
fn counts(loaded: &Loaded) -> (usize, usize, usize) {
    let dictionary = dsr_core::Dictionary::open();
    let graph = view(&loaded.scene.state, &dictionary);
    (graph.vertices().len(), graph.edges().len(), graph.writes().len())
}

fn tell(file: &str, outcome: &Outcome) {
    match outcome {
        Ok((loaded, repairs)) => {
            report::dropped(file, &loaded.dropped);
            let (vertices, edges, attributes) = counts(loaded);
            let verdict = match (repairs, loaded.dropped.len()) {
                (0, 0) => "sound",
                (0, _) => "sound after drops",
                _ => "repaired",
            };
            let mut line =
                format!("{verdict}: {file}: {vertices} vertices, {edges} edges, {attributes} attributes");
            if !loaded.dropped.is_empty() {
                add(&mut line, format_args!(", {} fault(s) dropped", loaded.dropped.len()));
            }
            if *repairs > 0 {
                add(&mut line, format_args!(", {repairs} repair(s) in the view"));
            }
            out(&(line + "\n"));
        }
        Err(InputError::Refused(refused)) => {
            report::faults(file, &refused.faults);
            out(&format!("refused: {file}: {} fault(s)\n", refused.faults.len()));
        }
        Err(error) => {
            err(format_args!("{file}: {error}\n  remedy: {}", error.remedy()));
            out(&format!("unreadable: {file}\n"));
        }
    }
}

fn report_of(file: &str, outcome: &Outcome) -> Value {
    match outcome {
        Ok((loaded, repairs)) => {
            let (vertices, edges, attributes) = counts(loaded);
            json!({
                "file": file, "sound": *repairs == 0,
                "vertices": vertices, "edges": edges, "attributes": attributes, "repairs": repairs,
                "dropped": loaded.dropped.iter().map(fault_report).collect::<Vec<_>>(),
            })
        }
        Err(InputError::Refused(refused)) => json!({
            "file": file, "sound": false, "faults": refused.faults.iter().map(fault_report).collect::<Vec<_>>(),
        }),
        Err(error) => json!({
            "file": file, "sound": false, "error": error.to_string(), "remedy": error.remedy(),
        }),
    }
}

fn fault_report(fault: &Fault) -> Value {
    let place = &fault.place;
    let mut report = json!({
        "line": place.line, "column": place.column, "what": fault.kind.to_string(), "remedy": fault.kind.remedy(),
    });
    if let Some(symbol) = &place.symbol {
        report["symbol"] = json!({ "id": symbol.id, "name": symbol.name.as_deref() });
    }
    if let Some(link) = &place.link {
        let target = link.target.map(|target| target.to_string());
        report["link"] = json!({ "index": link.index, "label": link.label.as_deref(), "target": target });
    }
    if let Some(attribute) = &place.attribute {
        report["attribute"] = json!(&**attribute);
    }
    if let Some(item) = place.item {
        report["item"] = json!(item);
    }
    report
}
