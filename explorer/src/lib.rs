//! The explorer: one HTML page that shows what a check found, and steps through its traces. `[spec: TRACE-5]`
//!
//! A page is a text that opens from disk: its style, its script and its data are in it, and its policy lets it load
//! nothing and run nothing else. What comes from data is only ever text: it is written into the page as JSON in
//! which no `<` is left, and the script makes nodes from it, never markup.
//!
//! | room | what |
//! |---|---|
//! | `data` | what the script reads: reports and traces without what is not drawn |
//! | `plain` | the steps of each trace as text, for readers without scripts |
//! | `page` | the parts put together, and the policy |
//! | `assets/` | the page's frame, style and script, a file for each concept |

mod data;
mod page;
mod plain;

pub use page::page;

use dsr_model::trace::{Trace, Unsound};
use serde_json::Value;

/// What a page shows.
#[derive(Clone, Debug)]
pub struct Content {
    /// What the page is called.
    pub title: String,
    /// What `dsr check --format json` prints.
    pub report: Option<Value>,
    /// What `dsr gallery --format json` prints.
    pub gallery: Option<Value>,
    /// The traces, in the order in which they are turned over.
    pub traces: Vec<Shown>,
}

/// A trace on a page.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The trace.
    pub trace: Trace,
    /// Where it is from.
    pub origin: Origin,
}

/// Where a trace is from: it decides what the trace is called in the page's fragments.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Origin {
    /// From nowhere in particular.
    Alone,
    /// From the run of this name.
    Run(String),
    /// From a row of the gallery.
    Row {
        /// The row's number.
        row: String,
        /// Whose semantics it ran on.
        side: Side,
    },
}

/// A row's two runs.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Side {
    /// The published semantics, which the row is about.
    Published,
    /// The same schedule on the checked one.
    Checked,
}

impl Side {
    /// The word in the page and in its fragments.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Published => "published",
            Self::Checked => "checked",
        }
    }
}

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum PageError {
    /// A trace cannot be. `[spec: TRACE-3]`
    #[error("the trace {title:?} cannot be shown: {why}; write it again")]
    Unsound {
        /// The trace's title.
        title: String,
        /// What is wrong with it.
        why: Unsound,
    },
    /// The data cannot be written as JSON.
    #[error("the page's data cannot be written: {0}")]
    Json(#[from] serde_json::Error),
}
