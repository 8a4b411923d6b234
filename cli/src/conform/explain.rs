//! `dsr conform explain`.

use super::chosen::case;
use super::error::ConformError;
use crate::output::out;
use crate::status::Status;
use dsr_conformance::render::{explain, mermaid};

const AFTER: &str = "\
Examples:
  dsr conform explain universal/delivery/twice
  dsr conform explain universal/delivery/twice --to mermaid";

/// Explains a case: why it is there, its steps as a diagram, what is expected, its clauses in full
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// The case
    id: String,
    /// How to print it
    #[arg(long, value_enum, default_value_t = Form::Text)]
    to: Form,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
enum Form {
    /// For people
    Text,
    /// A sequence diagram in the language of Mermaid
    Mermaid,
    /// The case as it is in the corpus
    Json,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, ConformError> {
        let case = case(&self.id)?;
        match self.to {
            Form::Text => out(&explain(&case)),
            Form::Mermaid => out(&mermaid(&case)),
            Form::Json => out(&(serde_json::to_string_pretty(&case)? + "\n")),
        }
        Ok(Status::Claimed)
    }
}
