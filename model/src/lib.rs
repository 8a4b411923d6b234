//! Exhaustive checking of concurrent replicas.

pub mod algebra;
pub mod checked;
pub mod engine;
pub mod focus;
pub mod histories;
pub mod progress;
pub mod scenario;
pub mod semantics;
pub mod suite;
pub mod tables;
pub mod trace;
pub mod verdict;
