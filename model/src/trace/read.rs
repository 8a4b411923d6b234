//! Reading a trace back.

use super::{TRACE_VERSION, Trace};
use serde_json::Value;

/// The name of the format.
const FORMAT: &str = "dsr-trace";

/// Why a text is no trace. Lines and columns count from 1.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum TraceError {
    /// It is not JSON.
    #[error("line {line}, column {column}: not JSON: {what}")]
    Syntax {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// What is wrong.
        what: String,
    },
    /// It does not say that it is a trace.
    #[error("no trace: found no `format`, expected {FORMAT:?}")]
    NoFormat,
    /// It says that it is something else.
    #[error("no trace: found the format {found}, expected {FORMAT:?}")]
    OtherFormat {
        /// What it says, as JSON.
        found: String,
    },
    /// It is a trace of another version.
    #[error("found version {found} of the trace format, only version {TRACE_VERSION} is understood")]
    OtherVersion {
        /// What it says, as JSON.
        found: String,
    },
    /// It has not the form of a trace.
    #[error("line {line}, column {column}: not the form of a trace: {what}")]
    Form {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// What is wrong.
        what: String,
    },
}

impl Trace {
    /// Reads a trace. `[spec: TRACE-3]`
    pub fn read(text: &str) -> Result<Self, TraceError> {
        let value: Value = serde_json::from_str(text).map_err(|error| {
            let (line, column, what) = place(&error);
            TraceError::Syntax { line, column, what }
        })?;
        match value.get("format") {
            Some(Value::String(format)) if format == FORMAT => {}
            Some(found) => return Err(TraceError::OtherFormat { found: found.to_string() }),
            None => return Err(TraceError::NoFormat),
        }
        match value.get("version") {
            Some(found) if found.as_u64() == Some(u64::from(TRACE_VERSION)) => {}
            found => {
                return Err(TraceError::OtherVersion {
                    found: found.map_or("none".into(), Value::to_string),
                });
            }
        }
        serde_json::from_str(text).map_err(|error| {
            let (line, column, what) = place(&error);
            TraceError::Form { line, column, what }
        })
    }
}

/// An error's line, column and words.
fn place(error: &serde_json::Error) -> (usize, usize, String) {
    let (line, column) = (error.line(), error.column());
    let words = error.to_string();
    let tail = format!(" at line {line} column {column}");
    (line, column, words.strip_suffix(&tail).unwrap_or(&words).into())
}
