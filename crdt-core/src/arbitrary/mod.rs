//! Small arbitrary values for fuzzers.
//!
//! Ids and names come from small pools, so that inputs meet: three agents, eight sequences, four names.
//! Every arbitrary state is well-formed and drawn from one universe in which a dot always has the same
//! record, so that no dot is used twice however many states are drawn, and the laws of join apply.

mod data;
mod mutation;
mod state;
