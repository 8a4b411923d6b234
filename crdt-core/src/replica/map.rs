//! An ordered map whose clone shares everything: a B-tree of shared nodes, copied only where a writer meets
//! a node that somebody else still reads.
//!
//! | operation | comparisons | copies |
//! |---|---|---|
//! | `get`, `range` | O(log n) | none |
//! | `insert`, `remove`, `get_mut` | O(log n), and O([`FULL`]) moves | none, or O(log n) nodes after a `clone` |
//! | `clone` | none | none |
//!
//! A node that is full is split where the new entry goes, not in the middle, so that keys that only grow, as
//! dots do, fill every leaf.

use alloc::sync::Arc;
use alloc::vec::Vec;
use core::borrow::Borrow;
use core::slice;

/// The most entries of a node.
const FULL: usize = 32;
/// A node with fewer is united with its neighbour, or takes from it.
const THIN: usize = FULL / 4;

/// See the [module](self).
#[derive(Debug)]
pub(crate) struct Map<K, V> {
    root: Arc<Node<K, V>>,
    len: usize,
}

#[derive(Clone, Debug)]
enum Node<K, V> {
    /// Ascending.
    Leaf(Vec<(K, V)>),
    /// Each child with a key that is above all keys before it and not above any key in it; the first child's
    /// key is not looked at.
    Inner(Vec<(K, Arc<Self>)>),
}

impl<K, V> Clone for Map<K, V> {
    fn clone(&self) -> Self {
        Self { root: Arc::clone(&self.root), len: self.len }
    }
}

impl<K, V> Default for Map<K, V> {
    fn default() -> Self {
        Self { root: Arc::new(Node::Leaf(Vec::new())), len: 0 }
    }
}

/// Which child of an inner node a key belongs to.
fn child_of<K: Borrow<Q>, Q: Ord + ?Sized, C>(children: &[(K, C)], key: &Q) -> usize {
    children.partition_point(|(least, _)| least.borrow() <= key).saturating_sub(1)
}

/// Splits a full list so that the entry that goes to `at` has room in the part returned or in the one left.
fn split<T>(list: &mut Vec<T>, at: usize) -> Vec<T> {
    // Two entries at least stay in each part of an inner node, so that none has one child for long.
    let at = if at <= FULL / 2 { FULL / 2 } else { at.min(FULL - 2) };
    let mut right = Vec::with_capacity(FULL);
    right.extend(list.drain(at..));
    right
}

/// Room for one more, never more than for a full node.
fn reserve<T>(list: &mut Vec<T>) {
    if list.len() == list.capacity() {
        let room = list.len().max(2).min(FULL.saturating_sub(list.len())).max(1);
        list.reserve_exact(room);
    }
}

type Inserted<K, V> = (Option<V>, Option<(K, Arc<Node<K, V>>)>);

impl<K: Ord + Clone, V: Clone> Node<K, V> {
    fn size(&self) -> usize {
        match self {
            Self::Leaf(entries) => entries.len(),
            Self::Inner(children) => children.len(),
        }
    }

    /// Inserts; the value replaced, and a right neighbour if the node was split.
    fn insert(&mut self, key: K, value: V) -> Inserted<K, V> {
        match self {
            Self::Leaf(entries) => {
                let at = match entries.binary_search_by(|(known, _)| known.cmp(&key)) {
                    Ok(at) => return (Some(core::mem::replace(&mut entries[at].1, value)), None),
                    Err(at) => at,
                };
                if entries.len() < FULL {
                    reserve(entries);
                    entries.insert(at, (key, value));
                    return (None, None);
                }
                if at == FULL {
                    let right = Self::Leaf(Vec::from([(key.clone(), value)]));
                    return (None, Some((key, Arc::new(right))));
                }
                let mut right = split(entries, at);
                match at.checked_sub(entries.len()) {
                    Some(at) if at > 0 => right.insert(at, (key, value)),
                    _ => entries.insert(at, (key, value)),
                }
                (None, Some((right[0].0.clone(), Arc::new(Self::Leaf(right)))))
            }
            Self::Inner(children) => {
                let at = child_of(children, &key);
                let (old, added) = Arc::make_mut(&mut children[at].1).insert(key, value);
                let Some(added) = added else { return (old, None) };
                let at = at + 1;
                if children.len() < FULL {
                    reserve(children);
                    children.insert(at, added);
                    return (old, None);
                }
                let mut right = split(children, at);
                match at.checked_sub(children.len()) {
                    Some(at) if at > 0 => right.insert(at, added),
                    _ => children.insert(at, added),
                }
                (old, Some((right[0].0.clone(), Arc::new(Self::Inner(right)))))
            }
        }
    }

