//! How replicas of one group come to be equal whatever the network does: the protocol as a pure state machine.
//!
//! A [`Session`] owns a [`Replica`](dsr_core::Replica) and speaks for it. It is told of datagrams, of time and of
//! mutations, and says what to send and what has changed. It has no clock, no randomness of its own, no thread and
//! no socket, so the same code runs over any network, in a simulation, and in a checker.
//!
//! | room | what it does |
//! |---|---|
//! | [`wire`] | datagrams and their bytes |
//! | `outbox`, `inbox` | the two ends of a stream: parts, what is kept, what is missing |
//! | `pacing` | how much may be sent now |
//! | [`Session`] | one member: streams, requests, beats, digests, the agent id |
//! | [`memory`] | a network in memory, with faults |
//! | [`simulation`] | runs of many sessions over it, judged and shrunk |
//!
//! **Everything is a message, cut into parts.** A stream to the group carries the deltas of its origin; streams to
//! one peer carry a digest, or the answer to one. Both ends of either are the same code. What is lost is asked for
//! part by part (`[spec: LINK-7]`); what cannot be had that way any more is lacking by a digest (`[spec: LINK-12]`);
//! a joiner's snapshot is the answer to an empty digest (`[spec: LINK-14]`). So every bound on every buffer heals by
//! the same road.
//!
//! Promised, under the assumptions of `spec/network.md`: if the network delivers from some moment on, and nobody
//! writes, all members become equal (`[spec: LINK-18]`). Not promised: protection against forgery; that a claim of an
//! agent id is heard (so an incarnation must be new in any case); order of deltas, which needs none.
//!
//! There are no sockets here yet: who has some calls [`Session::handle`] with what they receive, and sends what
//! [`Session::poll_action`] says.
//!
//! ```
//! use dsr_core::{Dictionary, Mutation, NewVertex, ReplicaId, VertexId, VertexLink};
//! use dsr_transport::memory::{Faults, Network};
//! use dsr_transport::{Action, Config, Event, MS, Session};
//!
//! // Half of all that is sent gets lost.
//! let mut network = Network::new(2, 1, Faults { loss: 500, ..Faults::NONE });
//! let mut sessions: Vec<Session> = (1..=2)
//!     .map(|agent| {
//!         let config = Config::new(ReplicaId::agent(agent), agent.into(), "agent", "lab", Dictionary::open());
//!         Session::new(config, agent.into(), 0)
//!     })
//!     .collect();
//! for now in (0..3000).map(|ms| ms * MS) {
//!     while let Some((port, from, bytes)) = network.arrive(now) {
//!         sessions[port].handle(Event::Datagram { from, bytes: &bytes }, now);
//!     }
//!     if now == 1000 * MS {
//!         let vertex = NewVertex::new("room", "kitchen");
//!         let mutation = Mutation::AddVertex { vertex, link: VertexLink::child_of(VertexId::ROOT) };
//!         sessions[0].mutate(&mutation, 0, now)?;
//!     }
//!     for (port, session) in sessions.iter_mut().enumerate() {
//!         session.handle(Event::Tick, now);
//!         while let Some(action) = session.poll_action() {
//!             if let Action::Send { to, bytes } = action {
//!                 network.send(port, to, bytes, now);
//!             }
//!         }
//!     }
//! }
//! assert!(sessions[1].snapshot().vertex_by_name("kitchen").is_some());
//! assert_eq!(sessions[0].replica().fingerprint(), sessions[1].replica().fingerprint());
//! # Ok::<(), dsr_transport::MutateError>(())
//! ```

mod action;
mod config;
mod flaw;
mod inbox;
#[cfg(feature = "simulation")]
pub mod memory;
mod message;
mod origin;
mod outbox;
mod pacing;
mod runs;
mod session;
#[cfg(feature = "simulation")]
pub mod simulation;
mod stats;
pub mod wire;

pub use action::{Action, Cause, Event, MutateError, Presence, Refusal};
pub use config::{Bounds, Config, MS, SECOND, Times};
#[cfg(feature = "simulation")]
pub use flaw::Flaw;
pub use origin::{Address, Destination, Origin};
pub use session::Session;
pub use stats::Stats;
