//! The kinematic tree, kept by looking only at claims whose acceptance can have changed. `[spec: VIEW-3]`
//!
//! The reference takes all visible claims, greatest first, and accepts each unless its child has a parent or
//! it would close a cycle. Here the accepted claims form a forest *F*, and a queue holds the claims to be
//! judged anew, greatest first. Judging claim *x* (parent → child):
//!
//! - If the child has a parent by a greater claim, *x* is refused.
//! - Else, if the child is an ancestor of the parent, *x* would close a cycle with the way between them. If
//!   the least claim on that way is greater than *x*, *x* is refused; else that one leaves F and is judged
//!   again at its turn.
//! - Else, or then, *x* is accepted, and a lesser claim that gave the child its parent leaves F, to be judged
//!   (and refused) at its turn.
//!
//! Where a claim that was accepted has gone or is refused, those are queued that it may have kept out: lesser
//! claims on its child, and lesser claims that would have closed a cycle (the few in `broken`).
//!
//! *Why this is the reference's forest.* Take the claims in descending rank and suppose that, of those greater
//! than *x*, F holds exactly the ones that the reference accepts. If *x* is queued, the rules above are the
//! reference's: a child without a greater parent is the top of its tree among the greater claims, so two ends
//! are joined by greater claims if and only if the child is an ancestor of the parent by them. If *x* is not
//! queued and in F, it fits with all of F, so with the greater ones. If it is not queued and not in F, it was
//! refused, and for reasons that all still hold: had one been withdrawn or refused, *x* would have been queued.
//! Only lesser claims than the one judged are ever queued, so each is judged once.
//!
//! Each judgement walks up the tree: O(depth · log n). A new claim that is the greatest, as those that a
//! replica makes itself are, needs one, and one more for each claim that it unseats. Worst case: as many as
//! there are claims of lesser rank on the children concerned and in `broken`, and those that they unseat.

use super::flips::Flip;
use super::graph::Graph;
use super::held::{Held, HeldEdge, NONE, Status};
use super::settle::Settling;
use crate::dot::{Dot, EdgeId, VertexId};
use crate::record::Rank;
use crate::view::{Repair, Rule};
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

/// A kinematic claim.
type Claim = (Dot, HeldEdge);

fn rank(claim: &Claim) -> Rank {
    (claim.1.stamp, claim.0)
}

/// The claims to be judged, and what was there before.
#[derive(Debug, Default)]
struct Judgement {
    queue: BTreeSet<Rank>,
    /// Claims that were accepted and have left the forest for now.
    unseated: BTreeSet<Dot>,
    /// The accepted claim into each child looked at, before.
    parents: BTreeMap<Dot, Option<Claim>>,
}

impl Graph {
    fn claim(&self, dot: Dot) -> Option<Claim> {
        if dot == NONE { None } else { Some((dot, *self.edge_held(dot)?)) }
    }

    /// The least claim on the way up from `low` to `high`, if `high` is an ancestor of `low`.
    fn least_between(&self, low: Dot, high: Dot) -> Option<Claim> {
        if high != VertexId::ROOT.0 && self.vertex_held(high)?.children == 0 {
            return None;
        }
        let (mut at, mut least) = (low, None::<Claim>);
        while at != high {
            let (dot, &edge) = self.parent_edge(at)?;
            let claim = (dot, edge);
            least = Some(least.filter(|least| rank(least) < rank(&claim)).unwrap_or(claim));
            at = edge.from;
        }
        least
    }
}

