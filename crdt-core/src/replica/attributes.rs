//! Attributes: which writes of each register are shown. `[spec: VIEW-8]`

use super::changes::Change;
use super::graph::Graph;
use super::held::{Exposure, Held, HeldWrite, Status};
use super::names::NameId;
use super::settle::{Flip, Settling};
use crate::dot::{Dot, VertexId};
use crate::view::Repair;
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

/// A write of a register: its dot, its stamp, what it is shown as.
type Seen = (Dot, u64, Exposure);

impl Graph {
    /// Whether attributes of this target are shown: of vertices in the graph and visible edge claims.
    /// `[spec: VIEW-1.1]`
    pub(super) fn shows_attributes_of(&self, target: Dot) -> bool {
        match self.records.get(&target) {
            Some(Held::Vertex(_)) => true,
            Some(Held::Edge(edge)) => edge.status != Status::Invisible,
            Some(Held::Write(_)) => false,
            None => target == VertexId::ROOT.0,
        }
    }

    fn exposure(&self, target_lives: bool, name: NameId, write: &HeldWrite) -> Exposure {
        let declared = |name| self.dictionary.allows_attribute(name, write.value.value_type());
        match self.names.text(name) {
            Some(name) if target_lives && declared(name) => Exposure::Shown,
            Some(_) if target_lives => Exposure::Undeclared,
            _ => Exposure::Invisible,
        }
    }
}

impl Settling<'_> {
    /// O(the writes of every register that is touched).
    pub(super) fn settle_attributes(&mut self, flips: &[Flip]) {
        let mut registers: BTreeMap<(Dot, NameId), Vec<Seen>> = BTreeMap::new();
        let mut targets: BTreeSet<Dot> = flips.iter().map(|flip| flip.dot).collect();
        for gone in &self.gone {
            match (&gone.held, &gone.write) {
                (Held::Write(at), Some(write)) => {
                    let seen = (gone.dot, write.stamp, write.exposure);
                    registers.entry((at.target, at.name)).or_default().push(seen);
                }
                _ => {
                    targets.insert(gone.dot);
                }
            }
        }
        for &dot in &self.came {
            match self.graph.records.get(&dot) {
                Some(Held::Write(at)) => {
                    registers.entry((at.target, at.name)).or_default();
                }
                _ => {
                    targets.insert(dot);
                }
            }
        }
        for target in targets {
            for (&(target, name, _), _) in self.graph.writes_on(target) {
                registers.entry((target, name)).or_default();
            }
        }
        for ((target, name), gone) in registers {
            self.settle_attribute(target, name, &gone);
        }
    }

    fn settle_attribute(&mut self, target: Dot, name: NameId, gone: &[Seen]) {
        let lives = self.graph.shows_attributes_of(target);
        let mut before: Vec<Seen> = gone.to_vec();
        let mut after: Vec<Seen> = Vec::new();
        let mut flipped = Vec::new();
        for (dot, write) in self.graph.writes_of(target, name) {
            let now = self.graph.exposure(lives, name, write);
            before.push((dot, write.stamp, write.exposure));
            after.push((dot, write.stamp, now));
            if now != write.exposure {
                flipped.push((dot, now));
            }
        }
        let undeclared = |list: &[Seen]| -> Vec<Repair> {
            let hidden = list.iter().filter(|seen| seen.2 == Exposure::Undeclared);
            hidden.map(|&(write, ..)| Repair::Undeclared { write }).collect()
        };
        self.repairs_before.extend(undeclared(&before));
        self.repairs_after.extend(undeclared(&after));
        let is_shown = |seen: &&Seen| seen.2 == Exposure::Shown;
        let differs = gone.iter().any(|seen| is_shown(&seen))
            || flipped.iter().any(|&(dot, now)| {
                let was = before.iter().any(|seen| seen.0 == dot && seen.2 == Exposure::Shown);
                was != (now == Exposure::Shown)
            });
        if differs {
            let winner = |list: &[Seen]| {
                list.iter().filter(is_shown).max_by_key(|seen| (seen.1, seen.0)).map(|seen| seen.0)
            };
            self.changes.push(Change::Attribute {
                target,
                name: self.graph.names.name(name),
                before: winner(&before),
                after: winner(&after),
            });
        }
        for (dot, exposure) in flipped {
            if let Some(write) = self.graph.writes.get_mut(&(target, name, dot)) {
                write.exposure = exposure;
            }
        }
    }
}
