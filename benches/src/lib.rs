//! Speed, memory and bytes of the core, measured beside other CRDT libraries in the same run.
//!
//! `cargo run --release -p dsr-benches -- --quick` prints the table; `docs/performance.md` holds a recorded run.
//!
//! | room | what it does |
//! |---|---|
//! | [`scene`] | what a library must be able to do to take part |
//! | [`libraries`] | ours and the peers, each with its mapping |
//! | [`questions`] | what is asked; one file for each kind |
//! | [`contest`], [`stopwatch`] | rounds in which all take their turns; the processor's time |
//! | [`growth`], [`sizes`], [`memory`], [`checker`] | what is measured otherwise |
//! | [`targets`] | what ours is to reach |
//! | [`report`] | text, JSON, Markdown, plots |
//!
//! **How it is measured.** All sides of a question are built first. Then come rounds: in each, every side does the job some
//! hundred times, in the same order. A result is the median of a side's rounds; a ratio is the median over rounds of the
//! peer's time by ours, with the least and the greatest round as spread. What counts is the processor's time of this process,
//! so that others on the machine disturb caches, and nothing else.

pub mod checker;
pub mod contest;
pub mod error;
pub mod growth;
pub mod libraries;
pub mod memory;
pub mod noise;
pub mod questions;
pub mod report;
pub mod run;
pub mod scene;
pub mod sizes;
pub mod stopwatch;
pub mod targets;
