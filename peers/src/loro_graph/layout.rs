//! Where things are in the document; what goes wrong if they are not.

use crate::graph::Attributes;
use crate::replica::{Identity, of_text, to_text};
use dsr_conformance::protocol::{EdgeName, ROOT};
use loro::{
    ExportMode, LoroDoc, LoroEncodeError, LoroError, LoroMap, LoroValue, TreeParentId, ValueOrContainer,
};

/// What goes wrong.
#[derive(Debug, thiserror::Error)]
pub enum LoroGraphError {
    /// In Loro.
    #[error(transparent)]
    Loro(#[from] LoroError),
    /// An update cannot be written.
    #[error(transparent)]
    Encode(#[from] LoroEncodeError),
    /// A text is no value.
    #[error("not a value: {0}")]
    Value(#[from] serde_json::Error),
    /// The document is not as this module lays it out.
    #[error("{0:?} is not where it should be in the document")]
    Layout(String),
}

pub(super) type Result<T> = std::result::Result<T, LoroGraphError>;

pub(super) fn map(parent: &LoroMap, key: &str) -> Result<LoroMap> {
    match parent.get(key) {
        Some(ValueOrContainer::Container(container)) => {
            container.into_map().ok().ok_or_else(|| LoroGraphError::Layout(key.into()))
        }
        _ => Err(LoroGraphError::Layout(key.into())),
    }
}

pub(super) fn text(parent: &LoroMap, key: &str) -> Result<String> {
    match parent.get(key) {
        Some(ValueOrContainer::Value(LoroValue::String(text))) => Ok(text.to_string()),
        _ => Err(LoroGraphError::Layout(key.into())),
    }
}

pub(super) fn keys(map: &LoroMap) -> Vec<String> {
    let mut keys: Vec<String> = map.keys().map(|key| key.to_string()).collect();
    keys.sort_unstable();
    keys
}

pub(super) fn attributes(element: &LoroMap) -> Result<Attributes> {
    let held = map(element, "attributes")?;
    keys(&held).into_iter().map(|name| Ok((name.clone(), of_text(&text(&held, &name)?)?))).collect()
}

pub(super) fn fill(element: &LoroMap, attributes: &Attributes) -> Result<()> {
    let map = element.insert_container("attributes", LoroMap::new())?;
    for (name, value) in attributes {
        map.insert(name, to_text(value)?)?;
    }
    Ok(())
}

pub(super) fn edge(element: &LoroMap) -> Result<EdgeName> {
    Ok(EdgeName { from: text(element, "from")?, label: text(element, "label")?, to: text(element, "to")? })
}

/// Opens the document of a replica, with the first change in it.
pub(super) fn open(identity: Identity) -> Result<LoroDoc> {
    let genesis = LoroDoc::new();
    genesis.set_peer_id(Identity { position: 0, incarnation: 0 }.number())?;
    let tree = genesis.get_tree("kinematic");
    tree.disable_fractional_index();
    let node = tree.create(TreeParentId::Root)?;
    let meta = tree.get_meta(node)?;
    meta.insert("vertex", ROOT)?;
    fill(&meta, &Attributes::new())?;
    genesis.get_map("vertices").insert(ROOT, node.to_string())?;
    genesis.commit();
    let document = LoroDoc::new();
    document.set_peer_id(identity.number())?;
    document.get_tree("kinematic").disable_fractional_index();
    document.import(&genesis.export(ExportMode::all_updates())?)?;
    Ok(document)
}
