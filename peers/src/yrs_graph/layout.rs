//! Where things are in the document; what goes wrong if they are not.

use crate::graph::{Attributes, Graph, Vertex};
use crate::replica::{of_text, register};
use dsr_conformance::protocol::{EdgeName, ROOT};
use dsr_core::{Dictionary, RT};
use std::collections::BTreeMap;
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
    pub(super) shown: MapRef,
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
            shown: document.get_or_insert_map("shown"),
            root: document.get_or_insert_map("root"),
        }
    }

    /// What is shown.
    pub(super) fn read(&self, transaction: &impl ReadTxn, dictionary: &Dictionary) -> Result<Graph> {
        let mut graph = Graph { root: attributes(&self.root, transaction)?, ..Graph::default() };
        for handle in keys(&self.vertices, transaction) {
            let held = map(&self.vertices, transaction, &handle)?;
            let vertex = Vertex {
                vertex_type: text(&held, transaction, "type")?,
                name: text(&held, transaction, "name")?,
                attributes: attributes(&map(&held, transaction, "attributes")?, transaction)?,
            };
            graph.vertices.insert(handle, vertex);
        }
        for held in self.shown(transaction, dictionary)?.into_values() {
            let attributes = attributes(&map(&held, transaction, "attributes")?, transaction)?;
            graph.show(edge(&held, transaction)?, attributes);
        }
        Ok(graph)
    }

    /// The edge of each register: of those whose ends are there the one that is named, else the greatest id.
    pub(super) fn shown(
        &self,
        transaction: &impl ReadTxn,
        dictionary: &Dictionary,
    ) -> Result<BTreeMap<String, MapRef>> {
        let is_there = |handle: &str| handle == ROOT || self.vertices.contains_key(transaction, handle);
        let mut found: BTreeMap<String, (bool, MapRef)> = BTreeMap::new();
        for id in keys(&self.edges, transaction) {
            let held = map(&self.edges, transaction, &id)?;
            let edge = edge(&held, transaction)?;
            let register = register_of(&edge, dictionary);
            let is_named = self.shown.contains_key(transaction, &register)
                && text(&self.shown, transaction, &register)? == id;
            let has_named = found.get(&register).is_some_and(|(is_named, _)| *is_named);
            if is_there(&edge.from) && is_there(&edge.to) && !has_named {
                found.insert(register, (is_named, held));
            }
        }
        Ok(found.into_iter().map(|(register, (_, held))| (register, held)).collect())
    }
}

/// The name of an edge's register: for an `RT` edge that of its child.
pub(super) fn register_of(edge: &EdgeName, dictionary: &Dictionary) -> String {
    if edge.label == RT {
        serde_json::Value::from(vec![edge.to.as_str()]).to_string()
    } else {
        register(edge, dictionary)
    }
}
