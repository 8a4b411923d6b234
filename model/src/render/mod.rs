//! Traces for people: the same run as text, as a sequence diagram, as a drawing, as a log with vector clocks.
//! `[spec: TRACE-3]`
//!
//! Every renderer draws the same [`Diagram`]: replicas are lanes, steps are rows, a delivery has an arrow from
//! the step that sent the message.

mod diagram;
mod mermaid;
mod shiviz;
mod svg;
mod text;
mod words;

pub use diagram::{Diagram, Event, Row};

use crate::trace::Trace;

/// What a trace is rendered to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Target {
    /// A space-time diagram for a terminal.
    Text,
    /// A sequence diagram in the language of Mermaid.
    Mermaid,
    /// A drawing.
    Svg,
    /// A log for `ShiViz`, to be read with this regular expression:
    /// `(?<event>.*)\n(?<host>\S*) (?<clock>\{.*\})`
    Shiviz,
}

/// Why a trace cannot be rendered. Steps count from 1.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum RenderError {
    /// There is nobody to draw.
    #[error("the trace names no replicas")]
    NoReplicas,
    /// A name stands for two lanes.
    #[error("two replicas are named {name:?}")]
    TwoReplicas {
        /// The name.
        name: String,
    },
    /// A step of, or an answer from, nobody.
    #[error("step {step} names the replica {name:?}, which the trace does not list")]
    UnknownReplica {
        /// Which step.
        step: usize,
        /// The name.
        name: String,
    },
    /// A delivery from nowhere.
    #[error("step {step} delivers the message {message:?}, which no step before it sends")]
    UnknownMessage {
        /// Which step.
        step: usize,
        /// The message.
        message: String,
    },
    /// A message that could come from either of two steps.
    #[error("step {step} sends the message {message:?}, which step {first} has sent already")]
    SentTwice {
        /// Which step.
        step: usize,
        /// The step before it.
        first: usize,
        /// The message.
        message: String,
    },
    /// More lanes than fit on a line of text.
    #[error("{replicas} replicas do not fit on a line of text, which holds at most {most}")]
    TooWide {
        /// How many there are.
        replicas: usize,
        /// How many fit.
        most: usize,
    },
}

/// Renders a trace. The result ends with a newline. `[spec: TRACE-3]`
pub fn render(trace: &Trace, target: Target) -> Result<String, RenderError> {
    let diagram = Diagram::of(trace)?;
    match target {
        Target::Text => text::text(&diagram),
        Target::Mermaid => Ok(mermaid::mermaid(&diagram)),
        Target::Svg => Ok(svg::svg(&diagram)),
        Target::Shiviz => Ok(shiviz::shiviz(&diagram)),
    }
}
