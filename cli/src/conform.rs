//! `dsr conform`: the corpus of conformance cases, against any adapter.

mod new_adapter;

use crate::output::{add, err, out};
use crate::status::Status;
use dsr_conformance::adapter::Core;
use dsr_conformance::case::{Case, CaseError, Level};
use dsr_conformance::corpus;
use dsr_conformance::report::{Outcome, Report, Verdict};
use dsr_conformance::run::{ChildLimits, InProcess, Open, Program, run};
use dsr_conformance::serve::serve;
use std::time::Duration;

const ABOUT: &str = "\
Runs the conformance cases against an implementation. An implementation takes part by an adapter: a program that reads one \
request a line and writes one reply a line, as the chapter spec/conformance.md says. Without a command, the core of this \
program is asked twice: in the same process, and as a child process over pipes.";

const AFTER: &str = "\
Examples:
  dsr conform
  dsr conform run -- python3 adapter.py
  dsr conform run --only 'universal/*' --format json -- ./adapter
  dsr conform list --only '*/refusals/*'
  dsr conform new-adapter --lang python --to my-adapter
  echo '{\"id\":1,\"do\":{\"hello\":{\"protocols\":[1],\"spec\":\"0.1\",\"corpus\":\"1.0.0\"}}}' | dsr conform adapter

Exit status: 0 as expected, 1 a case that is a MUST is not, 2 a case was skipped or not run, or none passed, 3 wrong usage.";

/// Arguments of `dsr conform`.
#[derive(clap::Args, Debug)]
#[command(about = "Runs conformance cases against an implementation", long_about = ABOUT, after_help = AFTER)]
#[command(args_conflicts_with_subcommands = true)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    choice: Choice,
    #[command(flatten)]
    printed: Printed,
}

#[derive(clap::Subcommand, Debug)]
enum Command {
    /// Runs the cases against an adapter
    Run {
        #[command(flatten)]
        choice: Choice,
        #[command(flatten)]
        printed: Printed,
        /// The most seconds for one reply
        #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..=3600))]
        seconds_max: u64,
        /// The adapter: a program and its arguments
        #[arg(last = true, required = true)]
        command: Vec<String>,
    },
    /// Lists the cases
    List {
        #[command(flatten)]
        choice: Choice,
    },
    /// Writes an adapter to start from, with a small implementation inside
    NewAdapter(new_adapter::Arguments),
    /// Is an adapter of this program's core, on standard input and output
    Adapter,
}

#[derive(clap::Args, Debug)]
struct Choice {
    /// Only cases whose id matches; `*` stands for any characters
    #[arg(long, value_name = "GLOB", default_value = "*")]
    only: String,
}

