//! What can be wrong between text, code and witnesses.

use crate::{ClauseId, Place};
use std::fmt;

/// One fault, with where to look.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Fault {
    /// Bold text that starts like a clause and is none.
    MalformedClause {
        /// The text.
        text: String,
        /// Where.
        place: Place,
    },
    /// An id that is defined twice.
    Duplicate {
        /// The id.
        id: ClauseId,
        /// Where it was first.
        first: Place,
        /// Where it is again.
        second: Place,
    },
    /// A clause that cites an id which is not defined.
    UnknownCitation {
        /// The id cited.
        id: ClauseId,
        /// The clause that cites it.
        place: Place,
    },
    /// A derived clause that cites none.
    DerivedFromNothing {
        /// The clause.
        id: ClauseId,
        /// Where.
        place: Place,
    },
    /// A tag that cannot be read.
    MalformedTag {
        /// Its text.
        text: String,
        /// Where.
        place: Place,
    },
    /// A tag that names no clause.
    Stale {
        /// The id named.
        id: ClauseId,
        /// Where.
        place: Place,
    },
    /// A binding clause that no code cites.
    NoCode {
        /// The clause.
        id: ClauseId,
        /// Where it is defined.
        place: Place,
    },
    /// A binding clause that no test or property cites.
    NoWitness {
        /// The clause.
        id: ClauseId,
        /// Where it is defined.
        place: Place,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::MalformedClause { text, place } => {
                write!(
                    f,
                    "{place}: {text:?} starts like a clause, but is not `**ID.**` or `**ID (marker).**`"
                )
            }
            Self::Duplicate { id, first, second } => {
                write!(f, "{second}: {id} is defined already at {first}")
            }
            Self::UnknownCitation { id, place } => write!(f, "{place}: cites {id}, which is no clause"),
            Self::DerivedFromNothing { id, place } => {
                write!(f, "{place}: {id} is derived, but cites no clause that it follows from")
            }
            Self::MalformedTag { text, place } => {
                write!(f, "{place}: {text:?} is no tag: expected `[spec: JOIN-3]`")
            }
            Self::Stale { id, place } => write!(f, "{place}: the tag names {id}, which is no clause"),
            Self::NoCode { id, place } => write!(f, "{place}: no code cites {id}"),
            Self::NoWitness { id, place } => write!(f, "{place}: no test or property witnesses {id}"),
        }
    }
}
