//! The graph in a yrs document, the Rust port of Yjs.
//!
//! **Layout.** Maps in maps below three named roots, which yrs lets every replica make: `vertices` by handle, `edges` by
//! register, `root`. A vertex is a map with `type`, `name`, `attributes`, and a register `parent`; an edge is a map with
//! `from`, `label`, `to` and `attributes`. The register of an `RT` edge is its child's `parent`, so a child has one
//! parent; that of another edge is the key of `edges` that spells its source, label and target, without the target if
//! the label is functional.
//!
//! **Mutations.** `add_vertex` inserts the vertex and its link. `add_edge` inserts a new map into the register, which
//! replaces what the author has seen there. `update_attributes` inserts and removes entries. `remove_edge` removes the
//! register's entry: what is inserted concurrently stays. `move_edge` does both. `remove_vertex` removes the vertex's
//! entry, and with it all that is written inside, whenever. A group is one transaction.
//!
//! **Messages** are the updates of single transactions. yrs keeps what it cannot place yet until what it hangs on has come,
//! places the rest around the gap, and takes duplicates. What another replica lacks is asked by its state vector.
//! Messages are grouped by `merge_updates_v1`. Garbage collection is off (`skip_gc`): with it, yrs 0.28.1 fails on a
//! collected range that arrives over a gap.
//!
//! **Reading** takes the entries that yrs shows. Of concurrent inserts under one key that is the one of the greatest
//! client; the others are gone for good.

mod layout;
mod write;

pub use layout::YrsGraphError;

use crate::edit::Edit;
use crate::graph::Graph;
use crate::replica::{Identity, Message, Replica};
use dsr_conformance::protocol::Implementation;
use dsr_core::Dictionary;
use layout::{Result, Roots};
use yrs::updates::decoder::Decode;
use yrs::{ClientID, Doc, Options, ReadTxn, StateVector, Transact, Update, merge_updates_v1};

/// A replica in yrs.
#[derive(Debug)]
pub struct YrsGraph {
    document: Doc,
    roots: Roots,
    dictionary: Dictionary,
    identity: Identity,
}

impl YrsGraph {
    fn stored(&self) -> Vec<u8> {
        self.document.transact().encode_state_as_update_v1(&StateVector::default())
    }

    fn load(identity: Identity, dictionary: &Dictionary, stored: &[u8]) -> Result<Self> {
        let graph = Self::new(identity, dictionary)?;
        graph.document.transact_mut().apply_update(Update::decode_v1(stored)?)?;
        Ok(graph)
    }
}

impl Replica for YrsGraph {
    type Error = YrsGraphError;
    type Update = Vec<u8>;

    fn implementation() -> Implementation {
        Implementation {
            name: "yrs".into(),
            version: "0.28.1".into(),
            language: "Rust".into(),
            source: "https://github.com/y-crdt/y-crdt".into(),
        }
    }

    fn new(identity: Identity, dictionary: &Dictionary) -> Result<Self> {
        let mut options = Options::with_client_id(ClientID::new(identity.number()));
        options.skip_gc = true;
        let document = Doc::with_options(options);
        let roots = Roots::of(&document);
        Ok(Self { document, roots, dictionary: dictionary.clone(), identity })
    }

    fn graph(&self) -> Result<Graph> {
        self.roots.read(&self.document.transact())
    }

    fn trial(&self) -> Result<Self> {
        Self::load(self.identity, &self.dictionary, &self.stored())
    }

    fn write(&mut self, edits: &[Edit]) -> Result<Message> {
        let mut transaction = self.document.transact_mut();
        for edit in edits {
            self.roots.edit(&mut transaction, edit, &self.dictionary)?;
        }
        Ok(vec![transaction.encode_update_v1()])
    }

    fn deliver(&mut self, message: &Message) -> Result<()> {
        let mut transaction = self.document.transact_mut();
        for update in message {
            transaction.apply_update(Update::decode_v1(update)?)?;
        }
        Ok(())
    }

    fn missing(&self, other: &Self) -> Result<Message> {
        let theirs = other.document.transact().state_vector();
        Ok(vec![self.document.transact().encode_state_as_update_v1(&theirs)])
    }

    fn restart(&mut self, identity: Identity, keeps: bool) -> Result<()> {
        *self = if keeps {
            Self::load(identity, &self.dictionary, &self.stored())?
        } else {
            Self::new(identity, &self.dictionary)?
        };
        Ok(())
    }

    fn group(messages: &[&Message]) -> Result<Message> {
        Ok(vec![merge_updates_v1(messages.iter().copied().flatten())?])
    }
}
