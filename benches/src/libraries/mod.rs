//! The libraries that take part, each used at its best; see `MAPPING` of each.

mod automerge;
mod crdts;
mod dson;
mod dsr;
mod loro;
mod yrs;

pub use automerge::AutomergeScene;
pub use crdts::Crdts;
pub use dson::Dson;
pub use dsr::Dsr;
pub use loro::Loro;
pub use yrs::Yrs;
