//! Mutations, written into the document.

use super::layout::{AutomergeGraphError, Result, object, place, read, shown};
use crate::edit::{Edit, Target};
use crate::graph::Attributes;
use crate::replica::to_text;
use automerge::transaction::Transactable;
use automerge::{ObjId, ObjType, ROOT as DOCUMENT, ReadDoc};
use dsr_conformance::protocol::{EdgeName, ROOT};
use dsr_core::{Dictionary, RT};

/// Writes into a transaction.
pub(super) struct Writer<'d, T> {
    pub(super) document: T,
    pub(super) dictionary: &'d Dictionary,
}

impl<T: Transactable + ReadDoc> Writer<'_, T> {
    /// Writes one mutation.
    pub(super) fn edit(&mut self, edit: &Edit) -> Result<()> {
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
