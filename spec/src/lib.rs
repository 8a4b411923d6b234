//! Ties each clause of the specification to the code that keeps it and to what witnesses it.
//!
//! The clauses stand in `spec/*.md`, the tags in the crates of the workspace; `spec/README.md` says how both
//! are written. Not promised: that a witness tests what its clause says. That is for readers, whom the
//! matrix in `spec/MATRIX.md` leads there.

#![forbid(unsafe_code)]

mod clause;
mod fault;
mod id;
mod matrix;
mod region;
mod tag;
mod text;
mod trace;
mod workspace;

pub use clause::{Clause, Clauses, Marker, collect_clauses};
pub use fault::Fault;
pub use id::ClauseId;
pub use matrix::{MATRIX_PATH, matrix};
pub use region::{TestModules, test_lines};
pub use tag::{Tag, TagKind, tags_of};
pub use text::{CHAPTERS, chapters, clause_text};
pub use trace::{Trace, trace};
pub use workspace::{Inputs, ReadError, read_inputs};

/// A text file: its path from the workspace root, with `/`, and its contents.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Source {
    /// Its path.
    pub path: String,
    /// Its contents.
    pub text: String,
}

impl Source {
    /// A file in memory.
    pub fn new(path: &str, text: &str) -> Self {
        Self { path: path.into(), text: text.into() }
    }
}

/// A line of a file, counted from 1.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Place {
    /// The file.
    pub path: String,
    /// The line.
    pub line: usize,
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}:{}", self.path, self.line)
    }
}
