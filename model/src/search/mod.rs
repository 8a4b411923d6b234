//! Searching a space to its end, twice: by stateright, and by a plain search of our own that must agree with
//! it on every count. Histories (L1) and schedules (L2) are both such spaces. `[spec: CHECK-9]`
//!
//! | room | what |
//! |---|---|
//! | `guided` | depth-first by stateright: judges, counts, reports progress, can be stopped |
//! | `plain` | breadth-first, keeping whole nodes: counts again, and finds shortest counterexamples |
//! | `run` | both, and what a report says of them |

mod guided;
mod plain;
mod run;

pub use guided::{Explored, explore};
pub use plain::{Counterexample, Counts, all, count, find_fault};
pub(crate) use run::{COUNTEREXAMPLE_MAX, Findings, search};

use std::fmt::Debug;
use std::hash::{Hash, Hasher};

/// What an engine needs of a space.
pub trait Space: Send + 'static {
    /// A point of the space, small enough to copy.
    type Node: Copy + Eq + Hash + Debug + Send + Sync + 'static;
    /// What leads from one node to the next.
    type Event: Copy + PartialEq + Debug + Send + Sync;
    /// A clause that does not hold.
    type Fault: Debug + Send;

    /// Where it begins.
    fn start(&self) -> Self::Node;

    /// Every node one event further.
    fn successors(
        &mut self,
        at: &Self::Node,
        out: &mut Vec<(Self::Event, Self::Node)>,
    ) -> Result<(), Self::Fault>;

    /// Judges a node by every clause.
    fn judge(&mut self, at: &Self::Node) -> Result<(), Self::Fault>;

    /// Whether all that [`judge`](Self::judge) would look at is judged as part of a later node.
    fn is_covered(&mut self, at: &Self::Node) -> bool {
        let _ = at;
        false
    }

    /// How many mutations a node is from the start.
    fn depth(&self, at: &Self::Node) -> usize;

    /// Replica states judged so far.
    fn states_judged(&self) -> u64;

    /// How many different things have been witnessed so far.
    fn witnessed(&self) -> usize;
}

/// Hashes numbers two at a time: most of a search is hashing.
pub(crate) fn hash_numbers(numbers: &[u32], hasher: &mut impl Hasher) {
    for pair in numbers.chunks(2) {
        let second = pair.get(1).copied().unwrap_or_default();
        hasher.write_u64(u64::from(pair[0]) << 32 | u64::from(second));
    }
}
