//! The tests of the core against its public face, in one program: linking twenty would cost more than running them.
//! A test that needs the process for itself has a file of its own beside this folder.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that cannot go on has failed"
)]

mod canary_invariants;
mod clauses_common;
mod clauses_conflicts;
mod clauses_events;
mod clauses_limits;
mod clauses_mutations;
mod clauses_state;
mod clauses_sync;
mod clauses_values;
mod clauses_view;
mod differential_histories;
mod differential_replica;
mod history_state_machine;
mod law_codec;
mod law_join;
#[cfg(feature = "serde")]
mod law_json;
mod law_mutation;
mod law_pieces;
mod law_sync;
mod law_view;
mod replica_support;
#[cfg(feature = "serde")]
mod scene_bad_input;
#[cfg(feature = "serde")]
mod scene_faults;
#[cfg(feature = "serde")]
mod scene_shared;
#[cfg(feature = "serde")]
mod scene_support;
#[cfg(feature = "serde")]
mod scene_values;
#[cfg(feature = "serde")]
mod scene_write;
