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
//! duplicates. What another replica lacks is asked by its version vector; what is kept goes with it. A group is imported as a batch.
//!
//! **Reading** takes Loro's tree, and of concurrent entries its last by Lamport time; a deletion is an entry like others.
//! If the edge that `shown` names is gone, or an end of it, another edge of the register is shown, if one is left.

mod layout;
mod write;

pub use layout::LoroGraphError;

use crate::edit::Edit;
use crate::graph::{Graph, Vertex};
use crate::replica::{Identity, Message, Replica, register};
use dsr_conformance::protocol::{EdgeName, Implementation, ROOT};
use dsr_core::{Dictionary, RT};
use layout::{Result, attributes, edge, keys, map, open, text};
use loro::{ExportMode, LoroDoc, LoroMap, LoroTree, TreeID, TreeParentId};

/// A replica in Loro.
#[derive(Debug)]
pub struct LoroGraph {
    document: LoroDoc,
    dictionary: Dictionary,
    identity: Identity,
    /// How many edges it has made.
    made: u64,
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

    /// The edge that a register shows: of those whose ends are there the one that is named, else the greatest id.
    fn shown(&self, register_name: &str) -> Result<Option<LoroMap>> {
        let (shown, edges, vertices) = (self.map("shown"), self.map("edges"), self.map("vertices"));
        let named =
            if shown.get(register_name).is_some() { Some(text(&shown, register_name)?) } else { None };
        let mut found = None;
        for id in keys(&edges) {
            let held = map(&edges, &id)?;
            let edge = edge(&held)?;
            let there = vertices.get(&edge.from).is_some() && vertices.get(&edge.to).is_some();
            if there && register(&edge, &self.dictionary) == register_name {
                found = Some(held);
                if named.as_ref() == Some(&id) {
                    break;
                }
            }
        }
        Ok(found)
    }

    fn is_linked(&self, parent: &str, child: &str) -> Result<bool> {
        let edge = EdgeName { from: parent.into(), label: RT.into(), to: child.into() };
        let vertices = self.map("vertices");
        let there = vertices.get(parent).is_some() && vertices.get(child).is_some();
        Ok(there && self.shown(&register(&edge, &self.dictionary))?.is_some())
    }
}

impl Replica for LoroGraph {
    type Error = LoroGraphError;
    type Update = Vec<u8>;

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
        let updates = self.document.export(ExportMode::updates(&other.document.oplog_vv()))?;
        Ok([Some(updates), self.document.export_pending_updates()?].into_iter().flatten().collect())
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
