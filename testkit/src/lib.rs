//! Test support that every crate shares. Nothing here is part of the system.
//!
//! | room | what it makes |
//! |---|---|
//! | [`atoms`] | strategies for dots, contexts, names and values |
//! | [`universe`] | well-formed states of hostile shape, alone or several over one set of records |
//! | [`candidates`], [`pick`], [`attempt`] | concrete mutations in a view |
//! | [`history`], [`World`] | replicas that mutate, deliver twice and out of order, and resynchronise |
//! | [`state`] | a state from a few lines of text |
//! | [`cases`] | how many samples a test takes |
//! | `bytes` (feature `arbitrary`) | universes, fates and steps from bytes, for fuzzers |
//!
//! ```
//! use dsr_core::{Dictionary, view};
//! // Two parents, and a write whose vertex has not arrived.
//! let state = dsr_testkit::state(
//!     "r1.1 vertex room kitchen @1
//!      r1.2 edge root -RT-> r1.1 @1
//!      r1.3 vertex robot shadow @2
//!      r1.4 edge r1.1 -RT-> r1.3 @2
//!      r2.1 edge root -RT-> r1.3 @2
//!      r2.2 write r3.1 level=5 @3
//!      dead r3.2",
//! );
//! let dictionary = Dictionary::open();
//! assert_eq!(view(&state, &dictionary).repairs().len(), 1);
//! ```

pub mod atoms;
#[cfg(feature = "arbitrary")]
pub mod bytes;
mod enabled;
pub mod history;
mod language;
mod sampling;
pub mod universe;
mod world;

pub use enabled::{NAMES, attempt, candidates, dictionary, pick};
pub use history::{History, Step, histories};
pub use language::{parse_state, state};
pub use sampling::cases;
pub use universe::{Anchors, Fate, Universe, encoded_states, fates, states, universes};
pub use world::{World, author};
