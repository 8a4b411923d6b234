//! What can go wrong while measuring.

use std::path::PathBuf;

/// Why a measurement has no result.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// The core refuses a mutation.
    #[error("dsr refuses: {0}")]
    Mutation(#[from] dsr_core::MutationError),
    /// The core refuses bytes.
    #[error("dsr cannot decode: {0}")]
    Decode(#[from] dsr_core::DecodeError),
    /// automerge refuses.
    #[error("automerge: {0}")]
    Automerge(#[from] automerge::AutomergeError),
    /// loro refuses.
    #[error("loro: {0}")]
    Loro(#[from] loro::LoroError),
    /// loro cannot encode.
    #[error("loro cannot encode: {0}")]
    LoroEncode(#[from] loro::LoroEncodeError),
    /// yrs refuses bytes.
    #[error("yrs cannot decode: {0}")]
    YrsDecode(#[from] yrs::encoding::read::Error),
    /// yrs refuses an update.
    #[error("yrs: {0}")]
    Yrs(#[from] yrs::error::UpdateError),
    /// An operation of crdts has no bytes, or bytes are none.
    #[error("postcard: {0}")]
    Postcard(#[from] postcard::Error),
    /// A delta of dson has no bytes.
    #[error("MessagePack: {0}")]
    MessagePack(#[from] rmp_serde::encode::Error),
    /// Bytes are no delta of dson.
    #[error("MessagePack cannot decode: {0}")]
    MessagePackDecode(#[from] rmp_serde::decode::Error),
    /// A library has not done what was asked.
    #[error("{library}: {what}; it did something else, and cannot be compared")]
    NotTheJob {
        /// Which library.
        library: &'static str,
        /// What it should have done.
        what: String,
    },
    /// A file cannot be written.
    #[error("cannot write {path}: {source}; check that the folder exists and may be written to")]
    Write {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A plot cannot be drawn.
    #[error("cannot draw: {0}")]
    Plot(String),
    /// A result is no JSON.
    #[error("cannot write JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// No question is meant.
    #[error("no question matches {pattern:?}; --list prints all of them")]
    NoQuestion {
        /// What was asked for.
        pattern: String,
    },
    /// The checker has no run to measure.
    #[error("the checker cannot be measured: {0}")]
    Checker(String),
}

/// A result of measuring.
pub type Result<T> = std::result::Result<T, BenchError>;

/// Says that a library has not done what was asked.
pub fn not_the_job<T>(library: &'static str, what: impl Into<String>) -> Result<T> {
    Err(BenchError::NotTheJob { library, what: what.into() })
}
