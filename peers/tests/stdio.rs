//! Each library over pipes: what comes of the corpus there is what comes of it in this process.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use dsr_conformance::case::Case;
use dsr_conformance::corpus::cases;
use dsr_conformance::report::{Report, Verdict};
use dsr_conformance::run::{ChildLimits, InProcess, Program, run};
use dsr_peers::replica::Replica;
use dsr_peers::{AutomergeGraph, LoroGraph, Peer, YrsGraph};
use std::process::{Command, Stdio};
use std::time::Duration;

const PROGRAM: &str = env!("CARGO_BIN_EXE_dsr-peer");

/// A run without its times.
fn timeless(mut report: Report) -> Report {
    report.results.iter_mut().for_each(|result| result.milliseconds = 0);
    report
}

/// Every case, here and there.
fn agrees<R: Replica + 'static>(name: &str) {
    let cases: Vec<Case> = cases().unwrap();
    let limits = ChildLimits { reply: Duration::from_secs(60), ..ChildLimits::default() };
    let mut program = Program { command: vec![PROGRAM.into(), name.into()], limits };
    let (there, here) = (run(&mut program, &cases), run(&mut InProcess(Peer::<R>::default), &cases));
    assert!(there.count(Verdict::Pass) > 0);
    assert_eq!(there.implementation.as_ref().map(|said| said.name.as_str()), Some(name));
    assert_eq!(timeless(there), timeless(here));
}

/// `[spec: CONF-1]`
#[test]
fn conform_automerge_over_pipes() {
    agrees::<AutomergeGraph>("automerge");
}

/// `[spec: CONF-1]`
#[test]
fn conform_loro_over_pipes() {
    agrees::<LoroGraph>("loro");
}

/// `[spec: CONF-1]`
#[test]
fn conform_yrs_over_pipes() {
    agrees::<YrsGraph>("yrs");
}

/// At the end of its input it ends with status 0; what it does not know it says. `[spec: CONF-1]`
#[test]
fn law_the_program_ends_with_its_input_and_refuses_other_names() {
    let status = Command::new(PROGRAM).arg("yrs").stdin(Stdio::null()).status().unwrap();
    assert_eq!(status.code(), Some(0));
    let output = Command::new(PROGRAM).arg("nobody").output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(["automerge", "loro", "yrs"].into_iter().all(|name| said.contains(name)), "{said}");
    let help = Command::new(PROGRAM).arg("--help").output().unwrap();
    assert!(String::from_utf8_lossy(&help.stdout).contains("dsr conform run -- dsr-peer loro"));
}

/// What a replica's implementation says of itself is what is linked.
#[test]
fn law_versions_are_those_of_the_lock_file() {
    let lock = concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.lock");
    let lock = std::fs::read_to_string(lock).unwrap();
    let said = [AutomergeGraph::implementation(), LoroGraph::implementation(), YrsGraph::implementation()];
    for said in said {
        let entry = format!("name = \"{}\"\nversion = \"{}\"\n", said.name, said.version);
        assert!(lock.contains(&entry), "{} {}", said.name, said.version);
    }
}
