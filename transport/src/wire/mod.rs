//! Datagrams: what they say, and their bytes. `[spec: LINK-3]`
//!
//! | bytes | meaning |
//! |---|---|
//! | 2 | `d5`, `52` |
//! | 1 | version, 1 |
//! | 8 | check: SipHash-2-4 of all that follows, keyed by the group |
//! | 4 | group |
//! | 4, 4, 8 | sender: agent, incarnation, nonce |
//! | rest | items, each a tag and its fields |
//!
//! Numbers of fixed size are little-endian; all others are varints, seven bits a byte, least first. The check
//! finds damage (NET-4), and strangers who do not know the group; it is no protection against an adversary.

mod decode;
mod encode;
mod error;
mod reader;

pub(crate) use encode::{begin, finish};
pub use error::WireError;

use crate::origin::Origin;
use siphasher::sip::SipHasher24;
use std::hash::Hasher;

/// What every datagram begins with.
const MAGIC: [u8; 2] = [0xd5, 0x52];
/// The version of this layout.
const VERSION: u8 = 1;
/// Bytes before the items.
pub const HEADER_BYTES: usize = 2 + 1 + 8 + 4 + 4 + 4 + 8;
/// What a part costs besides its bytes, at most: tag, stream, nonce, number, index, count, total, length.
pub const PART_BYTES: usize = 1 + 5 + 8 + 10 + 5 + 5 + 5 + 3;
/// The longest name of a session, in bytes.
pub const NAME_BYTES_MAX: usize = 64;
/// The most runs that one request names, of messages and of parts together.
pub const WANTED_MAX: usize = 96;
/// The largest message: a delta of one value of the greatest size, with room for the rest of its record.
pub const MESSAGE_BYTES_MAX: usize = dsr_core::limits::VALUE_BYTES_MAX + (1 << 20);
/// The most parts of one message.
const PARTS_MAX: u32 = 1 << 24;

/// The stream of deltas that goes to the group. `[spec: LINK-4]`
pub const GROUP_STREAM: u32 = 0;

/// A datagram.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Datagram {
    /// Who sends.
    pub sender: Origin,
    /// What it says, in order.
    pub items: Vec<Item>,
}

/// One thing that a datagram says.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Item {
    /// A message or a part of one. `[spec: LINK-5]`
    Part(Part),
    /// A request for what is missing. `[spec: LINK-7]`
    Want {
        /// Whose stream.
        origin: Origin,
        /// Which.
        stream: u32,
        /// What is missing.
        missing: Vec<Missing>,
    },
    /// What was asked for is no longer kept. `[spec: LINK-9]`
    Gone {
        /// Which of the sender's streams.
        stream: u32,
        /// Everything below this number.
        below: u64,
    },
    /// What has arrived of a stream that goes to one peer. `[spec: LINK-10]`
    Ack {
        /// Which of the receiver's streams.
        stream: u32,
        /// Everything below this number has been delivered; the greatest number there is once the stream is done.
        below: u64,
        /// How many bytes of messages have arrived, each counted once.
        received: u64,
    },
    /// I am here, and this is how far I am. `[spec: LINK-11]`
    Beat {
        /// The highest number of the group stream that exists; 0 if none.
        high: u64,
        /// The lowest that is still kept.
        oldest: u64,
        /// The fingerprint of the state, if it is known.
        fingerprint: Option<u128>,
        /// The sender's name.
        name: String,
    },
    /// I am about to use this agent id. `[spec: LINK-15]`
    Hello {
        /// The sender's name.
        name: String,
    },
    /// The agent id is mine. `[spec: LINK-15]`
    Object {
        /// To whom it is said.
        to: Origin,
        /// The owner's name.
        name: String,
    },
    /// I leave. `[spec: LINK-16]`
    Bye,
}

/// A part of a message; most messages have one. `[spec: LINK-5]`
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Part {
    /// Which stream of the sender.
    pub stream: u32,
    /// The nonce of the peer that the stream goes to; 0 for the group.
    pub to: u64,
    /// The number of the message, from 1.
    pub number: u64,
    /// Which part, from 0.
    pub index: u32,
    /// How many parts there are, at least 1.
    pub count: u32,
    /// The bytes of the whole message, at least 1.
    pub total: u32,
    /// The bytes of this part.
    pub bytes: Vec<u8>,
}

/// What is missing of a stream: messages from `first` to `last`, or, if parts are named, these of one message.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Missing {
    /// The first number.
    pub first: u64,
    /// The last number, counted.
    pub last: u64,
    /// Runs of parts, both ends counted; empty for whole messages.
    pub parts: Vec<(u32, u32)>,
}

/// Where a part begins in its message, and where it ends: all parts but the last are equally long.
/// `[spec: LINK-5]`
pub fn part_bounds(total: u32, count: u32, index: u32) -> Option<(usize, usize)> {
    if count == 0 || index >= count || total < count || count > PARTS_MAX {
        return None;
    }
    let size = total.div_ceil(count);
    let first = size.checked_mul(index).filter(|&first| first < total)?;
    let end = first.saturating_add(size).min(total);
    Some((usize::try_from(first).ok()?, usize::try_from(end).ok()?))
}

/// In how many parts of at most `size` bytes a message is sent. `[spec: LINK-5]`
pub fn part_count(total: u32, size: u32) -> u32 {
    let count = total.div_ceil(size.max(1)).max(1);
    // Equal sizes may need fewer.
    total.div_ceil(total.div_ceil(count).max(1)).max(1)
}

/// The group's number: a hash of its name. `[spec: LINK-3]`
pub fn group_key(name: &str) -> u32 {
    let mut hasher = SipHasher24::new_with_keys(0, 0);
    hasher.write(name.as_bytes());
    let [a, b, c, d, ..] = hasher.finish().to_le_bytes();
    u32::from_le_bytes([a, b, c, d])
}

/// The check of a datagram's rest.
fn check_of(group: u32, rest: &[u8]) -> u64 {
    let mut hasher = SipHasher24::new_with_keys(u64::from(group), u64::from(VERSION));
    hasher.write(rest);
    hasher.finish()
}
