//! A map against an ordered map that everybody trusts.

use super::*;
use crate::replica::node::FULL;
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
        let (mut kept, mut seen_alone, mut missed_alone) = (vec![], 0, 0);
        for round in 0..12_000_u64 {
            let key = below(span);
            let growing = round / 2000 % 2 == 0;
            if below(10) < if growing { 7 } else { 3 } {
                assert_eq!(map.insert(key, round), known.insert(key, round));
            } else {
                match below(6) {
                    0 => assert_eq!(map.get_mut(&key), known.get_mut(&key)),
                    1 => {
                        map.upsert(key, round, |value| *value += round);
                        known.entry(key).and_modify(|value| *value += round).or_insert(round);
                    }
                    2 => {
                        let stays = |value: &mut u64| {
                            *value += 1;
                            value.is_multiple_of(2)
                        };
                        let gone = map.remove_if(&key, |value| !stays(value));
                        let known_to_go = known.get_mut(&key).is_some_and(|value| !stays(value));
                        assert_eq!(gone, if known_to_go { known.remove(&key) } else { None });
                    }
                    3 => {
                        // Groups of four.
                        let (least, other) = (key / 4 * 4, key / 4 * 4 + below(4));
                        let group: Vec<u64> = known.range(least..least + 4).map(|(&key, _)| key).collect();
                        let found = map.only_of(&least, |key| key / 4 == least / 4);
                        if let Some((found, value)) = found {
                            assert_eq!((vec![*found], *value), (group.clone(), known[found]));
                            known.remove(found);
                            known.insert(other, round);
                            (*found, *value) = (other, round);
                            seen_alone += 1;
                        } else {
                            missed_alone += usize::from(group.len() == 1);
                        }
                    }
                    _ => assert_eq!(map.remove(&key), known.remove(&key)),
                }
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
        assert!(seen_alone > 30 && missed_alone * 10 < seen_alone, "{seen_alone}, and missed {missed_alone}");
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
