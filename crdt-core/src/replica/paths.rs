//! Paths to the root: a forest of shown edges that leads every vertex there which can get there.
//! `[spec: VIEW-5]`
//!
//! Each vertex keeps the shown edge that begins its way, `up`. Nothing is looked at unless edges are shown or
//! hidden, or vertices come, go, or change their place at the top of a tree. Then *lost* are the vertices
//! whose `up` is no longer shown, those that are new, and all of a band (a component without the root) that
//! is touched. Each lost vertex takes any shown edge to a vertex that has a way not through a lost one. Where
//! none has one, what hangs from the lost vertex is searched for a way out; if there is none, all that was
//! searched is a band.
//!
//! O(degree + depth) · log n for a vertex whose new way begins at itself, as when it moves with what hangs
//! from it. Worst case: all that hangs from what is lost, or the band.

use super::graph::{Band, Graph};
use super::held::{Held, NONE, Status};
use super::settle::{Came, Settling};
use crate::dot::{Dot, VertexId};
use crate::view::Repair;
use alloc::collections::{BTreeMap, BTreeSet, VecDeque};
use alloc::vec::Vec;

const ROOT: Dot = VertexId::ROOT.0;

/// From so many lost vertices on, ways that are known to lead to the root are remembered.
const MANY: usize = 16;

/// The vertices without a way so far.
#[derive(Debug, Default)]
struct Search {
    lost: BTreeSet<Dot>,
    /// Whether some vertex may hang from a lost one.
    hanging: bool,
    /// Vertices whose ways are known to lead to the root.
    known: BTreeSet<Dot>,
    remember: bool,
    /// Whether some vertex has been looked at in vain.
    waiting: bool,
}

impl Graph {
    /// The shown edges at a vertex, with their other ends.
    fn shown_at(&self, end: Dot) -> impl Iterator<Item = (Dot, Dot)> + '_ {
        self.edges_at(end).filter_map(move |dot| {
            let edge = self.edge_held(dot).filter(|edge| edge.status == Status::Shown)?;
            Some((dot, edge.other_end(end)))
        })
    }

    /// The vertex at the other end of a vertex's `up`.
    fn above(&self, vertex: Dot) -> Option<Dot> {
        let up = self.up_of(vertex);
        if up == NONE { None } else { Some(self.edge_held(up)?.other_end(vertex)) }
    }

    /// Whether the way from a vertex leads to the root, not through a lost one.
    fn leads_home(&self, search: &mut Search, from: Dot) -> bool {
        if !search.hanging {
            return from == ROOT || !search.lost.contains(&from);
        }
        let (mut at, mut way) = (from, Vec::new());
        while at != ROOT && !search.known.contains(&at) {
            let Some(above) = self.above(at).filter(|_| !search.lost.contains(&at)) else { return false };
            if search.remember {
                way.push(at);
            }
            at = above;
        }
        search.known.extend(way);
        true
    }

    /// The first shown edge from a vertex to one that has a way.
    fn way_from(&self, search: &mut Search, vertex: Dot) -> Option<Dot> {
        // Mostly it is the one to its parent.
        if let Some((edge, held)) = self.parent_edge(vertex)
            && self.leads_home(search, held.from)
        {
            return Some(edge);
        }
        self.shown_at(vertex).find(|&(_, other)| self.leads_home(search, other)).map(|(edge, _)| edge)
    }
}

