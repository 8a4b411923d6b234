//! Which program is asked, and how.

use crate::output::err;
use dsr_oracle::program::{DEFAULT, FACTS, Start};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::Duration;

/// Arguments of all three comparisons.
#[derive(clap::Args, Debug)]
pub(super) struct Whom {
    /// The program that is asked; `spec/coq/check` builds it
    #[arg(long, default_value = DEFAULT)]
    program: String,
    /// An argument of the program, before its own; may be given several times
    #[arg(long, value_name = "ARGUMENT")]
    argument: Vec<String>,
    /// How many programs at once; each uses one core
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: u16,
    /// How long one answer may take, in seconds
    #[arg(long, default_value_t = 60, value_parser = clap::value_parser!(u64).range(1..))]
    patience: u64,
    /// How the result is printed
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(super) format: Format,
}

/// How a result is printed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub(super) enum Format {
    /// For people
    Text,
    /// One JSON object
    Json,
}

impl Whom {
    /// The program as an adapter.
    pub(super) fn adapter(&self) -> Start {
        let start = Start::new(&self.program);
        let start = self.argument.iter().fold(start, Start::with);
        Start { patience: Duration::from_secs(self.patience), ..start }
    }

    /// The program as a server of facts.
    pub(super) fn facts(&self) -> Start {
        self.adapter().with(FACTS)
    }

    pub(super) fn jobs(&self) -> usize {
        self.jobs.into()
    }

    /// The options that make the same program be asked again.
    pub(super) fn options(&self) -> String {
        let mut options = String::new();
        if self.program != DEFAULT {
            options = format!(" --program {}", self.program);
        }
        self.argument.iter().fold(options, |options, argument| format!("{options} --argument {argument}"))
    }
}

/// How far long work is, on a terminal.
pub(super) fn bar(count: u64, of: &'static str) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let template = format!("{{wide_bar}} {{pos}}/{{len}} {of} · {{per_sec}} · {{eta}} left");
    let style = ProgressStyle::with_template(&template).unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(count).with_style(style)
}

/// A line for whoever waits where there is no terminal.
pub(super) fn mention(line: &str) {
    err(line);
}
