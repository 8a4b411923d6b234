//! Every index against the records that it is an index of: nothing is missing, and nothing is left behind.

use super::Replica;
use super::graph::{Graph, hash_of};
use super::held::{Held, Link, NONE, Status, mix};
use crate::{Dictionary, Dot, ReplicaId, State, ValueType, decode};
use alloc::collections::{BTreeMap, BTreeSet};
use dsr_testkit::encoded_states;
use proptest::prelude::*;

fn keys<K: Ord + Clone, V: Clone>(map: &super::map::Map<K, V>) -> BTreeSet<K> {
    map.iter().map(|(key, _)| key.clone()).collect()
}

impl Graph {
    /// What the indexes must hold, from the records alone.
    pub(super) fn check_indexes(&self) {
        let (mut claims, mut ends, mut loose) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
        let (mut named, mut typed, mut labelled) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
        let (mut writes, mut broken, mut stamps) = (BTreeSet::new(), BTreeSet::new(), BTreeMap::new());
        let (mut uses, mut children, mut ways) = (BTreeMap::new(), BTreeMap::new(), BTreeSet::new());
        for (&dot, held) in self.records.iter() {
            let name = match held {
                Held::Vertex(vertex) => {
                    named.insert((hash_of(&vertex.name), dot));
                    typed.insert((vertex.vertex_type, dot));
                    if vertex.link == Link::ParentAndWay {
                        ways.insert(dot);
                    }
                    if let Some((_, edge)) = self.parent_edge(dot) {
                        *children.entry(edge.from).or_insert(0) += 1;
                    }
                    vertex.vertex_type
                }
                Held::Edge(edge) => {
                    let register = self.register_of(edge);
                    claims.insert((register.0, register.1, mix(register.2), dot));
                    ends.insert((edge.other_end(register.0), dot));
                    labelled.insert((edge.label, dot));
                    let hidden = edge.is_rt() && edge.to != NONE && edge.status == Status::Hidden;
                    let outranked = self
                        .parent_edge(edge.to)
                        .is_some_and(|(parent, by)| (by.stamp, parent) > (edge.stamp, dot));
                    if hidden && !outranked {
                        broken.insert((edge.stamp, dot));
                    }
                    edge.label
                }
                Held::Write(at) => {
                    writes.insert((at.target, at.name, dot));
                    at.name
                }
            };
            *uses.entry(name).or_insert(usize::from(name == super::names::RT_ID)) += 1;
            let Some(record) = self.record(dot) else { panic!("{dot} has no write") };
            *stamps.entry(record.stamp()).or_insert(0) += 1;
            let is_element =
                |dot| dot == NONE || matches!(self.records.get(&dot), Some(Held::Vertex(_) | Held::Edge(_)));
            loose.extend(record.anchors().filter(|&anchor| !is_element(anchor)).map(|anchor| (anchor, dot)));
        }
        uses.entry(super::names::RT_ID).or_insert(1);
        assert_eq!(keys(&self.claims), claims);
        assert_eq!(keys(&self.ends), ends);
        assert_eq!(keys(&self.loose), loose);
        assert_eq!(keys(&self.named), named);
        assert_eq!(keys(&self.typed), typed);
        assert_eq!(keys(&self.labelled), labelled);
        assert_eq!(keys(&self.writes), writes);
        assert_eq!(keys(&self.broken), broken);
        assert_eq!(keys(&self.ways), ways);
        assert_eq!(
            self.stamps.iter().map(|(&stamp, &count)| (stamp, count)).collect::<BTreeMap<_, _>>(),
            stamps
        );
        assert_eq!(self.names.uses(), uses);
        self.check_vertices(&children);
    }

    fn check_vertices(&self, children: &BTreeMap<Dot, u32>) {
        let mut banded = BTreeSet::new();
        for (&leader, band) in self.bands.iter() {
            for &member in band.members.iter() {
                assert_eq!(self.strays.get(&member), Some(&leader));
                assert!(banded.insert(member));
            }
        }
        assert_eq!(keys(&self.strays), banded);
        for (&dot, held) in self.records.iter() {
            let Held::Vertex(vertex) = held else { continue };
            assert_eq!(vertex.children, children.get(&dot).copied().unwrap_or(0));
            // Each way is of shown edges, and ends at the root; a stray has none.
            let (mut at, mut steps) = (dot, 0);
            while at != NONE && !self.strays.contains(&dot) {
                let up = self.up_of(at);
                let Some(edge) = self.edge_held(up) else { panic!("{at} has no way") };
                assert_eq!(edge.status, Status::Shown);
                (at, steps) = (edge.other_end(at), steps + 1);
                assert!(steps <= self.records.len(), "a way goes round");
            }
            assert!(!self.strays.contains(&dot) || self.up_of(dot) == NONE);
        }
    }
}

proptest! {
    #![proptest_config(dsr_testkit::cases(2000))]

    /// `[spec: STATE-6]` `[spec: REPLICA-1]`
    #[test]
    fn law_indexes_hold_what_is_held_and_nothing_else(parts in encoded_states(4, 24)) {
        let mut dictionary = Dictionary::open().with_functional("in");
        dictionary.attributes.insert("a".into(), ValueType::Int);
        let mut replica = Replica::new(ReplicaId::agent(1), dictionary);
        for part in &parts {
            replica.apply(&decode(part).unwrap());
            replica.graph.check_indexes();
        }
        // Everything dies: nothing is left but the dots.
        let everything = State::assemble([], replica.context().clone());
        replica.apply(&everything);
        replica.graph.check_indexes();
        prop_assert!(replica.is_empty() && replica.repairs().next().is_none());
        prop_assert!(replica.graph.detached.is_empty() && replica.graph.bands.is_empty());
    }

    /// Also where dots were used twice. `[spec: CRASH-3]`
    #[test]
    fn law_indexes_survive_dots_used_twice(mine in encoded_states(2, 12), theirs in encoded_states(2, 12)) {
        let mut replica = Replica::new(ReplicaId::agent(1), Dictionary::open().with_functional("in"));
        for part in [&mine[0], &theirs[0], &mine[1], &theirs[1]] {
            replica.apply(&decode(part).unwrap());
            replica.graph.check_indexes();
        }
    }
}
