//! `dsr-peer`: an adapter over standard input and output.

use clap::{Parser, ValueEnum};
use dsr_conformance::adapter::Adapter;
use dsr_conformance::serve::serve;
use dsr_peers::published_graph::{Fork, Upstream};
use dsr_peers::{AutomergeGraph, LoroGraph, Peer, PublishedGraph, YrsGraph};
use std::io;
use std::process::ExitCode;

/// Answers the conformance harness with graphs that are built on another library's CRDTs.
///
/// Reads one request a line from standard input and writes one reply a line to standard output, as the chapter
/// `spec/conformance.md` says. Run it under the harness: `dsr conform run -- dsr-peer loro`.
#[derive(Parser)]
#[command(name = "dsr-peer", version)]
struct Arguments {
    /// Whose CRDTs hold the graph.
    #[arg(value_name = "LIBRARY")]
    whose: Library,
}

#[derive(Clone, Copy, ValueEnum)]
enum Library {
    /// automerge: maps of objects; multi-value registers.
    Automerge,
    /// Loro: a movable tree for the kinematic edges, last-writer-wins maps for the rest.
    Loro,
    /// The published Deep State Representation, as the checker models it.
    Published,
    /// Its fork.
    PublishedFork,
    /// yrs, the Rust port of Yjs: maps of maps.
    Yrs,
}

fn main() -> ExitCode {
    let mut adapter: Box<dyn Adapter> = match Arguments::parse().whose {
        Library::Automerge => Box::new(Peer::<AutomergeGraph>::default()),
        Library::Loro => Box::new(Peer::<LoroGraph>::default()),
        Library::Published => Box::new(Peer::<PublishedGraph<Upstream>>::default()),
        Library::PublishedFork => Box::new(Peer::<PublishedGraph<Fork>>::default()),
        Library::Yrs => Box::new(Peer::<YrsGraph>::default()),
    };
    match serve(&mut *adapter, io::stdin().lock(), io::stdout().lock()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("dsr-peer: {error}");
            ExitCode::FAILURE
        }
    }
}
