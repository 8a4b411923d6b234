//! Every row that is listed as found is found, replays, is shortest, and needs its cause.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

use dsr_model::gallery::{Found, RowReport, rows, run_control, run_row};
use dsr_model::progress::{Limits, Progress};
use dsr_model::published::{Event, Happening, Moment, Network, Value};
use dsr_model::search::{Space, count, explore, find_fault};
use dsr_model::semantics::Breach;
use std::sync::Arc;

fn reports() -> Vec<RowReport> {
    rows().iter().map(run_row).collect()
}

#[test]
fn oracle_every_row_is_found() {
    let reports = reports();
    for report in &reports {
        println!(
            "| {} | {} | {} | {} | {} | {} | {:.2} |",
            report.row,
            report.title,
            report.found.word(),
            report.bound,
            report.states,
            report.steps,
            report.seconds
        );
        for line in &report.lines {
            println!("      {line}");
        }
        println!("      => {:?} {:?}", report.breach, report.reason);
    }
    assert!(reports.iter().all(|report| report.found == Found::Search));
    assert!(reports.iter().all(|report| report.steps <= 12));
    // 1 to 33, 1b and 32b are known; the others the checker has added.
    assert_eq!(reports.len(), 40);
}

#[test]
fn canary_no_row_is_found_without_its_cause() {
    let mut wrong = Vec::new();
    for row in rows() {
        let control = run_control(&row).unwrap();
        println!("{} {:?} {control:?}", row.row, row.control.as_ref().map(|control| control.what));
        if control.found || !control.ended || control.judged == 0 {
            wrong.push(row.row);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// `[spec: CHECK-9]`
#[test]
fn law_both_engines_count_the_same() {
    for row in rows() {
        let setup = row.control.unwrap().setup;
        let counts =
            count(&mut Network::new(setup.clone()), 0, &Progress::new(Limits::default())).unwrap().unwrap();
        let (_, explored) = explore(Network::new(setup), &Arc::new(Progress::new(Limits::default())));
        assert!(explored.fault.is_none() && !explored.cut);
        assert_eq!((explored.unique, explored.generated), (counts.unique, counts.generated), "{}", row.row);
    }
}

#[test]
fn law_the_checked_semantics_holds_on_every_schedule() {
    let mut wrong = Vec::new();
    for report in reports() {
        println!("{} {:?}", report.row, report.checked);
        let checked = report.checked.unwrap();
        // The schedule is really the same: every call is made, and what it broadcasts arrives. A single replica
        // receives nothing, and in row 23 the only message is lost. In row 37 the deletion is refused: it would
        // leave a child without a parent.
        let arrives = checked.deliveries > 0 || ["23", "28", "36", "37"].contains(&report.row);
        let refused = usize::from(report.row == "37");
        // Where messages never arrive the replicas do differ before they resynchronise: the comparison sees it.
        let misses = ["23", "24", "25", "35"].contains(&report.row);
        assert_eq!(checked.resynchronised, misses, "{}", report.row);
        if checked.broken.is_some() || checked.refused != refused || !arrives {
            wrong.push(report.row);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// What the replicas show for attribute `x` of node 1 once all that is under way has arrived.
fn ends(number: &str) -> Vec<Option<Value>> {
    let row = rows().into_iter().find(|row| row.row == number).unwrap();
    let mut network = Network::new(row.setup.clone());
    let mut at = network.replay(&run_row(&row).schedule).unwrap();
    while let Some(copy) = network.letters(at).into_iter().next() {
        at = network.step(at, &Happening::Deliver(copy, false)).unwrap();
    }
    network.at(at).iter().map(|replica| replica.attribute(1, "x").map(|held| held.value)).collect()
}

/// The whole outcome of some rows, as predicted by reading: who ends with what.
#[test]
fn oracle_rows_end_as_predicted() {
    let number = |value| Some(Value::Number(value));
    // Both who had the latest write end empty; the third ends with the last of the second.
    assert_eq!(ends("1"), [None, None, number(30)]);
    assert_eq!(ends("1b"), [None, None, number(30)]);
    // The remover ends with the write, the writer without.
    assert_eq!(ends("2"), [number(2), None]);
    assert_eq!(ends("3"), [number(10), number(20)]);
    assert_eq!(ends("4"), [number(7), number(7), None]);
    assert_eq!(ends("5"), [number(60), number(7)]);
    assert_eq!(ends("6"), [None, None, number(2)]);
    assert_eq!(ends("12"), [number(1), None]);
    assert_eq!(ends("13"), [number(2), number(2), number(1)]);
    assert_eq!(ends("14"), [number(2), number(2), number(1)]);
    // The joiner keeps what the snapshot has.
    assert_eq!(ends("15"), [number(3), number(3), number(2)]);
    assert_eq!(ends("16"), [number(2), number(2), number(1)]);
    assert_eq!(ends("18"), [None, None, number(1)]);
    assert_eq!(ends("26"), [number(30), number(30)]);
    assert_eq!(ends("27"), [None, number(5)]);
}

/// A network that ends after some events.
struct Short {
    network: Network,
    events_max: usize,
}

impl Space for Short {
    type Node = (Moment, usize);
    type Event = Event;
    type Fault = Breach;

    fn start(&self) -> Self::Node {
        (self.network.start(), 0)
    }

    fn successors(&mut self, at: &Self::Node, out: &mut Vec<(Event, Self::Node)>) -> Result<(), Breach> {
        let mut successors = Vec::new();
        if at.1 < self.events_max {
            self.network.successors(&at.0, &mut successors)?;
        }
        out.extend(successors.into_iter().map(|(event, next)| (event, (next, at.1 + 1))));
        Ok(())
    }

    fn judge(&mut self, at: &Self::Node) -> Result<(), Breach> {
        self.network.judge(&at.0)
    }

    fn depth(&self, at: &Self::Node) -> usize {
        self.network.depth(&at.0)
    }

    fn states_judged(&self) -> u64 {
        self.network.states_judged()
    }

    fn witnessed(&self) -> usize {
        0
    }
}

#[test]
fn law_every_trace_is_shortest() {
    for row in rows() {
        let report = run_row(&row);
        let setup = row.setup;
        for (events_max, found) in [(report.steps, true), (report.steps - 1, false)] {
            let mut short = Short { network: Network::new(setup.clone()), events_max };
            assert_eq!(find_fault(&mut short, usize::MAX).is_some(), found, "{} {events_max}", row.row);
        }
    }
}

#[test]
fn law_every_trace_replays_to_the_same_states() {
    for row in rows() {
        let report = run_row(&row);
        let (setup, breach) = (row.setup, report.breach.unwrap());
        let mut searched = Network::new(setup.clone());
        let end = find_fault(&mut searched, usize::MAX).unwrap().end;
        for _ in 0..100 {
            let mut again = Network::new(setup.clone());
            let at = again.replay(&report.schedule).unwrap();
            assert_eq!(again.at(at), searched.at(end), "{}", row.row);
            assert_eq!(again.judge(&at), Err(breach.clone()), "{}", row.row);
        }
    }
}

/// A trace with one event left out cannot happen, or does not lead to the same states, and breaks nothing.
#[test]
fn canary_a_spoiled_trace_is_noticed() {
    for row in rows() {
        let report = run_row(&row);
        let setup = row.setup;
        let mut network = Network::new(setup.clone());
        let end = network.replay(&report.schedule).unwrap();
        for at in 0..report.steps {
            let mut spoiled = report.schedule.clone();
            spoiled.remove(at);
            let reached = network.replay(&spoiled);
            assert!(reached != Some(end), "{} without {at}", row.row);
            let breaks = reached.is_some_and(|reached| network.judge(&reached).is_err());
            assert!(!breaks, "{} breaks without {at}", row.row);
        }
    }
}

/// `[spec: TRACE-3]`
#[test]
fn regress_two_agents_with_one_number_have_names_of_their_own() {
    for row in rows() {
        let report = run_row(&row);
        let traces = report.trace.into_iter().chain(report.checked.map(|twin| twin.trace));
        for trace in traces {
            assert_eq!(trace.check(), Ok(()), "row {}", row.row);
        }
    }
}
