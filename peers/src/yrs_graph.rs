//! The graph in a yrs document, the Rust port of Yjs.
//!
//! **Layout.** Maps in maps below four named roots, which yrs lets every replica make. `vertices` has by handle a map with
//! `type`, `name` and `attributes`. `edges` has every edge under an id of its own, never used again: a map with `from`,
//! `label`, `to` and `attributes`. `shown` has for each register the id of its edge. The register of an `RT` edge is its
//! child, so a child has one parent; that of another edge is its source, label and target, without the target if the
//! label is functional. `root` has the root's attributes.
//!
//! **Mutations.** `add_vertex` inserts the vertex and its link. `add_edge` removes the register's edges that the author
//! holds, inserts one, and names it in `shown`. `update_attributes` inserts and removes entries. `remove_edge` removes
//! the register's edges that the author holds: what is inserted concurrently stays. `move_edge` does both.
//! `remove_vertex` removes the vertex's entry, and with it all that is written inside, whenever. A group is one
//! transaction.
//!
//! **Messages** are the updates of single transactions. yrs keeps what it cannot place yet until what it hangs on has come,
//! places the rest around the gap, and takes duplicates. To whom lacks something
//! the whole document is sent: a difference by state vectors leaves out what has been placed behind a gap.
//! Messages are grouped by `merge_updates_v1`. Garbage collection is off (`skip_gc`): with it, yrs 0.28.1 fails on a
//! collected range that arrives over a gap.
//!
//! **Reading** takes the entries that yrs shows; of concurrent inserts under one key that is the one of the greatest
//! client. If the edge that `shown` names is gone, or an end of it, another edge of the register is shown, if one is
//! left.

mod layout;
mod write;

pub use layout::YrsGraphError;

use crate::edit::Edit;
use crate::graph::Graph;
use crate::replica::{Identity, Message, Replica};
use dsr_conformance::protocol::Implementation;
use dsr_core::Dictionary;
use layout::{Result, Roots};
use write::Writer;
use yrs::updates::decoder::Decode;
use yrs::{ClientID, Doc, Options, ReadTxn, StateVector, Transact, Update, merge_updates_v1};

/// A replica in yrs.
#[derive(Debug)]
pub struct YrsGraph {
    document: Doc,
    roots: Roots,
    dictionary: Dictionary,
    identity: Identity,
    /// How many edges it has made.
    made: u64,
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
        Ok(Self { document, roots, dictionary: dictionary.clone(), identity, made: 0 })
    }

    fn graph(&self) -> Result<Graph> {
        self.roots.read(&self.document.transact(), &self.dictionary)
    }

    fn trial(&self) -> Result<Self> {
        let trial = Self::load(self.identity, &self.dictionary, &self.stored())?;
        Ok(Self { made: self.made, ..trial })
    }

    fn write(&mut self, edits: &[Edit]) -> Result<Message> {
        let mut writer = Writer {
            roots: &self.roots,
            transaction: self.document.transact_mut(),
            dictionary: &self.dictionary,
            author: self.identity.number(),
            made: self.made,
        };
        edits.iter().try_for_each(|edit| writer.edit(edit))?;
        self.made = writer.made;
        Ok(vec![writer.transaction.encode_update_v1()])
    }

    fn deliver(&mut self, message: &Message) -> Result<()> {
        let mut transaction = self.document.transact_mut();
        for update in message {
            transaction.apply_update(Update::decode_v1(update)?)?;
        }
        Ok(())
    }

    fn missing(&self, _other: &Self) -> Result<Message> {
        Ok(vec![self.stored()])
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