    fn remove(&mut self, key: &K) -> Option<V> {
        match self {
            Self::Leaf(entries) => {
                let at = entries.binary_search_by(|(known, _)| known.cmp(key)).ok()?;
                Some(entries.remove(at).1)
            }
            Self::Inner(children) => {
                let at = child_of(children, key);
                let child = Arc::make_mut(&mut children[at].1);
                let old = child.remove(key)?;
                if child.size() < THIN && children.len() > 1 {
                    let left = at.min(children.len() - 2);
                    balance(children, left);
                }
                Some(old)
            }
        }
    }
}

/// Unites the children at `left` and after it, or shares their entries evenly if these are too many for one.
fn balance<K: Ord + Clone, V: Clone>(children: &mut Vec<(K, Arc<Node<K, V>>)>, left: usize) {
    let (least, mut right) = children.remove(left + 1);
    let left_node = Arc::make_mut(&mut children[left].1);
    let rest = match (left_node, Arc::make_mut(&mut right)) {
        (Node::Leaf(left), Node::Leaf(right)) => {
            level(left, right).map(|rest| (rest[0].0.clone(), Node::Leaf(rest)))
        }
        (Node::Inner(left), Node::Inner(right)) => {
            // The first key was not looked at so far.
            right[0].0 = least;
            level(left, right).map(|rest| (rest[0].0.clone(), Node::Inner(rest)))
        }
        // All leaves are on one level.
        _ => None,
    };
    if let Some((least, rest)) = rest {
        children.insert(left + 1, (least, Arc::new(rest)));
    }
}

/// Moves all to the left, and half of it back if it is too much for one node.
fn level<T>(left: &mut Vec<T>, right: &mut Vec<T>) -> Option<Vec<T>> {
    left.append(right);
    (left.len() > FULL).then(|| left.split_off(left.len() / 2))
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
                    let at = entries.binary_search_by(|(known, _)| known.borrow().cmp(key)).ok()?;
                    return Some(&entries[at].1);
                }
                Node::Inner(children) => node = &children[child_of(children, key)].1,
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
                    let at = entries.binary_search_by(|(known, _)| known.cmp(key)).ok()?;
                    return Some(&mut entries[at].1);
                }
                Node::Inner(children) => {
                    let at = child_of(children, key);
                    node = Arc::make_mut(&mut children[at].1);
                }
            }
        }
    }

    /// Inserts; the value replaced.
    pub(crate) fn insert(&mut self, key: K, value: V) -> Option<V> {
        let root = Arc::make_mut(&mut self.root);
        let (old, added) = root.insert(key, value);
        if let Some((least, right)) = added {
            // The first key is not looked at: any will do.
            let left = core::mem::replace(&mut self.root, Arc::new(Node::Leaf(Vec::new())));
            self.root = Arc::new(Node::Inner(Vec::from([(least.clone(), left), (least, right)])));
        }
        self.len += usize::from(old.is_none());
        old
    }

    /// Removes; the value that was there.
    pub(crate) fn remove(&mut self, key: &K) -> Option<V> {
        if Arc::get_mut(&mut self.root).is_none() && !self.contains(key) {
            return None;
        }
        let old = Arc::make_mut(&mut self.root).remove(key)?;
        self.len -= 1;
        while let Node::Inner(children) = &*self.root
            && let [(_, only)] = &children[..]
        {
            self.root = Arc::clone(only);
        }
        Some(old)
    }

    /// The entries from `key` on, ascending.
    pub(crate) fn range(&self, key: &K) -> Range<'_, K, V> {
        let (leaf, next) = self.leaf_from(key);
        let start = leaf.partition_point(|(known, _)| known < key);
        Range { map: self, leaf: leaf[start..].iter(), next }
    }

    /// The leaf that a key belongs to, and the key at which the leaf after it begins.
    fn leaf_from(&self, key: &K) -> (&[(K, V)], Option<&K>) {
        let (mut node, mut next) = (&*self.root, None);
        loop {
            match node {
                Node::Leaf(entries) => return (entries, next),
                Node::Inner(children) => {
                    let at = child_of(children, key);
                    next = children.get(at + 1).map(|(least, _)| least).or(next);
                    node = &children[at].1;
                }
            }
        }
    }

    /// All entries, ascending.
    pub(crate) fn iter(&self) -> Range<'_, K, V> {
        let (mut node, mut next) = (&*self.root, None);
        loop {
            match node {
                Node::Leaf(entries) => return Range { map: self, leaf: entries.iter(), next },
                Node::Inner(children) => {
                    next = children.get(1).map(|(least, _)| least).or(next);
                    node = &children[0].1;
                }
            }
        }
    }

    /// The greatest entry.
    pub(crate) fn last(&self) -> Option<(&K, &V)> {
        let mut node = &*self.root;
        loop {
            match node {
                Node::Leaf(entries) => return entries.last().map(|(key, value)| (key, value)),
                Node::Inner(children) => node = &children.last()?.1,
            }
        }
    }
}

