//! A semantics of one's own in the checker: a graph in which the last writer wins. See
//! `docs/your-own-semantics.md`.

use dsr_model::graph::{self, Element};
use dsr_model::histories::{Bound, HistoryRun};
use dsr_model::progress::{Limits, Progress};
use dsr_model::semantics::{Breach, Clause, Judged, Semantics, Step};
use dsr_model::verdict::RunReport;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

/// A node by its name, or an edge between two.
type Key = (&'static str, &'static str);
const A: Key = ("a", "");
const B: Key = ("b", "");
const EDGE: Key = ("a", "b");

/// When an element was last written, by whom, and whether it is there since.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Written {
    time: u32,
    replica: usize,
    present: bool,
}

/// Every element that was ever written.
pub type Graph = BTreeMap<Key, Written>;

/// What a replica can do.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Act {
    /// Adds the edge from `a` to `b`.
    Link,
    /// Removes it.
    Unlink,
    /// Removes node `b` and the edge to it.
    RemoveB,
}

impl fmt::Display for Act {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self:?}")
    }
}

/// The later write of an element wins.
#[derive(Debug)]
pub struct LastWriterWins {
    /// Whether of two writes at one time that of the greater replica wins; else the one that arrives first.
    pub ties_by_replica: bool,
}

impl Semantics for LastWriterWins {
    type State = Graph;
    type Delta = Graph;
    type Mutation = Act;

    fn name(&self) -> String {
        "last writer wins".into()
    }

    fn initial(&self) -> Graph {
        [A, B].map(|node| (node, Written { time: 0, replica: 0, present: true })).into()
    }

    fn mutations(&self, graph: &Graph, _: usize) -> Vec<Act> {
        let there = |element| graph.get(&element).is_some_and(|written| written.present);
        let mut acts = Vec::new();
        if there(EDGE) {
            acts.push(Act::Unlink);
        } else if there(A) && there(B) {
            acts.push(Act::Link);
        }
        acts.extend(there(B).then_some(Act::RemoveB));
        acts
    }

    fn mutate(&self, graph: &Graph, replica: usize, act: &Act) -> Option<Step<Self>> {
        let time = graph.values().map(|written| written.time).max().unwrap_or(0) + 1;
        let write = |present| Written { time, replica, present };
        let delta: Graph = match act {
            Act::Link => [(EDGE, write(true))].into(),
            Act::Unlink => [(EDGE, write(false))].into(),
            Act::RemoveB => [(B, write(false)), (EDGE, write(false))].into(),
        };
        let after = self.join(graph, &delta);
        Some(Step { delta, after })
    }

    fn join(&self, graph: &Graph, delta: &Graph) -> Graph {
        let mut joined = graph.clone();
        for (&element, &theirs) in delta {
            let ours = joined.entry(element).or_insert(theirs);
            let wins_tie = self.ties_by_replica && theirs.replica > ours.replica;
            if theirs.time > ours.time || theirs.time == ours.time && wins_tie {
                *ours = theirs;
            }
        }
        joined
    }

    fn judge(&self, graph: &Graph) -> Result<Judged, Breach> {
        let there = |element| graph.get(&element).is_some_and(|written| written.present);
        if there(EDGE) && !(there(A) && there(B)) {
            return Err(Breach::new("INV-2", "the edge from a to b has lost an end"));
        }
        Ok(Judged::default())
    }

    fn shows(&self, graph: &Graph) -> graph::Graph {
        let shown = graph.iter().filter(|(_, written)| written.present);
        let elements = shown.map(|(&(from, to), written)| {
            let edge = Element::edge(from, "to", to);
            let element = if to.is_empty() { Element::vertex(from, "node") } else { edge };
            (format!("{from}{to}"), element.with("by", format!("r{}", written.replica + 1)))
        });
        elements.collect()
    }

    fn clauses(&self) -> Vec<Clause> {
        let commutes = Clause { id: "JOIN-3", claim: "L3", what: "the order of delivery does not matter" };
        vec![commutes, Clause { id: "INV-2", claim: "V1", what: "no edge dangles" }]
    }
}

/// Every history of two replicas with two mutations each.
pub fn check(semantics: LastWriterWins) -> RunReport {
    let run = HistoryRun {
        name: "2 × 2".into(),
        semantics: Arc::new(semantics),
        focus: 0,
        bound: Bound { replicas: 2, mutations: 2 },
        symmetry: false,
        second_engine: true,
    };
    run.run(&Arc::new(Progress::new(Limits::default())))
}

fn main() {
    for ties_by_replica in [false, true] {
        let report = check(LastWriterWins { ties_by_replica });
        println!("ties by replica: {ties_by_replica}: {}", report.verdict);
        for trace in &report.traces {
            println!("{}", trace.text);
        }
    }
}
