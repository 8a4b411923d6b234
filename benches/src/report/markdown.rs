//! For `docs/`.

use super::duration;
use crate::error::BenchError;
use crate::libraries::{AutomergeScene, Crdts, Dson, Dsr, Loro, Yrs};
use crate::questions::all;
use crate::run::{Results, Row};
use crate::scene::Scene;
use crate::targets::targets;
use std::fmt::Write;

/// What people have to say to the numbers: why something is missed, why something is slower than a peer.
const NOTES: &str = include_str!("../../notes.md");

/// The page, with the machine as its first line tells it; plots are in the folder `performance` beside it.
pub fn markdown(results: &Results, machine: &str) -> Result<String, BenchError> {
    let mut out = String::new();
    write(&mut out, results, machine).map_err(|error| BenchError::Plot(error.to_string()))?;
    Ok(out)
}

fn write(out: &mut String, results: &Results, machine: &str) -> std::fmt::Result {
    writeln!(
        out,
        "# Performance\n\nWritten by `cargo run --release -p dsr-benches -- --full --record docs`; the last section is \
         `benches/notes.md`.\nThe numbers as JSON: [`performance/run.json`](performance/run.json).\n\n\
         **The machine.** {machine}\n\n\
         **How.** Questions are in `benches/src/questions/`. Ours and the peers take turns in rounds, in one process; a time \
         is the\nmedian of a library's rounds, of processor time. *Ratio* is the median over the rounds of the best peer's time \
         by ours: above 1\nours is faster; *spread* is its least and its greatest round. Only libraries that can do the job \
         take part.\n"
    )?;
    writeln!(out, "## Targets\n\n| target | measured | |\n|---|---|---|")?;
    for target in targets(results) {
        let mark = if target.is_met { "met" } else { "**missed**" };
        writeln!(out, "| {} | {} | {mark} |", target.text, target.measured)?;
    }
    writeln!(out, "\n## Beside peers\n")?;
    let libraries =
        [Dsr::NAME, Yrs::NAME, Loro::NAME, AutomergeScene::NAME, Crdts::NAME, Dson::NAME].join(" | ");
    writeln!(out, "| question | {libraries} | ratio | spread |\n|---|---|---|---|---|---|---|---|---|")?;
    for row in &results.rows {
        write_row(out, row)?;
    }
    writeln!(out, "\n| question | what is asked |\n|---|---|")?;
    for question in all() {
        writeln!(out, "| {} | {} |", question.id, question.asks)?;
    }
    writeln!(out, "\n### What each library does\n\n| library | mapping |\n|---|---|")?;
    let mappings = [
        (Dsr::NAME, Dsr::MAPPING),
        (Yrs::NAME, Yrs::MAPPING),
        (Loro::NAME, Loro::MAPPING),
        (AutomergeScene::NAME, AutomergeScene::MAPPING),
        (Crdts::NAME, Crdts::MAPPING),
        (Dson::NAME, Dson::MAPPING),
    ];
    for (library, mapping) in mappings {
        writeln!(out, "| {library} | {mapping} |")?;
    }
    write_growth(out, results)?;
    write_sizes(out, results)?;
    if !results.paces.is_empty() {
        writeln!(out, "\n## The checker\n\n| run | states per second, one engine |\n|---|---|")?;
        for pace in &results.paces {
            writeln!(out, "| {} | {:.0} |", pace.id, pace.per_second)?;
        }
    }
    write!(out, "\n{NOTES}")
}

fn write_row(out: &mut String, row: &Row) -> std::fmt::Result {
    write!(out, "| {} |", row.question.id)?;
    let libraries = [Dsr::NAME, Yrs::NAME, Loro::NAME, AutomergeScene::NAME, Crdts::NAME, Dson::NAME];
    for library in libraries {
        match row.times.iter().find(|times| times.library == library) {
            Some(times) if row.ratio.as_ref().is_some_and(|ratio| ratio.peer == library) => {
                write!(out, " **{}** |", duration(times.ns()))?;
            }
            Some(times) => write!(out, " {} |", duration(times.ns()))?,
            None => write!(out, " – |")?,
        }
    }
    match &row.ratio {
        Some(ratio) => {
            writeln!(out, " {:.2} | {:.2} to {:.2} |", ratio.median, ratio.spread[0], ratio.spread[1])
        }
        None => writeln!(out, " | |"),
    }
}

fn write_growth(out: &mut String, results: &Results) -> std::fmt::Result {
    let Some(longest) = results.growth.iter().map(|curve| &curve.points).max_by_key(|points| points.len())
    else {
        return Ok(());
    };
    writeln!(
        out,
        "\n## Growth\n\n![Time by size of the graph](performance/growth.svg)\n\n\
         ![All libraries at one delta](performance/growth-peers.svg)\n"
    )?;
    let sizes: Vec<String> = longest.iter().map(|(n, _)| n.to_string()).collect();
    writeln!(out, "| | | {} | exponent |\n|---|---|{}---|", sizes.join(" | "), "---|".repeat(sizes.len()))?;
    for curve in &results.growth {
        write!(out, "| {} | {} |", curve.id, curve.library)?;
        for (n, _) in longest {
            match curve.points.iter().find(|(size, _)| size == n) {
                Some((_, ns)) => write!(out, " {} |", duration(*ns))?,
                None => write!(out, " – |")?,
            }
        }
        writeln!(out, " {:.3} |", curve.exponent())?;
    }
    writeln!(out)?;
    for (id, means) in crate::growth::ASKED {
        writeln!(out, "- `{id}`: {means}")?;
    }
    Ok(())
}

fn write_sizes(out: &mut String, results: &Results) -> std::fmt::Result {
    if results.sizes.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n## Bytes\n\nA write of ours carries a clock's reading of 9 bytes; no peer's does.\n")?;
    let libraries = [Dsr::NAME, Yrs::NAME, Loro::NAME, AutomergeScene::NAME, Crdts::NAME, Dson::NAME];
    writeln!(out, "| | {} |\n|---|---|---|---|---|---|---|", libraries.join(" | "))?;
    let mut whats: Vec<&str> = Vec::new();
    for what in results.sizes.iter().filter_map(|size| Some(size.id.rsplit_once('/')?.0)) {
        if !whats.contains(&what) {
            whats.push(what);
        }
    }
    for what in whats {
        write!(out, "| {what} |")?;
        for library in libraries {
            match results.sizes.iter().find(|size| size.id == format!("{what}/{library}")) {
                Some(size) => write!(out, " {} |", size.bytes)?,
                None => write!(out, " – |")?,
            }
        }
        writeln!(out)?;
    }
    Ok(())
}
