//! Carries out edits, and brings what is shown up to date where they touch it.
//!
//! First all indexes are edited; then each part of the view looks at what the edits touched, with the old
//! status of each record still written on it or on what has gone, and writes the new one. What differs
//! becomes the changes, so these are exact by construction. `[spec: EVENT-1]`

use super::filing::Gone;
use super::flips::Flip;
use super::graph::Graph;
use super::held::{Held, HeldEdge, HeldVertex, Status, WriteAt};
use crate::changes::{Change, Changes};
use crate::dot::{Dot, EdgeId, VertexId};
use crate::record::Record;
use crate::view::Repair;
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

/// What was filed under a dot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Came {
    Vertex {
        /// Whether its name found nothing when it was filed.
        is_alone: bool,
    },
    Edge,
    Write(WriteAt),
}

/// What edits have led to.
#[derive(Debug)]
pub(super) struct Outcome {
    pub(super) changes: Changes,
    /// The vertices that are stranded and were not, in order. `[spec: MUT-4.2]`
    pub(super) stranded: Vec<VertexId>,
    /// What was withdrawn, to be filed again where the edits are undone.
    pub(super) gone: Vec<(Dot, Record)>,
    /// What was filed.
    pub(super) came: Vec<(Dot, Came)>,
}

/// The work on one set of edits.
#[derive(Debug)]
pub(super) struct Settling<'g> {
    pub(super) graph: &'g mut Graph,
    /// What was withdrawn, as it was shown, by its dots.
    pub(super) gone: Vec<Gone>,
    /// What was filed, in order.
    pub(super) came: Vec<(Dot, Came)>,
    /// Whether records waited for others when the edits began. If none did, all that is at or on what has come has
    /// come with it.
    pub(super) waited: bool,
    pub(super) changes: Vec<Change>,
    pub(super) repairs_before: Vec<Repair>,
    pub(super) repairs_after: Vec<Repair>,
    /// Edges shown before and not after.
    pub(super) hidden: Vec<(Dot, HeldEdge)>,
    /// Edges shown after and not before.
    pub(super) shown: Vec<(Dot, HeldEdge)>,
    /// Vertices that have become detached or are no longer, with whether they were.
    pub(super) detached_before: BTreeMap<Dot, bool>,
    /// Vertices whose kinematic edges have changed, in any order, and again.
    pub(super) tops: Vec<Dot>,
    /// Vertices that are or were without a path, with whether they were.
    pub(super) strays_before: BTreeMap<Dot, bool>,
}

impl Graph {
    /// Withdraws and files records, each dot at most once in each list; a dot in both is replaced.
    pub(super) fn commit<'r>(
        &mut self,
        removed: impl IntoIterator<Item = Dot>,
        added: impl IntoIterator<Item = (Dot, &'r Record)>,
        keep_gone: bool,
    ) -> Outcome {
        let waited = !self.loose.is_empty();
        let mut gone: Vec<Gone> = removed.into_iter().filter_map(|dot| self.withdraw(dot)).collect();
        let mut came = Vec::new();
        for (dot, record) in added {
            // What has not been seen is not held.
            let replaced = if self.context.contains(dot) { self.withdraw(dot) } else { None };
            came.push((dot, self.file(dot, record)));
            if let Some(replaced) = replaced {
                self.keep_place(dot, &replaced);
                gone.push(replaced);
            }
        }
        gone.sort_unstable_by_key(|gone| gone.dot);
        let settling = Settling {
            graph: self,
            gone,
            came,
            waited,
            changes: Vec::new(),
            repairs_before: Vec::new(),
            repairs_after: Vec::new(),
            hidden: Vec::new(),
            shown: Vec::new(),
            detached_before: BTreeMap::new(),
            tops: Vec::new(),
            strays_before: BTreeMap::new(),
        };
        settling.finish(keep_gone)
    }

    /// A vertex whose record is replaced keeps its edges, and with them its place. `[spec: JOIN-2]`
    fn keep_place(&mut self, dot: Dot, replaced: &Gone) {
        if let (Held::Vertex(old), Some(new)) = (&replaced.held, self.vertex_mut(dot)) {
            new.children = old.children;
            self.set_link(dot, old.parent(), replaced.up);
        }
        if let Some(Held::Write(_)) = self.records.get(&dot) {
            self.let_loose(dot);
        }
    }
}

