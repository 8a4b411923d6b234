//! Mutations, written into the document.

use super::LoroGraph;
use super::layout::{LoroGraphError, Result, edge, fill, keys, map};
use crate::edit::{Edit, Target};
use crate::graph::Attributes;
use crate::replica::{register, to_text};
use dsr_conformance::protocol::EdgeName;
use dsr_core::RT;
use loro::{LoroMap, TreeParentId};

impl LoroGraph {
    /// Writes one mutation.
    pub(super) fn edit(&mut self, edit: &Edit) -> Result<()> {
        match edit {
            Edit::AddVertex { handle, vertex_type, name, attributes, link, link_attributes } => {
                if link.label != RT {
                    self.claim(link, link_attributes)?;
                }
                let node = self.tree().create(TreeParentId::Root)?;
                self.map("vertices").insert(handle, node.to_string())?;
                let meta = self.tree().get_meta(node)?;
                for (key, part) in [("vertex", handle), ("type", vertex_type), ("name", name)] {
                    meta.insert(key, part.as_str())?;
                }
                fill(&meta, attributes)?;
                if link.label == RT { self.claim(link, link_attributes) } else { Ok(()) }
            }
            Edit::AddEdge { edge, attributes } => self.claim(edge, attributes),
            Edit::Update { target, updates } => {
                let map = self.attributes_of(target)?;
                for (name, value) in updates {
                    match value {
                        Some(value) => map.insert(name, to_text(value)?)?,
                        None => map.delete(name)?,
                    }
                }
                Ok(())
            }
            Edit::RemoveEdge { edge } => self.free(edge),
            Edit::MoveEdge { old, new, attributes } => {
                let is_one_child = old.label == RT && new.label == RT && old.to == new.to;
                let is_one_register = register(old, &self.dictionary) == register(new, &self.dictionary);
                self.claim(new, attributes)?;
                if is_one_child || is_one_register { Ok(()) } else { self.free(old) }
            }
            Edit::RemoveVertex { handle } => Ok(self.map("vertices").delete(handle)?),
        }
    }

    /// Deletes the edges that `competes` picks.
    fn delete_edges(&self, competes: impl Fn(&EdgeName) -> bool) -> Result<()> {
        let edges = self.map("edges");
        for id in keys(&edges) {
            if competes(&edge(&map(&edges, &id)?)?) {
                edges.delete(&id)?;
            }
        }
        Ok(())
    }

    fn claim(&mut self, edge: &EdgeName, attributes: &Attributes) -> Result<()> {
        if edge.label == RT {
            self.place(&edge.to, &edge.from)?;
        }
        let key = register(edge, &self.dictionary);
        self.made += 1;
        let id = format!("{}.{}", self.identity.number(), self.made);
        self.map("shown").insert(&key, id.as_str())?;
        self.delete_edges(|held| register(held, &self.dictionary) == key)?;
        let held = self.map("edges").insert_container(&id, LoroMap::new())?;
        for (key, part) in [("from", &edge.from), ("label", &edge.label), ("to", &edge.to)] {
            held.insert(key, part.as_str())?;
        }
        fill(&held, attributes)
    }

    fn free(&self, edge: &EdgeName) -> Result<()> {
        let key = register(edge, &self.dictionary);
        self.delete_edges(|held| {
            if edge.label == RT {
                held.label == RT && held.to == edge.to
            } else {
                register(held, &self.dictionary) == key
            }
        })
    }

    /// Moves a vertex's node below its parent's.
    fn place(&self, child: &str, parent: &str) -> Result<()> {
        let tree = self.tree();
        let target = self.node(parent)?;
        let (mut node, mut vertex) = (target, parent.to_owned());
        while let Some((above, handle)) = self.above(node)? {
            if !self.is_linked(&handle, &vertex)? {
                tree.mov(node, TreeParentId::Root)?;
                break;
            }
            (node, vertex) = (above, handle);
        }
        Ok(tree.mov(self.node(child)?, TreeParentId::Node(target))?)
    }

    fn attributes_of(&self, target: &Target) -> Result<LoroMap> {
        let element = match target {
            Target::Vertex(handle) => self.tree().get_meta(self.node(handle)?)?,
            Target::Edge(edge) => {
                let key = register(edge, &self.dictionary);
                self.shown(&key)?.ok_or_else(|| LoroGraphError::Layout(key))?
            }
        };
        map(&element, "attributes")
    }
}
