//! Edge claims that come into sight or go out of it. `[spec: VIEW-1.1]`

use super::held::{Held, HeldEdge, Status};
use super::settle::{Came, Settling};
use crate::dot::Dot;
use alloc::vec::Vec;

/// An edge claim that has become visible or is no longer, as it was shown before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flip {
    pub(super) dot: Dot,
    pub(super) edge: HeldEdge,
    pub(super) appears: bool,
}

impl Settling<'_> {
    /// Whether a claim that has gone out of sight is held still, and so among those of its register.
    pub(super) fn is_held_still(&self, flip: &Flip) -> bool {
        self.graph.edge_held(flip.dot) == Some(&flip.edge)
    }

    /// Every edge claim that was visible and is not, or the reverse. Whatever waits at a dot that has come,
    /// or is left at one that was replaced, is among them.
    pub(super) fn flips(&self) -> Vec<Flip> {
        let mut flips = Vec::new();
        let mut at = Vec::new();
        for gone in &self.gone {
            match gone.held {
                Held::Edge(edge) if edge.status != Status::Invisible => {
                    flips.push(Flip { dot: gone.dot, edge, appears: false });
                }
                Held::Vertex(_) => at.extend(self.graph.edges_at(gone.dot)),
                _ => {}
            }
        }
        for &(dot, kind) in &self.came {
            match kind {
                Came::Edge => at.push(dot),
                Came::Vertex { .. } if self.waited => at.extend(self.graph.edges_at(dot)),
                Came::Vertex { .. } | Came::Write(_) => {}
            }
        }
        at.sort_unstable();
        at.dedup();
        for dot in at {
            let Some(&edge) = self.graph.edge_held(dot) else { continue };
            let appears = self.graph.is_visible(&edge);
            if appears != (edge.status != Status::Invisible) {
                flips.push(Flip { dot, edge, appears });
            }
        }
        flips
    }
}
