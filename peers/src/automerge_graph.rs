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
//! duplicates. What another replica lacks is asked by hashes.
//!
//! **Reading** takes, of concurrent puts, automerge's winner among those whose ends are there (`get_all`), and of
//! concurrent writes automerge's winner.

use crate::edit::{Edit, Target};
use crate::graph::{Attributes, Graph, Vertex};
use crate::replica::{Identity, Message, Replica, of_text, register, to_text};
use automerge::transaction::Transactable;
use automerge::{
    ActorId, Automerge, AutomergeError, Change, LoadChangeError, ObjId, ObjType, ROOT as DOCUMENT, ReadDoc,
    Value,
};
use dsr_conformance::protocol::{EdgeName, Implementation, ROOT};
use dsr_core::{Dictionary, RT};

/// What goes wrong.
#[derive(Debug, thiserror::Error)]
pub enum AutomergeGraphError {
    /// In automerge.
    #[error(transparent)]
    Automerge(#[from] AutomergeError),
    /// Bytes are no change.
    #[error("not a change: {0}")]
    Change(#[from] LoadChangeError),
    /// A text is no value.
    #[error("not a value: {0}")]
    Value(#[from] serde_json::Error),
    /// The document is not as this module lays it out.
    #[error("{0:?} is not where it should be in the document")]
    Layout(String),
}

type Result<T> = std::result::Result<T, AutomergeGraphError>;

/// A replica in automerge.
#[derive(Clone, Debug)]
pub struct AutomergeGraph {
    document: Automerge,
    dictionary: Dictionary,
}

fn actor(identity: Identity) -> ActorId {
    ActorId::from(identity.number().to_be_bytes().as_slice())
}

/// The first change, the same everywhere.
fn genesis() -> Result<Automerge> {
    let mut document = Automerge::new().with_actor(actor(Identity { position: 0, incarnation: 0 }));
    let mut transaction = document.transaction();
    for key in ["vertices", "edges", "root"] {
        transaction.put_object(DOCUMENT, key, ObjType::Map)?;
    }
    transaction.commit();
    Ok(document)
}

fn object(document: &impl ReadDoc, parent: &ObjId, key: &str) -> Result<ObjId> {
    match document.get(parent, key)? {
        Some((Value::Object(_), id)) => Ok(id),
        _ => Err(AutomergeGraphError::Layout(key.into())),
    }
}

fn text(document: &impl ReadDoc, parent: &ObjId, key: &str) -> Result<String> {
    let found = document.get(parent, key)?;
    let text = found.and_then(|(value, _)| value.as_str().map(String::from));
    text.ok_or_else(|| AutomergeGraphError::Layout(key.into()))
}

fn attributes(document: &impl ReadDoc, map: &ObjId) -> Result<Attributes> {
    let keys = document.keys(map);
    keys.map(|name| Ok((name.clone(), of_text(&text(document, map, &name)?)?))).collect()
}

/// Where the register of an edge is.
fn place(document: &impl ReadDoc, edge: &EdgeName, dictionary: &Dictionary) -> Result<(ObjId, String)> {
    if edge.label == RT {
        let vertices = object(document, &DOCUMENT, "vertices")?;
        Ok((object(document, &vertices, &edge.to)?, "parent".into()))
    } else {
        Ok((object(document, &DOCUMENT, "edges")?, register(edge, dictionary)))
    }
}

/// The edge that a register shows: the last of its concurrent objects, in automerge's order, whose ends are there.
fn shown(
    document: &impl ReadDoc,
    graph: &Graph,
    map: &ObjId,
    key: &str,
) -> Result<Option<(EdgeName, ObjId)>> {
    for (_, id) in document.get_all(map, key)?.into_iter().rev() {
        let part = |key| text(document, &id, key);
        let edge = EdgeName { from: part("from")?, label: part("label")?, to: part("to")? };
        if graph.has(&edge.from) && graph.has(&edge.to) {
            return Ok(Some((edge, id)));
        }
    }
    Ok(None)
}

fn read(document: &impl ReadDoc) -> Result<Graph> {
    let mut graph =
        Graph { root: attributes(document, &object(document, &DOCUMENT, "root")?)?, ..Graph::default() };
    let vertices = object(document, &DOCUMENT, "vertices")?;
    for handle in document.keys(&vertices) {
        let id = object(document, &vertices, &handle)?;
        let vertex = Vertex {
            vertex_type: text(document, &id, "type")?,
            name: text(document, &id, "name")?,
            attributes: attributes(document, &object(document, &id, "attributes")?)?,
        };
        graph.vertices.insert(handle, vertex);
    }
    let edges = object(document, &DOCUMENT, "edges")?;
    let mut registers: Vec<_> = document.keys(&edges).map(|key| (edges.clone(), key)).collect();
    for handle in graph.vertices.keys() {
        registers.push((object(document, &vertices, handle)?, "parent".into()));
    }
    for (map, key) in registers {
        if let Some((edge, id)) = shown(document, &graph, &map, &key)? {
            graph.show(edge, attributes(document, &object(document, &id, "attributes")?)?);
        }
    }
    Ok(graph)
}

struct Writer<'d, T> {
    document: T,
    dictionary: &'d Dictionary,
}

impl<T: Transactable + ReadDoc> Writer<'_, T> {
    fn edit(&mut self, edit: &Edit) -> Result<()> {
        match edit {
            Edit::AddVertex { handle, vertex_type, name, attributes, link, link_attributes } => {
                if link.label != RT {
                    self.claim(link, link_attributes)?;
                }
                let vertices = object(&self.document, &DOCUMENT, "vertices")?;
                let vertex = self.document.put_object(&vertices, handle.as_str(), ObjType::Map)?;
                self.document.put(&vertex, "type", vertex_type.as_str())?;
                self.document.put(&vertex, "name", name.as_str())?;
                self.fill(&vertex, attributes)?;
                // The register of such a link is inside the vertex.
                if link.label == RT { self.claim(link, link_attributes) } else { Ok(()) }
            }
            Edit::AddEdge { edge, attributes } => self.claim(edge, attributes),
            Edit::Update { target, updates } => {
                let map = self.attributes_of(target)?;
                for (name, value) in updates {
                    match value {
                        Some(value) => self.document.put(&map, name.as_str(), to_text(value)?)?,
                        None => self.document.delete(&map, name.as_str())?,
                    }
                }
                Ok(())
            }
            Edit::RemoveEdge { edge } => self.free(edge),
            Edit::MoveEdge { old, new, attributes } => {
                let (held, register) = (self.register(old)?, self.register(new)?);
                self.claim(new, attributes)?;
                if held == register { Ok(()) } else { self.free(old) }
            }
            Edit::RemoveVertex { handle } => {
                let vertices = object(&self.document, &DOCUMENT, "vertices")?;
                Ok(self.document.delete(&vertices, handle.as_str())?)
            }
        }
    }

    fn fill(&mut self, element: &ObjId, attributes: &Attributes) -> Result<()> {
        let map = self.document.put_object(element, "attributes", ObjType::Map)?;
        for (name, value) in attributes {
            self.document.put(&map, name.as_str(), to_text(value)?)?;
        }
        Ok(())
    }

    fn register(&self, edge: &EdgeName) -> Result<(ObjId, String)> {
        place(&self.document, edge, self.dictionary)
    }

    fn claim(&mut self, edge: &EdgeName, attributes: &Attributes) -> Result<()> {
        let (map, key) = self.register(edge)?;
        let id = self.document.put_object(&map, key.as_str(), ObjType::Map)?;
        for (key, part) in [("from", &edge.from), ("label", &edge.label), ("to", &edge.to)] {
            self.document.put(&id, key, part.as_str())?;
        }
        self.fill(&id, attributes)
    }

    fn free(&mut self, edge: &EdgeName) -> Result<()> {
        let (map, key) = self.register(edge)?;
        Ok(self.document.delete(&map, key.as_str())?)
    }

    fn attributes_of(&self, target: &Target) -> Result<ObjId> {
        let document = &self.document;
        match target {
            Target::Vertex(handle) if handle == ROOT => object(document, &DOCUMENT, "root"),
            Target::Vertex(handle) => {
                let vertex = object(document, &object(document, &DOCUMENT, "vertices")?, handle)?;
                object(document, &vertex, "attributes")
            }
            Target::Edge(edge) => {
                let (map, key) = place(document, edge, self.dictionary)?;
                let found = shown(document, &read(document)?, &map, &key)?;
                let (_, id) = found.ok_or_else(|| AutomergeGraphError::Layout(key))?;
                object(document, &id, "attributes")
            }
        }
    }
}

impl Replica for AutomergeGraph {
    type Error = AutomergeGraphError;

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
        let changes = message.iter().map(|bytes| Change::from_bytes(bytes.clone()));
        Ok(self.document.apply_changes(changes.collect::<std::result::Result<Vec<_>, _>>()?)?)
    }

    fn missing(&self, other: &Self) -> Result<Message> {
        let changes = other.document.get_changes_added(&self.document);
        Ok(changes.iter().map(|change| change.raw_bytes().to_vec()).collect())
    }

    fn restart(&mut self, identity: Identity, keeps: bool) -> Result<()> {
        let document = if keeps { Automerge::load(&self.document.save())? } else { genesis()? };
        self.document = document.with_actor(actor(identity));
        Ok(())
    }
}
