//! Ties each clause of the specification to the code that keeps it and to what witnesses it, and says what else
//! speaks for it: theorems, the layers of the checker, samples, conformance cases.
//!
//! The clauses stand in `spec/*.md`, the tags in the crates of the workspace; `spec/README.md` says how both
//! are written. Not promised: that a witness tests what its clause says. That is for readers, whom the
//! matrix in `spec/MATRIX.md` leads there, and `docs/assurance.md` to everything else.

#![forbid(unsafe_code)]

mod assurance;
mod cases;
mod claim;
mod clause;
mod evidence;
mod fault;
mod gap;
mod generated;
mod id;
mod judged;
mod list;
mod matrix;
mod proof;
mod region;
mod table;
mod tag;
mod text;
mod trace;
mod witness;
mod workspace;

pub use assurance::{ASSURANCE_PATH, README_PATH, assurance, readme};
pub use cases::{CORPUS_PATH, Cases, count_cases};
pub use claim::{Claim, claims};
pub use clause::{Clause, Clauses, Marker, collect_clauses};
pub use evidence::{Documents, Evidence, Grade, Grounds, evidence};
pub use fault::Fault;
pub use gap::Gap;
pub use id::ClauseId;
pub use judged::{JUDGED_PATH, Layer, layers_of};
pub use matrix::{MATRIX_PATH, matrix};
pub use proof::{LEFT_OUT_PATH, LeftOut, THEOREMS_PATH, Theorem, left_out_of, theorems_of};
pub use region::{TestModules, test_lines};
pub use tag::{Tag, TagKind, tags_of};
pub use text::{CHAPTERS, chapters, clause_text};
pub use trace::{Trace, trace};
pub use witness::{WitnessKind, witness_kinds};
pub use workspace::{Inputs, ReadError, read_documents, read_file, read_inputs};

/// A text file: its path from the workspace root, with `/`, and its contents.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
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
