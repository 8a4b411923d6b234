//! Where things are in the document; what goes wrong if they are not.

use crate::graph::{Attributes, Graph, Vertex};
use crate::replica::of_text;
use dsr_conformance::protocol::EdgeName;
use yrs::{Any, Doc, Map, MapRef, Out, ReadTxn};

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

pub(super) type Result<T> = std::result::Result<T, YrsGraphError>;

/// The maps that everything is below.
#[derive(Clone, Debug)]
pub(super) struct Roots {
    pub(super) vertices: MapRef,
    pub(super) edges: MapRef,
    pub(super) root: MapRef,
}

pub(super) fn map(parent: &MapRef, transaction: &impl ReadTxn, key: &str) -> Result<MapRef> {
    match parent.get(transaction, key) {
        Some(Out::YMap(map)) => Ok(map),
        _ => Err(YrsGraphError::Layout(key.into())),
    }
}

pub(super) fn text(parent: &MapRef, transaction: &impl ReadTxn, key: &str) -> Result<String> {
    match parent.get(transaction, key) {
        Some(Out::Any(Any::String(text))) => Ok(text.to_string()),
        _ => Err(YrsGraphError::Layout(key.into())),
    }
}

pub(super) fn keys(map: &MapRef, transaction: &impl ReadTxn) -> Vec<String> {
    let mut keys: Vec<String> = map.keys(transaction).map(String::from).collect();
    keys.sort_unstable();
    keys
}

pub(super) fn attributes(element: &MapRef, transaction: &impl ReadTxn) -> Result<Attributes> {
    let names = keys(element, transaction).into_iter();
    names.map(|name| Ok((name.clone(), of_text(&text(element, transaction, &name)?)?))).collect()
}

pub(super) fn edge(element: &MapRef, transaction: &impl ReadTxn) -> Result<EdgeName> {
    let part = |key| text(element, transaction, key);
    Ok(EdgeName { from: part("from")?, label: part("label")?, to: part("to")? })
}

impl Roots {
    /// Of a document.
    pub(super) fn of(document: &Doc) -> Self {
        Self {
            vertices: document.get_or_insert_map("vertices"),
            edges: document.get_or_insert_map("edges"),
            root: document.get_or_insert_map("root"),
        }
    }

    /// What is shown.
    pub(super) fn read(&self, transaction: &impl ReadTxn) -> Result<Graph> {
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
}
