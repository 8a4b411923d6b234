//! The kinematic tree: one parent per vertex, no cycle, one root. `[spec: VIEW-3]` `[spec: VIEW-4]`
//! `[spec: INV-3]`

use super::union_find::UnionFind;
use super::{Repair, Rule, ShownEdge};
use crate::dot::{EdgeId, VertexId};
use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Reverse;

/// Where a vertex stands in the kinematic tree. `[spec: VIEW-4]`
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Placement {
    /// It is the root.
    Root,
    /// Below a parent, with a pose relative to it.
    Child {
        /// The parent.
        parent: VertexId,
        /// The edge shown between them.
        edge: EdgeId,
    },
    /// Hanging from the root by repair: no pose relative to it is known, and none may be invented.
    Detached,
    /// It has no part in the tree: only symbolic edges.
    Outside,
}

pub(super) struct Tree<'s> {
    pub(super) accepted: Vec<ShownEdge<'s>>,
    /// Beside the vertices.
    pub(super) placements: Vec<Placement>,
}

/// Accepts kinematic claims, greatest first, each unless its child has a parent already or it would close
/// a cycle; then hangs every other top of a tree from the root. Greedy acceptance is maximal.
pub(super) fn grow<'s>(
    candidates: &[ShownEdge<'s>],
    vertices: &[VertexId],
    repairs: &mut Vec<Repair>,
) -> Tree<'s> {
    let kinematic = candidates.iter().filter(|claim| claim.edge.is_rt() && !claim.edge.to.is_root());
    let mut claims: Vec<ShownEdge<'s>> = Vec::with_capacity(candidates.len());
    claims.extend(kinematic.copied());
    claims.sort_unstable_by_key(|claim| Reverse((claim.edge.stamp, claim.id)));
    let mut placements = vec![Placement::Outside; vertices.len()];
    let mut trees = UnionFind::new(vertices.len());
    let mut has_child = vec![false; vertices.len()];
    let mut accepted = Vec::with_capacity(claims.len());
    for claim in claims {
        let (Ok(parent), Ok(child)) =
            (vertices.binary_search(&claim.edge.from), vertices.binary_search(&claim.edge.to))
        else {
            continue;
        };
        if let Placement::Child { edge, .. } = placements[child] {
            repairs.push(Repair::Superseded { hidden: claim.id, shown: edge, rule: Rule::RtParent });
        } else if trees.unite(parent, child) {
            placements[child] = Placement::Child { parent: claim.edge.from, edge: claim.id };
            has_child[parent] = true;
            accepted.push(claim);
        } else {
            repairs.push(Repair::CycleBroken { hidden: claim.id });
        }
    }
    placements[0] = Placement::Root;
    for (at, placement) in placements.iter_mut().enumerate() {
        if *placement == Placement::Outside && has_child[at] {
            *placement = Placement::Detached;
            repairs.push(Repair::Detached { vertex: vertices[at] });
        }
    }
    Tree { accepted, placements }
}
