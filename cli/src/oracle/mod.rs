//! `dsr oracle`: the core beside a program that answers from the machine-checked model.

mod corpus;
mod histories;
mod random;
mod whom;

use crate::output::err;
use crate::status::Status;
use dsr_oracle::program::Trouble;
use dsr_oracle::verdict::Verdict;

const ABOUT: &str = "\
Asks the core and a program the same questions, state by state. The program is extracted from the Coq development in \
spec/coq, which proves what the specification claims of its model; `spec/coq/check` builds it. What both are asked, and what \
counts as a disagreement, is the chapter spec/oracle.md. A disagreement is shown with the shortest history that leads to it.";

const AFTER: &str = "\
Examples:
  dsr oracle histories                               every canonical history of L1, five minutes
  dsr oracle histories --extent small                the same at smaller bounds, seconds
  dsr oracle random --histories 1000000 --seed 1     random histories of hostile shape
  dsr oracle random --seed 1 --only 4711             one of them, again
  dsr oracle corpus                                  the conformance corpus, twice
  dsr oracle corpus --format json

Exit status: 0 agree, 1 disagree, 2 something that had to occur never did, 3 the program cannot be asked";

/// Arguments of `dsr oracle`.
#[derive(clap::Args, Debug)]
#[command(about = "Compares the core with a program from the machine-checked model", long_about = ABOUT, after_help = AFTER)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

// One line per subcommand, in the order of `--help`; each has its own module.
#[derive(clap::Subcommand, Debug)]
enum Command {
    Histories(histories::Arguments),
    Random(random::Arguments),
    Corpus(corpus::Arguments),
}

/// Why nothing can be compared. Exit status 3.
#[derive(Debug, thiserror::Error)]
enum OracleError {
    #[error("{0}")]
    Program(#[from] Trouble),
    #[error("{0}")]
    Histories(#[from] dsr_oracle::histories::NoHistories),
    #[error("{0}")]
    Corpus(#[from] dsr_conformance::case::CaseError),
}

impl Arguments {
    /// `[spec: ORACLE-5]` `[spec: ORACLE-6]`
    pub(crate) fn run(&self) -> Status {
        let ended = match &self.command {
            Command::Histories(arguments) => arguments.run(),
            Command::Random(arguments) => arguments.run(),
            Command::Corpus(arguments) => arguments.run(),
        };
        match ended {
            Ok(Verdict::Agree) => Status::Claimed,
            Ok(Verdict::Disagree) => Status::Violated,
            Ok(Verdict::Vacuous) => Status::Incomplete,
            Err(error) => {
                err(error);
                Status::Usage
            }
        }
    }
}
