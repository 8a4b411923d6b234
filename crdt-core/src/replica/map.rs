//! An ordered map whose clone shares everything: a B-tree of shared nodes, copied only where a writer meets
//! a node that somebody else still reads.
//!
//! | operation | comparisons | copies |
//! |---|---|---|
//! | `get`, `range` | O(log n) | none |
//! | `insert`, `remove`, `get_mut` | O(log n), and O(64) moves | none, or O(log n) nodes after a `clone` |
//! | `clone` | none | none |
//!
//! A node that is full is split where the new entry goes, not in the middle, so that keys that only grow, as
//! dots do, fill every leaf.

use super::node::{List, Node, child_of};
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::borrow::Borrow;
use core::iter::Zip;
use core::slice;

/// See the [module](self).
#[derive(Debug)]
pub(crate) struct Map<K, V> {
    root: Arc<Node<K, V>>,
    len: usize,
}

impl<K, V> Clone for Map<K, V> {
    fn clone(&self) -> Self {
        Self { root: Arc::clone(&self.root), len: self.len }
    }
}

impl<K, V> Default for Map<K, V> {
    fn default() -> Self {
        Self { root: Arc::new(Node::Leaf(List::new())), len: 0 }
    }
}

impl<K: Ord + Clone, V: Clone> Map<K, V> {
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.len == 0
    }

    pub(crate) fn get<Q: Ord + ?Sized>(&self, key: &Q) -> Option<&V>
    where
        K: Borrow<Q>,
    {
        let mut node = &*self.root;
        loop {
            match node {
                Node::Leaf(entries) => {
                    let at = entries.keys.binary_search_by(|known| known.borrow().cmp(key)).ok()?;
                    return Some(&entries.values[at]);
                }
                Node::Inner(children) => node = &children.values[child_of(&children.keys, key)],
            }
        }
    }

    pub(crate) fn contains(&self, key: &K) -> bool {
        self.get(key).is_some()
    }

    /// For a key that is there: what is not there costs a second descent, and copies nothing.
    pub(crate) fn get_mut(&mut self, key: &K) -> Option<&mut V> {
        if Arc::get_mut(&mut self.root).is_none() && !self.contains(key) {
            return None;
        }
        let mut node = Arc::make_mut(&mut self.root);
        loop {
            match node {
                Node::Leaf(entries) => {
                    let at = entries.keys.binary_search(key).ok()?;
                    return Some(&mut entries.values[at]);
                }
                Node::Inner(children) => {
                    let at = child_of(&children.keys, key);
                    node = Arc::make_mut(&mut children.values[at]);
                }
            }
        }
    }

    /// Inserts; the value replaced.
    pub(crate) fn insert(&mut self, key: K, value: V) -> Option<V> {
        self.insert_or(key, value, core::mem::replace)
    }

    /// Inserts, or changes what is there already.
    pub(crate) fn upsert(&mut self, key: K, value: V, change: impl FnOnce(&mut V)) {
        self.insert_or(key, value, |held, _| change(held));
    }

    /// Inserts, or lets `meet` deal with the value that is there; what it says.
    fn insert_or<R>(&mut self, key: K, value: V, meet: impl FnOnce(&mut V, V) -> R) -> Option<R> {
        let root = Arc::make_mut(&mut self.root);
        let (answer, added) = root.insert(key, value, meet);
        if let Some((least, right)) = added {
            // The first key is not looked at: any will do.
            let left = core::mem::replace(&mut self.root, Arc::new(Node::Leaf(List::new())));
            let children = List { keys: Vec::from([least.clone(), least]), values: Vec::from([left, right]) };
            self.root = Arc::new(Node::Inner(children));
        }
        self.len += usize::from(answer.is_none());
        answer
    }

    /// Removes; the value that was there.
    pub(crate) fn remove(&mut self, key: &K) -> Option<V> {
        self.remove_if(key, |_| true)
    }

    /// Removes what is there if it is to go, as `goes` says, which may change what stays; the value removed.
    pub(crate) fn remove_if(&mut self, key: &K, goes: impl FnOnce(&mut V) -> bool) -> Option<V> {
        if Arc::get_mut(&mut self.root).is_none() && !self.contains(key) {
            return None;
        }
        let old = Arc::make_mut(&mut self.root).remove(key, goes)?;
        self.len -= 1;
        while let Node::Inner(children) = &*self.root
            && let [only] = &children.values[..]
        {
            self.root = Arc::clone(only);
        }
        Some(old)
    }

    /// The entry of a group of neighbours, if it is the only one, or `None` where that would take a second look.
    /// `least` is not above any key of the group. Its key may be changed to any other of the group.
    pub(crate) fn only_of(
        &mut self,
        least: &K,
        is_of_group: impl Fn(&K) -> bool,
    ) -> Option<(&mut K, &mut V)> {
        let mut node = Arc::make_mut(&mut self.root);
        let mut next = None;
        loop {
            match node {
                Node::Leaf(List { keys, values }) => {
                    let at = keys.partition_point(|known| known < least);
                    let is_only = !keys.get(at + 1).or(next).is_some_and(&is_of_group);
                    let key = keys.get_mut(at).filter(|key| is_only && is_of_group(key))?;
                    return Some((key, &mut values[at]));
                }
                Node::Inner(List { keys, values }) => {
                    let at = child_of(keys, least);
                    next = keys.get(at + 1).or(next);
                    node = Arc::make_mut(&mut values[at]);
                }
            }
        }
    }

    /// The entries from `key` on, ascending.
    pub(crate) fn range(&self, key: &K) -> Range<'_, K, V> {
        let (leaf, next) = self.leaf_from(key);
        let start = leaf.keys.partition_point(|known| known < key);
        Range { map: self, leaf: leaf.keys[start..].iter().zip(&leaf.values[start..]), next }
    }

    /// The leaf that a key belongs to, and the key at which the leaf after it begins.
    fn leaf_from(&self, key: &K) -> (&List<K, V>, Option<&K>) {
        let (mut node, mut next) = (&*self.root, None);
        loop {
            match node {
                Node::Leaf(entries) => return (entries, next),
                Node::Inner(children) => {
                    let at = child_of(&children.keys, key);
                    next = children.keys.get(at + 1).or(next);
                    node = &children.values[at];
                }
            }
        }
    }

    /// All entries, ascending.
    pub(crate) fn iter(&self) -> Range<'_, K, V> {
        let (mut node, mut next) = (&*self.root, None);
        loop {
            match node {
                Node::Leaf(entries) => {
                    return Range { map: self, leaf: entries.keys.iter().zip(&entries.values), next };
                }
                Node::Inner(children) => {
                    next = children.keys.get(1).or(next);
                    node = &children.values[0];
                }
            }
        }
    }

    /// The greatest entry.
    pub(crate) fn last(&self) -> Option<(&K, &V)> {
        let mut node = &*self.root;
        loop {
            match node {
                Node::Leaf(entries) => return entries.keys.last().zip(entries.values.last()),
                Node::Inner(children) => node = children.values.last()?,
            }
        }
    }
}

/// Entries in order.
#[derive(Debug)]
pub(crate) struct Range<'m, K, V> {
    map: &'m Map<K, V>,
    leaf: Zip<slice::Iter<'m, K>, slice::Iter<'m, V>>,
    next: Option<&'m K>,
}

impl<K, V> Clone for Range<'_, K, V> {
    fn clone(&self) -> Self {
        Self { map: self.map, leaf: self.leaf.clone(), next: self.next }
    }
}

impl<'m, K: Ord + Clone, V: Clone> Iterator for Range<'m, K, V> {
    type Item = (&'m K, &'m V);

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some((key, value)) = self.leaf.next() {
                return Some((key, value));
            }
            let (leaf, next) = self.map.leaf_from(self.next?);
            (self.leaf, self.next) = (leaf.keys.iter().zip(&leaf.values), next);
        }
    }
}

#[cfg(test)]
mod tests;
