//! What a session is told, and what it wants done.

use crate::origin::{Address, Destination, Origin};
use dsr_core::{Changes, MutationError};

/// What has happened outside.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Event<'b> {
    /// A datagram has come: any bytes. `[spec: LINK-1]`
    Datagram {
        /// Where from.
        from: Address,
        /// Its bytes.
        bytes: &'b [u8],
    },
    /// Time has passed: at the latest when [`Session::next_wake`](crate::Session::next_wake) says.
    Tick,
    /// The session is to leave: it sends what is queued, says so, and does nothing more. `[spec: LINK-16]`
    Leave,
}

/// What is to be done, or told.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Action {
    /// A datagram is to be sent. It may get lost.
    Send {
        /// Whereto.
        to: Destination,
        /// Its bytes.
        bytes: Vec<u8>,
    },
    /// The graph has changed. `[spec: EVENT-1]`
    Changed {
        /// How.
        changes: Changes,
        /// Why.
        cause: Cause,
    },
    /// A peer has come or gone.
    Peer {
        /// Which.
        origin: Origin,
        /// Its name.
        name: String,
        /// Whether it has come or gone.
        presence: Presence,
    },
    /// The agent id is somebody else's: nothing can be written any more. `[spec: LINK-15]`
    Refused(Refusal),
    /// For the first time the session holds what a peer held, or it is alone. `[spec: LINK-14]`
    Synced,
}

/// Two that claim one agent id. `[spec: LINK-15]`
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error(
    "agent {agent} is taken: {owner:?} holds it as {owner_origin}, {claimant:?} claimed it as {claimant_origin}; \
     choose another agent id, or stop the other one"
)]
pub struct Refusal {
    /// The id.
    pub agent: u32,
    /// Who holds it.
    pub owner_origin: Origin,
    /// The owner's name.
    pub owner: String,
    /// Who claimed it: this session.
    pub claimant_origin: Origin,
    /// This session's name.
    pub claimant: String,
}

/// Why the graph has changed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Cause {
    /// A mutation here.
    Local,
    /// A delta that its origin sent to the group.
    Remote {
        /// Whose.
        origin: Origin,
    },
    /// A piece of an answer to a digest.
    Repair {
        /// Who answered.
        from: Origin,
    },
}

/// Whether a peer is there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Presence {
    /// It was heard for the first time, or again.
    Joined,
    /// It said that it leaves.
    Left,
    /// It has said nothing for too long.
    Lost,
}

/// Why a mutation is refused.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MutateError {
    /// The agent id is being claimed. `[spec: LINK-15]`
    #[error("the agent id is being claimed; try again in {nanoseconds} ns")]
    Claiming {
        /// How long it still takes.
        nanoseconds: u64,
    },
    /// The agent id is somebody else's. `[spec: LINK-15]`
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The session has left.
    #[error("the session has left the group")]
    Left,
    /// Too much waits to be sent. `[spec: LINK-10]`
    #[error("{queued} bytes wait to be sent, allowed are {max}; try again when some have been")]
    Busy {
        /// So many bytes.
        queued: usize,
        /// The bound.
        max: usize,
    },
    /// The graph does not allow it.
    #[error(transparent)]
    Mutation(#[from] MutationError),
}