impl Settling<'_> {
    fn finish(mut self, keep_gone: bool) -> Outcome {
        let flips = self.flips();
        if !flips.is_empty() || self.touches_vertices() {
            self.settle_edges(&flips);
            self.settle_detached();
            self.settle_paths();
            self.settle_vertices();
        }
        self.settle_attributes(&flips);
        self.settle_repairs();
        let stranded = self.newly_stranded();
        let mut gone = Vec::new();
        if keep_gone {
            gone.extend(self.gone.iter().filter_map(|gone| Some((gone.dot, self.graph.record_of(gone)?))));
        }
        for gone in &self.gone {
            self.graph.release(gone);
        }
        Outcome { changes: self.changes.into_iter().collect(), stranded, gone, came: self.came }
    }

    fn touches_vertices(&self) -> bool {
        self.gone.iter().any(|gone| matches!(gone.held, Held::Vertex(_)))
            || self.came.iter().any(|(_, kind)| matches!(kind, Came::Vertex { .. }))
    }

    /// The vertices that have gone.
    pub(super) fn gone_vertices(&self) -> impl Iterator<Item = (Dot, &HeldVertex)> + '_ {
        self.gone.iter().filter_map(|gone| match &gone.held {
            Held::Vertex(vertex) => Some((gone.dot, vertex)),
            _ => None,
        })
    }

    /// What was withdrawn under a dot.
    pub(super) fn gone_at(&self, dot: Dot) -> Option<&Held> {
        let at = self.gone.binary_search_by_key(&dot, |gone| gone.dot).ok()?;
        Some(&self.gone[at].held)
    }

    fn settle_edges(&mut self, flips: &[Flip]) {
        let mut kinematic = Vec::new();
        let mut symbolic: BTreeMap<_, Vec<Flip>> = BTreeMap::new();
        for flip in flips {
            if !flip.edge.is_rt() {
                symbolic.entry(self.graph.register_of(&flip.edge)).or_default().push(*flip);
            } else if flip.edge.to != VertexId::ROOT.0 {
                kinematic.push(*flip);
            } else if let Some(edge) = self.graph.edge_mut(flip.dot) {
                // Never shown, and no claim on anything; but its attributes are.
                edge.status = if flip.appears { Status::Hidden } else { Status::Invisible };
            }
        }
        for (key, flips) in symbolic {
            self.settle_register(key, &flips);
        }
        self.settle_tree(&kinematic);
    }

    pub(super) fn hide(&mut self, dot: Dot, edge: HeldEdge) {
        self.changes.push(Change::EdgeHidden { edge: EdgeId(dot), key: self.graph.key_of(&edge) });
        self.hidden.push((dot, edge));
    }

    pub(super) fn show(&mut self, dot: Dot, edge: HeldEdge) {
        self.changes.push(Change::EdgeShown { edge: EdgeId(dot), key: self.graph.key_of(&edge) });
        self.shown.push((dot, edge));
    }

    pub(super) fn set_status(&mut self, dot: Dot, status: Status) {
        if let Some(edge) = self.graph.edge_mut(dot) {
            edge.status = status;
        }
    }

    /// What is repaired before and after is no change. `[spec: EVENT-4]`
    fn settle_repairs(&mut self) {
        if self.repairs_before.is_empty() && self.repairs_after.is_empty() {
            return;
        }
        self.repairs_before.sort_unstable();
        self.repairs_after.sort_unstable();
        let is_in = |list: &[Repair], repair: &Repair| list.binary_search(repair).is_ok();
        for repair in &self.repairs_before {
            if !is_in(&self.repairs_after, repair) {
                self.graph.repairs.remove(repair);
                self.changes.push(Change::RepairGone(repair.clone()));
            }
        }
        for repair in &self.repairs_after {
            if !is_in(&self.repairs_before, repair) {
                self.graph.repairs.insert(repair.clone(), ());
                self.changes.push(Change::RepairMade(repair.clone()));
            }
        }
    }

    fn newly_stranded(&self) -> Vec<VertexId> {
        if self.strays_before.is_empty() && self.detached_before.is_empty() {
            return Vec::new();
        }
        let was = |vertex: Dot| {
            let stray = self.strays_before.get(&vertex).copied().unwrap_or(false);
            let detached = self.detached_before.get(&vertex).copied();
            stray || detached.unwrap_or_else(|| self.graph.detached.contains(&vertex))
        };
        let touched: BTreeSet<Dot> =
            self.strays_before.keys().chain(self.detached_before.keys()).copied().collect();
        let is = |vertex: &Dot| self.graph.detached.contains(vertex) || self.graph.strays.contains(vertex);
        touched.into_iter().filter(|vertex| is(vertex) && !was(*vertex)).map(VertexId).collect()
    }
}
