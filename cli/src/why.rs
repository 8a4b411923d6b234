//! `dsr why`: why a replica shows a thing as it does.

use crate::check::Format;
use crate::output::{err, out};
use crate::status::Status;
use crate::trace::{self, Refusal};
use dsr_model::why::{TargetError, WhyError, why};

const ABOUT: &str = "\
Runs a trace again up to a step, and tells why a replica then shows an element or an attribute as it does, or does not: \
every claim on it, who wrote it and when, which messages brought it here, which one is shown, what it beat and by which \
clause of the specification.";

const AFTER: &str = "\
ELEMENT is a name or an id of the trace: bed, r1.2, 'person -in-> bed', bed.level, '#1.x'.

Examples:
  dsr why dsr-traces/01-JOIN-3.trace.json 4 r2 bed.level
  dsr gallery --row 15 --traces gallery && dsr why gallery/row-15.trace.json 8 'agent 3' '#1.x'

Exit status: 0 answered, 1 the trace does not happen again as it is written, 3 wrong usage or input.";

/// Arguments of `dsr why`.
#[derive(clap::Args, Debug)]
#[command(about = "Explains what a replica of a trace shows", long_about = ABOUT, after_help = AFTER)]
pub(crate) struct Arguments {
    /// A trace file, or `-` for standard input
    file: String,
    /// After which step, from 1; 0 is the start
    step: usize,
    /// The replica's name
    replica: String,
    /// An element or an attribute, by name or id
    element: String,
    /// How the answer is printed
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

impl Arguments {
    pub(crate) fn run(&self) -> Status {
        let trace = match trace::read(&self.file) {
            Ok(trace) => trace,
            Err(refusal) => return self.refuse(&refusal),
        };
        match why(&trace, self.step, &self.replica, &self.element) {
            Ok(answer) => {
                out(&match self.format {
                    Format::Text => answer.to_string(),
                    Format::Json => serde_json::to_string_pretty(&answer).unwrap_or_default() + "\n",
                });
                Status::Claimed
            }
            Err(error) => {
                let remedy = match &error {
                    WhyError::Replay(_) => "see `dsr replay`: the file was changed, or the program was",
                    WhyError::NoStep { .. } => "count the steps from 1, as `dsr trace` prints them",
                    WhyError::NoReplica { .. } => "name one of these",
                    WhyError::Target(TargetError::Ambiguous { .. }) => "name one id",
                    WhyError::Target(_) => "name an element, or element.attribute, as `dsr trace` prints it",
                    WhyError::Nothing { .. } => "ask about a later step, or another element",
                };
                err(format_args!("{}: {error}\n  remedy: {remedy}", self.file));
                if matches!(error, WhyError::Replay(_)) { Status::Violated } else { Status::Usage }
            }
        }
    }

    fn refuse(&self, refusal: &Refusal) -> Status {
        err(format_args!("{}: {refusal}\n  remedy: {}", self.file, refusal.remedy()));
        Status::Usage
    }
}
