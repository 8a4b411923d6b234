//! loro.

use crate::error::{BenchError, Result, not_the_job};
use crate::scene::{Content, Link, Plan, Reconciles, Scene, Tree};
use loro::{
    ExportMode, LoroDoc, LoroMap, LoroTree, LoroValue, TreeID, TreeParentId, ValueOrContainer, VersionVector,
};
use std::collections::BTreeMap;

/// A document of loro.
#[derive(Debug)]
pub struct Loro {
    document: LoroDoc,
    tree: LoroTree,
    edges: LoroMap,
    nodes: Vec<TreeID>,
    data: Vec<LoroMap>,
}

fn value(content: &Content) -> LoroValue {
    match content {
        Content::Double(number) => LoroValue::Double(*number),
        Content::Bytes(bytes) => LoroValue::Binary(bytes.to_vec().into()),
    }
}

impl Loro {
    fn add(&mut self, name: &str, parent: Option<usize>) -> Result<()> {
        let parent = parent.map_or(TreeParentId::Root, |parent| TreeParentId::Node(self.nodes[parent]));
        let node = self.tree.create(parent)?;
        let data = self.tree.get_meta(node)?;
        data.insert("type", "thing")?;
        data.insert("name", name)?;
        self.nodes.push(node);
        self.data.push(data);
        Ok(())
    }

    /// What has been done since, as bytes.
    fn exported(&self, change: impl FnOnce() -> Result<()>) -> Result<Vec<u8>> {
        let before = self.document.oplog_vv();
        change()?;
        self.document.commit();
        Ok(self.document.export(ExportMode::updates(&before))?)
    }
}

impl Scene for Loro {
    const NAME: &'static str = "loro";
    const MAPPING: &'static str = "a node of one movable tree for each vertex, without fractional index; its metadata, \
        kept at hand, has `type`, `name` and the attributes; edges as entries of one map; `export` of the updates since \
        the version before, `import`.";

    fn empty(replica: u16) -> Result<Self> {
        let document = LoroDoc::new();
        document.set_peer_id(u64::from(replica))?;
        let (tree, edges) = (document.get_tree("vertices"), document.get_map("edges"));
        tree.disable_fractional_index();
        Ok(Self { document, tree, edges, nodes: Vec::new(), data: Vec::new() })
    }

    fn populate(&mut self, plan: &Plan) -> Result<()> {
        for (name, parent) in plan.names.iter().zip(&plan.parents) {
            self.add(name, *parent)?;
        }
        self.document.commit();
        Ok(())
    }

    fn save(&mut self) -> Result<Vec<u8>> {
        Ok(self.document.export(ExportMode::Snapshot)?)
    }

    fn load(replica: u16, bytes: &[u8]) -> Result<Self> {
        let mut loaded = Self::empty(replica)?;
        loaded.apply(bytes)?;
        Ok(loaded)
    }

    fn again(&mut self) -> Result<Self> {
        let bytes = self.save()?;
        let again = Self::empty(0)?;
        again.document.set_peer_id(self.document.peer_id())?;
        again.document.import(&bytes)?;
        Ok(again)
    }

    fn find(&mut self, plan: &Plan) -> Result<()> {
        let mut found = BTreeMap::new();
        for node in self.tree.get_nodes(false) {
            let data = self.tree.get_meta(node.id)?;
            if let Some(ValueOrContainer::Value(LoroValue::String(name))) = data.get("name") {
                found.insert(name.to_string(), (node.id, data));
            }
        }
        for name in &plan.names {
            let Some((node, data)) = found.remove(name) else {
                return not_the_job(Self::NAME, format!("{name} to have come"));
            };
            self.nodes.push(node);
            self.data.push(data);
        }
        Ok(())
    }

    fn count(&self) -> Result<usize> {
        Ok(self.tree.get_nodes(false).len())
    }

    fn set(&mut self, vertex: usize, content: &Content) -> Result<Vec<u8>> {
        self.exported(|| Ok(self.data[vertex].insert("level", value(content))?))
    }

    fn set_unencoded(&mut self, vertex: usize, content: &Content) -> Result<()> {
        self.data[vertex].insert("level", value(content))?;
        self.document.commit();
        Ok(())
    }

    fn read(&self, vertex: usize) -> Result<Option<Content>> {
        Ok(match self.data[vertex].get("level") {
            Some(ValueOrContainer::Value(LoroValue::Double(number))) => Some(Content::Double(number)),
            Some(ValueOrContainer::Value(LoroValue::Binary(bytes))) => {
                Some(Content::Bytes(bytes.iter().copied().collect()))
            }
            _ => None,
        })
    }

    fn add_vertex(&mut self, name: &str, parent: usize) -> Result<Vec<u8>> {
        let before = self.document.oplog_vv();
        self.add(name, Some(parent))?;
        self.document.commit();
        Ok(self.document.export(ExportMode::updates(&before))?)
    }

    fn remove_last_vertex(&mut self, _name: &str) -> Result<Vec<u8>> {
        self.data.pop();
        let Some(node) = self.nodes.pop() else { return not_the_job(Self::NAME, "a vertex to remove") };
        self.exported(|| Ok(self.tree.delete(node)?))
    }

    fn add_edge(&mut self, link: &Link) -> Result<Vec<u8>> {
        self.exported(|| Ok(self.edges.insert(&link.key, true)?))
    }

    fn remove_edge(&mut self, link: &Link) -> Result<Vec<u8>> {
        self.exported(|| Ok(self.edges.delete(&link.key)?))
    }

    fn has_edge(&self, link: &Link) -> Result<bool> {
        Ok(self.edges.get(&link.key).is_some())
    }

    fn apply(&mut self, message: &[u8]) -> Result<()> {
        self.document.import(message)?;
        Ok(())
    }

    type Whole = Vec<u8>;

    fn whole(&mut self) -> Result<Vec<u8>> {
        Ok(self.document.export(ExportMode::all_updates())?)
    }

    fn merge(&mut self, other: Vec<u8>) -> Result<()> {
        self.apply(&other)
    }
}

impl Reconciles for Loro {
    fn digest(&mut self) -> Result<Vec<u8>> {
        Ok(self.document.oplog_vv().encode())
    }

    fn missing(&mut self, digest: &[u8]) -> Result<Vec<u8>> {
        let theirs = VersionVector::decode(digest).map_err(BenchError::from)?;
        Ok(self.document.export(ExportMode::updates(&theirs))?)
    }
}

impl Tree for Loro {
    fn move_below(&mut self, vertex: usize, parent: usize) -> Result<Vec<u8>> {
        self.exported(|| Ok(self.tree.mov(self.nodes[vertex], self.nodes[parent])?))
    }

    fn move_unencoded(&mut self, vertex: usize, parent: usize) -> Result<()> {
        self.tree.mov(self.nodes[vertex], self.nodes[parent])?;
        self.document.commit();
        Ok(())
    }

    fn depth(&self, vertex: usize) -> Result<usize> {
        let (mut at, mut depth) = (self.nodes[vertex], 0);
        while let Some(TreeParentId::Node(parent)) = self.tree.parent(at) {
            (at, depth) = (parent, depth + 1);
        }
        Ok(depth)
    }
}
