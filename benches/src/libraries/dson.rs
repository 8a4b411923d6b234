//! dson.

use crate::error::{Result, not_the_job};
use crate::scene::{Content, Link, Plan, Reconciles, Scene};
use dson::api::{map, register};
use dson::crdts::mvreg::MvRegValue;
use dson::{CausalContext, CausalDotStore, Identifier, OrMap};

type Store = CausalDotStore<OrMap<String>>;

/// A store of dson.
#[derive(Debug)]
pub struct Dson {
    id: Identifier,
    store: Store,
    names: Vec<String>,
}

impl Dson {
    fn join(&mut self, delta: Store) {
        self.store.join_or_replace_with(delta.store, &delta.context);
    }

    /// Writes a register of a vertex; the delta, joined.
    fn write(&mut self, vertex: &str, name: &str, value: MvRegValue) -> Store {
        let write = move |held: &dson::MvReg, context: &_, id| held.write(value, context, id);
        let update = map::apply_to_map(map::apply_to_register(write, name.to_owned()), vertex.to_owned());
        let delta = update(&self.store.store, &self.store.context, self.id);
        self.join(delta.clone());
        delta
    }

    fn level(&mut self, vertex: usize, value: &Content) -> Store {
        let value = match value {
            Content::Double(number) => MvRegValue::Double(*number),
            Content::Bytes(bytes) => MvRegValue::Bytes(bytes.to_vec()),
        };
        let name = self.names[vertex].clone();
        self.write(&name, "level", value)
    }

    fn add(&mut self, name: &str, parent: &str) -> Store {
        let delta = self.write(name, "parent", MvRegValue::String(parent.to_owned()));
        self.names.push(name.to_owned());
        delta
    }

    fn edge(link: &Link) -> String {
        format!("near {}", link.to)
    }
}

fn bytes(delta: &Store) -> Result<Vec<u8>> {
    Ok(rmp_serde::to_vec(delta)?)
}

impl Scene for Dson {
    const NAME: &'static str = "dson";
    const MAPPING: &'static str = "`OrMap` by name of `OrMap` of registers, `parent` and the attribute; edges as registers \
        of their source. The functions of `dson::api`, which copy nothing, not transactions, which copy the store. The \
        crate encodes nothing; MessagePack, as its source recommends. No tree. A join makes the whole map anew.";

    fn empty(replica: u16) -> Result<Self> {
        Ok(Self { id: Identifier::new(1, replica), store: Store::default(), names: Vec::new() })
    }

    fn populate(&mut self, plan: &Plan) -> Result<()> {
        for (name, parent) in plan.names.iter().zip(&plan.parents) {
            self.add(name, parent.map_or("root", |parent| &plan.names[parent]));
        }
        Ok(())
    }

    fn save(&mut self) -> Result<Vec<u8>> {
        bytes(&self.store)
    }

    fn load(replica: u16, bytes: &[u8]) -> Result<Self> {
        let mut loaded = Self::empty(replica)?;
        loaded.apply(bytes)?;
        Ok(loaded)
    }

    fn again(&mut self) -> Result<Self> {
        Ok(Self { id: self.id, store: self.store.clone(), names: self.names.clone() })
    }

    fn find(&mut self, plan: &Plan) -> Result<()> {
        self.names.clone_from(&plan.names);
        if self.names.iter().all(|name| self.store.store.get(name).is_some()) {
            Ok(())
        } else {
            not_the_job(Self::NAME, "all vertices to have come")
        }
    }

    fn count(&self) -> Result<usize> {
        Ok(self.store.store.len())
    }

    fn set(&mut self, vertex: usize, value: &Content) -> Result<Vec<u8>> {
        let delta = self.level(vertex, value);
        bytes(&delta)
    }

    fn set_unencoded(&mut self, vertex: usize, value: &Content) -> Result<()> {
        std::hint::black_box(self.level(vertex, value));
        Ok(())
    }

    fn read(&self, vertex: usize) -> Result<Option<Content>> {
        let held = self.store.store.get(&self.names[vertex]).and_then(|vertex| vertex.map.get("level"));
        Ok(held.and_then(|held| match register::value(&held.reg) {
            Ok(MvRegValue::Double(number)) => Some(Content::Double(*number)),
            Ok(MvRegValue::Bytes(bytes)) => Some(Content::Bytes(bytes.as_slice().into())),
            _ => None,
        }))
    }

    fn add_vertex(&mut self, name: &str, parent: usize) -> Result<Vec<u8>> {
        let parent = self.names[parent].clone();
        let delta = self.add(name, &parent);
        bytes(&delta)
    }

    fn remove_last_vertex(&mut self, name: &str) -> Result<Vec<u8>> {
        self.names.pop();
        let delta = map::remove(name)(&self.store.store, &self.store.context, self.id);
        self.join(delta.clone());
        bytes(&delta)
    }

    fn add_edge(&mut self, link: &Link) -> Result<Vec<u8>> {
        let from = self.names[link.from].clone();
        let delta = self.write(&from, &Self::edge(link), MvRegValue::Bool(true));
        bytes(&delta)
    }

    fn remove_edge(&mut self, link: &Link) -> Result<Vec<u8>> {
        let (from, edge) = (self.names[link.from].clone(), Self::edge(link));
        let removal = map::apply_to_map(
            |edges: &OrMap<String>, context: &_, id| edges.remove(&edge, context, id),
            from,
        );
        let delta = removal(&self.store.store, &self.store.context, self.id);
        self.join(delta.clone());
        bytes(&delta)
    }

    fn has_edge(&self, link: &Link) -> Result<bool> {
        let from = self.store.store.get(&self.names[link.from]);
        Ok(from.is_some_and(|from| from.map.get(&Self::edge(link)).is_some()))
    }

    fn apply(&mut self, message: &[u8]) -> Result<()> {
        self.join(rmp_serde::from_slice(message)?);
        Ok(())
    }

    type Whole = Store;

    fn whole(&mut self) -> Result<Store> {
        Ok(self.store.clone())
    }

    fn merge(&mut self, other: Store) -> Result<()> {
        self.join(other);
        Ok(())
    }
}

impl Reconciles for Dson {
    fn digest(&mut self) -> Result<Vec<u8>> {
        Ok(rmp_serde::to_vec(&self.store.context)?)
    }

    fn missing(&mut self, digest: &[u8]) -> Result<Vec<u8>> {
        let theirs: CausalContext = rmp_serde::from_slice(digest)?;
        bytes(&self.store.subset_for_inflation_from(&theirs))
    }
}
