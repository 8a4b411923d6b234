//! The known anomalies of the [published semantics](crate::published), each found by search.
//!
//! A row is a setup small enough to be searched, and what ought not to be found in it. The search is
//! breadth-first, so what it finds is shortest. Most rows have a control as well: the same setup without the
//! cause, in which a search to the end finds nothing.
//!
//! | room | what |
//! |---|---|
//! | `registers` | one attribute that several write |
//! | `edges` | edges, and the nodes that they need |
//! | `joining` | whoever joins, restarts, or does not hear |
//! | `kinematics` | names, parents, levels |
//! | `run` | a row's search and its report |
//! | `record` | a row's schedule as a trace |
//! | `checked` | the same schedule on `dsr-core` |

mod checked;
mod edges;
mod joining;
mod kinematics;
mod record;
mod registers;
mod run;

pub use checked::{Twin, mutations_before, run_checked};
pub use record::{PublishedRun, SEMANTICS, is_published};
pub use run::{ControlReport, Found, RowReport, run_control, run_row};

use crate::published::{Guard, Operation, Order, Play, Powers, Property, Setup, Variant, When};

/// One anomaly.
#[derive(Clone, Debug)]
pub struct Row {
    /// Its number in the list of known anomalies; from 34 on, those that the checker has added.
    pub row: &'static str,
    /// What goes wrong.
    pub title: &'static str,
    /// Where it is sought.
    pub setup: Setup,
    /// The same without the cause.
    pub control: Option<Control>,
}

/// A setup in which an anomaly must not be found.
#[derive(Clone, Debug)]
pub struct Control {
    /// What is different, in words.
    pub what: &'static str,
    /// The setup.
    pub setup: Setup,
}

impl Row {
    fn new(row: &'static str, title: &'static str, setup: Setup) -> Self {
        Self { row, title, setup, control: None }
    }

    /// Adds a control: the row's setup, changed.
    fn unless(mut self, what: &'static str, change: impl FnOnce(&mut Setup)) -> Self {
        let mut setup = self.setup.clone();
        change(&mut setup);
        self.control = Some(Control { what, setup });
        self
    }
}

/// All rows, in the order of their numbers.
pub fn rows() -> Vec<Row> {
    let mut rows = [registers::rows(), edges::rows(), joining::rows(), kinematics::rows()].concat();
    let number = |row: &str| row.trim_end_matches('b').parse::<u32>().unwrap_or(u32::MAX);
    rows.sort_by_key(|row| (number(row.row), row.row));
    rows
}

/// A setup of replicas with these agents, each with its own number in what it makes, on a network that keeps
/// the order of each pair, judged at rest. Each makes as many calls as it is given, in any order, and the same again.
fn setup(agents: &[u32], before: &[Operation], plays: &[&[(Guard, Operation)]], property: Property) -> Setup {
    Setup {
        variant: Variant::STAMPED,
        agents: agents.to_vec(),
        before: before.to_vec(),
        ignored: Vec::new(),
        plays: plays.iter().map(|calls| Play::free(calls)).collect(),
        powers: Powers::ordered(Order::Pair),
        property,
        when: When::Quiet,
    }
}

/// The same, with each replica's calls once each, in this order.
fn in_order(mut setup: Setup) -> Setup {
    for play in &mut setup.plays {
        play.in_order = true;
    }
    setup
}

/// A call that is always allowed.
const fn free(operation: Operation) -> (Guard, Operation) {
    (Guard::Always, operation)
}

/// Inserts node `id` with `x` = 1.
const fn node(id: u32, name: &'static str) -> Operation {
    Operation::InsertNode { id, kind: "thing", name, attributes: &[("x", 1)] }
}

/// Sets `x` of node 1.
const fn set(value: i64) -> Operation {
    Operation::Set { node: 1, key: "x", value }
}

/// Inserts the edge `in` between two nodes, without attributes.
const fn link(from: u32, to: u32) -> Operation {
    Operation::AssignEdge { from, to, kind: "in", attributes: &[] }
}

/// Removes `x` of node 1.
const REMOVE: Operation = Operation::Remove { node: 1, key: "x" };
/// Node 1.
const NODE: Operation = node(1, "k");
/// Node 2.
const END: Operation = node(2, "t");