#[derive(clap::Args, Debug)]
struct Printed {
    /// How to print what came of it
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
enum Format {
    /// For people
    Text,
    /// One line of JSON for each run
    Json,
}

/// Why nothing can be run.
#[derive(Debug, thiserror::Error)]
enum ConformError {
    #[error("{0}")]
    Corpus(#[from] CaseError),
    #[error("no case matches {only:?}\n  remedy: see `dsr conform list`")]
    NoCase { only: String },
    #[error("this program does not find itself: {0}\n  remedy: run `dsr conform run -- dsr conform adapter`")]
    Myself(std::io::Error),
    #[error("the summary cannot be written: {0}\n  remedy: use --format text")]
    Summary(serde_json::Error),
}

impl Arguments {
    /// `[spec: CONF-10]`
    pub(crate) fn run(&self) -> Status {
        let ended = match &self.command {
            None => on_the_core(&self.choice, self.printed.format),
            Some(Command::Run { choice, printed, seconds_max, command }) => {
                let limits =
                    ChildLimits { reply: Duration::from_secs(*seconds_max), ..ChildLimits::default() };
                let mut program = Program { command: command.clone(), limits };
                choice
                    .cases()
                    .and_then(|cases| shown(&mut program, &cases, printed.format, &command.join(" ")))
            }
            Some(Command::List { choice }) => choice.cases().map(|cases| list(&cases)),
            Some(Command::NewAdapter(arguments)) => return arguments.run(),
            Some(Command::Adapter) => return adapter(),
        };
        ended.unwrap_or_else(|error| {
            err(error);
            Status::Usage
        })
    }
}

impl Choice {
    fn cases(&self) -> Result<Vec<Case>, ConformError> {
        let cases = corpus::cases()?.into_iter().filter(|case| corpus::matches(&self.only, &case.id));
        let cases: Vec<Case> = cases.collect();
        if cases.is_empty() { Err(ConformError::NoCase { only: self.only.clone() }) } else { Ok(cases) }
    }
}

fn adapter() -> Status {
    match serve(&mut Core::default(), std::io::stdin().lock(), std::io::stdout().lock()) {
        Ok(()) => Status::Claimed,
        Err(error) => {
            err(error);
            Status::Usage
        }
    }
}

/// In-process and as a child.
fn on_the_core(choice: &Choice, format: Format) -> Result<Status, ConformError> {
    let cases = choice.cases()?;
    let here = shown(&mut InProcess(Core::default), &cases, format, "the core, in-process")?;
    let myself = std::env::current_exe().map_err(ConformError::Myself)?;
    let command = vec![myself.to_string_lossy().into_owned(), "conform".into(), "adapter".into()];
    let mut program = Program { command, limits: ChildLimits::default() };
    Ok(here.max(shown(&mut program, &cases, format, "the core, over pipes")?))
}

/// Runs and prints.
fn shown(open: &mut dyn Open, cases: &[Case], format: Format, whom: &str) -> Result<Status, ConformError> {
    let report = run(open, cases);
    match format {
        Format::Text => out(&text(&report, whom)),
        Format::Json => {
            let line = serde_json::to_string(&report.summary()).map_err(ConformError::Summary)?;
            out(&(line + "\n"));
        }
    }
    Ok(match report.outcome() {
        Outcome::Expected => Status::Claimed,
        Outcome::Unexpected => Status::Violated,
        Outcome::Incomplete => Status::Incomplete,
    })
}

/// What is not a pass, then the counts.
fn text(report: &Report, whom: &str) -> String {
    let mut text = String::new();
    for result in report.results.iter().filter(|result| result.verdict != Verdict::Pass) {
        add(
            &mut text,
            format_args!("{} {} [{}]\n", result.verdict.name(), result.id, result.spec.join(", ")),
        );
        if result.failure.step > 0 {
            add(&mut text, format_args!("    step {}\n", result.failure.step));
        }
        for line in result.failure.to_string().lines() {
            add(&mut text, format_args!("    {}\n", safe(line)));
        }
    }
    let named = report.implementation.as_ref().map_or_else(
        || "it never said what it is".to_owned(),
        |implementation| format!("{:?} {:?}", implementation.name, implementation.version),
    );
    add(&mut text, format_args!("{whom} ({named}): "));
    let counts = Verdict::ALL.map(|verdict| (verdict.name(), report.count(verdict)));
    let not_run = [("not run", report.wanted - report.results.len())];
    let counts = counts.iter().chain(&not_run).filter(|(_, count)| *count > 0);
    let counts: Vec<String> = counts.map(|(name, count)| format!("{count} {name}")).collect();
    add(&mut text, format_args!("{}\n", counts.join(", ")));
    text
}

/// A line from an adapter, without what could upset a terminal.
fn safe(line: &str) -> String {
    let keeps = |character| matches!(character, '"' | '\'' | '\\');
    let pieces = line.chars().map(|character| {
        if keeps(character) { character.to_string() } else { character.escape_debug().to_string() }
    });
    pieces.collect()
}

fn list(cases: &[Case]) -> Status {
    let mut text = String::new();
    for case in cases {
        let level = match case.level {
            Level::Must => "must",
            Level::Should => "should",
            Level::May => "may",
        };
        add(&mut text, format_args!("{:<44} {level:<6} {}\n", case.id, case.title));
    }
    out(&text);
    Status::Claimed
}
