//! Attributes: each (target, name) is a multi-value register of its live writes. `[spec: VIEW-8]`
//! `[spec: INV-5]`

use super::{Repair, ShownEdge};
use crate::dictionary::Dictionary;
use crate::dot::{Dot, EdgeId, VertexId};
use crate::record::{Record, Write};
use crate::state::State;
use alloc::vec::Vec;
use core::cmp::Reverse;

/// The declared writes on live elements, by target and name, the winner of each first.
#[derive(Clone, Debug)]
pub(super) struct Attributes<'s> {
    writes: Vec<(Dot, &'s Write)>,
}

impl<'s> Attributes<'s> {
    pub(super) fn of(
        state: &'s State,
        dictionary: &Dictionary,
        vertices: &[VertexId],
        candidates: &[ShownEdge<'s>],
        repairs: &mut Vec<Repair>,
    ) -> Self {
        let lives = |target: Dot| {
            vertices.binary_search(&VertexId(target)).is_ok()
                || candidates.binary_search_by_key(&EdgeId(target), |edge| edge.id).is_ok()
        };
        let mut writes = Vec::new();
        for (dot, record) in state.records() {
            let Record::Write(write) = record else { continue };
            if !lives(write.target) {
                continue;
            }
            if dictionary.allows_attribute(&write.name, write.value.value_type()) {
                writes.push((dot, write));
            } else {
                repairs.push(Repair::Undeclared { write: dot });
            }
        }
        writes.sort_unstable_by(|(left, l), (right, r)| {
            let by_register = (l.target, &l.name).cmp(&(r.target, &r.name));
            by_register.then_with(|| Reverse((l.stamp, left)).cmp(&Reverse((r.stamp, right))))
        });
        Self { writes }
    }

    pub(super) fn all(&self) -> &[(Dot, &'s Write)] {
        &self.writes
    }

    pub(super) fn register(&self, target: Dot, name: &str) -> &[(Dot, &'s Write)] {
        let key = (target, name);
        let start = self.writes.partition_point(|(_, write)| (write.target, &*write.name) < key);
        let end = self.writes.partition_point(|(_, write)| (write.target, &*write.name) <= key);
        &self.writes[start..end]
    }

    pub(super) fn winners_of(&self, target: Dot) -> impl Iterator<Item = (Dot, &'s Write)> + '_ {
        let start = self.writes.partition_point(|(_, write)| write.target < target);
        let end = self.writes.partition_point(|(_, write)| write.target <= target);
        self.writes[start..end]
            .chunk_by(|(_, l), (_, r)| l.name == r.name)
            .filter_map(|register| register.first().copied())
    }
}
