//! Symbolic edges: which of several competing claims is shown. `[spec: VIEW-2]` `[spec: VIEW-6]`
//! `[spec: INV-6]`

use super::{Repair, Rule, ShownEdge};
use crate::dictionary::Dictionary;
use crate::dot::VertexId;
use crate::record::Edge;
use alloc::vec::Vec;
use core::cmp::Reverse;

/// What two claims compete on. Kinematic claims compete in the tree. `[spec: STAMP-4]`
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Register<'s> {
    from: VertexId,
    label: &'s str,
    /// `None` for a functional label: all targets compete.
    to: Option<VertexId>,
}

impl<'s> Register<'s> {
    fn of(edge: &'s Edge, dictionary: &Dictionary) -> Self {
        let to = (!dictionary.is_functional(&edge.label)).then_some(edge.to);
        Self { from: edge.from, label: &edge.label, to }
    }
}

/// The greatest claim of each register of symbolic edges; the others become repairs.
pub(super) fn shown<'s>(
    candidates: &[ShownEdge<'s>],
    dictionary: &Dictionary,
    repairs: &mut Vec<Repair>,
) -> Vec<ShownEdge<'s>> {
    let symbolic = candidates.iter().filter(|claim| !claim.edge.is_rt());
    let mut claims = Vec::with_capacity(candidates.len());
    claims.extend(
        symbolic.map(|claim| {
            (Register::of(claim.edge, dictionary), Reverse((claim.edge.stamp, claim.id)), *claim)
        }),
    );
    claims.sort_unstable_by(|l, r| (&l.0, l.1).cmp(&(&r.0, r.1)));
    let mut shown = Vec::with_capacity(claims.len());
    for register in claims.chunk_by(|l, r| l.0 == r.0) {
        if let [(key, _, winner), losers @ ..] = register {
            shown.push(*winner);
            let rule = if key.to.is_none() { Rule::Functional } else { Rule::SameKey };
            repairs.extend(losers.iter().map(|(_, _, loser)| Repair::Superseded {
                hidden: loser.id,
                shown: winner.id,
                rule,
            }));
        }
    }
    shown
}
