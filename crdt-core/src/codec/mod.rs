//! The canonical binary encoding of states, deltas and digests. `[spec: ENC-1]`
//!
//! Equal states have equal bytes, and every accepted byte string is what [`encode`] writes for the state
//! that it spells: `encode(&decode(b)?) == b`. Decoding takes any bytes: it never panics, checks every
//! declared length against the bytes that remain before it reserves anything, and accepts only states
//! that are well-formed. The layout is normative in `spec/encoding.md`.
//!
//! Not promised: that bytes of one version are read by another, or that they were not tampered with.
//!
//! ```
//! # use dsr_core::*;
//! let dictionary = Dictionary::open();
//! let nothing = State::new();
//! let author = Author::new(ReplicaId::agent(1));
//! let link = VertexLink::child_of(VertexId::ROOT);
//! let delta = add_vertex(&view(&nothing, &dictionary), author, &NewVertex::new("room", "kitchen"), &link)?;
//! let bytes = encode(&delta);
//! assert_eq!(bytes.len(), 28);
//! assert_eq!(decode(&bytes).as_ref(), Ok(&delta));
//! # Ok::<(), AddVertexError>(())
//! ```

mod digest;
mod error;
mod names;
mod reader;
mod record;
mod replicas;
mod runs;
mod seen;
mod state;
mod value;
mod vocabulary;
mod writer;
mod zigzag;

pub use digest::{MalformedDigest, check_digest, decode_digest, encode_digest};
pub use error::DecodeError;
pub use state::{decode, encode};

/// The low half of the first byte of everything encoded. `[spec: ENC-2]`
const VERSION: u8 = 2;
/// The high half of the first byte: a state or a delta. `[spec: ENC-2]`
const KIND_STATE: u8 = 0;
/// The high half of the first byte: a digest. `[spec: ENC-2]`
const KIND_DIGEST: u8 = 1;
