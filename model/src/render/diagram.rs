//! The layout that all renderers share.

use crate::trace::{Act, Sent, Trace, TraceStep, Unsound};
use std::collections::BTreeMap;

/// A trace whose names are resolved: lanes, rows, and for each delivery where it comes from.
#[derive(Clone, PartialEq, Debug)]
pub struct Diagram<'t> {
    /// The trace.
    pub trace: &'t Trace,
    /// The replicas' names, in the order of the trace.
    pub lanes: Vec<&'t str>,
    /// The steps, in order. What is found is found after the last.
    pub rows: Vec<Row<'t>>,
}

/// One step.
#[derive(Clone, PartialEq, Debug)]
pub struct Row<'t> {
    /// Whose: an index into the lanes.
    pub lane: usize,
    /// What happens.
    pub event: Event<'t>,
    /// What changes in what the replica shows, a line each.
    pub changes: Vec<String>,
}

/// What happens in a row.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Event<'t> {
    /// A mutation, and messages for everybody.
    Mutation {
        /// The mutation, for people.
        text: &'t str,
        /// The messages.
        sends: &'t [Sent],
    },
    /// A message arrives.
    Delivery(Arrow<'t>),
    /// A message never arrives.
    Loss(Arrow<'t>),
    /// The replica stops and starts again.
    Restart {
        /// Whether with its state.
        keeps: bool,
    },
    /// The replica sends another what that one lacks.
    Answer {
        /// Whom: a lane.
        to: usize,
        /// The messages.
        sends: &'t [Sent],
    },
    /// Something else.
    Other {
        /// What.
        text: &'t str,
    },
}

/// Where a message comes from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Arrow<'t> {
    /// The message.
    pub message: &'t str,
    /// The row that sent it.
    pub sent: usize,
    /// The lane that sent it.
    pub from: usize,
    /// Whether it was sent to one replica only.
    pub is_answer: bool,
}

impl<'t> Diagram<'t> {
    /// Resolves every name of a trace. `[spec: TRACE-3]`
    pub fn of(trace: &'t Trace) -> Result<Self, Unsound> {
        trace.check()?;
        let lanes: Vec<&str> = trace.replicas.iter().map(|replica| &*replica.name).collect();
        let names = trace.names();
        let mut layout = Layout { lanes: &lanes, sent: BTreeMap::new() };
        let rows = trace.steps.iter().enumerate().map(|(at, step)| {
            let changes = step.changes.iter().flat_map(|change| change.lines(&names)).collect();
            let (lane, event) = layout.row(at, step)?;
            Ok(Row { lane, event, changes })
        });
        let rows = rows.collect::<Result<_, Unsound>>()?;
        Ok(Self { trace, lanes, rows })
    }

    /// The lane of the last step, or the first.
    pub fn last_lane(&self) -> usize {
        self.rows.last().map_or(0, |row| row.lane)
    }

    /// The trace in a line.
    pub fn headline(&self) -> String {
        let Self { trace, rows, .. } = self;
        let steps = if rows.len() == 1 { "step" } else { "steps" };
        format!("{} ({}, {}, {} {steps})", trace.title, trace.semantics, trace.layer, rows.len())
    }

    /// What happens in a row, in words, without its replica.
    pub fn words(&self, row: &Row<'_>) -> String {
        let name = |lane: usize| if lane == row.lane { "itself" } else { self.lanes[lane] };
        match row.event {
            Event::Mutation { text, sends: [] } | Event::Other { text } => text.to_owned(),
            Event::Mutation { text, sends } => format!("{text}  → {}", messages(sends)),
            Event::Delivery(Arrow { message, from, .. }) => format!("receives {message} from {}", name(from)),
            Event::Loss(Arrow { message, from, .. }) => {
                format!("never receives {message} from {}", name(from))
            }
            Event::Restart { keeps: true } => "restarts with its state".into(),
            Event::Restart { keeps: false } => "restarts without its state".into(),
            Event::Answer { to, sends } => format!("sends {} what it lacks  → {}", name(to), messages(sends)),
        }
    }

    /// What is found, with its sign.
    pub fn finding(&self) -> String {
        format!("{} {}", self.trace.finding.kind.sign(), self.trace.finding)
    }
}

fn messages(sends: &[Sent]) -> String {
    let told = |sent: &Sent| {
        if sent.text.is_empty() || sends.len() < 2 {
            sent.message.clone()
        } else {
            format!("{} ({})", sent.message, sent.text)
        }
    };
    sends.iter().map(told).collect::<Vec<_>>().join(", ")
}

/// The names that are known so far.
struct Layout<'l, 't> {
    lanes: &'l [&'t str],
    /// By message, the row and the lane that sent it, and whether it is an answer.
    sent: BTreeMap<&'t str, (usize, usize, bool)>,
}

impl<'t> Layout<'_, 't> {
    fn lane(&self, at: usize, name: &str) -> Result<usize, Unsound> {
        let lane = self.lanes.iter().position(|known| *known == name);
        lane.ok_or_else(|| Unsound::Replica { step: at + 1, replica: name.to_owned() })
    }

    fn arrow(&self, at: usize, message: &'t str) -> Result<Arrow<'t>, Unsound> {
        let sent = self.sent.get(message).copied();
        let (sent, from, is_answer) =
            sent.ok_or_else(|| Unsound::Message { step: at + 1, message: message.to_owned() })?;
        Ok(Arrow { message, sent, from, is_answer })
    }

    fn row(&mut self, at: usize, step: &'t TraceStep) -> Result<(usize, Event<'t>), Unsound> {
        let lane = self.lane(at, &step.replica)?;
        let is_answer = matches!(step.does, Act::Answer { .. });
        let sent = step.does.sends().iter().map(|sent| (&*sent.message, (at, lane, is_answer)));
        self.sent.extend(sent);
        let event = match &step.does {
            Act::Mutate { text, sends, .. } => Event::Mutation { text, sends },
            Act::Deliver { message, .. } => Event::Delivery(self.arrow(at, message)?),
            Act::Lose { message } => Event::Loss(self.arrow(at, message)?),
            Act::Restart { keeps } => Event::Restart { keeps: *keeps },
            Act::Answer { to, sends } => Event::Answer { to: self.lane(at, to)?, sends },
            Act::Happen { text } => Event::Other { text },
        };
        Ok((lane, event))
    }
}
