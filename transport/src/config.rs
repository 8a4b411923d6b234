//! What a session is told: who it is, its times, its bounds.

use crate::flaw::Flaw;
use crate::wire::group_key;
use dsr_core::{Dictionary, ReplicaId};

/// One millisecond, in nanoseconds.
pub const MS: u64 = 1_000_000;
/// One second, in nanoseconds.
pub const SECOND: u64 = 1_000 * MS;

/// All that a session is told. Times are in nanoseconds, sizes in bytes. `[spec: LINK-17]`
#[derive(Clone, Debug)]
pub struct Config {
    /// The replica: the agent id that it claims, with an incarnation that it has never used. `[spec: CRASH-2]`
    pub replica: ReplicaId,
    /// Drawn at random by each start. `[spec: LINK-4]`
    pub nonce: u64,
    /// A name for people, at most 64 bytes.
    pub name: String,
    /// The group's number, see [`group_key`].
    pub group: u32,
    /// What the graph is shown under.
    pub dictionary: Dictionary,
    /// When to do what.
    pub times: Times,
    /// How much of what.
    pub bounds: Bounds,
    /// What is broken on purpose.
    #[cfg(feature = "simulation")]
    pub flaw: Option<Flaw>,
}

/// When to do what, in nanoseconds.
#[derive(Clone, Debug)]
pub struct Times {
    /// How long an agent id is claimed before it is used. `[spec: LINK-15]`
    pub claim: u64,
    /// How long what is missing may still come by itself. `[spec: LINK-7]`
    pub reorder: u64,
    /// Up to how much is waited more, at random, so that one of many asks first. `[spec: LINK-7]`
    pub spread: u64,
    /// How long after its last part the rest of a message counts as missing. `[spec: LINK-7]`
    pub tail: u64,
    /// The least time between two answers to requests for the same part. `[spec: LINK-8]`
    pub guard: u64,
    /// The longest time between two requests. `[spec: LINK-7]`
    pub want_max: u64,
    /// The time from the last delta to the first beat; it doubles up to `beat`. `[spec: LINK-11]`
    pub beat_min: u64,
    /// The period of beats. `[spec: LINK-11]`
    pub beat: u64,
    /// After so long a peer that has said nothing is lost. `[spec: LINK-16]`
    pub lost: u64,
    /// How long fingerprints may differ. `[spec: LINK-12]`
    pub settle: u64,
    /// How long an exchange of digest and answer may make no progress. `[spec: LINK-12]`
    pub exchange: u64,
    /// The longest time for which a peer whose answer had nothing new is not asked. `[spec: LINK-12]`
    pub quiet_max: u64,
    /// How long an acknowledgement may wait for more to acknowledge. `[spec: LINK-10]`
    pub ack: u64,
    /// After how long without an acknowledgement the last part is sent again. `[spec: LINK-10]`
    pub probe: u64,
    /// After how long alone a session counts as synchronised. `[spec: LINK-14]`
    pub alone: u64,
}

/// How much of what.
#[derive(Clone, Debug)]
pub struct Bounds {
    /// The largest datagram. `[spec: LINK-1]`
    pub datagram_bytes: usize,
    /// What is sent in a second, deltas and answers together. `[spec: LINK-10]`
    pub bytes_per_second: u64,
    /// What may be sent at once. `[spec: LINK-10]`
    pub burst_bytes: u64,
    /// Deltas that have been sent and are kept for who asks. `[spec: LINK-8]`
    pub kept_bytes: usize,
    /// The same, as a number of messages.
    pub kept_messages: usize,
    /// Deltas that have not been sent yet; beyond it mutations are refused as busy. `[spec: LINK-10]`
    pub queued_bytes: usize,
    /// Parts of messages that are not complete, of all peers. `[spec: LINK-6]`
    pub begun_bytes: usize,
    /// The number of such messages of one stream.
    pub begun_messages: usize,
    /// Runs of numbers that are remembered as delivered, of one stream. `[spec: LINK-6]`
    pub runs: usize,
    /// Requests for the same before it is given up. `[spec: LINK-7]`
    pub wants: u32,
    /// Requests, beats and acknowledgements that wait to be sent.
    pub control: usize,
    /// Peers. `[spec: LINK-16]`
    pub peers: usize,
    /// Streams of one peer to this one that are not done.
    pub incoming: usize,
    /// Answers that are under way. `[spec: LINK-13]`
    pub answers: usize,
    /// What an answer may have sent and not acknowledged. `[spec: LINK-10]`
    pub window_bytes: u64,
    /// The size of the pieces of an answer. `[spec: SYNC-6]`
    pub piece_bytes: usize,
    /// Times that the last part is sent again before an answer is given up. `[spec: LINK-10]`
    pub probes: u32,
}

impl Config {
    /// The defaults, for a local network.
    pub fn new(replica: ReplicaId, nonce: u64, name: &str, group: &str, dictionary: Dictionary) -> Self {
        Self {
            replica,
            nonce,
            name: name.into(),
            group: group_key(group),
            dictionary,
            times: Times::default(),
            bounds: Bounds::default(),
            #[cfg(feature = "simulation")]
            flaw: None,
        }
    }
}

impl Config {
    #[cfg(feature = "simulation")]
    pub(crate) fn is_flawed(&self, flaw: Flaw) -> bool {
        self.flaw == Some(flaw)
    }

    /// Without simulations nothing is broken on purpose.
    #[cfg(not(feature = "simulation"))]
    #[allow(clippy::unused_self, reason = "asked of the configuration either way")]
    pub(crate) const fn is_flawed(&self, _flaw: Flaw) -> bool {
        false
    }
}

impl Default for Times {
    fn default() -> Self {
        Self {
            claim: 150 * MS,
            reorder: 2 * MS,
            spread: 4 * MS,
            tail: 10 * MS,
            guard: 2 * MS,
            want_max: 100 * MS,
            beat_min: 20 * MS,
            beat: SECOND,
            lost: 3500 * MS,
            settle: 100 * MS,
            exchange: 600 * MS,
            quiet_max: 4 * SECOND,
            ack: 2 * MS,
            probe: 50 * MS,
            alone: 300 * MS,
        }
    }
}

impl Default for Bounds {
    fn default() -> Self {
        Self {
            datagram_bytes: 1400,
            bytes_per_second: 200_000_000,
            burst_bytes: 256 << 10,
            kept_bytes: 64 << 20,
            kept_messages: 65_536,
            queued_bytes: 16 << 20,
            begun_bytes: 128 << 20,
            begun_messages: 256,
            runs: 4096,
            wants: 12,
            control: 4096,
            peers: 256,
            incoming: 8,
            answers: 16,
            window_bytes: 256 << 10,
            piece_bytes: 32 << 10,
            probes: 12,
        }
    }
}
