//! Which cases, against what, and how it is printed: arguments that subcommands share.

use super::error::ConformError;
use dsr_conformance::case::Case;
use dsr_conformance::corpus::{self, Filter};
use dsr_conformance::protocol::Profile;
use dsr_conformance::run::{ChildLimits, Program};
use std::time::Duration;

#[derive(clap::Args, Debug)]
pub(super) struct Choice {
    /// Only cases whose id matches; `*` stands for any characters
    #[arg(long, value_name = "GLOB", default_value = "*")]
    pub(super) only: String,
    /// Only cases up to this depth; without it, all that the adapter announces
    #[arg(long, value_enum)]
    pub(super) profile: Option<Depth>,
}

/// How deep cases look.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub(super) enum Depth {
    /// At graphs alone
    Observe,
    /// Also at dots and contexts
    Causal,
    /// Also at bytes
    Wire,
}

#[derive(clap::Args, Debug)]
pub(super) struct Printed {
    /// How to print what came of it
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(super) format: Format,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub(super) enum Format {
    /// For people
    Text,
    /// For programs
    Json,
}

#[derive(clap::Args, Debug)]
pub(super) struct Command {
    #[command(flatten)]
    patience: Patience,
    /// The adapter: a program and its arguments
    #[arg(last = true, required = true)]
    pub(super) command: Vec<String>,
}

/// How long an adapter is waited for.
#[derive(clap::Args, Clone, Copy, Debug)]
pub(super) struct Patience {
    /// The most seconds for one reply
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..=3600))]
    seconds_max: u64,
}

impl From<Depth> for Profile {
    fn from(depth: Depth) -> Self {
        match depth {
            Depth::Observe => Self::Observe,
            Depth::Causal => Self::Causal,
            Depth::Wire => Self::Wire,
        }
    }
}

impl Choice {
    pub(super) fn profile(&self) -> Option<Profile> {
        self.profile.map(Profile::from)
    }

    pub(super) fn cases(&self) -> Result<Vec<Case>, ConformError> {
        self.citing(None)
    }

    pub(super) fn citing(&self, clause: Option<&str>) -> Result<Vec<Case>, ConformError> {
        let filter =
            Filter { only: self.only.clone(), profile: self.profile(), clause: clause.map(String::from) };
        let all = corpus::cases()?;
        let cases: Vec<Case> = all.iter().filter(|case| filter.takes(case)).cloned().collect();
        if cases.is_empty() { Err(none(&self.only, &all)) } else { Ok(cases) }
    }
}

impl Command {
    pub(super) fn program(&self) -> Program {
        self.patience.program(&self.command)
    }
}

impl Patience {
    pub(super) fn program(self, command: &[String]) -> Program {
        let limits = ChildLimits { reply: Duration::from_secs(self.seconds_max), ..ChildLimits::default() };
        Program { command: command.to_vec(), limits }
    }
}

/// The case of an id.
pub(super) fn case(id: &str) -> Result<Case, ConformError> {
    let all = corpus::cases()?;
    let found = all.iter().find(|case| case.id == id).cloned();
    found.ok_or_else(|| none(id, &all))
}

/// The ids of the whole corpus.
pub(super) fn ids() -> Result<Vec<String>, ConformError> {
    Ok(corpus::cases()?.into_iter().map(|case| case.id).collect())
}

fn none(only: &str, all: &[Case]) -> ConformError {
    let similar = corpus::similar(only, all.iter().map(|case| case.id.as_str()));
    ConformError::NoCase { only: only.into(), similar: similar.into_iter().map(String::from).collect() }
}
