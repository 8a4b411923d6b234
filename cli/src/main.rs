//! The `dsr` command: checks, shows and converts Deep State Representation graphs.

mod alarms;
mod check;
mod conform;
mod gallery;
mod input;
mod oracle;
mod output;
mod page;
mod replay;
mod scene;
mod status;
mod trace;
mod why;

use clap::{Parser, Subcommand};
use status::Status;
use std::process::ExitCode;

/// The checker allocates small maps by the million; this halves its time.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Checks, shows and converts Deep State Representation graphs.
#[derive(Parser, Debug)]
#[command(name = "dsr", version, after_help = status::HELP, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

// One line per subcommand, in the order of `--help`; each has its own module of that name.
#[derive(Subcommand, Debug)]
enum Command {
    Check(check::Arguments),
    Alarms(alarms::Arguments),
    Conform(conform::Arguments),
    Oracle(oracle::Arguments),
    Gallery(gallery::Arguments),
    Trace(trace::Arguments),
    Replay(replay::Arguments),
    Why(why::Arguments),
    /// Checks, shows, converts and compares scenes: graph files of the published system
    #[command(subcommand)]
    Scene(scene::Command),
}

impl Command {
    fn run(&self) -> Status {
        match self {
            Self::Check(arguments) => arguments.run(),
            Self::Alarms(arguments) => arguments.run(),
            Self::Conform(arguments) => arguments.run(),
            Self::Oracle(arguments) => arguments.run(),
            Self::Gallery(arguments) => arguments.run(),
            Self::Trace(arguments) => arguments.run(),
            Self::Replay(arguments) => arguments.run(),
            Self::Why(arguments) => arguments.run(),
            Self::Scene(command) => command.run(),
        }
    }
}

fn main() -> ExitCode {
    match Arguments::try_parse() {
        Ok(arguments) => arguments.command.run().into(),
        Err(error) => {
            // Help and version go to standard output and are no errors. Nothing is left to say if this fails.
            let _ = error.print();
            if error.use_stderr() { Status::Usage.into() } else { Status::Claimed.into() }
        }
    }
}
