//! For a terminal.

use super::duration;
use crate::run::{Results, Row};
use crate::targets::targets;
use std::fmt::Write;

/// The table, and what else was measured.
pub fn text(results: &Results) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut out, results);
    out
}

fn write(out: &mut String, results: &Results) -> std::fmt::Result {
    if !results.rows.is_empty() {
        writeln!(
            out,
            "{:22} {:>9}  {:>7} {:>17}  {:10} others",
            "question", "dsr", "ratio", "spread", "best peer"
        )?;
    }
    for row in &results.rows {
        write_row(out, row)?;
    }
    if !results.rows.is_empty() {
        writeln!(out, "ratio: the time of the best peer by ours; above 1 ours is faster\n")?;
    }
    for curve in &results.growth {
        write!(out, "growth {:14} {:10} exponent {:>6.3} ", curve.id, curve.library, curve.exponent())?;
        for (n, ns) in &curve.points {
            write!(out, "  {n}: {}", duration(*ns))?;
        }
        writeln!(out)?;
    }
    for size in &results.sizes {
        writeln!(out, "{:44} {:>9} bytes", size.id, size.bytes)?;
    }
    for pace in &results.paces {
        writeln!(out, "checker {:36} {:>9.0} states/s", pace.id, pace.per_second)?;
    }
    for target in targets(results) {
        let mark = if target.is_met { "met   " } else { "MISSED" };
        writeln!(out, "{mark} {}: {}", target.text, target.measured)?;
    }
    Ok(())
}

fn write_row(out: &mut String, row: &Row) -> std::fmt::Result {
    let Some((ours, peers)) = row.times.split_first() else { return Ok(()) };
    write!(out, "{:22} {:>9}", row.question.id, duration(ours.ns()))?;
    let best = row.ratio.as_ref().map_or("", |ratio| ratio.peer);
    if let Some(ratio) = &row.ratio {
        let spread = format!("{:.2} to {:.2}", ratio.spread[0], ratio.spread[1]);
        write!(out, "  {:>7.2} {spread:>17}", ratio.median)?;
    }
    let (first, others): (Vec<_>, Vec<_>) = peers.iter().partition(|peer| peer.library == best);
    for peer in first.into_iter().chain(others) {
        write!(out, "  {} {}", peer.library, duration(peer.ns()))?;
    }
    writeln!(out)
}
