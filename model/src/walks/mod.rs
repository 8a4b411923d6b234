//! L3: random walks. Long courses of one semantics, each event drawn at random from those that can happen.
//! `[spec: CHECK-13]`
//!
//! A walk proves nothing: it is a test. It goes where the exhaustive layers cannot, to many mutations of many
//! replicas with everything that a network does, and says afterwards what it did. What it finds is
//! [shrunk](crate::shrink) before it is shown.
//!
//! | room | what |
//! |---|---|
//! | `dice` | numbers that are the same for the same seed, on every machine and thread |
//! | `walk` | one walk: which events can happen, and which is drawn |
//! | `counts` | what walks did and saw |
//! | `run` | many walks and their report |

mod counts;
mod dice;
mod run;
mod walk;

pub use counts::Counts;
pub use dice::Dice;
pub use run::{WalkFinding, WalkRun, find};
pub use walk::{Faults, Walk, Walked};
