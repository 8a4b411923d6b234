//! Who sends, and whereto.

use dsr_core::ReplicaId;
use std::fmt;

/// One start of one replica. Numbers of messages count from it. `[spec: LINK-4]`
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Origin {
    /// The replica.
    pub replica: ReplicaId,
    /// Drawn at random by each start, so that two starts under one id are told apart.
    pub nonce: u64,
}

/// Prints `r3+1#00000000000000ff`.
impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}#{:016x}", self.replica, self.nonce)
    }
}

/// Where a datagram came from, in the words of the binding: an IPv6 address (or an IPv4 one within it) and a
/// port, or whatever else tells peers apart. Sessions only compare it and hand it back. `[spec: LINK-1]`
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Address {
    /// The host.
    pub host: u128,
    /// The port.
    pub port: u16,
}

/// Whereto a datagram is sent. `[spec: LINK-1]`
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Destination {
    /// To everybody in the group.
    Group,
    /// To one peer.
    Peer(Address),
}
