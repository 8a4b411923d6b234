//! The Deep State Representation as a pure δ-CRDT: a causal set of dotted records, six δ-mutations, and a
//! view that keeps the graph's invariants whatever the network delivers, in whatever order, how often.
//!
//! ```
//! use dsr_core::{Author, Dictionary, NewVertex, ReplicaId, State, VertexId, VertexLink, add_vertex, view};
//!
//! let dictionary = Dictionary::open().with_functional("in");
//! let mut here = State::new();
//! let author = Author::new(ReplicaId::agent(1));
//! let delta = add_vertex(
//!     &view(&here, &dictionary),
//!     author,
//!     &NewVertex::new("room", "kitchen"),
//!     &VertexLink::child_of(VertexId::ROOT),
//! )?;
//! here.join(&delta);
//!
//! let mut there = State::new();
//! there.join(&delta);
//! there.join(&delta); // twice is once
//! assert_eq!(here, there);
//! assert!(view(&there, &dictionary).vertex_by_name("kitchen").is_some());
//! # Ok::<(), dsr_core::AddVertexError>(())
//! ```
//!
//! The clauses in square brackets are those of the specification in `spec/`. No I/O, clock, randomness,
//! thread or hash order: equal inputs give equal outputs, byte for byte.

#![no_std]
#![forbid(unsafe_code)]

extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

#[cfg(feature = "arbitrary")]
mod arbitrary;
mod changes;
mod cloud;
mod codec;
mod context;
mod dictionary;
mod digest;
mod dot;
pub mod invariant;
#[cfg(feature = "serde")]
pub mod json;
pub mod limits;
mod mutation;
mod pieces;
mod record;
mod replica;
#[cfg(feature = "serde")]
pub mod scene;
mod state;
mod value;
mod view;
mod wellformed;

pub use changes::{Change, Changes};
pub use codec::{DecodeError, MalformedDigest, check_digest, decode, decode_digest, encode, encode_digest};
pub use context::{CausalContext, Run, runs_of};
pub use dictionary::Dictionary;
pub use digest::{Digest, Fingerprint, delta_for, digest, fingerprint};
pub use dot::{Dot, EdgeId, ParseDotError, ReplicaId, VertexId};
pub use mutation::*;
pub use record::{Edge, EdgeKey, Name, RT, Rank, Record, Vertex, Write};
pub use replica::{Graph, Mutated, Replica, Shown};
pub use state::{Delta, State};
pub use value::{Value, ValueType};
pub use view::{Placement, Repair, Rule, ShownEdge, Shows, View, view};
pub use wellformed::{Malformed, check_well_formed};
