//! yrs, the Rust port of Yjs.

use crate::error::{BenchError, Result, not_the_job};
use crate::scene::{Content, Link, Plan, Reconciles, Scene};
use std::sync::Arc;
use yrs::any::Number;
use yrs::updates::decoder::Decode;
use yrs::updates::encoder::Encode;
use yrs::{Any, Doc, Map, MapPrelim, MapRef, Out, ReadTxn, StateVector, Transact, TransactionMut, Update};

/// A document of yrs.
#[derive(Debug)]
pub struct Yrs {
    document: Doc,
    all: MapRef,
    edges: MapRef,
    vertices: Vec<MapRef>,
    names: Vec<Arc<str>>,
}

fn any(content: &Content) -> Any {
    match content {
        Content::Double(number) => Any::Number((*number).into()),
        Content::Bytes(bytes) => Any::Buffer(bytes.clone()),
    }
}

fn add(all: &MapRef, transaction: &mut TransactionMut<'_>, name: &str, parent: &str) -> MapRef {
    let vertex = all.insert(transaction, name, MapPrelim::default());
    vertex.insert(transaction, "type", "thing");
    vertex.insert(transaction, "parent", parent);
    vertex
}

impl Scene for Yrs {
    const NAME: &'static str = "yrs";
    const MAPPING: &'static str = "a map by name of maps with `type`, `parent` and the attributes, kept at hand; edges as \
        entries of one map; `encode_update_v1` of the transaction, `apply_update`. No tree: a parent is an entry, and a \
        cycle is nobody's concern.";

    fn empty(replica: u16) -> Result<Self> {
        let document = Doc::with_client_id(u64::from(replica));
        let (all, edges) = (document.get_or_insert_map("vertices"), document.get_or_insert_map("edges"));
        Ok(Self { document, all, edges, vertices: Vec::new(), names: Vec::new() })
    }

    fn populate(&mut self, plan: &Plan) -> Result<()> {
        let mut transaction = self.document.transact_mut();
        for (name, parent) in plan.names.iter().zip(&plan.parents) {
            let parent = parent.map_or("root", |parent| &plan.names[parent]);
            self.vertices.push(add(&self.all, &mut transaction, name, parent));
            self.names.push(name.as_str().into());
        }
        Ok(())
    }

    fn save(&mut self) -> Result<Vec<u8>> {
        Ok(self.document.transact().encode_state_as_update_v1(&StateVector::default()))
    }

    fn load(replica: u16, bytes: &[u8]) -> Result<Self> {
        let mut loaded = Self::empty(replica)?;
        loaded.apply(bytes)?;
        Ok(loaded)
    }

    fn again(&mut self) -> Result<Self> {
        let bytes = self.save()?;
        let document = Doc::with_client_id(self.document.client_id().get());
        let (all, edges) = (document.get_or_insert_map("vertices"), document.get_or_insert_map("edges"));
        let mut again = Self { document, all, edges, vertices: Vec::new(), names: Vec::new() };
        again.apply(&bytes)?;
        Ok(again)
    }

    fn find(&mut self, plan: &Plan) -> Result<()> {
        let transaction = self.document.transact();
        for name in &plan.names {
            let Some(Out::YMap(vertex)) = self.all.get(&transaction, name) else {
                return not_the_job(Self::NAME, format!("{name} to have come"));
            };
            self.vertices.push(vertex);
            self.names.push(name.as_str().into());
        }
        Ok(())
    }

    fn count(&self) -> Result<usize> {
        Ok(self.all.len(&self.document.transact()) as usize)
    }

    fn set(&mut self, vertex: usize, value: &Content) -> Result<Vec<u8>> {
        let mut transaction = self.document.transact_mut();
        self.vertices[vertex].insert(&mut transaction, "level", any(value));
        Ok(transaction.encode_update_v1())
    }

    fn set_unencoded(&mut self, vertex: usize, value: &Content) -> Result<()> {
        self.vertices[vertex].insert(&mut self.document.transact_mut(), "level", any(value));
        Ok(())
    }

    fn read(&self, vertex: usize) -> Result<Option<Content>> {
        Ok(match self.vertices[vertex].get(&self.document.transact(), "level") {
            Some(Out::Any(Any::Number(Number::Float(number)))) => Some(Content::Double(number)),
            Some(Out::Any(Any::Buffer(bytes))) => Some(Content::Bytes(bytes)),
            _ => None,
        })
    }

    fn add_vertex(&mut self, name: &str, parent: usize) -> Result<Vec<u8>> {
        let mut transaction = self.document.transact_mut();
        self.vertices.push(add(&self.all, &mut transaction, name, &self.names[parent]));
        let delta = transaction.encode_update_v1();
        drop(transaction);
        self.names.push(name.into());
        Ok(delta)
    }

    fn remove_last_vertex(&mut self, name: &str) -> Result<Vec<u8>> {
        self.vertices.pop();
        self.names.pop();
        let mut transaction = self.document.transact_mut();
        self.all.remove(&mut transaction, name);
        Ok(transaction.encode_update_v1())
    }

    fn add_edge(&mut self, link: &Link) -> Result<Vec<u8>> {
        let mut transaction = self.document.transact_mut();
        self.edges.insert(&mut transaction, link.key.as_str(), true);
        Ok(transaction.encode_update_v1())
    }

    fn remove_edge(&mut self, link: &Link) -> Result<Vec<u8>> {
        let mut transaction = self.document.transact_mut();
        self.edges.remove(&mut transaction, &link.key);
        Ok(transaction.encode_update_v1())
    }

    fn has_edge(&self, link: &Link) -> Result<bool> {
        Ok(self.edges.contains_key(&self.document.transact(), &link.key))
    }

    fn apply(&mut self, message: &[u8]) -> Result<()> {
        self.document.transact_mut().apply_update(Update::decode_v1(message)?)?;
        Ok(())
    }

    type Whole = Vec<u8>;

    fn whole(&mut self) -> Result<Vec<u8>> {
        self.save()
    }

    fn merge(&mut self, other: Vec<u8>) -> Result<()> {
        self.apply(&other)
    }
}

impl Reconciles for Yrs {
    fn digest(&mut self) -> Result<Vec<u8>> {
        Ok(self.document.transact().state_vector().encode_v1())
    }

    fn missing(&mut self, digest: &[u8]) -> Result<Vec<u8>> {
        let theirs = StateVector::decode_v1(digest).map_err(BenchError::from)?;
        Ok(self.document.transact().encode_diff_v1(&theirs))
    }
}
