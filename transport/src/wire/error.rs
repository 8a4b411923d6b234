//! Why a datagram is refused.

/// Why bytes are no datagram of this group. Offsets count bytes from 0. `[spec: LINK-3]`
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WireError {
    /// It does not begin as datagrams of this protocol do.
    #[error("no datagram of this protocol")]
    Magic,
    /// Another version.
    #[error("version {found}; this library speaks version {}", super::VERSION)]
    Version {
        /// The byte.
        found: u8,
    },
    /// The check does not fit: damaged, cut off, or of another group.
    #[error("the check does not fit: damaged, or of another group")]
    Check,
    /// Another group, though the check fits.
    #[error("group {found:08x}; this session is in {expected:08x}")]
    Group {
        /// The datagram's.
        found: u32,
        /// Ours.
        expected: u32,
    },
    /// The bytes end too early, or a declared length is more than what remains.
    #[error("at byte {offset}: {what} needs {needed} more bytes, {left} are left")]
    End {
        /// Where.
        offset: usize,
        /// What is read.
        what: &'static str,
        /// How many are needed at least.
        needed: u64,
        /// How many there are.
        left: usize,
    },
    /// A tag that is not defined.
    #[error("at byte {offset}: {found} is no item")]
    Tag {
        /// Where.
        offset: usize,
        /// The byte.
        found: u8,
    },
    /// A number outside what its place allows.
    #[error("at byte {offset}: {what} is {found}; allowed are {min} to {max}")]
    Range {
        /// Where.
        offset: usize,
        /// What.
        what: &'static str,
        /// The number.
        found: u64,
        /// The least allowed.
        min: u64,
        /// The greatest allowed.
        max: u64,
    },
    /// The length of a part is not what its place in the message says.
    #[error("at byte {offset}: part {index} of {count} of {total} bytes cannot have {found} bytes")]
    PartLength {
        /// Where.
        offset: usize,
        /// Which part.
        index: u32,
        /// Of how many.
        count: u32,
        /// The message's bytes.
        total: u32,
        /// The part's bytes.
        found: usize,
    },
    /// A name is not UTF-8.
    #[error("at byte {offset}: the name is not UTF-8")]
    NotUtf8 {
        /// Where it begins.
        offset: usize,
    },
}
