//! `dsr conform`: the corpus of conformance cases, against any adapter.

mod chosen;
mod compare;
mod error;
mod expect;
mod explain;
mod kernel;
mod list;
mod look;
mod new_adapter;
mod replay;
mod report;
mod run;
mod score;
mod smoke;
mod validate;

use crate::output::err;
use crate::status::Status;

const ABOUT: &str = "\
Runs the conformance cases against an implementation. An implementation takes part by an adapter: a program that reads one \
request a line and writes one reply a line, as the chapter spec/conformance.md says. Without a command, the core of this \
program is asked twice: in the same process, and as a child process over pipes.";

const AFTER: &str = "\
Examples:
  dsr conform
  dsr conform smoke -- python3 adapter.py
  dsr conform run --log run.ndjson -- python3 adapter.py
  dsr conform run --only 'universal/*' --format json -- ./adapter
  dsr conform explain universal/delivery/twice
  dsr conform new-adapter --lang python --to my-adapter
  dsr conform report run.ndjson --to html > report.html

Exit status: 0 as expected, 1 a case that is a MUST is not, 2 a case was skipped or not run, or none passed, 3 wrong usage.";

/// Arguments of `dsr conform`.
#[derive(clap::Args, Debug)]
#[command(about = "Runs conformance cases against an implementation", long_about = ABOUT, after_help = AFTER)]
#[command(args_conflicts_with_subcommands = true)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    on_the_core: kernel::OnTheCore,
}

// One line per subcommand, in the order of `--help`; each has its own module.
#[derive(clap::Subcommand, Debug)]
enum Command {
    Run(run::Arguments),
    Smoke(smoke::Arguments),
    List(list::Arguments),
    Explain(explain::Arguments),
    Replay(replay::Arguments),
    Expect(expect::Arguments),
    Report(report::Arguments),
    Compare(compare::Arguments),
    Validate(validate::Arguments),
    Score(score::Arguments),
    /// Writes an adapter to start from, with a small implementation inside
    NewAdapter(new_adapter::NewAdapter),
    /// Is an adapter of this program's core, on standard input and output
    Adapter,
}

impl Arguments {
    /// `[spec: CONF-10]`
    pub(crate) fn run(&self) -> Status {
        let ended = match &self.command {
            None => self.on_the_core.run(),
            Some(Command::Run(arguments)) => arguments.run(),
            Some(Command::Smoke(arguments)) => arguments.run(),
            Some(Command::List(arguments)) => arguments.run(),
            Some(Command::Explain(arguments)) => arguments.run(),
            Some(Command::Replay(arguments)) => arguments.run(),
            Some(Command::Expect(arguments)) => arguments.run(),
            Some(Command::Report(arguments)) => arguments.run(),
            Some(Command::Compare(arguments)) => arguments.run(),
            Some(Command::Validate(arguments)) => arguments.run(),
            Some(Command::Score(arguments)) => arguments.run(),
            Some(Command::NewAdapter(arguments)) => return arguments.run(),
            Some(Command::Adapter) => kernel::adapter(),
        };
        ended.unwrap_or_else(|error| {
            err(error);
            Status::Usage
        })
    }
}
