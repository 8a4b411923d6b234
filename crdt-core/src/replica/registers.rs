//! Symbolic edges: the greatest visible claim of each register. `[spec: VIEW-2]` `[spec: VIEW-6]`

use super::flips::Flip;
use super::held::{HeldEdge, NONE, RegisterKey, Status};
use super::settle::Settling;
use crate::dot::{Dot, EdgeId};
use crate::view::{Repair, Rule};
use alloc::vec::Vec;

impl Settling<'_> {
    /// Looks at one register some of whose claims have come into sight or gone out of it. O(its claims).
    pub(super) fn settle_register(&mut self, key: RegisterKey, flips: &[Flip]) {
        let held: Vec<(Dot, HeldEdge)> =
            self.graph.claims_on(key).filter_map(|dot| Some((dot, *self.graph.edge_held(dot)?))).collect();
        let gone = flips.iter().filter(|flip| !flip.appears && !self.is_held_still(flip));
        let still = held.iter().copied().filter(|(_, edge)| edge.status != Status::Invisible);
        let before: Vec<(Dot, HeldEdge)> = still.chain(gone.map(|flip| (flip.dot, flip.edge))).collect();
        let after: Vec<(Dot, HeldEdge)> =
            held.iter().copied().filter(|(_, edge)| self.graph.is_visible(edge)).collect();
        let old = before.iter().copied().find(|(_, edge)| edge.status == Status::Shown);
        let new = after.iter().copied().max_by_key(|&(dot, edge)| (edge.stamp, dot));
        let rule = if key.2 == NONE && self.graph.names.is_functional(key.1) {
            Rule::Functional
        } else {
            Rule::SameKey
        };
        let superseded = |claims: &[(Dot, HeldEdge)], shown: Option<(Dot, HeldEdge)>| -> Vec<Repair> {
            let Some((shown, _)) = shown else { return Vec::new() };
            let hidden = claims.iter().filter(|(dot, _)| *dot != shown);
            let repair =
                |&(dot, _): &(Dot, _)| Repair::Superseded { hidden: EdgeId(dot), shown: EdgeId(shown), rule };
            hidden.map(repair).collect()
        };
        self.repairs_before.extend(superseded(&before, old));
        self.repairs_after.extend(superseded(&after, new));
        for (dot, edge) in held {
            let status = match new {
                Some((winner, _)) if winner == dot => Status::Shown,
                _ if self.graph.is_visible(&edge) => Status::Hidden,
                _ => Status::Invisible,
            };
            if status != edge.status {
                self.set_status(dot, status);
            }
        }
        let plain = |claim: Option<(Dot, HeldEdge)>| {
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
