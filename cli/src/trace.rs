//! `dsr trace`: counterexamples for people.

use crate::input::{self, InputError};
use crate::output::{err, out};
use crate::status::Status;
use dsr_explorer::{Content, Origin, PageError, Shown};
use dsr_model::render::{self, RenderError};
use dsr_model::trace::{Trace, TraceError};
use std::path::PathBuf;

const ABOUT: &str = "\
When `dsr check` finds a broken clause, it writes the shortest way there to a trace file (into dsr-traces, or where \
--traces says). This prints such a file as a diagram: replicas side by side, time downwards, an arrow for each message \
that arrives, and what breaks at the end.";

const AFTER: &str = r"Examples:
  dsr trace dsr-traces/01-JOIN-3.trace.json                               in the terminal
  dsr trace dsr-traces/01-JOIN-3.trace.json --to svg --output join-3.svg  a drawing
  dsr trace dsr-traces/01-JOIN-3.trace.json --to rust --output join_3.rs  a test that replays it
  dsr trace dsr-traces/01-JOIN-3.trace.json --to html --output join-3.html  step by step, in a browser

For ShiViz (https://bestchai.bitbucket.io/shiviz/), paste the log and this regular expression:
  (?<event>.*)\n(?<host>\S*) (?<clock>\{.*\})

Exit status: 0 printed, 3 otherwise. Traces are limited to 64 MiB.";

/// The most bytes of a trace.
const BYTES_MAX: usize = 64 << 20;

/// Arguments of `dsr trace`.
#[derive(clap::Args, Debug)]
#[command(about = "Draws a counterexample that `dsr check` has written", long_about = ABOUT, after_help = AFTER)]
pub(crate) struct Arguments {
    /// A trace file, or `-` for standard input
    file: String,
    /// What it is drawn as
    #[arg(long, value_enum, default_value_t = Target::Text)]
    to: Target,
    /// The file to write, instead of standard output
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// What a trace is drawn as.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
enum Target {
    /// A diagram for the terminal
    Text,
    /// A sequence diagram for Mermaid, as in Markdown on many sites
    Mermaid,
    /// A drawing for a browser
    Svg,
    /// A page for a browser that steps through the trace
    Html,
    #[value(help = "A log with vector clocks for ShiViz")]
    Shiviz,
    /// A test in Rust that replays it
    Rust,
}

impl Target {
    fn of(self, trace: Trace) -> Result<String, Refusal> {
        let target = match self {
            Self::Html => return Ok(dsr_explorer::page(&alone(trace))?),
            Self::Text => render::Target::Text,
            Self::Mermaid => render::Target::Mermaid,
            Self::Svg => render::Target::Svg,
            Self::Shiviz => render::Target::Shiviz,
            Self::Rust => render::Target::Rust,
        };
        Ok(render::render(&trace, target)?)
    }
}

fn alone(trace: Trace) -> Content {
    let title = trace.title.clone();
    Content { title, report: None, gallery: None, traces: vec![Shown { trace, origin: Origin::Alone }] }
}

/// Why a trace is not read or drawn.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Refusal {
    #[error(transparent)]
    Input(#[from] InputError),
    #[error(transparent)]
    Trace(#[from] TraceError),
    #[error(transparent)]
    Render(#[from] RenderError),
    #[error(transparent)]
    Page(#[from] PageError),
}

impl Refusal {
    pub(crate) fn remedy(&self) -> &'static str {
        match self {
            Self::Input(InputError::TooLarge { .. }) => "check that it is a trace file",
            Self::Input(error) => error.remedy(),
            Self::Trace(TraceError::Syntax { .. }) => {
                "check that the file is complete, or run `dsr check` again"
            }
            Self::Trace(TraceError::NoFormat | TraceError::OtherFormat { .. }) => {
                "give a trace file of `dsr check` or `dsr gallery`; L0 finds states, not runs, and writes those"
            }
            Self::Trace(TraceError::OtherVersion { .. }) => {
                "use the version of dsr that wrote the file, or run `dsr check` again"
            }
            Self::Render(RenderError::TooWide { .. }) => "use --to svg",
            Self::Trace(TraceError::Form { .. } | TraceError::Unsound(_))
            | Self::Render(_)
            | Self::Page(_) => {
                "correct the file (TRACE-1 in spec/trace.md has the form), or run `dsr check` again"
            }
        }
    }
}

impl Arguments {
    pub(crate) fn run(&self) -> Status {
        let rendered = match self.rendered() {
            Ok(rendered) => rendered,
            Err(refusal) => {
                err(format_args!("{}: {refusal}\n  remedy: {}", self.file, refusal.remedy()));
                return Status::Usage;
            }
        };
        let Some(path) = &self.output else {
            out(&rendered);
            return Status::Claimed;
        };
        if let Err(error) = std::fs::write(path, rendered) {
            let path = path.display();
            err(format_args!(
                "{path}: cannot write: {error}\n  remedy: check the path, the permissions and the space"
            ));
            return Status::Usage;
        }
        Status::Claimed
    }

    fn rendered(&self) -> Result<String, Refusal> {
        self.to.of(read(&self.file)?)
    }
}

/// Reads a trace that need not fit together.
pub(crate) fn read_form(file: &str) -> Result<Trace, Refusal> {
    Ok(Trace::read_form(&input::text(file, BYTES_MAX, "trace")?)?)
}

/// Reads a trace.
pub(crate) fn read(file: &str) -> Result<Trace, Refusal> {
    Ok(Trace::read(&input::text(file, BYTES_MAX, "trace")?)?)
}
