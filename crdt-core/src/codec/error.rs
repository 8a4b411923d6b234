//! Why bytes are refused.

use super::digest::MalformedDigest;
use crate::dot::ReplicaId;
use crate::limits;
use crate::wellformed::Malformed;

/// Why bytes are not the canonical encoding of a well-formed state or digest. Offsets count bytes from 0 and
/// name where the faulty part begins. `[spec: ENC-10]`
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DecodeError {
    /// More bytes than any state may have. `[spec: LIMIT-9]`
    #[error("{bytes} bytes; allowed are {}", limits::ENCODED_BYTES_MAX)]
    TooLong {
        /// How many.
        bytes: usize,
    },
    /// The first byte is not of this version.
    #[error("version {found}; this library reads version {}", super::VERSION)]
    Version {
        /// The version that it names.
        found: u8,
    },
    /// A number that says what follows is not one of those defined, or not the one asked for.
    #[error("at byte {offset}: {found} is no {what}")]
    Tag {
        /// Where.
        offset: usize,
        /// What it should say.
        what: &'static str,
        /// The number.
        found: u8,
    },
    /// The bytes end too early, or a declared length is more than what remains.
    #[error("at byte {offset}: {needed} more bytes are needed, {left} are left")]
    End {
        /// Where.
        offset: usize,
        /// How many are needed at least.
        needed: u64,
        /// How many there are.
        left: usize,
    },
    /// Bytes follow the end.
    #[error("at byte {offset}: {bytes} bytes follow the end")]
    Trailing {
        /// Where they begin.
        offset: usize,
        /// How many.
        bytes: usize,
    },
    /// A variable-length integer has a shorter spelling.
    #[error("at byte {offset}: the integer has a shorter spelling")]
    LongVarint {
        /// Where it begins.
        offset: usize,
    },
    /// An integer is over what its place can hold.
    #[error("at byte {offset}: {what} is over {max}")]
    TooGreat {
        /// Where it begins.
        offset: usize,
        /// What it is.
        what: &'static str,
        /// The greatest allowed.
        max: u64,
    },
    /// A sequence of 0, where the dot of an event must stand.
    #[error("at byte {offset}: sequence 0 names no event")]
    NoEvent {
        /// Where.
        offset: usize,
    },
    /// An index past the end of its table.
    #[error("at byte {offset}: {what} {index} of a table of {count}")]
    Index {
        /// Where.
        offset: usize,
        /// Of which table.
        what: &'static str,
        /// The index.
        index: u64,
        /// How many entries the table has.
        count: usize,
    },
    /// A table entry is not greater than the one before it.
    #[error("at byte {offset}: {what} {index} is not greater than the one before")]
    Unsorted {
        /// Where the entry begins.
        offset: usize,
        /// Of which table.
        what: &'static str,
        /// Which entry.
        index: usize,
    },
    /// A message's own table has a name of the static table. `[spec: ENC-6]`
    #[error("at byte {offset}: {name} needs no entry: it is name {index} of the static table")]
    Static {
        /// Where the entry begins.
        offset: usize,
        /// The name.
        name: &'static str,
        /// Its index in the static table.
        index: usize,
    },
    /// A record's dot lies beyond all that the context has seen of its replica. `[spec: ENC-8]`
    #[error(
        "at byte {offset}: {skip} dots of {replica} are passed over, and its context has seen no more after them"
    )]
    Unseen {
        /// Where the record begins.
        offset: usize,
        /// Whose dot it is.
        replica: ReplicaId,
        /// How many dots it passes over.
        skip: u64,
    },
    /// A table entry that nothing refers to.
    #[error("{what} {index} of the table is never used")]
    Unused {
        /// Of which table.
        what: &'static str,
        /// Which entry.
        index: usize,
    },
    /// A name is empty or too long. `[spec: LIMIT-2]`
    #[error("at byte {offset}: a name has {bytes} bytes; allowed are 1 to {}", limits::NAME_BYTES_MAX)]
    NameLength {
        /// Where.
        offset: usize,
        /// Its length.
        bytes: u64,
    },
    /// A text is not UTF-8.
    #[error("at byte {offset}: the text is not UTF-8")]
    NotUtf8 {
        /// Where the first bad byte is.
        offset: usize,
    },
    /// The bytes spell a state that is not well-formed.
    #[error(transparent)]
    Malformed(#[from] Malformed),
    /// The bytes spell a digest of no state.
    #[error(transparent)]
    MalformedDigest(#[from] MalformedDigest),
}
