//! Traces for people: the same run as text, as a sequence diagram, as a drawing, as a log with vector clocks.
//! `[spec: TRACE-3]`
//!
//! Every renderer draws the same [`Diagram`]: replicas are lanes, steps are rows, a delivery has an arrow from
//! the step that sent the message.

mod diagram;
mod mermaid;
mod rust;
mod shiviz;
mod svg;
mod text;
mod words;

pub use diagram::{Arrow, Diagram, Event, Row};

use crate::trace::{Trace, Unsound};

/// What a trace is rendered to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Target {
    /// A space-time diagram for a terminal.
    Text,
    /// A sequence diagram in the language of Mermaid.
    Mermaid,
    /// The same without what changes, for a glance.
    MermaidBrief,
    /// A drawing.
    Svg,
    /// A log for `ShiViz`, to be read with this regular expression:
    /// `(?<event>.*)\n(?<host>\S*) (?<clock>\{.*\})`
    Shiviz,
    /// A test in Rust that replays it.
    Rust,
}

/// Why a trace cannot be rendered.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum RenderError {
    /// It cannot be.
    #[error(transparent)]
    Unsound(#[from] Unsound),
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
        Target::Mermaid => Ok(mermaid::mermaid(&diagram, true)),
        Target::MermaidBrief => Ok(mermaid::mermaid(&diagram, false)),
        Target::Svg => Ok(svg::svg(&diagram)),
        Target::Shiviz => Ok(shiviz::shiviz(&diagram)),
        Target::Rust => Ok(rust::rust(trace)),
    }
}
