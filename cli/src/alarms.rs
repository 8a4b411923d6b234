//! `dsr alarms`: cores broken on purpose, and which layer of the checker finds each.

use crate::check::Format;
use crate::output::{err, out};
use crate::status::Status;
use dsr_model::alarms;

const ABOUT: &str = "\
A checker that finds nothing is believed only if it would have found something. Each alarm is the production core with \
one flaw; the layers are tried in turn at growing bounds. The core without a flaw goes through the same layers, and \
nothing may be found there.";

const STATUS: &str = "\
Exit status: 0 every flaw was found and nothing else, 1 a flaw was missed or the sound core was accused,
3 wrong usage";

/// Arguments of `dsr alarms`.
#[derive(clap::Args, Debug)]
#[command(about = "Runs cores broken on purpose: every one must be found", long_about = ABOUT, after_help = STATUS)]
pub(crate) struct Arguments {
    /// How the result is printed
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Tries every layer on every alarm, not only until one finds it
    #[arg(long)]
    all_layers: bool,
}

impl Arguments {
    pub(crate) fn run(&self) -> Status {
        err("running every alarm; this takes some seconds");
        let report = alarms::report(self.all_layers);
        match self.format {
            Format::Text => out(&report.to_string()),
            Format::Json => out(&format!("{}\n", serde_json::to_string_pretty(&report).unwrap_or_default())),
        }
        if report.is_good() { Status::Claimed } else { Status::Violated }
    }
}
