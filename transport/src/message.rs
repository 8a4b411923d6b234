//! What a message holds: its bytes, then one that says what they are. `[spec: LINK-5]`

use dsr_core::{DecodeError, Delta, Digest, decode, decode_digest, encode, encode_digest};

/// A message.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Message {
    /// A delta, or a piece of an answer.
    Delta(Delta),
    /// A digest: a request for what its sender lacks. `[spec: LINK-12]`
    Digest(Digest),
    /// The end of the answer to the digest on this stream of the receiver. `[spec: LINK-13]`
    End(u32),
}

const DELTA: u8 = 0;
const DIGEST: u8 = 1;
const END: u8 = 2;

/// Why a message is refused.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub(crate) enum MessageError {
    #[error("no kind of message: {0:?}")]
    Kind(Option<u8>),
    #[error(transparent)]
    Decode(#[from] DecodeError),
}

impl Message {
    pub(crate) fn encode(&self) -> Vec<u8> {
        let (kind, mut bytes) = match self {
            Self::Delta(delta) => (DELTA, encode(delta)),
            Self::Digest(digest) => (DIGEST, encode_digest(digest)),
            Self::End(stream) => (END, stream.to_le_bytes().to_vec()),
        };
        // At the end, so that nothing is moved.
        bytes.push(kind);
        bytes
    }

    pub(crate) fn decode(bytes: &[u8]) -> Result<Self, MessageError> {
        match bytes {
            [rest @ .., DELTA] => Ok(Self::Delta(decode(rest)?)),
            [rest @ .., DIGEST] => Ok(Self::Digest(decode_digest(rest)?)),
            &[a, b, c, d, END] => Ok(Self::End(u32::from_le_bytes([a, b, c, d]))),
            _ => Err(MessageError::Kind(bytes.last().copied())),
        }
    }
}
