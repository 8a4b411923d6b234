//! Reading a trace back.

use super::{FORMAT, TRACE_VERSION, Trace, senders};
use crate::graph::ChangeError;
use serde_json::Value;
use std::collections::BTreeSet;

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
    /// It has the form, and cannot be.
    #[error(transparent)]
    Unsound(#[from] Unsound),
}

/// Why a trace cannot be. Steps count from 1. `[spec: TRACE-3]`
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Unsound {
    /// There is nobody in it.
    #[error("the trace names no replicas")]
    NoReplicas,
    /// A name stands for two replicas.
    #[error("two replicas are named {name:?}")]
    TwoReplicas {
        /// The name.
        name: String,
    },
    /// A step of, or an answer to, nobody.
    #[error("step {step} names the replica {replica:?}, which the trace does not list")]
    Replica {
        /// Which step.
        step: usize,
        /// The name.
        replica: String,
    },
    /// The finding names somebody else.
    #[error("the finding names the replica {replica:?}, which the trace does not list")]
    FoundAt {
        /// The name.
        replica: String,
    },
    /// A delivery from nowhere.
    #[error("step {step} speaks of the message {message:?}, which no step before it sends")]
    Message {
        /// Which step.
        step: usize,
        /// The message.
        message: String,
    },
    /// A message that could come from either of two steps.
    #[error("step {second} sends the message {message:?}, which step {first} has sent already")]
    SentTwice {
        /// The message.
        message: String,
        /// The first of the steps.
        first: usize,
        /// The second.
        second: usize,
    },
    /// A change of what was not so.
    #[error("step {step}: {why}")]
    Change {
        /// Which step.
        step: usize,
        /// What.
        why: ChangeError,
    },
}

impl Trace {
    /// Reads a trace. `[spec: TRACE-3]`
    pub fn read(text: &str) -> Result<Self, TraceError> {
        let trace = Self::read_form(text)?;
        trace.check()?;
        Ok(trace)
    }

    /// Reads a trace that need not fit together: a replay tells better where it does not.
    pub fn read_form(text: &str) -> Result<Self, TraceError> {
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

    /// Whether all names and changes fit together. `[spec: TRACE-3]`
    pub fn check(&self) -> Result<(), Unsound> {
        self.check_names()?;
        self.graphs().map(|_| ())
    }

    /// Whether all names of replicas and messages fit together.
    pub fn check_names(&self) -> Result<(), Unsound> {
        if self.replicas.is_empty() {
            return Err(Unsound::NoReplicas);
        }
        let mut names = BTreeSet::new();
        for replica in &self.replicas {
            if !names.insert(&replica.name) {
                return Err(Unsound::TwoReplicas { name: replica.name.clone() });
            }
        }
        let senders = senders(&self.steps)?;
        for (at, step) in self.steps.iter().enumerate() {
            self.position(at, &step.replica)?;
            if let super::Act::Answer { to, .. } = &step.does {
                self.position(at, to)?;
            }
            if let Some(message) = step.does.message()
                && senders.get(message).is_none_or(|&sender| sender >= at)
            {
                return Err(Unsound::Message { step: at + 1, message: message.into() });
            }
        }
        if let Some(replica) = self.finding.replicas.iter().find(|replica| !names.contains(replica)) {
            return Err(Unsound::FoundAt { replica: replica.clone() });
        }
        Ok(())
    }
}

/// An error's line, column and words.
fn place(error: &serde_json::Error) -> (usize, usize, String) {
    let (line, column) = (error.line(), error.column());
    let words = error.to_string();
    let tail = format!(" at line {line} column {column}");
    (line, column, words.strip_suffix(&tail).unwrap_or(&words).into())
}
