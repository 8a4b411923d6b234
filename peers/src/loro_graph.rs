//! The graph in a Loro document.
//!
//! **Layout.** Every vertex is a node of one movable tree, `kinematic`, whose first node, the root, is part of a first
//! change that all replicas share. A node's metadata has the vertex's handle, `type`, `name` and `attributes`. The map
//! `vertices` has the node of each vertex that is in the graph. The map `edges` has every edge under an id of its own,
//! never used again, with `from`, `label`, `to` and `attributes`; the map `shown` has, for each register (a source,
//! label and target; a source alone, if the label is functional), the id of its edge. A vertex hangs in the tree below
//! its kinematic parent, or at the top of the forest if it has none.
//!
//! An `RT` edge is shown if the tree has its child below its parent and `shown` names an edge for this pair. So the
//! tree decides between concurrent moves, and the edge that belongs to its answer comes with its attributes.
//!
//! **Mutations.** `add_vertex` makes the node, the entry and the link. `add_edge` deletes the edges of the register,
//! inserts one and names it in `shown`; of an `RT` edge it also moves the child's node. `update_attributes` inserts and
//! deletes entries. `remove_edge` deletes the edges of the register that the author holds, for an `RT` edge all that
//! enter its child, and leaves the node where it is, so that a concurrent move still stands. `move_edge` does both; for
//! one child it leaves the old edge to the tree, which may refuse the move when it meets a concurrent one. `remove_vertex`
//! deletes the vertex's entry and leaves its node, whose children would otherwise be lost: concurrent moves would bring a
//! deleted node back, an entry that nobody writes again stays away. Before a node is moved below another one, the
//! topmost node above that whose own link is not shown is moved to the top of the forest, since a link that nobody sees
//! must close no cycle. A group is one commit. Whatever competes for a register is the first operation of its mutation: Loro
//! orders by operations, so that after equal histories the peer decides, and not how much else a mutation writes.
//!
//! **Messages** are exported updates since the version before. Loro keeps those whose causes have not come, and takes
//! duplicates. What another replica lacks is asked by its version vector. A group is imported as a batch.
//!
//! **Reading** takes Loro's tree, and of concurrent entries its last by Lamport time; a deletion is an entry like others.

