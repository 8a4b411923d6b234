//! Exhaustive checking of concurrent replicas.

pub mod alarms;
pub mod algebra;
pub mod checked;
pub mod course;
pub mod focus;
pub mod gallery;
pub mod graph;
pub mod histories;
pub mod job;
pub mod progress;
pub mod published;
pub mod render;
pub mod replay;
pub mod scenario;
pub mod schedules;
pub mod search;
pub mod semantics;
pub mod shrink;
pub mod suite;
pub mod tables;
pub mod trace;
pub mod twin;
pub mod verdict;
pub mod walks;
pub mod why;
