//! Cases that are computed: schedules that the checker has found, with what the core shows.
//!
//! Who writes such a case asks the core for its views, and the checker and the oracles whether these are right.

mod builder;
mod gallery;
mod model;

pub use builder::{Builder, CannotWrite};
pub use gallery::gallery;
pub use model::{Generated, Group, Rule, model};
