//! The nodes of a [`Map`](super::map::Map).

use alloc::sync::Arc;
use alloc::vec::Vec;
use core::borrow::Borrow;

/// The most entries of a node.
pub(super) const FULL: usize = 64;
/// A node with fewer is united with its neighbour, or takes from it.
const THIN: usize = FULL / 4;
/// The room for new entries in a copy of a node.
const SPARE: usize = 4;

#[derive(Clone, Debug)]
pub(super) enum Node<K, V> {
    /// Entries, ascending.
    Leaf(List<K, V>),
    /// Each child with a key that is above all keys before it and not above any key in it; the first child's
    /// key is not looked at.
    Inner(List<K, Arc<Self>>),
}

/// Keys, and beside each what belongs to it: apart, since a search reads keys only.
#[derive(Debug)]
pub(super) struct List<K, V> {
    pub(super) keys: Vec<K>,
    pub(super) values: Vec<V>,
}

/// With room for some more: who copies a node is about to write to it.
impl<K: Clone, V: Clone> Clone for List<K, V> {
    fn clone(&self) -> Self {
        let room = (self.len() + SPARE).min(FULL);
        let (mut keys, mut values) = (Vec::with_capacity(room), Vec::with_capacity(room));
        keys.extend_from_slice(&self.keys);
        values.extend_from_slice(&self.values);
        Self { keys, values }
    }
}

impl<K, V> List<K, V> {
    pub(super) const fn new() -> Self {
        Self { keys: Vec::new(), values: Vec::new() }
    }

    pub(super) fn len(&self) -> usize {
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

/// Which child of an inner node a key belongs to.
pub(super) fn child_of<K: Borrow<Q>, Q: Ord + ?Sized>(keys: &[K], key: &Q) -> usize {
    // Keys mostly grow.
    match keys.last() {
        Some(last) if last.borrow() <= key => keys.len() - 1,
        _ => keys.partition_point(|least| least.borrow() <= key).saturating_sub(1),
    }
}

/// What was said of the value met, and a right neighbour.
type Inserted<K, V, R> = (Option<R>, Option<(K, Arc<Node<K, V>>)>);

impl<K: Ord + Clone, V: Clone> Node<K, V> {
    pub(super) fn size(&self) -> usize {
        match self {
            Self::Leaf(entries) => entries.len(),
            Self::Inner(children) => children.len(),
        }
    }

    /// Inserts, or lets `meet` deal with the value that is there; what it says, and a right neighbour if the node
    /// was split.
    pub(super) fn insert<R>(
        &mut self,
        key: K,
        value: V,
        meet: impl FnOnce(&mut V, V) -> R,
    ) -> Inserted<K, V, R> {
        match self {
            Self::Leaf(entries) => match entries.keys.binary_search(&key) {
                Ok(at) => (Some(meet(&mut entries.values[at], value)), None),
                Err(at) => {
                    let right = entries.insert_or_split(at, (key, value));
                    (None, right.map(|right| (right.keys[0].clone(), Arc::new(Self::Leaf(right)))))
                }
            },
            Self::Inner(children) => {
                let at = child_of(&children.keys, &key);
                let (answer, added) = Arc::make_mut(&mut children.values[at]).insert(key, value, meet);
                let right = added.and_then(|added| children.insert_or_split(at + 1, added));
                (answer, right.map(|right| (right.keys[0].clone(), Arc::new(Self::Inner(right)))))
            }
        }
    }

    /// Removes what `goes` says is to go; the value removed.
    pub(super) fn remove(&mut self, key: &K, goes: impl FnOnce(&mut V) -> bool) -> Option<V> {
        match self {
            Self::Leaf(entries) => {
                let at = entries.keys.binary_search(key).ok()?;
                goes(&mut entries.values[at]).then(|| entries.remove(at).1)
            }
            Self::Inner(children) => {
                let at = child_of(&children.keys, key);
                let child = Arc::make_mut(&mut children.values[at]);
                let old = child.remove(key, goes)?;
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