impl Settling<'_> {
    pub(super) fn settle_paths(&mut self) {
        let mut search = Search::default();
        self.collect_lost(&mut search);
        if search.lost.is_empty() {
            return;
        }
        search.remember = search.lost.len() >= MANY;
        let mut queue: VecDeque<Dot> = search.lost.iter().copied().collect();
        loop {
            while let Some(vertex) = queue.pop_front() {
                if !search.lost.contains(&vertex) {
                    continue;
                }
                if let Some(edge) = self.graph.way_from(&mut search, vertex) {
                    self.graph.set_up(vertex, edge);
                    search.lost.remove(&vertex);
                    self.call_neighbours(&search, vertex, &mut queue);
                } else {
                    search.waiting = true;
                }
            }
            let Some(&vertex) = search.lost.first() else { return };
            self.search_from(&mut search, vertex, &mut queue);
        }
    }

    /// Lost neighbours of a vertex that has a way now have one, too.
    fn call_neighbours(&self, search: &Search, vertex: Dot, queue: &mut VecDeque<Dot>) {
        if search.waiting && !search.lost.is_empty() {
            let others = self.graph.shown_at(vertex).map(|(_, other)| other);
            queue.extend(others.filter(|other| search.lost.contains(other)));
        }
    }

    fn collect_lost(&mut self, search: &mut Search) {
        let edges = self.hidden.iter().chain(&self.shown);
        let ends = edges.flat_map(|(_, edge)| [edge.from, edge.to]);
        let mut touched: Vec<Dot> = Vec::new();
        if !self.graph.strays.is_empty() {
            touched.extend(ends);
            touched.extend(self.gone_vertices().map(|(dot, _)| dot));
        }
        for vertex in touched {
            if let Some(&leader) = self.graph.strays.get(&vertex) {
                self.dissolve(search, leader);
            }
        }
        for at in 0..self.hidden.len() {
            let (dot, edge) = self.hidden[at];
            for end in [edge.from, edge.to] {
                if self.graph.up_of(end) == dot {
                    self.graph.set_up(end, NONE);
                    search.lost.insert(end);
                    search.hanging = true;
                }
            }
        }
        for &(dot, kind) in &self.came {
            if matches!(kind, Came::Vertex { .. }) && self.graph.up_of(dot) == NONE {
                search.lost.insert(dot);
            }
        }
    }

    /// Forgets a band: each of its members is looked at anew.
    fn dissolve(&mut self, search: &mut Search, leader: Dot) {
        let Some(band) = self.graph.bands.remove(&leader) else { return };
        self.repairs_before.extend(band.reattached.map(|dot| Repair::Reattached { vertex: VertexId(dot) }));
        for &member in band.members.iter() {
            self.graph.strays.remove(&member);
            self.strays_before.insert(member, true);
            if self.graph.vertex_held(member).is_some() {
                search.lost.insert(member);
            }
        }
    }

    /// Looks for a way out of all that hangs from a lost vertex; makes it a band if there is none.
    fn search_from(&mut self, search: &mut Search, start: Dot, queue: &mut VecDeque<Dot>) {
        // Each vertex reached, with the edge and the vertex that it was reached by.
        let mut reached: BTreeMap<Dot, (Dot, Dot)> = BTreeMap::from([(start, (NONE, NONE))]);
        let mut front = VecDeque::from([start]);
        while let Some(vertex) = front.pop_front() {
            let shown: Vec<(Dot, Dot)> = self.graph.shown_at(vertex).collect();
            for (edge, other) in shown {
                if reached.contains_key(&other) {
                    continue;
                }
                if self.graph.leads_home(search, other) {
                    self.turn_round(search, &reached, vertex, edge);
                    queue.extend(reached.keys().filter(|vertex| search.lost.contains(vertex)));
                    return;
                }
                reached.insert(other, (edge, vertex));
                front.push_back(other);
            }
        }
        self.band_together(search, reached.into_keys().collect());
    }

    /// Turns the way by which a vertex was reached round, so that it leads out by `edge`.
    fn turn_round(
        &mut self,
        search: &mut Search,
        reached: &BTreeMap<Dot, (Dot, Dot)>,
        vertex: Dot,
        edge: Dot,
    ) {
        let (mut at, mut up) = (vertex, edge);
        while at != NONE {
            self.graph.set_up(at, up);
            search.lost.remove(&at);
            (up, at) = reached.get(&at).copied().unwrap_or((NONE, NONE));
        }
    }

    fn band_together(&mut self, search: &mut Search, members: Vec<Dot>) {
        let Some(&leader) = members.first() else { return };
        let hangs = members.iter().any(|member| self.graph.detached.contains(member));
        let age = |&dot: &Dot| match self.graph.records.get(&dot) {
            Some(Held::Vertex(vertex)) => Some((vertex.stamp, dot)),
            _ => None,
        };
        let oldest = members.iter().filter_map(age).min().map(|(_, dot)| dot);
        let reattached = if hangs { None } else { oldest };
        self.repairs_after.extend(reattached.map(|dot| Repair::Reattached { vertex: VertexId(dot) }));
        for &member in &members {
            self.graph.set_up(member, NONE);
            self.graph.strays.insert(member, leader);
            self.strays_before.entry(member).or_insert(false);
            search.lost.remove(&member);
        }
        self.graph.bands.insert(leader, Band { members: members.into(), reattached });
    }
}
