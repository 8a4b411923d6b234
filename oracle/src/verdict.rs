//! What a comparison has shown. `[spec: ORACLE-5]`

use serde::Serialize;
use std::fmt;

/// The verdict; that the program cannot be asked is none. `[spec: ORACLE-5]` `[spec: ORACLE-6]`
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Both say the same of everything that was asked.
    Agree,
    /// So they do, but something that had to occur never did.
    Vacuous,
    /// Of something they say different things.
    Disagree,
}

impl Verdict {
    /// The verdict on what was found.
    pub const fn of(disagrees: bool, vacuous: bool) -> Self {
        match (disagrees, vacuous) {
            (true, _) => Self::Disagree,
            (false, true) => Self::Vacuous,
            (false, false) => Self::Agree,
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Agree => "agree",
            Self::Vacuous => "vacuous",
            Self::Disagree => "disagree",
        })
    }
}
