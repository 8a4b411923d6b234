//! The command that measures.

use clap::{Parser, ValueEnum};
use dsr_benches::error::BenchError;
use dsr_benches::questions;
use dsr_benches::report::{json, markdown, plots, text};
use dsr_benches::run::{Extent, PARTS, Results, run};
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Measures the core beside other CRDT libraries in the same run.
#[derive(Parser, Debug)]
#[command(name = "dsr-benches", version)]
struct Arguments {
    /// Under three minutes; growth to 10⁵ vertices. The default
    #[arg(long, conflicts_with = "full")]
    quick: bool,
    /// More rounds; growth to 10⁶ vertices
    #[arg(long)]
    full: bool,
    /// Only what a pattern means, such as `apply/*`; `*` stands for anything
    #[arg(long, value_name = "GLOB", default_value = "*")]
    only: String,
    /// Only these peers, separated by commas; ours is always there
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    peers: Option<Vec<String>>,
    /// How the results are printed
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Lists the questions, and measures nothing
    #[arg(long)]
    list: bool,
    /// Draws growth curves as SVG into a folder
    #[arg(long, value_name = "DIR")]
    plots: Option<PathBuf>,
    /// Writes performance.md, and performance/ with plots and JSON, into a folder
    #[arg(long, value_name = "DIR")]
    record: Option<PathBuf>,
}

#[derive(Clone, Copy, ValueEnum, Debug)]
enum Format {
    /// A table
    Text,
    /// For programs
    Json,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match carry_out(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn carry_out(arguments: &Arguments) -> Result<(), BenchError> {
    if arguments.list {
        let questions = questions::all().into_iter().map(|question| (question.id, question.asks));
        let lines: Vec<String> =
            questions.chain(PARTS).map(|(id, asks)| format!("{id:22} {asks}\n")).collect();
        return print(&lines.concat());
    }
    let extent = if arguments.full { Extent::Full } else { Extent::Quick };
    let before = load();
    let is_watched = std::io::stderr().is_terminal();
    let results = run(extent, &arguments.only, arguments.peers.as_deref(), |what| {
        if is_watched {
            eprintln!("{what} …");
        }
    })?;
    if let Some(folder) = &arguments.plots {
        plots(&results.growth, folder)?;
    }
    if let Some(folder) = &arguments.record {
        record(&results, folder, &before)?;
    }
    match arguments.format {
        Format::Text => print(&format!("load {before} before, {} after\n{}", load(), text(&results))),
        Format::Json => print(&format!("{}\n", json(&results)?)),
    }
}

fn print(text: &str) -> Result<(), BenchError> {
    let written = std::io::stdout().write_all(text.as_bytes());
    written.map_err(|source| BenchError::Write { path: "standard output".into(), source })
}

fn record(results: &Results, folder: &Path, load_before: &str) -> Result<(), BenchError> {
    plots(&results.growth, &folder.join("performance"))?;
    let machine = format!(
        "{}; load average {load_before} before the run, {} after it (others work on the machine).",
        machine(),
        load()
    );
    let files = [
        (folder.join("performance/run.json"), format!("{}\n", json(results)?)),
        (folder.join("performance.md"), markdown(results, &machine)?),
    ];
    for (path, content) in files {
        std::fs::write(&path, content).map_err(|source| BenchError::Write { path, source })?;
    }
    Ok(())
}

/// A file of Linux, or nothing elsewhere.
fn told(path: &str) -> String {
    std::fs::read_to_string(path).unwrap_or_default()
}

/// How much the machine has to do, over 1, 5 and 15 minutes.
fn load() -> String {
    let told = told("/proc/loadavg");
    let numbers: Vec<&str> = told.split(' ').take(3).collect();
    if numbers.len() == 3 { numbers.join(", ") } else { "unknown".into() }
}

fn machine() -> String {
    let (processor, memory) = (told("/proc/cpuinfo"), told("/proc/meminfo"));
    let field = |text: &str, name: &str| {
        let line = text.lines().find(|line| line.starts_with(name));
        line.and_then(|line| line.split_once(':'))
            .map_or("unknown".into(), |(_, value)| value.trim().to_owned())
    };
    let cores = std::thread::available_parallelism().map_or(0, std::num::NonZero::get);
    format!(
        "{}, {cores} cores, {} of memory, {} {}",
        field(&processor, "model name"),
        field(&memory, "MemTotal"),
        std::env::consts::OS,
        std::env::consts::ARCH
    )
}