use crate::edit::{Edit, Target};
use crate::graph::{Attributes, Graph, Vertex};
use crate::replica::{Identity, Message, Replica, of_text, register, to_text};
use dsr_conformance::protocol::{EdgeName, Implementation, ROOT};
use dsr_core::{Dictionary, RT};
use loro::{
    ExportMode, LoroDoc, LoroEncodeError, LoroError, LoroMap, LoroTree, LoroValue, TreeID, TreeParentId,
    ValueOrContainer,
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

type Result<T> = std::result::Result<T, LoroGraphError>;

/// A replica in Loro.
#[derive(Debug)]
pub struct LoroGraph {
    document: LoroDoc,
    dictionary: Dictionary,
    identity: Identity,
    /// How many edges it has made.
    made: u64,
}

fn map(parent: &LoroMap, key: &str) -> Result<LoroMap> {
    match parent.get(key) {
        Some(ValueOrContainer::Container(container)) => {
            container.into_map().ok().ok_or_else(|| LoroGraphError::Layout(key.into()))
        }
        _ => Err(LoroGraphError::Layout(key.into())),
    }
}

fn text(parent: &LoroMap, key: &str) -> Result<String> {
    match parent.get(key) {
        Some(ValueOrContainer::Value(LoroValue::String(text))) => Ok(text.to_string()),
        _ => Err(LoroGraphError::Layout(key.into())),
    }
}

fn keys(map: &LoroMap) -> Vec<String> {
    let mut keys: Vec<String> = map.keys().map(|key| key.to_string()).collect();
    keys.sort_unstable();
    keys
}

fn attributes(element: &LoroMap) -> Result<Attributes> {
    let held = map(element, "attributes")?;
    keys(&held).into_iter().map(|name| Ok((name.clone(), of_text(&text(&held, &name)?)?))).collect()
}

fn fill(element: &LoroMap, attributes: &Attributes) -> Result<()> {
    let map = element.insert_container("attributes", LoroMap::new())?;
    for (name, value) in attributes {
        map.insert(name, to_text(value)?)?;
    }
    Ok(())
}

fn edge(element: &LoroMap) -> Result<EdgeName> {
    Ok(EdgeName { from: text(element, "from")?, label: text(element, "label")?, to: text(element, "to")? })
}

/// Opens the document of a replica, with the first change in it.
fn open(identity: Identity) -> Result<LoroDoc> {
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

impl LoroGraph {
    fn tree(&self) -> LoroTree {
        self.document.get_tree("kinematic")
    }

    fn map(&self, name: &str) -> LoroMap {
        self.document.get_map(name)
    }

    fn node(&self, handle: &str) -> Result<TreeID> {
        Ok(TreeID::try_from(text(&self.map("vertices"), handle)?.as_str())?)
    }

    /// The vertex that a vertex hangs below in the tree, in the graph or not.
    fn above(&self, node: TreeID) -> Result<Option<(TreeID, String)>> {
        match self.tree().parent(node) {
            Some(TreeParentId::Node(parent)) => {
                Ok(Some((parent, text(&self.tree().get_meta(parent)?, "vertex")?)))
            }
            _ => Ok(None),
        }
    }

    /// The edge that a register shows.
    fn shown(&self, register: &str) -> Result<Option<LoroMap>> {
        let (shown, edges) = (self.map("shown"), self.map("edges"));
        let Some(ValueOrContainer::Value(LoroValue::String(id))) = shown.get(register) else {
            return Ok(None);
        };
        if edges.get(&id).is_some() { map(&edges, &id).map(Some) } else { Ok(None) }
    }

    fn is_linked(&self, parent: &str, child: &str) -> Result<bool> {
        let edge = EdgeName { from: parent.into(), label: RT.into(), to: child.into() };
        let vertices = self.map("vertices");
        let there = vertices.get(parent).is_some() && vertices.get(child).is_some();
        Ok(there && self.shown(&register(&edge, &self.dictionary))?.is_some())
    }

    fn edit(&mut self, edit: &Edit) -> Result<()> {
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

impl Replica for LoroGraph {
    type Error = LoroGraphError;

    fn implementation() -> Implementation {
        Implementation {
            name: "loro".into(),
            version: loro::LORO_VERSION.into(),
            language: "Rust".into(),
            source: "https://github.com/loro-dev/loro".into(),
        }
    }

    fn new(identity: Identity, dictionary: &Dictionary) -> Result<Self> {
        Ok(Self { document: open(identity)?, dictionary: dictionary.clone(), identity, made: 0 })
    }

    fn graph(&self) -> Result<Graph> {
        let (tree, vertices) = (self.tree(), self.map("vertices"));
        let mut graph = Graph { root: attributes(&tree.get_meta(self.node(ROOT)?)?)?, ..Graph::default() };
        for handle in keys(&vertices) {
            let meta = tree.get_meta(self.node(&handle)?)?;
            if handle != ROOT {
                let vertex = Vertex {
                    vertex_type: text(&meta, "type")?,
                    name: text(&meta, "name")?,
                    attributes: attributes(&meta)?,
                };
                graph.vertices.insert(handle, vertex);
            }
        }
        for key in keys(&self.map("shown")) {
            let Some(held) = self.shown(&key)? else { continue };
            let edge = edge(&held)?;
            let both = graph.has(&edge.from) && graph.has(&edge.to);
            let placed = || self.above(self.node(&edge.to)?).map(|found| found.map(|(_, handle)| handle));
            if both && (edge.label != RT || placed()?.as_ref() == Some(&edge.from)) {
                graph.show(edge, attributes(&held)?);
            }
        }
        Ok(graph)
    }

    fn trial(&self) -> Result<Self> {
        let document = self.document.fork();
        document.set_peer_id(self.identity.number())?;
        document.get_tree("kinematic").disable_fractional_index();
        Ok(Self { document, dictionary: self.dictionary.clone(), ..*self })
    }

    fn write(&mut self, edits: &[Edit]) -> Result<Message> {
        let before = self.document.oplog_vv();
        for edit in edits {
            self.edit(edit)?;
        }
        self.document.commit();
        Ok(vec![self.document.export(ExportMode::updates(&before))?])
    }

    fn deliver(&mut self, message: &Message) -> Result<()> {
        self.document.import_batch(message)?;
        Ok(())
    }

    fn missing(&self, other: &Self) -> Result<Message> {
        Ok(vec![self.document.export(ExportMode::updates(&other.document.oplog_vv()))?])
    }

    fn restart(&mut self, identity: Identity, keeps: bool) -> Result<()> {
        let document = open(identity)?;
        if keeps {
            document.import(&self.document.export(ExportMode::Snapshot)?)?;
            if let Some(pending) = self.document.export_pending_updates()? {
                document.import(&pending)?;
            }
        }
        (self.document, self.identity) = (document, identity);
        Ok(())
    }
}
