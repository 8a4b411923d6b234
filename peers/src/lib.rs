//! The Deep State Representation on the CRDTs of other libraries, as adapters of the conformance corpus: automerge, Loro
//! and yrs. They answer one question: which invariants does a graph keep under concurrency, if it is built from a
//! library's registers, maps and trees?
//!
//! # What is the library's part, and what is not
//!
//! Each mapping is written as a careful user of the library would write it, and uses its best means. Three things are
//! the user's part, as in any program, and are the same here for all libraries:
//!
//! - the layout of the data;
//! - the conditions before a mutation, over what the author's own document shows: what the specification refuses is
//!   refused, and a group is written as a whole or not at all;
//! - filters at reading that look at one element and what it names: an edge is shown if both its ends are there; a vertex
//!   that has children and no parent, or that has no edge, is shown as hanging from the root; if the edge that a register
//!   shows is gone, or an end of it, another one of the same register is shown.
//!
//! What goes beyond one register is not done: breaking cycles, by choosing which of the concurrent claims to ignore, or
//! connecting parts of the graph that have lost their path. That would be the reference view once more, and the library's own answer would
//! not be seen.
//!
//! | room | what is in it |
//! |---|---|
//! | [`graph`], [`check`], [`edit`], [`refusal`] | what is shown; the conditions of mutations; what is written |
//! | [`replica`], [`peer`] | what a mapping provides; the adapter over it |
//! | [`automerge_graph`], [`loro_graph`], [`yrs_graph`] | the mappings |
//! | [`published_graph`] | the published system, as the checker has it |

#![forbid(unsafe_code)]

pub mod automerge_graph;
pub mod check;
pub mod edit;
pub mod graph;
pub mod loro_graph;
pub mod peer;
pub mod published_graph;
pub mod refusal;
pub mod replica;
pub mod yrs_graph;

pub use automerge_graph::AutomergeGraph;
pub use loro_graph::LoroGraph;
pub use peer::Peer;
pub use published_graph::PublishedGraph;
pub use yrs_graph::YrsGraph;
