//! Vertices that have come or gone, and who is found by their names. `[spec: VIEW-7]`

use super::settle::{Came, Settling};
use crate::changes::Change;
use crate::dot::{Dot, VertexId};
use crate::mutation::is_root_name;
use crate::record::Name;
use crate::view::Repair;
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

impl Settling<'_> {
    /// O(the vertices that share a name with one that has come or gone).
    pub(super) fn settle_vertices(&mut self) {
        let mut names: BTreeMap<Name, Vec<(u64, Dot)>> = BTreeMap::new();
        let mut changes = Vec::new();
        for (dot, vertex) in self.gone_vertices() {
            names.entry(vertex.name.clone()).or_default().push((vertex.stamp, dot));
            changes.push(Change::VertexRemoved { vertex: VertexId(dot), name: vertex.name.clone() });
        }
        for &(dot, kind) in &self.came {
            let Came::Vertex { is_alone } = kind else { continue };
            changes.push(Change::VertexAdded { vertex: VertexId(dot) });
            if !is_alone && let Some(vertex) = self.graph.vertex_held(dot) {
                names.entry(vertex.name.clone()).or_default();
            }
        }
        self.changes.append(&mut changes);
        if names.is_empty() {
            return;
        }
        let came: BTreeSet<Dot> = self.came.iter().map(|(dot, _)| *dot).collect();
        for (name, gone) in names {
            let now: Vec<(u64, Dot)> =
                self.graph.namesakes(&name).map(|(dot, vertex)| (vertex.stamp, dot)).collect();
            let stayed = now.iter().copied().filter(|(_, dot)| !came.contains(dot));
            let before: Vec<(u64, Dot)> = stayed.chain(gone).collect();
            self.repairs_before.extend(clashes(&name, &before));
            self.repairs_after.extend(clashes(&name, &now));
        }
    }
}

/// A repair for each vertex that its name does not find.
fn clashes(name: &Name, vertices: &[(u64, Dot)]) -> Vec<Repair> {
    let oldest = vertices.iter().min().map(|&(_, dot)| VertexId(dot));
    let shown = if is_root_name(name) { Some(VertexId::ROOT) } else { oldest };
    let Some(shown) = shown else { return Vec::new() };
    let hidden = vertices.iter().map(|&(_, dot)| VertexId(dot)).filter(|&vertex| vertex != shown);
    hidden.map(|hidden| Repair::NameClash { name: name.clone(), shown, hidden }).collect()
}
