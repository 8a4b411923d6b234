//! The published semantics of the Deep State Representation, as a second implementation for the checker.
//!
//! It is written from a description of what the published implementation does, mistakes included, and shares
//! no code with it or with `dsr-core`. Everything is a pure function: clocks are given, nothing is read.
//!
//! | room | what |
//! |---|---|
//! | `context`, `register` | dots, what is known, one value that replicas overwrite |
//! | `graph` | attributes, edges and nodes as values of registers, and their wire form |
//! | `message` | what is broadcast, by topic |
//! | `replica`, `buffers` | one replica's graph, its indices, what it holds back |
//! | `operation`, `local` | what an agent may call, and what it broadcasts |
//! | `remote`, `remote_edges`, `snapshot` | what a replica does with what arrives |
//! | `setup`, `world`, `tables`, `space`, `machines` | several replicas and their network, as a space to search |
//! | `property` | what may break |
//! | `show`, `picture`, `json`, `explain` | events in words; for traces, what a replica shows, all of it, and why |
//! | `suite` | the same replicas behind the checker's trait, and what `dsr check` runs of them |

mod buffers;
mod context;
mod explain;
mod graph;
mod json;
mod local;
mod machines;
mod message;
mod operation;
mod picture;
mod property;
mod register;
mod remote;
mod remote_edges;
mod replica;
mod setup;
mod show;
mod snapshot;
mod space;
pub mod suite;
mod tables;
mod variant;
mod world;

pub use buffers::{Buffers, Held, HeldIncoming};
pub use context::{Context, Dot};
pub use graph::{Attribute, AttributeRegisters, Edge, Node, NodeName, Value};
pub use message::{EdgePart, Message, NodePart, Topic};
pub use operation::Operation;
pub use property::Property;
pub use register::{Payload, REGISTER_ID, Register};
pub use replica::{NodeCopy, Replica, Shown, ShownEdge, ShownNode};
pub use setup::{CALL_TIME, Guard, Joiner, Order, Play, Powers, REPLICAS_MAX, Setup, When};
pub use show::{Envelope, Happening};
pub use space::{Moment, Network};
pub use variant::{Stamps, Variant, Workers};
pub use world::{Event, Letter};

use std::fmt;

/// A node's identity. The published one is 64 bits of time, counter and agent; here it is given, and small.
pub type NodeId = u32;
/// An agent's number.
pub type AgentId = u32;
/// The agent of a replica that has called nothing yet: no message is its own.
pub const NOBODY: AgentId = AgentId::MAX;
/// A wall clock, in nanoseconds. Always given, never read.
pub type Time = u64;
/// The type of a node or of an edge.
pub type Kind = &'static str;
/// The name of an attribute.
pub type Key = &'static str;

/// What ends the process of the published implementation, or leaves it without a defined next step.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Crash {
    /// A register was read that is present and holds nothing: an assertion fails.
    EmptyRegister,
    /// A register held more than one value after a join: an assertion fails.
    SeveralValues,
}

impl fmt::Display for Crash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::EmptyRegister => "an empty register was read",
            Self::SeveralValues => "a register holds several values",
        })
    }
}
