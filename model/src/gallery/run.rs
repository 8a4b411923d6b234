//! A row's search and its report.

use super::record::PublishedRun;
use super::{Row, Twin, run_checked};
use crate::published::{Happening, Network, Order, Setup};
use crate::search::{Space, find_fault};
use crate::semantics::Breach;
use crate::trace::Trace;
use std::time::Instant;

/// The most moments that a row's search looks at.
const MOMENTS_MAX: usize = 4_000_000;

/// How a row was found.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Found {
    /// By search, shortest.
    Search,
    /// Not at all.
    No,
}

impl Found {
    /// In a word.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Search => "search",
            Self::No => "no",
        }
    }
}

/// What became of a row.
#[derive(Clone, Debug)]
pub struct RowReport {
    /// Its number.
    pub row: &'static str,
    /// What goes wrong.
    pub title: &'static str,
    /// How it was found.
    pub found: Found,
    /// Why it was not.
    pub reason: Option<&'static str>,
    /// The layer: whole schedules.
    pub layer: &'static str,
    /// The setup, in words.
    pub bound: String,
    /// How many different moments the search met.
    pub states: u64,
    /// How many events lead to the fault.
    pub steps: usize,
    /// How long the search took.
    pub seconds: f64,
    /// What happens.
    pub schedule: Vec<Happening>,
    /// The same, a line each.
    pub lines: Vec<String>,
    /// The same, as a trace.
    pub trace: Option<Trace>,
    /// What is broken then.
    pub breach: Option<Breach>,
    /// What the checked semantics does with the same schedule.
    pub checked: Option<Twin>,
    /// The same search without the cause.
    pub control: Option<ControlReport>,
}

/// Searches for a row's anomaly.
pub fn run_row(row: &Row) -> RowReport {
    let mut report = RowReport {
        row: row.row,
        title: row.title,
        found: Found::No,
        reason: None,
        layer: "L2",
        bound: String::new(),
        states: 0,
        steps: 0,
        seconds: 0.0,
        schedule: Vec::new(),
        lines: Vec::new(),
        trace: None,
        breach: None,
        checked: None,
        control: run_control(row),
    };
    let setup = &row.setup;
    report.bound = bound(setup);
    let begun = Instant::now();
    let mut network = Network::new(setup.clone());
    let found = find_fault(&mut network, MOMENTS_MAX);
    report.seconds = begun.elapsed().as_secs_f64();
    report.states = network.moments();
    let Some(found) = found else {
        return RowReport { reason: Some("the search ended without finding it"), ..report };
    };
    report.found = Found::Search;
    report.steps = found.events.len();
    report.schedule = found.events.iter().map(|(_, event)| network.happening(event)).collect();
    report.lines = report.schedule.iter().map(|happening| setup.line(happening)).collect();
    report.trace = write(row, &report.schedule, &found.fault);
    report.breach = Some(found.fault);
    report.checked = run_checked(row, &report.schedule);
    report
}

fn write(row: &Row, schedule: &[Happening], breach: &Breach) -> Option<Trace> {
    let mut run = PublishedRun::new(&row.setup);
    schedule.iter().all(|happening| run.happen(happening)).then(|| run.finish(row, breach))
}

/// What a search of a row's control came to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ControlReport {
    /// What is different from the row's search.
    pub what: &'static str,
    /// Whether it found the anomaly after all.
    pub found: bool,
    /// Whether it came to its end.
    pub ended: bool,
    /// How many different moments it met.
    pub states: u64,
    /// At how many of them the property was judged.
    pub judged: u64,
}

/// Searches a row's control; `None` if there is none.
pub fn run_control(row: &Row) -> Option<ControlReport> {
    let control = row.control.as_ref()?;
    let mut network = Network::new(control.setup.clone());
    let found = find_fault(&mut network, MOMENTS_MAX).is_some();
    let states = network.moments();
    let ended = states < MOMENTS_MAX as u64;
    Some(ControlReport { what: control.what, found, ended, states, judged: network.states_judged() })
}

/// How far a search goes, in words.
pub(super) fn bound(setup: &Setup) -> String {
    let calls: usize = setup.plays.iter().map(|play| usize::from(play.calls_max)).sum();
    let powers = &setup.powers;
    let order = match powers.order {
        Order::Causal => "causal order",
        Order::Pair => "order by pair",
        Order::Topic => "order by topic",
        Order::Pool => "order by topic, nodes and edges in any",
    };
    let several = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let mut words = vec![several(setup.replicas(), "replica"), several(calls, "call"), order.into()];
    if powers.losses_max > 0 {
        words.push(format!("{} lost", powers.losses_max));
    }
    if powers.duplicates_max > 0 {
        words.push(format!("{} repeated", powers.duplicates_max));
    }
    words.extend(powers.restarts.map(|_| "1 restart".into()));
    words.extend(powers.joiner.as_ref().map(|_| "1 joiner".into()));
    words.extend(powers.slow.map(|_| "1 slow copy".into()));
    if powers.ahead.iter().any(|ahead| *ahead != 0) {
        words.push("clocks differ".into());
    }
    words.join(", ")
}
