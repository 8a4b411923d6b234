//! The graph in an automerge document.
//!
//! **Layout.** Maps in maps, from a first change that all replicas share, as automerge's own guide has it for objects
//! that several replicas write: `vertices` by handle, `edges` by register, `root`. A vertex is an object with `type`,
//! `name`, `attributes`, and a register `parent`; an edge is an object with `from`, `label`, `to` and `attributes`.
//! The register of an `RT` edge is its child's `parent`, so a child has one parent; that of another edge is the key
//! of `edges` that spells its source, label and target, without the target if the label is functional.
//!
//! **Mutations.** `add_vertex` puts the vertex and its link. `add_edge` puts a new object into the register, which
//! replaces what the author has seen there. `update_attributes` puts and deletes entries. `remove_edge` deletes the
//! register's entry: automerge's map lets a concurrent put survive. `move_edge` does both. `remove_vertex` deletes the
//! vertex's entry, and with it all that is written inside, whenever. A group is one transaction. Whatever competes for a
//! register is the first operation of its mutation: automerge orders by operations, so that after equal histories the
//! actor decides, and not how much else a mutation writes.
//!
//! **Messages** are changes, by their bytes; automerge holds back those whose causes have not come, and takes
//! duplicates. What another replica lacks is asked by hashes; if something is held back, the whole document is sent with it.
//!
//! **Reading** takes, of concurrent puts, automerge's winner among those whose ends are there (`get_all`), and of
//! concurrent writes automerge's winner.

mod layout;
mod write;

pub use layout::AutomergeGraphError;

use crate::edit::Edit;
use crate::graph::Graph;
use crate::replica::{Identity, Message, Replica};
use automerge::{Automerge, ReadDoc};
use dsr_conformance::protocol::Implementation;
use dsr_core::Dictionary;
use layout::{Result, actor, genesis, read};
use write::Writer;

/// A replica in automerge.
#[derive(Clone, Debug)]
pub struct AutomergeGraph {
    document: Automerge,
    dictionary: Dictionary,
}

impl Replica for AutomergeGraph {
    type Error = AutomergeGraphError;
    type Update = Vec<u8>;

    fn implementation() -> Implementation {
        Implementation {
            name: "automerge".into(),
            version: "0.12.0".into(),
            language: "Rust".into(),
            source: "https://github.com/automerge/automerge".into(),
        }
    }

    fn new(identity: Identity, dictionary: &Dictionary) -> Result<Self> {
        let document = genesis()?.with_actor(actor(identity));
        Ok(Self { document, dictionary: dictionary.clone() })
    }

    fn graph(&self) -> Result<Graph> {
        read(&self.document)
    }

    fn trial(&self) -> Result<Self> {
        Ok(self.clone())
    }

    fn write(&mut self, edits: &[Edit]) -> Result<Message> {
        let hash = {
            let mut writer = Writer { document: self.document.transaction(), dictionary: &self.dictionary };
            edits.iter().try_for_each(|edit| writer.edit(edit))?;
            writer.document.commit().0
        };
        let change = hash.and_then(|hash| self.document.get_change_by_hash(&hash));
        Ok(change.map(|change| change.raw_bytes().to_vec()).into_iter().collect())
    }

    fn deliver(&mut self, message: &Message) -> Result<()> {
        for chunk in message {
            self.document.load_incremental(chunk)?;
        }
        Ok(())
    }

    fn missing(&self, other: &Self) -> Result<Message> {
        if !self.document.get_missing_deps(&[]).is_empty() {
            // What waits is no change of the document yet, and travels only with the whole of it.
            return Ok(vec![self.document.save()]);
        }
        let changes = other.document.get_changes_added(&self.document);
        Ok(changes.iter().map(|change| change.raw_bytes().to_vec()).collect())
    }

    fn restart(&mut self, identity: Identity, keeps: bool) -> Result<()> {
        let document = if keeps { Automerge::load(&self.document.save())? } else { genesis()? };
        self.document = document.with_actor(actor(identity));
        Ok(())
    }
}
