//! The layout that all renderers share.

use super::RenderError;
use crate::trace::{Act, Trace, TraceStep};
use std::collections::BTreeMap;

/// A trace whose names are resolved: lanes, rows, and for each delivery where it comes from.
#[derive(Clone, PartialEq, Debug)]
pub struct Diagram<'t> {
    /// The trace.
    pub trace: &'t Trace,
    /// The replicas' names, in the order of the trace.
    pub lanes: Vec<&'t str>,
    /// The steps, in order. The clause breaks at the last.
    pub rows: Vec<Row<'t>>,
}

/// One step.
#[derive(Clone, PartialEq, Debug)]
pub struct Row<'t> {
    /// Whose: an index into the lanes.
    pub lane: usize,
    /// What happens.
    pub event: Event<'t>,
    /// What changes in the replica's view, a line each.
    pub changes: &'t [String],
}

/// What happens in a row.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Event<'t> {
    /// A mutation, and a message for everybody.
    Mutation {
        /// The message.
        message: &'t str,
        /// The mutation, for people.
        text: &'t str,
    },
    /// A message arrives.
    Delivery {
        /// The message.
        message: &'t str,
        /// The row that sent it.
        sent: usize,
        /// The lane that sent it.
        from: usize,
    },
    /// The replica stops and starts again.
    Restart,
    /// An answer to a digest arrives. A trace does not tell when it was sent.
    Resynchronisation {
        /// The lane that answered.
        from: usize,
    },
}

impl<'t> Diagram<'t> {
    /// Resolves every name of a trace. `[spec: TRACE-3]`
    pub fn of(trace: &'t Trace) -> Result<Self, RenderError> {
        if trace.replicas.is_empty() {
            return Err(RenderError::NoReplicas);
        }
        let mut numbers = BTreeMap::new();
        for (lane, name) in trace.replicas.iter().enumerate() {
            if numbers.insert(name.as_str(), lane).is_some() {
                return Err(RenderError::TwoReplicas { name: name.clone() });
            }
        }
        let mut names = Names { lanes: numbers, sent: BTreeMap::new() };
        let rows = trace.steps.iter().enumerate().map(|(at, step)| names.row(at, step));
        let rows = rows.collect::<Result<_, _>>()?;
        Ok(Self { trace, lanes: trace.replicas.iter().map(String::as_str).collect(), rows })
    }

    /// The lane in which the clause breaks; the first if it breaks before any step.
    pub fn breaking_lane(&self) -> usize {
        self.rows.last().map_or(0, |row| row.lane)
    }

    /// The trace in a line.
    pub fn headline(&self) -> String {
        let Self { trace, rows, .. } = self;
        let steps = if rows.len() == 1 { "step" } else { "steps" };
        format!("{}, {}: {} {steps} to {}", trace.semantics, trace.layer, rows.len(), trace.breach.clause)
    }

    /// What happens in a row, in words, without its replica.
    pub fn words(&self, row: &Row<'_>) -> String {
        let name = |lane: usize| if lane == row.lane { "itself" } else { self.lanes[lane] };
        match row.event {
            Event::Mutation { message, text } => {
                let text = if text.is_empty() { "mutates" } else { text };
                format!("{text}  → {message}")
            }
            Event::Delivery { message, from, .. } => format!("receives {message} from {}", name(from)),
            Event::Restart => "restarts under a fresh incarnation".into(),
            Event::Resynchronisation { from } => format!("resynchronises with {}", name(from)),
        }
    }

    /// The broken clause, with what is wrong.
    pub fn breach(&self) -> String {
        let (clause, detail) = (format!("[{}]", self.trace.breach.clause), &self.trace.breach.detail);
        // Some details name the clause themselves.
        if detail.starts_with(&clause) { detail.clone() } else { format!("{clause} {detail}") }
    }
}

/// The names that are known so far.
struct Names<'t> {
    lanes: BTreeMap<&'t str, usize>,
    /// By message, the row and the lane that sent it.
    sent: BTreeMap<&'t str, (usize, usize)>,
}

impl<'t> Names<'t> {
    fn lane(&self, at: usize, name: &str) -> Result<usize, RenderError> {
        let unknown = || RenderError::UnknownReplica { step: at + 1, name: name.to_owned() };
        self.lanes.get(name).copied().ok_or_else(unknown)
    }

    fn row(&mut self, at: usize, step: &'t TraceStep) -> Result<Row<'t>, RenderError> {
        let lane = self.lane(at, &step.replica)?;
        let event = match &step.act {
            Act::Mutate { message, text, .. } => {
                if let Some((first, _)) = self.sent.insert(message, (at, lane)) {
                    let message = message.clone();
                    return Err(RenderError::SentTwice { step: at + 1, first: first + 1, message });
                }
                Event::Mutation { message, text }
            }
            Act::Deliver { message } => {
                let unknown = || RenderError::UnknownMessage { step: at + 1, message: message.clone() };
                let (sent, from) = self.sent.get(message.as_str()).copied().ok_or_else(unknown)?;
                Event::Delivery { message, sent, from }
            }
            Act::Restart => Event::Restart,
            Act::Resynchronise { from, .. } => Event::Resynchronisation { from: self.lane(at, from)? },
        };
        Ok(Row { lane, event, changes: &step.changes })
    }
}
