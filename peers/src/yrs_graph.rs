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

use crate::edit::{Edit, Target};
use crate::graph::{Attributes, Graph, Vertex};
use crate::replica::{Identity, Message, Replica, of_text, register, to_text};
use dsr_conformance::protocol::{EdgeName, Implementation, ROOT};
use dsr_core::{Dictionary, RT};
use yrs::updates::decoder::Decode;
use yrs::{
    Any, ClientID, Doc, Map, MapPrelim, MapRef, Options, Out, ReadTxn, StateVector, Transact, TransactionMut,
    Update, merge_updates_v1,
};

/// What goes wrong.
#[derive(Debug, thiserror::Error)]
pub enum YrsGraphError {
    /// Bytes are no update.
    #[error("not an update: {0}")]
    Decode(#[from] yrs::encoding::read::Error),
    /// An update cannot be applied.
    #[error(transparent)]
    Update(#[from] yrs::error::UpdateError),
    /// A text is no value.
    #[error("not a value: {0}")]
    Value(#[from] serde_json::Error),
    /// The document is not as this module lays it out.
    #[error("{0:?} is not where it should be in the document")]
    Layout(String),
}

type Result<T> = std::result::Result<T, YrsGraphError>;

/// A replica in yrs.
#[derive(Debug)]
pub struct YrsGraph {
    document: Doc,
    roots: Roots,
    dictionary: Dictionary,
    identity: Identity,
}

#[derive(Clone, Debug)]
struct Roots {
    vertices: MapRef,
    edges: MapRef,
    root: MapRef,
}

fn map(parent: &MapRef, transaction: &impl ReadTxn, key: &str) -> Result<MapRef> {
    match parent.get(transaction, key) {
        Some(Out::YMap(map)) => Ok(map),
        _ => Err(YrsGraphError::Layout(key.into())),
    }
}

fn text(parent: &MapRef, transaction: &impl ReadTxn, key: &str) -> Result<String> {
    match parent.get(transaction, key) {
        Some(Out::Any(Any::String(text))) => Ok(text.to_string()),
        _ => Err(YrsGraphError::Layout(key.into())),
    }
}

fn keys(map: &MapRef, transaction: &impl ReadTxn) -> Vec<String> {
    let mut keys: Vec<String> = map.keys(transaction).map(String::from).collect();
    keys.sort_unstable();
    keys
}

fn attributes(element: &MapRef, transaction: &impl ReadTxn) -> Result<Attributes> {
    let names = keys(element, transaction).into_iter();
    names.map(|name| Ok((name.clone(), of_text(&text(element, transaction, &name)?)?))).collect()
}

fn edge(element: &MapRef, transaction: &impl ReadTxn) -> Result<EdgeName> {
    let part = |key| text(element, transaction, key);
    Ok(EdgeName { from: part("from")?, label: part("label")?, to: part("to")? })
}

fn fill(element: &MapRef, transaction: &mut TransactionMut<'_>, attributes: &Attributes) -> Result<()> {
    let map = element.insert(transaction, "attributes", MapPrelim::default());
    for (name, value) in attributes {
        map.insert(transaction, name.as_str(), to_text(value)?);
    }
    Ok(())
}

impl Roots {
    fn of(document: &Doc) -> Self {
        Self {
            vertices: document.get_or_insert_map("vertices"),
            edges: document.get_or_insert_map("edges"),
            root: document.get_or_insert_map("root"),
        }
    }

    fn read(&self, transaction: &impl ReadTxn) -> Result<Graph> {
        let mut graph = Graph { root: attributes(&self.root, transaction)?, ..Graph::default() };
        let mut claims = Vec::new();
        for handle in keys(&self.vertices, transaction) {
            let held = map(&self.vertices, transaction, &handle)?;
            let vertex = Vertex {
                vertex_type: text(&held, transaction, "type")?,
                name: text(&held, transaction, "name")?,
                attributes: attributes(&map(&held, transaction, "attributes")?, transaction)?,
            };
            if held.contains_key(transaction, "parent") {
                claims.push(map(&held, transaction, "parent")?);
            }
            graph.vertices.insert(handle, vertex);
        }
        for key in keys(&self.edges, transaction) {
            claims.push(map(&self.edges, transaction, &key)?);
        }
        for claim in claims {
            let held = attributes(&map(&claim, transaction, "attributes")?, transaction)?;
            graph.show(edge(&claim, transaction)?, held);
        }
        Ok(graph)
    }

    /// Where the register of an edge is.
    fn place(
        &self,
        transaction: &impl ReadTxn,
        edge: &EdgeName,
        dictionary: &Dictionary,
    ) -> Result<(MapRef, String)> {
        if edge.label == RT {
            Ok((map(&self.vertices, transaction, &edge.to)?, "parent".into()))
        } else {
            Ok((self.edges.clone(), register(edge, dictionary)))
        }
    }

    fn attributes_of(
        &self,
        transaction: &impl ReadTxn,
        target: &Target,
        dictionary: &Dictionary,
    ) -> Result<MapRef> {
        match target {
            Target::Vertex(handle) if handle == ROOT => Ok(self.root.clone()),
            Target::Vertex(handle) => {
                map(&map(&self.vertices, transaction, handle)?, transaction, "attributes")
            }
            Target::Edge(edge) => {
                let (holder, key) = self.place(transaction, edge, dictionary)?;
                map(&map(&holder, transaction, &key)?, transaction, "attributes")
            }
        }
    }

    fn edit(&self, transaction: &mut TransactionMut<'_>, edit: &Edit, dictionary: &Dictionary) -> Result<()> {
        match edit {
            Edit::AddVertex { handle, vertex_type, name, attributes, link, link_attributes } => {
                let vertex = self.vertices.insert(transaction, handle.as_str(), MapPrelim::default());
                vertex.insert(transaction, "type", vertex_type.as_str());
                vertex.insert(transaction, "name", name.as_str());
                fill(&vertex, transaction, attributes)?;
                self.claim(transaction, link, link_attributes, dictionary)
            }
            Edit::AddEdge { edge, attributes } => self.claim(transaction, edge, attributes, dictionary),
            Edit::Update { target, updates } => {
                let map = self.attributes_of(transaction, target, dictionary)?;
                for (name, value) in updates {
                    match value {
                        Some(value) => {
                            map.insert(transaction, name.as_str(), to_text(value)?);
                        }
                        None => {
                            map.remove(transaction, name);
                        }
                    }
                }
                Ok(())
            }
            Edit::RemoveEdge { edge } => self.free(transaction, edge, dictionary),
            Edit::MoveEdge { old, new, attributes } => {
                self.free(transaction, old, dictionary)?;
                self.claim(transaction, new, attributes, dictionary)
            }
            Edit::RemoveVertex { handle } => {
                self.vertices.remove(transaction, handle);
                Ok(())
            }
        }
    }

    fn claim(
        &self,
        transaction: &mut TransactionMut<'_>,
        edge: &EdgeName,
        attributes: &Attributes,
        dictionary: &Dictionary,
    ) -> Result<()> {
        let (holder, key) = self.place(transaction, edge, dictionary)?;
        let held = holder.insert(transaction, key, MapPrelim::default());
        for (key, part) in [("from", &edge.from), ("label", &edge.label), ("to", &edge.to)] {
            held.insert(transaction, key, part.as_str());
        }
        fill(&held, transaction, attributes)
    }

    fn free(
        &self,
        transaction: &mut TransactionMut<'_>,
        edge: &EdgeName,
        dictionary: &Dictionary,
    ) -> Result<()> {
        let (holder, key) = self.place(transaction, edge, dictionary)?;
        holder.remove(transaction, &key);
        Ok(())
    }
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
