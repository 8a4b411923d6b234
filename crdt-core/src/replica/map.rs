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
use core::iter::Zip;
use core::slice;

/// The most entries of a node.
const FULL: usize = 64;
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
    /// Entries, ascending.
    Leaf(List<K, V>),
    /// Each child with a key that is above all keys before it and not above any key in it; the first child's
    /// key is not looked at.
    Inner(List<K, Arc<Self>>),
}

/// Keys, and beside each what belongs to it: apart, since a search reads keys only.
#[derive(Debug)]
struct List<K, V> {
    keys: Vec<K>,
    values: Vec<V>,
}

impl<K: Clone, V: Clone> Clone for List<K, V> {
    fn clone(&self) -> Self {
        let (mut keys, mut values) = (Vec::with_capacity(FULL), Vec::with_capacity(FULL));
        keys.extend_from_slice(&self.keys);
        values.extend_from_slice(&self.values);
        Self { keys, values }
    }
}

impl<K, V> List<K, V> {
    const fn new() -> Self {
        Self { keys: Vec::new(), values: Vec::new() }
    }

    fn len(&self) -> usize {
        self.keys.len()
    }

    fn insert(&mut self, at: usize, (key, value): (K, V)) {
        self.keys.insert(at, key);
        self.values.insert(at, value);
    }

    fn remove(&mut self, at: usize) -> (K, V) {
        (self.keys.remove(at), self.values.remove(at))
    }

    fn split_off(&mut self, at: usize) -> Self {
        let (mut keys, mut values) = (Vec::with_capacity(FULL), Vec::with_capacity(FULL));
        keys.extend(self.keys.drain(at..));
        values.extend(self.values.drain(at..));
        Self { keys, values }
    }

    fn append(&mut self, other: &mut Self) {
        self.keys.append(&mut other.keys);
        self.values.append(&mut other.values);
    }

    /// Inserts; if there is no room, into the one of two halves that it belongs to, of which the right one is
    /// returned.
    fn insert_or_split(&mut self, at: usize, entry: (K, V)) -> Option<Self> {
        if self.len() < FULL {
            self.insert(at, entry);
            return None;
        }
        if at == FULL {
            let mut right = Self { keys: Vec::with_capacity(2), values: Vec::with_capacity(2) };
            right.insert(0, entry);
            return Some(right);
        }
        // Two entries at least go to the right, so that no inner node has one child for long.
        let mut right = self.split_off(if at <= FULL / 2 { FULL / 2 } else { at.min(FULL - 2) });
        match at.checked_sub(self.len()) {
            Some(at) if at > 0 => right.insert(at, entry),
            _ => self.insert(at, entry),
        }
        Some(right)
    }
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

/// Which child of an inner node a key belongs to.
fn child_of<K: Borrow<Q>, Q: Ord + ?Sized>(keys: &[K], key: &Q) -> usize {
    keys.partition_point(|least| least.borrow() <= key).saturating_sub(1)
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
            Self::Leaf(entries) => match entries.keys.binary_search(&key) {
                Ok(at) => (Some(core::mem::replace(&mut entries.values[at], value)), None),
                Err(at) => {
                    let right = entries.insert_or_split(at, (key, value));
                    (None, right.map(|right| (right.keys[0].clone(), Arc::new(Self::Leaf(right)))))
                }
            },
            Self::Inner(children) => {
                let at = child_of(&children.keys, &key);
                let (old, added) = Arc::make_mut(&mut children.values[at]).insert(key, value);
                let right = added.and_then(|added| children.insert_or_split(at + 1, added));
                (old, right.map(|right| (right.keys[0].clone(), Arc::new(Self::Inner(right)))))
            }
        }
    }

    fn remove(&mut self, key: &K) -> Option<V> {
        match self {
            Self::Leaf(entries) => {
                let at = entries.keys.binary_search(key).ok()?;
                Some(entries.remove(at).1)
            }
            Self::Inner(children) => {
                let at = child_of(&children.keys, key);
                let child = Arc::make_mut(&mut children.values[at]);
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
fn balance<K: Ord + Clone, V: Clone>(children: &mut List<K, Arc<Node<K, V>>>, left: usize) {
    let (least, mut right) = children.remove(left + 1);
    let left_node = Arc::make_mut(&mut children.values[left]);
    let rest = match (left_node, Arc::make_mut(&mut right)) {
        (Node::Leaf(left), Node::Leaf(right)) => {
            level(left, right).map(|rest| (rest.keys[0].clone(), Node::Leaf(rest)))
        }
        (Node::Inner(left), Node::Inner(right)) => {
            // The first key was not looked at so far.
            right.keys[0] = least;
            level(left, right).map(|rest| (rest.keys[0].clone(), Node::Inner(rest)))
        }
        // All leaves are on one level.
        _ => None,
    };
    if let Some((least, rest)) = rest {
        children.insert(left + 1, (least, Arc::new(rest)));
    }
}

/// Moves all to the left, and half of it back if it is too much for one node.
fn level<K, V>(left: &mut List<K, V>, right: &mut List<K, V>) -> Option<List<K, V>> {
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
        let root = Arc::make_mut(&mut self.root);
        let (old, added) = root.insert(key, value);
        if let Some((least, right)) = added {
            // The first key is not looked at: any will do.
            let left = core::mem::replace(&mut self.root, Arc::new(Node::Leaf(List::new())));
            let children = List { keys: Vec::from([least.clone(), least]), values: Vec::from([left, right]) };
            self.root = Arc::new(Node::Inner(children));
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
            && let [only] = &children.values[..]
        {
            self.root = Arc::clone(only);
        }
        Some(old)
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
                    assert!(entries.keys.iter().all(inside));
                    assert!(entries.keys.is_sorted_by(|l, r| l < r));
                    assert_eq!(entries.keys.len(), entries.values.len());
                    0
                }
                Node::Inner(children) => {
                    assert!(children.len() > 1 && children.len() == children.values.len());
                    assert!(children.keys[1..].iter().all(inside));
                    let depths: Vec<usize> = (0..children.len())
                        .map(|at| {
                            let low = if at == 0 { low } else { Some(&children.keys[at]) };
                            let high = children.keys.get(at + 1).or(high);
                            Self::check(&children.values[at], low, high)
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
                Node::Inner(children) => children.values.iter().map(|child| leaves(child)).sum(),
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
