//! Runs of real sessions over the [memory network](crate::memory): a run is its seed. `[spec: LINK-18]`
//!
//! | room | what it does |
//! |---|---|
//! | `plan`, `dice` | what happens when, as data, drawn from a seed |
//! | `workload` | mutations of the graph as it is |
//! | `world` | sessions, clocks and network, from one moment to the next |
//! | `act` | carries out one step of a plan |
//! | `hostile` | datagrams that strangers send |
//! | `judge` | what must hold, at each step and at the end |
//! | `run` | a plan carried out |
//! | `shrink` | a plan that fails, made small |
//! | `totals` | many runs, and how often rare things happened |

mod act;
mod dice;
mod hostile;
mod judge;
mod plan;
mod run;
mod shrink;
mod totals;
mod workload;
mod world;

pub use judge::{Failure, HEAL_MAX};
pub use plan::{Options, Plan, Step};
pub use run::{Outcome, run, run_telling};
pub use shrink::shrink;
pub use totals::Totals;
