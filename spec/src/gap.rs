//! What can be wrong with what is said of the evidence.

use crate::{ClauseId, Place};

/// One gap, with where to look and what to do.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, thiserror::Error)]
pub enum Gap {
    /// A row of a table with too few or too many cells.
    #[error("{place}: a row with {cells} cells where {expected} belong")]
    MalformedRow {
        /// Where.
        place: Place,
        /// How many it has.
        cells: usize,
        /// How many it should have.
        expected: usize,
    },
    /// A row of a table of theorems that names none.
    #[error("{place}: {text:?} names no theorem: expected `File.name` between backticks")]
    NoTheorem {
        /// The cell.
        text: String,
        /// Where.
        place: Place,
    },
    /// A theorem about nothing.
    #[error("{place}: {theorem} cites no clause: name those that it is about, or say `tool`")]
    NothingCited {
        /// The theorem.
        theorem: String,
        /// Where.
        place: Place,
    },
    /// What stands where clauses are listed.
    #[error("{place}: {text:?} is no clause and no range of clauses such as `WF-4 – WF-6`")]
    NoList {
        /// The text.
        text: String,
        /// Where.
        place: Place,
    },
    /// An id that no chapter defines.
    #[error("{place}: cites {id}, which is no clause")]
    UnknownClause {
        /// The id.
        id: ClauseId,
        /// Where.
        place: Place,
    },
    /// A file that is not what it should be.
    #[error("{path}: {why}")]
    Unreadable {
        /// The file.
        path: String,
        /// Why.
        why: String,
    },
    /// A file or folder that should have something.
    #[error("{path}: no {what} found")]
    Empty {
        /// Where.
        path: String,
        /// What is missing.
        what: &'static str,
    },
    /// A clause is said to be proved in part, and no theorem is about it.
    #[error(
        "{place}: {id} is said to be proved in part, but no theorem is about it: give the reason instead"
    )]
    NoPart {
        /// The clause.
        id: ClauseId,
        /// Where that is said.
        place: Place,
    },
    /// A reason for missing proofs where none is missing.
    #[error("{place}: theorems are about all of these clauses by now: take the row away")]
    StaleReason {
        /// Where.
        place: Place,
    },
    /// A clause without a theorem, and no reason is given.
    #[error("{place}: no theorem is about {id}, and spec/coq/coverage.md does not say why")]
    NoReason {
        /// The clause.
        id: ClauseId,
        /// Where it is defined.
        place: Place,
    },
    /// A clause that binds, and nothing at all speaks for it.
    #[error(
        "{place}: nothing speaks for {id}: no theorem, no layer of the checker, no test, no sample, no case"
    )]
    NoEvidence {
        /// The clause.
        id: ClauseId,
        /// Where it is defined.
        place: Place,
    },
    /// A claim that cites no clause.
    #[error("{place}: {id} names no clause that says it exactly")]
    EmptyClaim {
        /// The claim.
        id: ClauseId,
        /// Where it is defined.
        place: Place,
    },
    /// A file without the region that is to be written.
    #[error("{path}: no lines `{begin}` and `{end}`, in this order, to write between")]
    NoRegion {
        /// The file.
        path: String,
        /// The first line.
        begin: String,
        /// The last line.
        end: String,
    },
}
