//! Where things are in the document; what goes wrong if they are not.

use crate::graph::{Attributes, Graph, Vertex};
use crate::replica::{Identity, of_text, register};
use automerge::transaction::Transactable;
use automerge::{ActorId, Automerge, AutomergeError, ObjId, ObjType, ROOT as DOCUMENT, ReadDoc, Value};
use dsr_conformance::protocol::EdgeName;
use dsr_core::{Dictionary, RT};

/// What goes wrong.
#[derive(Debug, thiserror::Error)]
pub enum AutomergeGraphError {
    /// In automerge.
    #[error(transparent)]
    Automerge(#[from] AutomergeError),
    /// A text is no value.
    #[error("not a value: {0}")]
    Value(#[from] serde_json::Error),
    /// The document is not as this module lays it out.
    #[error("{0:?} is not where it should be in the document")]
    Layout(String),
}

pub(super) type Result<T> = std::result::Result<T, AutomergeGraphError>;

pub(super) fn actor(identity: Identity) -> ActorId {
    ActorId::from(identity.number().to_be_bytes().as_slice())
}

/// The first change, the same everywhere.
pub(super) fn genesis() -> Result<Automerge> {
    let mut document = Automerge::new().with_actor(actor(Identity { position: 0, incarnation: 0 }));
    let mut transaction = document.transaction();
    for key in ["vertices", "edges", "root"] {
        transaction.put_object(DOCUMENT, key, ObjType::Map)?;
    }
    transaction.commit();
    Ok(document)
}

pub(super) fn object(document: &impl ReadDoc, parent: &ObjId, key: &str) -> Result<ObjId> {
    match document.get(parent, key)? {
        Some((Value::Object(_), id)) => Ok(id),
        _ => Err(AutomergeGraphError::Layout(key.into())),
    }
}

pub(super) fn text(document: &impl ReadDoc, parent: &ObjId, key: &str) -> Result<String> {
    let found = document.get(parent, key)?;
    let text = found.and_then(|(value, _)| value.as_str().map(String::from));
    text.ok_or_else(|| AutomergeGraphError::Layout(key.into()))
}

pub(super) fn attributes(document: &impl ReadDoc, map: &ObjId) -> Result<Attributes> {
    let keys = document.keys(map);
    keys.map(|name| Ok((name.clone(), of_text(&text(document, map, &name)?)?))).collect()
}

/// Where the register of an edge is.
pub(super) fn place(
    document: &impl ReadDoc,
    edge: &EdgeName,
    dictionary: &Dictionary,
) -> Result<(ObjId, String)> {
    if edge.label == RT {
        let vertices = object(document, &DOCUMENT, "vertices")?;
        Ok((object(document, &vertices, &edge.to)?, "parent".into()))
    } else {
        Ok((object(document, &DOCUMENT, "edges")?, register(edge, dictionary)))
    }
}

/// The edge that a register shows: the last of its concurrent objects, in automerge's order, whose ends are there.
pub(super) fn shown(
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

pub(super) fn read(document: &impl ReadDoc) -> Result<Graph> {
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
