//! Traces: a run as people and programs read it, step by step, up to what is found. `[spec: TRACE-1]`
//!
//! | room | what |
//! |---|---|
//! | `scribe` | writes down what replicas do and show |
//! | `record` | runs a [course](crate::course) and has it written down |
//! | `of_course`, `rest` | the trace of a course that was run; what is judged of the moment after it |
//! | `read` | reads a trace back and refuses what is none |

mod of_course;
mod read;
mod record;
mod rest;
mod scribe;

pub use of_course::of_course;
pub use read::{TraceError, Unsound};
pub use record::{CannotHappen, Part, Recorder};
pub use scribe::{Heading, Scribe, message_name};

use crate::graph::{Change, Graph, Names};
use crate::semantics::{Breach, Clause};
use crate::verdict::RunTrace;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// The name of the format.
pub const FORMAT: &str = "dsr-trace";
/// The version of the trace format.
pub const TRACE_VERSION: u32 = 2;

/// A run of replicas, step by step. Format version [`TRACE_VERSION`]. `[spec: TRACE-1]`
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Trace {
    /// Always `dsr-trace`.
    pub format: String,
    /// The format's version.
    pub version: u32,
    /// What it shows, in words.
    pub title: String,
    /// Whose semantics.
    pub semantics: String,
    /// What it takes to run that semantics again from the same start; the form is that semantics' own.
    pub setup: Value,
    /// The layer that found it: `L1`, `L2`, `L3`, `scenario` or `gallery`.
    pub layer: String,
    /// How far the search went that found it, in words.
    pub bound: String,
    /// The replicas; observers only receive.
    pub replicas: Vec<TraceReplica>,
    /// What happens, in order.
    pub steps: Vec<TraceStep>,
    /// What is found after the last step.
    pub finding: Finding,
}

/// Who takes part. `[spec: TRACE-1]`
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TraceReplica {
    /// Its name.
    pub name: String,
    /// The index by which it mutates in its first incarnation: it decides who wins ties.
    pub index: usize,
    /// What it shows at the start.
    pub starts: Graph,
    /// The state that it starts with, if not the one in the setup; the form is that of the semantics.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<Value>,
}

/// One step of one replica. `[spec: TRACE-1]`
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TraceStep {
    /// Who.
    pub replica: String,
    /// What.
    pub does: Act,
    /// What changed in what the replica shows.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub changes: Vec<Change>,
    /// A hash of the replica's whole state after the step. `[spec: TRACE-2]`
    pub state: String,
}

/// What a replica does. `[spec: TRACE-1]`
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Act {
    /// Makes mutations, one after the other, and broadcasts them.
    Mutate {
        /// The mutations, for people.
        text: String,
        /// The mutations.
        mutations: Vec<Value>,
        /// The messages sent: none if nothing is to be told.
        sends: Vec<Sent>,
    },
    /// Receives a message.
    Deliver {
        /// Which.
        message: String,
        /// Whether another copy of it is still under way.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        again: bool,
    },
    /// A message never arrives here.
    Lose {
        /// Which.
        message: String,
    },
    /// Stops and starts again under its next incarnation.
    Restart {
        /// Whether with its state; else with what it started from.
        keeps: bool,
    },
    /// Sends another replica what that one lacks.
    Answer {
        /// Whom.
        to: String,
        /// The messages sent.
        sends: Vec<Sent>,
    },
    /// Something else.
    Happen {
        /// What.
        text: String,
    },
}

/// A message on its way. `[spec: TRACE-1]`
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sent {
    /// Its name.
    pub message: String,
    /// What it says, for people.
    pub text: String,
    /// What it says.
    pub delta: Value,
}

/// What kind of end a trace has. `[spec: TRACE-4]`
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FindingKind {
    /// A clause does not hold.
    Broken,
    /// A property of a scenario does not hold.
    Fails,
    /// Something is seen that had to be seen somewhere.
    Seen,
    /// Nothing broke.
    Holds,
}

/// What is found after the last step. `[spec: TRACE-4]`
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Finding {
    /// What kind of end this is.
    pub kind: FindingKind,
    /// The clause, or the property of a scenario.
    pub clause: String,
    /// What it demands.
    pub what: String,
    /// What was found, with the values.
    pub detail: String,
    /// The names of the replicas that show it.
    pub replicas: Vec<String>,
}

impl FindingKind {
    /// A sign for drawings.
    pub const fn sign(self) -> char {
        match self {
            Self::Broken | Self::Fails => '✗',
            Self::Seen => '◉',
            Self::Holds => '✓',
        }
    }
}

/// The clause, and what was found; some details name the clause themselves.
impl std::fmt::Display for Finding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { clause, detail, .. } = self;
        let head = format!("[{clause}]");
        write!(f, "{head} {}", detail.strip_prefix(&head).unwrap_or(detail).trim_start())
    }
}

