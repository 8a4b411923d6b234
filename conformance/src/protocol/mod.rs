//! Requests and replies. `[spec: CONF-2]`

mod hex;
mod mutation;
mod need;
mod reply;
mod request;
mod strict;
mod unique;
mod value;
mod view;

pub use hex::Hex;
pub use mutation::{EdgeName, Link, Mutation};
pub use need::{Feature, Need, Profile};
pub use reply::{
    Answer, BytesShown, Decline, DigestShown, Done, ErrorCode, ErrorReply, Found, HelloReply, Implementation,
    Limits, MadeDelta, Reply, Shown, Skip, StateShown,
};
pub use request::{
    AnswerDigest, AnswerFor, CaseBegin, Command, Decode, Deliver, DeltaName, Group, Hello, Load, Lookup,
    Mutate, Read, ReplicaName, Request, Restart,
};
pub use strict::read_strictly;
pub use unique::Unique;
pub use value::Tagged;
pub use view::{EdgeView, RootView, VertexView, View};

/// The version of the protocol that this crate speaks. `[spec: CONF-3]`
pub const PROTOCOL: u32 = 1;
/// The most bytes that a line may have, its end excluded. `[spec: CONF-1]`
pub const LINE_BYTES_MAX: usize = 1 << 20;
/// The handle of the root. `[spec: CONF-5]`
pub const ROOT: &str = "root";
