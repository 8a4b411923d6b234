//! Logs with vector clocks, for `ShiViz` (<https://bestchai.bitbucket.io/shiviz/>).
//!
//! Paste the log, and as its regular expression
//!
//! ```text
//! (?<event>.*)\n(?<host>\S*) (?<clock>\{.*\})
//! ```
//!
//! A replica that restarts stays one host.

use super::diagram::{Arrow, Diagram, Event};
use super::words::{add, one_line};
use serde_json::Value;

/// Two lines for each step: what happens, and its host with its clock.
pub(super) fn shiviz(diagram: &Diagram<'_>) -> String {
    let hosts = hosts(&diagram.lanes);
    let clocks = clocks(diagram);
    let mut log = String::new();
    for (at, (row, clock)) in diagram.rows.iter().zip(&clocks).enumerate() {
        // The word at the start keeps the expression from taking an event for a host with its clock.
        let mut event = format!("step {}: {}", at + 1, diagram.words(row));
        for change in &row.changes {
            add(&mut event, format_args!("; {change}"));
        }
        if at + 1 == diagram.rows.len() {
            add(&mut event, format_args!("; {}", diagram.finding()));
        }
        log += &entry(&event, &hosts, row.lane, clock);
    }
    if diagram.rows.is_empty() {
        log += &entry(&diagram.finding(), &hosts, 0, &[1]);
    }
    log
}

fn entry(event: &str, hosts: &[String], lane: usize, clock: &[u64]) -> String {
    let known = hosts.iter().zip(clock).filter(|(_, count)| **count > 0);
    let entries: Vec<String> =
        known.map(|(host, count)| format!("{}: {count}", Value::from(host.as_str()))).collect();
    format!("{}\n{} {{{}}}\n", one_line(event), hosts[lane], entries.join(", "))
}

/// By row, how many events of each lane it knows, itself among them.
fn clocks(diagram: &Diagram<'_>) -> Vec<Vec<u64>> {
    let mut now = vec![vec![0; diagram.lanes.len()]; diagram.lanes.len()];
    let mut clocks: Vec<Vec<u64>> = Vec::new();
    for row in &diagram.rows {
        let heard = match row.event {
            Event::Delivery(Arrow { sent, .. }) => clocks[sent].clone(),
            _ => Vec::new(),
        };
        let own = &mut now[row.lane];
        for (count, heard) in own.iter_mut().zip(heard) {
            *count = heard.max(*count);
        }
        own[row.lane] += 1;
        clocks.push(own.clone());
    }
    clocks
}

/// The lanes' names without spaces. Two that become one are told apart by their lanes' numbers.
fn hosts(lanes: &[&str]) -> Vec<String> {
    let plain = |name: &str| {
        let name: String = one_line(name).chars().map(|c| if c.is_whitespace() { '_' } else { c }).collect();
        if name.is_empty() { "_".into() } else { name }
    };
    let mut hosts: Vec<String> = Vec::new();
    for (lane, name) in lanes.iter().enumerate() {
        let mut host = plain(name);
        while hosts.contains(&host) || lanes.iter().any(|other| other != name && *other == host) {
            add(&mut host, format_args!("_{}", lane + 1));
        }
        hosts.push(host);
    }
    hosts
}
