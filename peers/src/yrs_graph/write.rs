//! Mutations, written into the document.

use super::layout::{Result, Roots, YrsGraphError, edge, keys, map, register_of};
use crate::edit::{Edit, Target};
use crate::graph::Attributes;
use crate::replica::to_text;
use dsr_conformance::protocol::{EdgeName, ROOT};
use dsr_core::Dictionary;
use yrs::{Map, MapPrelim, MapRef, TransactionMut};

/// Writes into a transaction.
pub(super) struct Writer<'w, 't> {
    pub(super) roots: &'w Roots,
    pub(super) transaction: TransactionMut<'t>,
    pub(super) dictionary: &'w Dictionary,
    /// What the ids of edges begin with, and how many edges have been made.
    pub(super) author: u64,
    pub(super) made: u64,
}

impl Writer<'_, '_> {
    /// Writes one mutation.
    pub(super) fn edit(&mut self, edit: &Edit) -> Result<()> {
        match edit {
            Edit::AddVertex { handle, vertex_type, name, attributes, link, link_attributes } => {
                let vertices = &self.roots.vertices;
                let vertex = vertices.insert(&mut self.transaction, handle.as_str(), MapPrelim::default());
                vertex.insert(&mut self.transaction, "type", vertex_type.as_str());
                vertex.insert(&mut self.transaction, "name", name.as_str());
                self.fill(&vertex, attributes)?;
                self.claim(link, link_attributes)
            }
            Edit::AddEdge { edge, attributes } => self.claim(edge, attributes),
            Edit::Update { target, updates } => {
                let map = self.attributes_of(target)?;
                for (name, value) in updates {
                    match value {
                        Some(value) => {
                            map.insert(&mut self.transaction, name.as_str(), to_text(value)?);
                        }
                        None => {
                            map.remove(&mut self.transaction, name);
                        }
                    }
                }
                Ok(())
            }
            Edit::RemoveEdge { edge } => self.free(edge),
            Edit::MoveEdge { old, new, attributes } => {
                self.free(old)?;
                self.claim(new, attributes)
            }
            Edit::RemoveVertex { handle } => {
                self.roots.vertices.remove(&mut self.transaction, handle);
                Ok(())
            }
        }
    }

    fn fill(&mut self, element: &MapRef, attributes: &Attributes) -> Result<()> {
        let map = element.insert(&mut self.transaction, "attributes", MapPrelim::default());
        for (name, value) in attributes {
            map.insert(&mut self.transaction, name.as_str(), to_text(value)?);
        }
        Ok(())
    }

    fn claim(&mut self, edge: &EdgeName, attributes: &Attributes) -> Result<()> {
        self.free(edge)?;
        self.made += 1;
        let id = format!("{}.{}", self.author, self.made);
        let held = self.roots.edges.insert(&mut self.transaction, id.as_str(), MapPrelim::default());
        for (key, part) in [("from", &edge.from), ("label", &edge.label), ("to", &edge.to)] {
            held.insert(&mut self.transaction, key, part.as_str());
        }
        self.fill(&held, attributes)?;
        self.roots.shown.insert(&mut self.transaction, register_of(edge, self.dictionary), id);
        Ok(())
    }

    /// Removes every edge of a register that is held.
    fn free(&mut self, freed: &EdgeName) -> Result<()> {
        let (edges, register) = (&self.roots.edges, register_of(freed, self.dictionary));
        for id in keys(edges, &self.transaction) {
            let held = edge(&map(edges, &self.transaction, &id)?, &self.transaction)?;
            if register_of(&held, self.dictionary) == register {
                edges.remove(&mut self.transaction, &id);
            }
        }
        Ok(())
    }

    fn attributes_of(&self, target: &Target) -> Result<MapRef> {
        let (roots, transaction) = (self.roots, &self.transaction);
        let element = match target {
            Target::Vertex(handle) if handle == ROOT => return Ok(roots.root.clone()),
            Target::Vertex(handle) => map(&roots.vertices, transaction, handle)?,
            Target::Edge(edge) => {
                let register = register_of(edge, self.dictionary);
                let found = roots.shown(transaction, self.dictionary)?.remove(&register);
                found.ok_or(YrsGraphError::Layout(register))?
            }
        };
        map(&element, transaction, "attributes")
    }
}
