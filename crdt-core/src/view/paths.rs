//! Paths to the root, whatever the direction and label of the edges on them. `[spec: VIEW-5]` `[spec: INV-1]`

use super::union_find::UnionFind;
use super::{Placement, Repair, ShownEdge};
use crate::dot::VertexId;
use crate::state::State;
use alloc::vec;
use alloc::vec::Vec;

/// Links each component that has no path to the root, not even by a detached top, to the root by its
/// oldest vertex; returns every vertex that only a repair holds, in order.
pub(super) fn stranded(
    state: &State,
    vertices: &[VertexId],
    edges: &[ShownEdge<'_>],
    placements: &[Placement],
    repairs: &mut Vec<Repair>,
) -> Vec<VertexId> {
    let mut components = UnionFind::new(vertices.len());
    for shown in edges {
        if let (Ok(from), Ok(to)) =
            (vertices.binary_search(&shown.edge.from), vertices.binary_search(&shown.edge.to))
        {
            components.unite(from, to);
        }
    }
    let mut stranded = Vec::new();
    // Per component, by the index that leads it: hung by a detached top, or else its oldest vertex.
    let mut hung = vec![false; vertices.len()];
    let mut oldest: Vec<Option<(u64, VertexId)>> = vec![None; vertices.len()];
    for (at, &vertex) in vertices.iter().enumerate() {
        let component = components.find(at);
        if placements[at] == Placement::Detached {
            hung[component] = true;
            stranded.push(vertex);
        } else if component != 0 {
            stranded.push(vertex);
        }
        let age = state.vertex(vertex.0).map(|record| (record.stamp, vertex));
        if oldest[component].is_none_or(|known| age.is_some_and(|age| age < known)) {
            oldest[component] = age;
        }
    }
    let unreached = oldest.iter().zip(&hung).skip(1).filter(|(_, hung)| !**hung);
    repairs.extend(unreached.filter_map(|(age, _)| age.map(|(_, vertex)| Repair::Reattached { vertex })));
    stranded
}
