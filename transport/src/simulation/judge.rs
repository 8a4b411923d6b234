//! What must hold: of one session at any moment, of all at the end. `[spec: LINK-18]`

use super::world::World;
use crate::config::{MS, SECOND};
use crate::session::Session;
use dsr_core::Dot;
use dsr_core::invariant::{self, Violation};
use std::collections::BTreeMap;

/// After the network has healed, all are equal within so long a time.
pub const HEAL_MAX: u64 = 8 * SECOND;

/// What was broken.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Failure {
    /// Sessions are not equal, long after the network has healed.
    #[error("{} ms after healing the states differ: {fingerprints:?}", after / MS)]
    Differ {
        /// How long after.
        after: u64,
        /// The nodes with each fingerprint.
        fingerprints: Vec<(String, Vec<usize>)>,
    },
    /// Fingerprints are equal and states are not.
    #[error("n{node} has another state than the first, with the same fingerprint")]
    BytesDiffer {
        /// Which.
        node: usize,
    },
    /// A graph breaks an invariant.
    #[error("n{node} breaks an invariant: {violation}")]
    Invariant {
        /// Which.
        node: usize,
        /// How.
        violation: Violation,
    },
    /// A dot was used twice.
    #[error("n{node} uses {dot}, which was used before")]
    DotReused {
        /// Which.
        node: usize,
        /// The dot.
        dot: Dot,
    },
    /// Two sessions hold one agent id.
    #[error("n{first} and n{second} both hold agent id {agent}")]
    TwoHolders {
        /// One.
        first: usize,
        /// The other.
        second: usize,
        /// The id.
        agent: u32,
    },
    /// Something is missing still, though all is quiet.
    #[error("n{node} still misses messages that exist")]
    GapsLeft {
        /// Which.
        node: usize,
    },
    /// Parts are kept of messages that will never be complete.
    #[error("n{node} still keeps {bytes} bytes of messages that never came in whole")]
    PartsLeft {
        /// Which.
        node: usize,
        /// How many.
        bytes: usize,
    },
}

/// The invariants of one graph.
pub(super) fn session(node: usize, session: &Session) -> Result<(), Failure> {
    let state = session.replica().state();
    let judged = invariant::check_view(&session.replica().shown(&state));
    judged.map_err(|violation| Failure::Invariant { node, violation })
}

/// Whether all sessions have one fingerprint.
pub(super) fn are_equal(world: &World<'_>) -> bool {
    let mut prints = world.sessions().map(|(_, session)| session.replica().fingerprint());
    let first = prints.next();
    prints.all(|print| Some(print) == first)
}

pub(super) fn differ(world: &World<'_>, after: u64) -> Failure {
    let mut nodes: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (at, session) in world.sessions() {
        nodes.entry(session.replica().fingerprint().to_string()).or_default().push(at);
    }
    Failure::Differ { after, fingerprints: nodes.into_iter().collect() }
}

/// What must hold at the end, when all has been quiet for a while.
pub(super) fn at_end(world: &World<'_>) -> Result<(), Failure> {
    if !are_equal(world) {
        return Err(differ(world, HEAL_MAX));
    }
    let mut states = world.sessions().map(|(at, session)| (at, session.replica().encode()));
    let first = states.next().map(|(_, bytes)| bytes);
    if let Some((node, _)) = states.find(|(_, bytes)| Some(bytes) != first.as_ref()) {
        return Err(Failure::BytesDiffer { node });
    }
    let mut holders = BTreeMap::new();
    for (node, one) in world.sessions() {
        session(node, one)?;
        if one.has_gaps() {
            return Err(Failure::GapsLeft { node });
        }
        if one.begun_bytes() > 0 {
            return Err(Failure::PartsLeft { node, bytes: one.begun_bytes() });
        }
        let agent = one.origin().replica.agent;
        if one.is_writer()
            && let Some(first) = holders.insert(agent, node)
        {
            return Err(Failure::TwoHolders { first, second: node, agent });
        }
    }
    Ok(())
}
