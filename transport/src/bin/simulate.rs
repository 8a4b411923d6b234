//! Runs the simulation: `simulate --runs 5000 --seed 1`.

use clap::Parser;
use dsr_transport::simulation::{Options, Plan, Totals, run, run_telling, shrink};
use std::process::ExitCode;
use std::time::Instant;

/// Runs real sessions over a network in memory with all faults at once, and judges them.
#[derive(Parser)]
struct Arguments {
    /// How many runs.
    #[arg(long, default_value_t = 1000)]
    runs: u64,
    /// The seed of the first; the others follow.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The most nodes of a run, 3 to 50; the fewest are 3. Runs of few take milliseconds, runs of 50 seconds.
    #[arg(long, default_value_t = 7, value_parser = clap::value_parser!(u16).range(3..=50))]
    nodes: u16,
    /// Exactly so many nodes in every run.
    #[arg(long)]
    exactly: Option<u16>,
    /// Differing fingerprints lead to no digest, nobody dies and nobody lies: then sessions must know by themselves
    /// whatever they lack.
    #[arg(long)]
    known: bool,
    /// Tell what happens in the run of `--seed`, line by line.
    #[arg(long)]
    tell: bool,
}

/// Runs in a second.
#[allow(clippy::cast_precision_loss, reason = "to be read by people")]
fn rate(runs: u64, begun: Instant) -> f64 {
    runs as f64 / begun.elapsed().as_secs_f64()
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let nodes_max = usize::from(arguments.exactly.unwrap_or(arguments.nodes)).clamp(3, 50);
    let nodes_min = if arguments.exactly.is_some() { nodes_max } else { 3 };
    let mut options = Options { nodes_min, nodes_max, ..Options::WIDE };
    if arguments.known {
        options = Options { fingerprints: false, deaths: false, hostile: false, ..options };
    }
    if arguments.tell {
        let (outcome, told) = run_telling(&Plan::draw(arguments.seed, &options));
        println!("{}\n{outcome:#?}", told.join("\n"));
        return if outcome.failure.is_none() { ExitCode::SUCCESS } else { ExitCode::FAILURE };
    }
    let begun = Instant::now();
    let mut totals = Totals::default();
    for seed in arguments.seed..arguments.seed.saturating_add(arguments.runs) {
        let plan = Plan::draw(seed, &options);
        let outcome = run(&plan);
        totals.add(&outcome);
        if let Some(failure) = outcome.failure {
            let (small, runs) = shrink(&plan);
            let (outcome, told) = run_telling(&small);
            println!(
                "seed {seed}: {failure}\nshrunk in {runs} runs to {} steps, {:?}:",
                small.steps.len(),
                small.faults
            );
            println!("{}\n{:#?}\n", told.join("\n"), outcome.stats);
        }
        if totals.runs % 100 == 0 {
            let rate = rate(totals.runs, begun);
            eprintln!(
                "{} of {} runs, {} failed, {rate:.1} runs/s",
                totals.runs, arguments.runs, totals.failed
            );
        }
    }
    let seconds = begun.elapsed().as_secs_f64();
    println!(
        "{totals}
{seconds:.1} s, {:.1} runs/s",
        rate(totals.runs, begun)
    );
    if totals.failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