impl Settling<'_> {
    /// Judges the claims that may be accepted now, or no longer.
    pub(super) fn settle_tree(&mut self, flips: &[Flip]) {
        if flips.is_empty() {
            return;
        }
        let mut judgement = Judgement::default();
        for flip in flips {
            self.note_parent(&mut judgement, flip.edge.to);
            if flip.edge.status == Status::Hidden {
                self.graph.broken.remove(&(flip.edge.stamp, flip.dot));
            }
        }
        let lost = |flip: &&Flip| !flip.appears && flip.edge.status == Status::Shown;
        for flip in flips.iter().filter(lost) {
            self.unlink(&mut judgement, (flip.dot, flip.edge));
        }
        for flip in flips {
            if flip.appears {
                judgement.queue.insert((flip.edge.stamp, flip.dot));
            } else if flip.edge.status == Status::Shown {
                self.queue_below(&mut judgement, (flip.dot, flip.edge));
            }
        }
        while let Some((_, dot)) = judgement.queue.pop_last() {
            if let Some(claim) = self.graph.claim(dot) {
                self.judge(&mut judgement, claim);
            }
        }
        self.report_tree(judgement.parents, flips);
    }

    fn judge(&mut self, judgement: &mut Judgement, claim: Claim) {
        let (parent, child) = (claim.1.from, claim.1.to);
        self.note_parent(judgement, child);
        let held = self.graph.parent_edge(child).map(|(dot, &edge)| (dot, edge));
        let between = self.graph.least_between(parent, child);
        let blocks = |other: &Claim| rank(other) > rank(&claim);
        if held.as_ref().is_some_and(blocks) || between.as_ref().is_some_and(blocks) {
            if judgement.unseated.contains(&claim.0) {
                self.queue_below(judgement, claim);
            }
            return;
        }
        for lesser in [held, between].into_iter().flatten() {
            self.unlink(judgement, lesser);
            judgement.unseated.insert(lesser.0);
            judgement.queue.insert(rank(&lesser));
        }
        self.link(claim);
    }

    /// Queues what a claim may have kept out.
    fn queue_below(&mut self, judgement: &mut Judgement, claim: Claim) {
        let below = rank(&claim);
        let graph = &*self.graph;
        for rival in graph.claims_on(graph.register_of(&claim.1)).filter_map(|dot| graph.claim(dot)) {
            let accepted = graph.vertex_held(rival.1.to).is_some_and(|child| child.parent() == rival.0);
            if rank(&rival) < below && !accepted && graph.is_visible(&rival.1) {
                judgement.queue.insert(rank(&rival));
            }
        }
        judgement.queue.extend(graph.broken.iter().map(|(rank, ())| *rank).take_while(|rank| *rank < below));
    }

    /// Remembers how a child had its parent, before anything is changed.
    fn note_parent(&self, judgement: &mut Judgement, child: Dot) {
        judgement.parents.entry(child).or_insert_with(|| {
            let vertex = match self.gone_at(child) {
                Some(Held::Vertex(vertex)) => vertex,
                _ => self.graph.vertex_held(child)?,
            };
            match self.gone_at(vertex.parent()) {
                Some(&Held::Edge(edge)) => Some((vertex.parent(), edge)),
                _ => self.graph.claim(vertex.parent()),
            }
        });
    }

    fn unlink(&mut self, judgement: &mut Judgement, claim: Claim) {
        self.note_parent(judgement, claim.1.to);
        if self.graph.vertex_held(claim.1.to).is_some_and(|child| child.parent() == claim.0) {
            self.graph.set_parent(claim.1.to, NONE);
        }
        if let Some(parent) = self.graph.vertex_mut(claim.1.from) {
            parent.children = parent.children.saturating_sub(1);
        }
        self.tops.extend([claim.1.from, claim.1.to]);
    }

    fn link(&mut self, claim: Claim) {
        self.graph.set_parent(claim.1.to, claim.0);
        if let Some(parent) = self.graph.vertex_mut(claim.1.from) {
            parent.children += 1;
        }
        self.tops.extend([claim.1.from, claim.1.to]);
    }

    /// Says what has changed for each child looked at. O(the claims on it).
    fn report_tree(&mut self, parents: BTreeMap<Dot, Option<Claim>>, flips: &[Flip]) {
        let mut vanished: BTreeMap<Dot, Vec<Claim>> = BTreeMap::new();
        for flip in flips.iter().filter(|flip| !flip.appears && !self.is_held_still(flip)) {
            vanished.entry(flip.edge.to).or_default().push((flip.dot, flip.edge));
        }
        for (child, old) in parents {
            let register = self.graph.register_at(NONE, super::names::RT_ID, child);
            let held: Vec<Claim> =
                self.graph.claims_on(register).filter_map(|dot| self.graph.claim(dot)).collect();
            let new = self.graph.parent_edge(child).map(|(dot, &edge)| (dot, edge));
            // Mostly it has come alone, and nothing is repaired.
            if let (&[only], None, Some(_)) = (&held[..], old, new)
                && only.1.status == Status::Invisible
                && vanished.is_empty()
            {
                self.set_status(only.0, Status::Shown);
                self.show(only.0, only.1);
                continue;
            }
            let mut before = vanished.remove(&child).unwrap_or_default();
            before.extend(held.iter().copied().filter(|claim| claim.1.status != Status::Invisible));
            let after: Vec<Claim> =
                held.iter().copied().filter(|claim| self.graph.is_visible(&claim.1)).collect();
            self.repairs_before.extend(refusals(&before, old));
            self.repairs_after.extend(refusals(&after, new));
            for claim in held {
                let status = match new {
                    Some((parent, _)) if parent == claim.0 => Status::Shown,
                    _ if self.graph.is_visible(&claim.1) => Status::Hidden,
                    _ => Status::Invisible,
                };
                if status == Status::Hidden && new.is_none_or(|new| rank(&new) < rank(&claim)) {
                    self.graph.broken.insert(rank(&claim), ());
                } else {
                    self.graph.broken.remove(&rank(&claim));
                }
                if status != claim.1.status {
                    self.set_status(claim.0, status);
                }
            }
            let plain = |claim: Option<Claim>| {
                claim.map(|(dot, edge)| (dot, HeldEdge { status: Status::Shown, ..edge }))
            };
            if plain(old) != plain(new) {
                if let Some((dot, edge)) = old {
                    self.hide(dot, edge);
                }
                if let Some((dot, edge)) = new {
                    self.show(dot, edge);
                }
            }
        }
    }
}

/// Why the visible claims on one child that are not shown are not.
fn refusals(claims: &[Claim], parent: Option<Claim>) -> Vec<Repair> {
    let refused = claims.iter().filter(|claim| parent.is_none_or(|parent| parent.0 != claim.0));
    let repair = |claim: &Claim| {
        let hidden = EdgeId(claim.0);
        match parent.filter(|parent| rank(parent) > rank(claim)) {
            Some((shown, _)) => Repair::Superseded { hidden, shown: EdgeId(shown), rule: Rule::RtParent },
            None => Repair::CycleBroken { hidden },
        }
    };
    refused.map(repair).collect()
}
