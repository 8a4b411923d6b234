//! Exit statuses, the same for every subcommand.

use std::process::ExitCode;

/// What `--help` says about exit statuses.
pub(crate) const HELP: &str = "\
Exit status:
  0  as claimed: sound, equal, done
  1  violated: a fault, a difference, a broken claim
  2  incomplete: a bound was reached before the answer
  3  wrong usage or input: arguments, or a file that cannot be read";

/// How a command ends. The greater of two statuses wins.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub(crate) enum Status {
    /// As claimed.
    #[default]
    Claimed = 0,
    /// Violated.
    Violated = 1,
    /// Incomplete: a bound was reached before the answer.
    Incomplete = 2,
    /// Wrong usage or input.
    Usage = 3,
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        Self::from(status as u8)
    }
}
