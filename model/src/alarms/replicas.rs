//! Flaws of fast replicas: indexes and changes that are not kept up.

use super::flawed::ReplicaFlaw;
use dsr_core::{
    Change, Changes, Delta, Dot, Graph, Mutation, Name, Placement, Replica, State, VertexId, Write,
};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex, PoisonError};

/// Of an edge that is no longer shown nothing is told.
#[derive(Clone, Default, Debug)]
pub(super) struct MissedChange;

impl ReplicaFlaw for MissedChange {
    fn tell(&self, changes: Changes) -> Changes {
        changes.into_iter().filter(|change| !matches!(change, Change::EdgeHidden { .. })).collect()
    }
}

/// Of a vertex that comes, its name is told as if it were an attribute.
#[derive(Clone, Default, Debug)]
pub(super) struct SpuriousChange;

impl ReplicaFlaw for SpuriousChange {
    fn tell(&self, changes: Changes) -> Changes {
        let told = |change: Change| {
            let more = match &change {
                Change::VertexAdded { vertex } => Some(Change::Attribute {
                    target: vertex.0,
                    name: "name".into(),
                    before: None,
                    after: Some(vertex.0),
                }),
                _ => None,
            };
            core::iter::once(change).chain(more)
        };
        changes.into_iter().flat_map(told).collect()
    }
}

/// Of an attribute, a write that loses is told as if it had won.
#[derive(Clone, Default, Debug)]
pub(super) struct LoserTold;

impl ReplicaFlaw for LoserTold {
    fn tell(&self, changes: Changes) -> Changes {
        let told = |change: Change| match change {
            Change::Attribute { target, name, before, after } if before == after => {
                Change::Attribute { target, name, before: None, after }
            }
            other => other,
        };
        changes.into_iter().map(told).collect()
    }
}

/// Where a vertex stands is looked up anew when an edge of its comes, and not when one goes.
#[derive(Clone, Default, Debug)]
pub(super) struct StaleParent {
    placements: BTreeMap<VertexId, Placement>,
}

impl ReplicaFlaw for StaleParent {
    fn see(&mut self, graph: &Graph, changes: &Changes) {
        let ends = changes.iter().filter_map(|change| match change {
            Change::EdgeShown { key, .. } => Some([key.from, key.to]),
            _ => None,
        });
        for vertex in ends.flatten() {
            self.placements.extend(graph.placement(vertex).map(|placement| (vertex, placement)));
        }
    }

    fn placement(&self, graph: &Graph, vertex: VertexId) -> Option<Placement> {
        self.placements.get(&vertex).copied().or_else(|| graph.placement(vertex))
    }
}

/// The index of names keeps the vertices that have gone.
#[derive(Clone, Default, Debug)]
pub(super) struct NamesKept {
    names: BTreeMap<Name, BTreeSet<(u64, Dot)>>,
}

impl ReplicaFlaw for NamesKept {
    fn see(&mut self, graph: &Graph, changes: &Changes) {
        for change in changes {
            if let Change::VertexAdded { vertex } = change
                && let Some(record) = graph.vertex(*vertex)
            {
                self.names.entry(record.name).or_default().insert((record.stamp, vertex.0));
            }
        }
    }

    fn vertex_by_name(&self, graph: &Graph, name: &str) -> Option<VertexId> {
        let oldest = self.names.get(name).and_then(|namesakes| namesakes.first());
        oldest.map(|(_, dot)| VertexId(*dot)).or_else(|| graph.vertex_by_name(name))
    }
}

/// The index of writes keeps those that have gone.
#[derive(Clone, Default, Debug)]
pub(super) struct WritesKept {
    writes: BTreeMap<Dot, Write>,
}

impl ReplicaFlaw for WritesKept {
    fn see(&mut self, graph: &Graph, changes: &Changes) {
        for change in changes {
            if let Change::Attribute { target, name, .. } = change {
                self.writes.extend(graph.attribute_writes(*target, name));
            }
        }
    }

    fn attribute_writes(&self, graph: &Graph, target: Dot, name: &str) -> Vec<(Dot, Write)> {
        let kept = self.writes.iter().filter(|(_, write)| write.target == target && *write.name == *name);
        let mut all: BTreeMap<Dot, Write> = kept.map(|(dot, write)| (*dot, write.clone())).collect();
        all.extend(graph.attribute_writes(target, name));
        let mut all: Vec<(Dot, Write)> = all.into_iter().collect();
        all.sort_by_key(|(dot, write)| core::cmp::Reverse((write.stamp, *dot)));
        all
    }
}

/// A removal that is refused is not undone.
#[derive(Clone, Default, Debug)]
pub(super) struct NotUndone;

impl ReplicaFlaw for NotUndone {
    fn refuse(&self, replica: &mut Replica, mutation: &Mutation) {
        if let Mutation::RemoveEdge { key } | Mutation::MoveEdge { from: key, .. } = mutation
            && let Some(edge) = replica.edge_by_key(key)
        {
            replica.apply(&State::assemble([], core::iter::once(edge.0).collect()));
        }
    }
}

/// An answer to a digest says what lives, and not what is dead.
#[derive(Clone, Default, Debug)]
pub(super) struct DeathsUnanswered;

impl ReplicaFlaw for DeathsUnanswered {
    fn answer(&self, answer: Delta) -> Delta {
        let held = answer.records().map(|(dot, record)| (dot, record.clone()));
        State::assemble(held, answer.records().map(|(dot, _)| dot).collect())
    }
}

/// Where vertices stand is kept in one place for a replica and all its snapshots.
#[derive(Clone, Default, Debug)]
pub(super) struct SnapshotsShare {
    placements: Arc<Mutex<BTreeMap<VertexId, Placement>>>,
}

impl ReplicaFlaw for SnapshotsShare {
    fn see(&mut self, graph: &Graph, _: &Changes) {
        let now = graph.vertices().filter_map(|vertex| Some((vertex, graph.placement(vertex)?)));
        *self.placements.lock().unwrap_or_else(PoisonError::into_inner) = now.collect();
    }

    fn placement(&self, _: &Graph, vertex: VertexId) -> Option<Placement> {
        self.placements.lock().unwrap_or_else(PoisonError::into_inner).get(&vertex).copied()
    }
}
