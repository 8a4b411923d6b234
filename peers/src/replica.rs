//! A graph in a library's document: what each of the three mappings provides.

use crate::edit::Edit;
use crate::graph::Graph;
use dsr_conformance::protocol::{EdgeName, Feature, Implementation, Tagged};
use dsr_core::{Dictionary, RT};
use std::error::Error;
use std::fmt::Debug;

/// Which replica of a case, and how often it has restarted: every library gets its actor's id from these two, so that
/// a case runs alike each time.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Identity {
    /// Its place among the case's replicas, from 1.
    pub position: u32,
    /// How often it has restarted.
    pub incarnation: u32,
}

impl Identity {
    /// One number for both; ascending like the pair.
    pub fn number(self) -> u64 {
        const INCARNATIONS: u64 = 1 << 20;
        u64::from(self.position) * INCARNATIONS + u64::from(self.incarnation)
    }
}

/// What travels: updates, as the library encodes them if it does. A group has several, if the library has no form for
/// their union.
pub type Message<U = Vec<u8>> = Vec<U>;

/// One replica: a document of the library that holds the graph.
pub trait Replica: Sized {
    /// What can go wrong in the library, or with what is read back from it.
    type Error: Error;
    /// What travels.
    type Update: Clone + Debug;
    /// What it can do beyond the profile `observe`.
    const FEATURES: &'static [Feature] = &[
        Feature::Dictionary,
        Feature::ErrorKinds,
        Feature::Grouping,
        Feature::Restart,
        Feature::Resynchronisation,
    ];

    /// The library.
    fn implementation() -> Implementation;
    /// An empty graph. All replicas of a case share the dictionary.
    fn new(identity: Identity, dictionary: &Dictionary) -> Result<Self, Self::Error>;
    /// What it shows.
    fn graph(&self) -> Result<Graph, Self::Error>;
    /// A copy on which a group can be tried.
    fn trial(&self) -> Result<Self, Self::Error>;
    /// Writes a group in one transaction; returns what it is to the others.
    fn write(&mut self, edits: &[Edit]) -> Result<Message<Self::Update>, Self::Error>;
    /// Takes what another one has written.
    fn deliver(&mut self, message: &Message<Self::Update>) -> Result<(), Self::Error>;
    /// What `other` lacks of this one.
    fn missing(&self, other: &Self) -> Result<Message<Self::Update>, Self::Error>;
    /// Starts anew, under another identity, from what is stored of it; or, if it `keeps` nothing, from nothing.
    fn restart(&mut self, identity: Identity, keeps: bool) -> Result<(), Self::Error>;
    /// Whether an error is a refusal by the implementation, where the conditions of the specification hold.
    fn refuses(error: &Self::Error) -> bool {
        let _ = error;
        false
    }
    /// Several messages as one.
    fn group(messages: &[&Message<Self::Update>]) -> Result<Message<Self::Update>, Self::Error> {
        Ok(messages.iter().flat_map(|message| message.iter().cloned()).collect())
    }
}

/// The name of the register that an edge competes for, beyond kinematic ones: those of one key, or of one source and
/// functional label (STAMP-4).
pub(crate) fn register(edge: &EdgeName, dictionary: &Dictionary) -> String {
    let functional = edge.label != RT && dictionary.is_functional(&edge.label);
    let parts = [Some(&edge.from), Some(&edge.label), (!functional).then_some(&edge.to)];
    parts.into_iter().flatten().map(String::as_str).collect::<serde_json::Value>().to_string()
}

/// A value as text: the project's JSON of all fourteen types, which loses nothing (JSON-4 to JSON-6). A value is one
/// register, never merged within, so every library gets it as one text.
pub(crate) fn to_text(value: &Tagged) -> Result<String, serde_json::Error> {
    serde_json::to_string(value)
}

/// The value of a text.
pub(crate) fn of_text(text: &str) -> Result<Tagged, serde_json::Error> {
    serde_json::from_str(text)
}
