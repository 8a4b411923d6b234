//! Texts and values as the checker's model takes them: names that live as long as the process, small numbers.
//!
//! Each distinct text and list of attributes is kept once, and never given back.

use dsr_conformance::protocol::Tagged;
use dsr_model::published::{Key, NodeId};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, MutexGuard, PoisonError};

static TABLES: Mutex<Tables> = Mutex::new(Tables {
    texts: BTreeSet::new(),
    lists: BTreeSet::new(),
    nodes: Table::new(),
    values: Table::new(),
});

type List = &'static [(Key, i64)];

struct Tables {
    texts: BTreeSet<&'static str>,
    lists: BTreeSet<List>,
    nodes: Table<&'static str>,
    values: Table<Tagged>,
}

/// Numbers for what is met, from 1.
struct Table<T> {
    numbers: BTreeMap<T, u32>,
    met: Vec<T>,
}

impl<T: Ord + Clone> Table<T> {
    const fn new() -> Self {
        Self { numbers: BTreeMap::new(), met: Vec::new() }
    }

    fn number(&mut self, of: T) -> u32 {
        let next = u32::try_from(self.met.len()).unwrap_or(u32::MAX).saturating_add(1);
        *self.numbers.entry(of.clone()).or_insert_with(|| {
            self.met.push(of);
            next
        })
    }

    fn of(&self, number: u32) -> Option<&T> {
        self.met.get(usize::try_from(number).ok()?.checked_sub(1)?)
    }
}

fn tables() -> MutexGuard<'static, Tables> {
    TABLES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A text that lives as long as the process.
pub(super) fn name(text: &str) -> &'static str {
    let mut tables = tables();
    if let Some(kept) = tables.texts.get(text) {
        return kept;
    }
    let kept: &'static str = Box::leak(text.into());
    tables.texts.insert(kept);
    kept
}

/// A list that lives as long as the process.
pub(super) fn list(list: Vec<(Key, i64)>) -> List {
    let mut tables = tables();
    if let Some(kept) = tables.lists.get(list.as_slice()) {
        return kept;
    }
    let kept: List = Box::leak(list.into());
    tables.lists.insert(kept);
    kept
}

/// The node of a handle.
pub(super) fn node(handle: &str) -> NodeId {
    let handle = name(handle);
    tables().nodes.number(handle)
}

/// The handle of a node.
pub(super) fn text(node: NodeId) -> Option<&'static str> {
    tables().nodes.of(node).copied()
}

/// The number of a value.
pub(super) fn number(value: &Tagged) -> i64 {
    i64::from(tables().values.number(value.clone()))
}

/// The value of a number.
pub(super) fn value(number: i64) -> Option<Tagged> {
    tables().values.of(u32::try_from(number).ok()?).cloned()
}
