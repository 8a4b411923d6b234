//! automerge.

use crate::error::{Result, not_the_job};
use crate::scene::{Content, Link, Plan, Reconciles, Scene};
use automerge::transaction::{Transactable, Transaction};
use automerge::{ActorId, Automerge, ChangeHash, ObjId, ObjType, ROOT, ReadDoc, ScalarValue, Value};

/// A document of automerge.
#[derive(Debug)]
pub struct AutomergeScene {
    document: Automerge,
    all: ObjId,
    edges: ObjId,
    vertices: Vec<ObjId>,
    names: Vec<String>,
    /// The heads that the other one is known to have: those of the document that both come from.
    shared: Vec<ChangeHash>,
}

fn scalar(content: &Content) -> ScalarValue {
    match content {
        Content::Double(number) => ScalarValue::F64(*number),
        Content::Bytes(bytes) => ScalarValue::Bytes(bytes.to_vec()),
    }
}

fn add(all: &ObjId, transaction: &mut Transaction<'_>, name: &str, parent: &str) -> Result<ObjId> {
    let vertex = transaction.put_object(all, name, ObjType::Map)?;
    transaction.put(&vertex, "type", "thing")?;
    transaction.put(&vertex, "parent", parent)?;
    Ok(vertex)
}

impl AutomergeScene {
    fn of(mut document: Automerge, replica: u16) -> Result<Self> {
        document.set_actor(ActorId::from(replica.to_be_bytes().as_slice()));
        let (Some((_, all)), Some((_, edges))) =
            (document.get(ROOT, "vertices")?, document.get(ROOT, "edges")?)
        else {
            return not_the_job(Self::NAME, "the first change to have come");
        };
        let shared = document.get_heads();
        Ok(Self { document, all, edges, vertices: Vec::new(), names: Vec::new(), shared })
    }

    /// The last local change, as bytes.
    fn last(&self) -> Result<Vec<u8>> {
        match self.document.get_last_local_change() {
            Some(change) => Ok(change.raw_bytes().to_vec()),
            None => not_the_job(Self::NAME, "a change to have been made"),
        }
    }

    fn put(&mut self, vertex: usize, value: &Content) -> Result<()> {
        let mut transaction = self.document.transaction();
        transaction.put(&self.vertices[vertex], "level", scalar(value))?;
        transaction.commit();
        Ok(())
    }
}

impl Scene for AutomergeScene {
    const NAME: &'static str = "automerge";
    const MAPPING: &'static str = "a map by name of maps with `type`, `parent` and the attributes, kept at hand; edges as \
        entries of one map; the bytes of the last local change, `load_incremental`. No tree: a parent is an entry, and a \
        cycle is nobody's concern.";

    fn empty(replica: u16) -> Result<Self> {
        let mut document = Automerge::new().with_actor(ActorId::from([0].as_slice()));
        let mut transaction = document.transaction();
        transaction.put_object(ROOT, "vertices", ObjType::Map)?;
        transaction.put_object(ROOT, "edges", ObjType::Map)?;
        transaction.commit();
        Self::of(document, replica)
    }

    fn populate(&mut self, plan: &Plan) -> Result<()> {
        let mut transaction = self.document.transaction();
        for (name, parent) in plan.names.iter().zip(&plan.parents) {
            let parent = parent.map_or("root", |parent| &plan.names[parent]);
            self.vertices.push(add(&self.all, &mut transaction, name, parent)?);
            self.names.push(name.clone());
        }
        transaction.commit();
        Ok(())
    }

    fn save(&mut self) -> Result<Vec<u8>> {
        Ok(self.document.save())
    }

    fn load(replica: u16, bytes: &[u8]) -> Result<Self> {
        Self::of(Automerge::load(bytes)?, replica)
    }

    fn again(&mut self) -> Result<Self> {
        Ok(Self {
            document: self.document.clone(),
            all: self.all.clone(),
            edges: self.edges.clone(),
            vertices: self.vertices.clone(),
            names: self.names.clone(),
            shared: self.shared.clone(),
        })
    }

    fn find(&mut self, plan: &Plan) -> Result<()> {
        for name in &plan.names {
            let Some((Value::Object(_), vertex)) = self.document.get(&self.all, name.as_str())? else {
                return not_the_job(Self::NAME, format!("{name} to have come"));
            };
            self.vertices.push(vertex);
            self.names.push(name.clone());
        }
        Ok(())
    }

    fn count(&self) -> Result<usize> {
        Ok(self.document.length(&self.all))
    }

    fn set(&mut self, vertex: usize, value: &Content) -> Result<Vec<u8>> {
        self.put(vertex, value)?;
        self.last()
    }

    fn set_unencoded(&mut self, vertex: usize, value: &Content) -> Result<()> {
        self.put(vertex, value)
    }

    fn read(&self, vertex: usize) -> Result<Option<Content>> {
        let found = self.document.get(&self.vertices[vertex], "level")?;
        Ok(found.and_then(|(value, _)| match value {
            Value::Scalar(scalar) => match &*scalar {
                ScalarValue::F64(number) => Some(Content::Double(*number)),
                ScalarValue::Bytes(bytes) => Some(Content::Bytes(bytes.as_slice().into())),
                _ => None,
            },
            Value::Object(_) => None,
        }))
    }

    fn add_vertex(&mut self, name: &str, parent: usize) -> Result<Vec<u8>> {
        let mut transaction = self.document.transaction();
        self.vertices.push(add(&self.all, &mut transaction, name, &self.names[parent])?);
        transaction.commit();
        self.names.push(name.into());
        self.last()
    }

    fn remove_last_vertex(&mut self, name: &str) -> Result<Vec<u8>> {
        self.vertices.pop();
        self.names.pop();
        let mut transaction = self.document.transaction();
        transaction.delete(&self.all, name)?;
        transaction.commit();
        self.last()
    }

    fn add_edge(&mut self, link: &Link) -> Result<Vec<u8>> {
        let mut transaction = self.document.transaction();
        transaction.put(&self.edges, link.key.as_str(), true)?;
        transaction.commit();
        self.last()
    }

    fn remove_edge(&mut self, link: &Link) -> Result<Vec<u8>> {
        let mut transaction = self.document.transaction();
        transaction.delete(&self.edges, link.key.as_str())?;
        transaction.commit();
        self.last()
    }

    fn has_edge(&self, link: &Link) -> Result<bool> {
        Ok(self.document.get(&self.edges, link.key.as_str())?.is_some())
    }

    fn apply(&mut self, message: &[u8]) -> Result<()> {
        self.document.load_incremental(message)?;
        Ok(())
    }

    type Whole = Automerge;

    fn whole(&mut self) -> Result<Automerge> {
        Ok(self.document.fork())
    }

    fn merge(&mut self, mut other: Automerge) -> Result<()> {
        self.document.merge(&mut other)?;
        Ok(())
    }
}

impl Reconciles for AutomergeScene {
    fn digest(&mut self) -> Result<Vec<u8>> {
        Ok(self.shared.iter().flat_map(|head| head.0).collect())
    }

    fn missing(&mut self, digest: &[u8]) -> Result<Vec<u8>> {
        let hash = |bytes: &[u8]| ChangeHash::try_from(bytes);
        let heads: std::result::Result<Vec<ChangeHash>, _> = digest.chunks(32).map(hash).collect();
        let Ok(heads) = heads else { return not_the_job(Self::NAME, "heads of 32 bytes each") };
        Ok(self.document.get_changes(&heads).iter().flat_map(|change| change.raw_bytes().to_vec()).collect())
    }
}
