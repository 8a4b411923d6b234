//! Exhaustive checking of concurrent replicas.

pub mod checked;
pub mod histories;
pub mod semantics;
pub mod tables;
