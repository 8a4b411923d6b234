//! A graph laid out for the judges of [`invariant`](crate::invariant).

use super::graph::Graph;
use super::held::{Exposure, Held, Status};
use crate::dictionary::Dictionary;
use crate::dot::{Dot, EdgeId, VertexId};
use crate::record::Write;
use crate::state::State;
use crate::view::{Placement, Repair, ShownEdge, Shows};
use alloc::vec::Vec;

/// Everything that a graph shows, as lists over its state. See [`Graph::shown`].
#[derive(Clone, Debug)]
pub struct Shown<'s> {
    graph: &'s Graph,
    state: &'s State,
    vertices: Vec<VertexId>,
    edges: Vec<ShownEdge<'s>>,
    writes: Vec<(Dot, &'s Write)>,
    repairs: Vec<Repair>,
}

impl Graph {
    /// Lays everything shown out in lists, in the order of a [`View`](crate::View), for judges and tests.
    /// `state` must be [`Graph::state`]: what it lacks is left out. O(n log n).
    ///
    /// ```
    /// # use dsr_core::*;
    /// let replica = Replica::new(ReplicaId::agent(1), Dictionary::open());
    /// let state = replica.state();
    /// assert_eq!(invariant::check_view(&replica.shown(&state)), Ok(()));
    /// ```
    pub fn shown<'s>(&'s self, state: &'s State) -> Shown<'s> {
        let shown = self
            .records
            .iter()
            .filter(|(_, held)| matches!(held, Held::Edge(edge) if edge.status == Status::Shown));
        let mut edges: Vec<ShownEdge<'s>> = shown
            .filter_map(|(&dot, _)| Some(ShownEdge { id: EdgeId(dot), edge: state.edge(dot)? }))
            .collect();
        edges.sort_unstable_by(|l, r| {
            (l.edge.from, l.edge.to, &l.edge.label).cmp(&(r.edge.from, r.edge.to, &r.edge.label))
        });
        let declared = self.writes.iter().filter(|(_, write)| write.exposure == Exposure::Shown);
        let mut writes: Vec<(Dot, &Write)> =
            declared.filter_map(|(&(.., dot), _)| Some((dot, state.write(dot)?))).collect();
        writes.sort_unstable_by(|(left, l), (right, r)| {
            let by_register = (l.target, &l.name).cmp(&(r.target, &r.name));
            by_register.then_with(|| (r.stamp, right).cmp(&(l.stamp, left)))
        });
        let (vertices, repairs) = (self.vertices().collect(), self.repairs().cloned().collect());
        Shown { graph: self, state, vertices, edges, writes, repairs }
    }
}

impl Shown<'_> {
    /// See [`Graph::stranded`].
    pub fn stranded(&self) -> Vec<VertexId> {
        self.graph.stranded()
    }
}

impl Shows for Shown<'_> {
    fn state(&self) -> &State {
        self.state
    }

    fn dictionary(&self) -> &Dictionary {
        self.graph.dictionary()
    }

    fn vertices(&self) -> &[VertexId] {
        &self.vertices
    }

    fn edges(&self) -> &[ShownEdge<'_>] {
        &self.edges
    }

    fn placement(&self, vertex: VertexId) -> Option<Placement> {
        self.graph.placement(vertex)
    }

    fn vertex_by_name(&self, name: &str) -> Option<VertexId> {
        self.graph.vertex_by_name(name)
    }

    fn writes(&self) -> &[(Dot, &Write)] {
        &self.writes
    }

    fn repairs(&self) -> &[Repair] {
        &self.repairs
    }
}
