//! Mutations, written into the document.

use super::layout::{Result, Roots, map};
use crate::edit::{Edit, Target};
use crate::graph::Attributes;
use crate::replica::{register, to_text};
use dsr_conformance::protocol::{EdgeName, ROOT};
use dsr_core::{Dictionary, RT};
use yrs::{Map, MapPrelim, MapRef, ReadTxn, TransactionMut};

fn fill(element: &MapRef, transaction: &mut TransactionMut<'_>, attributes: &Attributes) -> Result<()> {
    let map = element.insert(transaction, "attributes", MapPrelim::default());
    for (name, value) in attributes {
        map.insert(transaction, name.as_str(), to_text(value)?);
    }
    Ok(())
}

impl Roots {
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

    /// Writes one mutation.
    pub(super) fn edit(
        &self,
        transaction: &mut TransactionMut<'_>,
        edit: &Edit,
        dictionary: &Dictionary,
    ) -> Result<()> {
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
