//! Cases, failures and logs, for people and for other programs. `[spec: CONF-16]`

mod badge;
mod diagram;
pub mod escape;
mod explain;
mod failure;
mod graph;
mod html;
mod junit;
mod markdown;
mod matrix;
mod mermaid;
mod tally;
mod words;

pub use badge::badge;
pub use diagram::diagram;
pub use explain::explain;
pub use failure::failure;
pub use graph::graph;
pub use html::html;
pub use junit::junit;
pub use markdown::markdown;
pub use matrix::matrix;
pub use mermaid::mermaid;
pub use tally::{Named, Tally};
pub use words::words;