impl Finding {
    /// A clause that does not hold, and who shows it.
    pub fn broken(clauses: &[Clause], breach: &Breach, replicas: Vec<String>) -> Self {
        let what = clauses.iter().find(|clause| clause.id == breach.clause).map_or("", |clause| clause.what);
        Self {
            kind: FindingKind::Broken,
            clause: breach.clause.into(),
            what: what.into(),
            detail: breach.detail.clone(),
            replicas,
        }
    }
}

impl Act {
    /// The messages that it sends.
    pub fn sends(&self) -> &[Sent] {
        match self {
            Self::Mutate { sends, .. } | Self::Answer { sends, .. } => sends,
            _ => &[],
        }
    }

    /// The message that arrives, or never does.
    pub fn message(&self) -> Option<&str> {
        match self {
            Self::Deliver { message, .. } | Self::Lose { message } => Some(message),
            _ => None,
        }
    }
}

impl Trace {
    /// What each replica shows after each step: `graphs()[step][replica]`, the first before the first step.
    /// `[spec: TRACE-3]`
    pub fn graphs(&self) -> Result<Vec<Vec<Graph>>, Unsound> {
        let mut now: Vec<Graph> = self.replicas.iter().map(|replica| replica.starts.clone()).collect();
        let mut all = vec![now.clone()];
        for (at, step) in self.steps.iter().enumerate() {
            let replica = self.position(at, &step.replica)?;
            for change in &step.changes {
                now[replica].change(change).map_err(|why| Unsound::Change { step: at + 1, why })?;
            }
            all.push(now.clone());
        }
        Ok(all)
    }

    /// What elements are called.
    pub fn names(&self) -> Names {
        let starts = self.replicas.iter().flat_map(|replica| &replica.starts.elements);
        let changes = self.steps.iter().flat_map(|step| &step.changes);
        let later = changes.filter_map(|change| match change {
            Change::Element { element, after: Some(after), .. } => Some((element, after)),
            _ => None,
        });
        Names::of(starts.chain(later))
    }

    fn position(&self, at: usize, name: &str) -> Result<usize, Unsound> {
        let known = self.replicas.iter().position(|replica| replica.name == name);
        known.ok_or_else(|| Unsound::Replica { step: at + 1, replica: name.into() })
    }
}

impl From<Trace> for RunTrace {
    fn from(trace: Trace) -> Self {
        let Finding { clause, detail, .. } = trace.finding.clone();
        let json = serde_json::to_value(&trace).unwrap_or_default();
        Self { clause, detail, steps: trace.steps.len(), text: trace.to_string(), json }
    }
}

/// Prints a trace for people: a line per step, what changed below it, what is found last.
impl std::fmt::Display for Trace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let names = self.names();
        for (at, step) in self.steps.iter().enumerate() {
            writeln!(f, "{:>3}  {:<10} {}", at + 1, step.replica, step.does)?;
            for line in step.changes.iter().flat_map(|change| change.lines(&names)) {
                writeln!(f, "                {line}")?;
            }
        }
        write!(f, "  {}  {}", self.finding.kind.sign(), self.finding)
    }
}

/// What is done, in words.
impl std::fmt::Display for Act {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let names: Vec<&str> = self.sends().iter().map(|sent| &*sent.message).collect();
        match self {
            Self::Mutate { text, .. } if names.is_empty() => f.write_str(text),
            Self::Mutate { text, .. } => write!(f, "{text}  → {}", names.join(", ")),
            Self::Deliver { message, .. } => write!(f, "receives {message}"),
            Self::Lose { message } => write!(f, "never receives {message}"),
            Self::Restart { keeps: true } => f.write_str("restarts with its state"),
            Self::Restart { keeps: false } => f.write_str("restarts without its state"),
            Self::Answer { to, .. } => write!(f, "sends {to} what it lacks  → {}", names.join(", ")),
            Self::Happen { text } => f.write_str(text),
        }
    }
}

/// A hash of a value's JSON text. `[spec: TRACE-2]`
pub(crate) fn hash(value: &Value) -> String {
    let text = value.to_string();
    let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    format!("{hash:016x}")
}

/// Names that are used twice, and so on, by message.
pub(super) fn senders(steps: &[TraceStep]) -> Result<BTreeMap<&str, usize>, Unsound> {
    let mut senders = BTreeMap::new();
    for (at, step) in steps.iter().enumerate() {
        for sent in step.does.sends() {
            if let Some(first) = senders.insert(&*sent.message, at) {
                let (first, second) = (first + 1, at + 1);
                return Err(Unsound::SentTwice { message: sent.message.clone(), first, second });
            }
        }
    }
    Ok(senders)
}
