//! Attributes: which writes of each register are shown. `[spec: VIEW-8]`

use super::flips::Flip;
use super::graph::Graph;
use super::held::{Exposure, Held, HeldWrite, Status};
use super::names::NameId;
use super::settle::{Came, Settling};
use crate::changes::Change;
use crate::dot::{Dot, VertexId};
use crate::record::{Name, Rank};
use crate::view::Repair;
use alloc::collections::BTreeSet;
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

    fn exposure(&self, target_lives: bool, name: &Name, write: &HeldWrite) -> Exposure {
        if !target_lives {
            Exposure::Invisible
        } else if self.dictionary.allows_attribute(name, write.value.value_type()) {
            Exposure::Shown
        } else {
            Exposure::Undeclared
        }
    }
}

/// A register, with one of its writes that has gone, as it was shown.
type Touched = (Dot, NameId, Option<Seen>);

/// The greatest of the writes shown.
#[derive(Clone, Copy, Default)]
struct Winner(Option<Rank>);

impl Winner {
    fn see(&mut self, (dot, stamp, exposure): Seen) {
        if exposure == Exposure::Shown {
            self.0 = self.0.max(Some((stamp, dot)));
        }
    }

    fn dot(self) -> Option<Dot> {
        self.0.map(|(_, dot)| dot)
    }
}

impl Settling<'_> {
    /// O(the writes of every register that is touched).
    pub(super) fn settle_attributes(&mut self, flips: &[Flip]) {
        let mut touched: Vec<Touched> = Vec::new();
        let mut targets: BTreeSet<Dot> =
            flips.iter().filter(|flip| self.waited || !flip.appears).map(|flip| flip.dot).collect();
        for gone in &self.gone {
            if let (Held::Write(at), Some(write)) = (&gone.held, &gone.write) {
                touched.push((at.target, at.name, Some((gone.dot, write.stamp, write.exposure))));
            } else {
                targets.insert(gone.dot);
            }
        }
        for &(dot, kind) in &self.came {
            if let Came::Write(at) = kind {
                touched.push((at.target, at.name, None));
            } else if self.waited {
                targets.insert(dot);
            }
        }
        for target in targets {
            touched.extend(self.graph.writes_on(target).map(|(&(target, name, _), _)| (target, name, None)));
        }
        touched.sort_unstable_by_key(|&(target, name, _)| (target, name));
        for register in touched.chunk_by(|l, r| (l.0, l.1) == (r.0, r.1)) {
            self.settle_attribute(register);
        }
    }

    fn settle_attribute(&mut self, touched: &[Touched]) {
        let [(target, name, _), ..] = *touched else { return };
        let lives = self.graph.shows_attributes_of(target);
        let text = self.graph.names.name(name);
        let (mut before, mut after) = (Winner::default(), Winner::default());
        let (mut differs, mut flipped) = (false, Vec::new());
        for &seen in touched.iter().filter_map(|(.., seen)| seen.as_ref()) {
            before.see(seen);
            differs |= seen.2 == Exposure::Shown;
            if seen.2 == Exposure::Undeclared {
                self.repairs_before.push(Repair::Undeclared { write: seen.0 });
            }
        }
        for (dot, write) in self.graph.writes_of(target, name) {
            let (was, is) = (write.exposure, self.graph.exposure(lives, &text, write));
            before.see((dot, write.stamp, was));
            after.see((dot, write.stamp, is));
            if was == is {
                continue;
            }
            flipped.push((dot, is));
            differs |= was == Exposure::Shown || is == Exposure::Shown;
            let repair = Repair::Undeclared { write: dot };
            if was == Exposure::Undeclared {
                self.repairs_before.push(repair);
            } else if is == Exposure::Undeclared {
                self.repairs_after.push(repair);
            }
        }
        if differs {
            let (before, after) = (before.dot(), after.dot());
            self.changes.push(Change::Attribute { target, name: text, before, after });
        }
        for (dot, exposure) in flipped {
            if let Some(write) = self.graph.writes.get_mut(&(target, name, dot)) {
                write.exposure = exposure;
            }
        }
    }
}
