//! Exhaustive checking of concurrent replicas.

pub mod algebra;
pub mod checked;
pub mod engine;
pub mod histories;
pub mod semantics;
pub mod tables;
pub mod trace;
pub mod verdict;
