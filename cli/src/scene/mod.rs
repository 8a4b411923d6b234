//! `dsr scene`: one module per subcommand.

mod check;
mod convert;
mod diff;
mod dot;
mod names;
mod report;
mod show;

use crate::input::{self, InputError, Loaded};
use crate::status::Status;
use clap::{Args, Subcommand};
use dsr_core::Dictionary;
use dsr_core::scene::Strictness;

const AFTER: &str = "\
Lengths are in the units of the file: millimetres in files of the published system, metres in @flat and @tiny. \
Angles are in radians. FILE may also be a state, as JSON or binary.

Exit status: 0 printed, 3 otherwise. Scenes are limited to 64 MiB, states to 1 GiB.";

/// The subcommands of `dsr scene`.
#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    /// Says whether scenes are sound, and names every fault
    #[command(after_help = check::AFTER)]
    Check(check::Arguments),
    /// Prints the kinematic tree with poses, the other edges, and attributes
    #[command(after_help = AFTER)]
    Show(show::Arguments),
    /// Converts between scene files and states
    #[command(after_help = convert::AFTER)]
    Convert(convert::Arguments),
    /// Lists the differences between two graphs
    #[command(after_help = diff::AFTER)]
    Diff(diff::Arguments),
    /// Prints the graph for Graphviz: dsr scene dot FILE | dot -Tsvg
    #[command(after_help = AFTER)]
    Dot(dot::Arguments),
}

/// How a file is read, for every subcommand.
#[derive(Args, Debug)]
pub(crate) struct Reading {
    /// The names that a scene may use: `open` (any), `published`, `aal`, or a dictionary file
    #[arg(long, value_name = "NAME|FILE", default_value = "open")]
    dictionary: String,
    /// Drop what is broken, and list it on standard error
    #[arg(long)]
    lenient: bool,
}

impl Reading {
    /// The dictionary; a fault is told.
    fn dictionary(&self) -> Result<Dictionary, Status> {
        input::dictionary(&self.dictionary).map_err(|error| report::unusable(&self.dictionary, &error))
    }

    fn load(&self, file: &str, dictionary: &Dictionary) -> Result<Loaded, InputError> {
        let strictness = if self.lenient { Strictness::Lenient } else { Strictness::Strict };
        input::load(file, dictionary, strictness)
    }

    /// The graph in a file; what was dropped and what is wrong is told.
    fn load_or_tell(&self, file: &str, dictionary: &Dictionary) -> Result<Loaded, Status> {
        let loaded = self.load(file, dictionary).map_err(|error| report::unusable(file, &error))?;
        report::dropped(file, &loaded.dropped);
        Ok(loaded)
    }
}

impl Command {
    pub(crate) fn run(&self) -> Status {
        let outcome = match self {
            Self::Check(arguments) => check::run(arguments),
            Self::Show(arguments) => show::run(arguments),
            Self::Convert(arguments) => convert::run(arguments),
            Self::Diff(arguments) => diff::run(arguments),
            Self::Dot(arguments) => dot::run(arguments),
        };
        outcome.unwrap_or_else(|status| status)
    }
}