/// Entries in order.
#[derive(Debug)]
pub(crate) struct Range<'m, K, V> {
    map: &'m Map<K, V>,
    leaf: slice::Iter<'m, (K, V)>,
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
            (self.leaf, self.next) = (leaf.iter(), next);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::collections::BTreeMap;
    use alloc::vec;

    impl<K: Ord + Clone, V: Clone> Map<K, V> {
        /// Depth of leaves; every node obeys its bounds.
        fn check(node: &Node<K, V>, low: Option<&K>, high: Option<&K>) -> usize {
            let inside = |key: &K| low.is_none_or(|low| low <= key) && high.is_none_or(|high| key < high);
            assert!(node.size() <= FULL);
            match node {
                Node::Leaf(entries) => {
                    assert!(entries.iter().all(|(key, _)| inside(key)));
                    assert!(entries.is_sorted_by(|l, r| l.0 < r.0));
                    0
                }
                Node::Inner(children) => {
                    assert!(!children.is_empty());
                    assert!(children[1..].iter().all(|(key, _)| inside(key)));
                    let depths: Vec<usize> = (0..children.len())
                        .map(|at| {
                            let low = if at == 0 { low } else { Some(&children[at].0) };
                            let high = children.get(at + 1).map(|(key, _)| key).or(high);
                            Self::check(&children[at].1, low, high)
                        })
                        .collect();
                    assert!(depths.windows(2).all(|pair| pair[0] == pair[1]));
                    depths[0] + 1
                }
            }
        }
    }

    /// Noise of Knuth's constants: the same on every run.
    fn noise() -> impl FnMut(u64) -> u64 {
        let mut state = 7_u64;
        move |below| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % below
        }
    }

    #[test]
    fn oracle_a_map_is_a_btree_map_and_its_clones_stay_as_they_were() {
        let mut below = noise();
        for span in [20, 300, 5000] {
            let (mut map, mut known) = (Map::default(), BTreeMap::new());
            let mut kept = vec![];
            for round in 0..12_000_u64 {
                let key = below(span);
                let growing = round / 2000 % 2 == 0;
                if below(10) < if growing { 7 } else { 3 } {
                    assert_eq!(map.insert(key, round), known.insert(key, round));
                } else if below(3) == 0 {
                    assert_eq!(map.get_mut(&key), known.get_mut(&key));
                } else {
                    assert_eq!(map.remove(&key), known.remove(&key));
                }
                let probe = below(span);
                assert_eq!(map.get(&probe), known.get(&probe));
                assert_eq!(map.range(&probe).next(), known.range(probe..).next());
                if round % 499 == 0 {
                    kept.push((map.clone(), known.clone()));
                }
                if round % 61 == 0 {
                    Map::check(&map.root, None, None);
                    assert!(map.iter().eq(known.iter()));
                    assert!(map.range(&probe).eq(known.range(probe..)));
                    assert_eq!((map.len(), map.last()), (known.len(), known.last_key_value()));
                }
            }
            assert!(kept.iter().all(|(map, known)| map.iter().eq(known.iter())));
            for key in 0..span {
                map.remove(&key);
            }
            assert!(map.is_empty() && map.iter().next().is_none());
        }
    }

    #[test]
    fn law_growing_keys_fill_every_leaf() {
        fn leaves<K, V>(node: &Node<K, V>) -> usize {
            match node {
                Node::Leaf(_) => 1,
                Node::Inner(children) => children.iter().map(|(_, child)| leaves(child)).sum(),
            }
        }
        // Two authors in turn: one grows in the middle.
        let mut map = Map::default();
        for at in 0..10_000_u64 {
            map.insert((at % 2, at), ());
        }
        Map::check(&map.root, None, None);
        assert!(leaves(&map.root) <= 10_000 / FULL + 10, "{}", leaves(&map.root));
    }
}
