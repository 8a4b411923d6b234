//! Every case of the corpus against each library, in this process: what fails is what is written down, with its reason.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use dsr_conformance::case::Case;
use dsr_conformance::corpus::cases;
use dsr_conformance::expect::{Expectations, update};
use dsr_conformance::report::{Report, Verdict};
use dsr_conformance::run::{InProcess, run};
use dsr_peers::replica::Replica;
use dsr_peers::{AutomergeGraph, LoroGraph, Peer, YrsGraph};
use std::path::PathBuf;

fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("expected").join(format!("{name}.json"))
}

fn read(name: &str) -> Expectations {
    Expectations::read(name, &std::fs::read_to_string(file(name)).unwrap()).unwrap()
}

fn report<R: Replica + 'static>(cases: &[Case]) -> Report {
    run(&mut InProcess(Peer::<R>::default), cases)
}

/// What is not as the list says.
fn differences(report: &Report, known: &Expectations, ids: &[String]) -> Vec<String> {
    let unexpected = report.results.iter().filter(|result| result.verdict.is_bad() && !known.excuses(result));
    let told = unexpected.map(|result| {
        format!(
            "{} {:?}, step {}: {}{}",
            result.id,
            result.verdict,
            result.failure.step,
            result.failure.what,
            result
                .failure
                .difference
                .as_ref()
                .map(|found| format!("; expected {:?}, found {:?}", found.expected, found.got))
                .unwrap_or_default()
        )
    });
    told.chain(known.surprises(report, ids).iter().map(ToString::to_string)).collect()
}

fn conforms<R: Replica + 'static>() {
    let cases = cases().unwrap();
    let ids: Vec<String> = cases.iter().map(|case| case.id.clone()).collect();
    let (report, name) = (report::<R>(&cases), R::implementation().name);
    println!("{name}: {:?}", report.summary().families);
    let odd: Vec<_> = report
        .results
        .iter()
        .filter(|result| !matches!(result.verdict, Verdict::Pass | Verdict::Fail | Verdict::Unsupported))
        .collect();
    assert!(odd.is_empty(), "{odd:#?}");
    assert_eq!(report.results.len(), report.wanted);
    assert!(report.count(Verdict::Pass) > report.count(Verdict::Fail));
    if std::env::var_os("DSR_WRITE").is_some() {
        let new = update(Some(&read(&name)), &report, &ids);
        std::fs::write(file(&name), new.text().unwrap()).unwrap();
    }
    let known = read(&name);
    assert_eq!(known.implementation, name);
    assert!(known.expected.iter().all(|entry| entry.verdict == Verdict::Fail));
    let differences = differences(&report, &known, &ids);
    assert!(differences.is_empty(), "{name}:\n{}", differences.join("\n"));
    known.have_reasons(&name).unwrap();
}

/// Set `DSR_WRITE=1` to write the list anew.
#[test]
fn conform_automerge() {
    conforms::<AutomergeGraph>();
}

/// Set `DSR_WRITE=1` to write the list anew.
#[test]
fn conform_loro() {
    conforms::<LoroGraph>();
}

/// Set `DSR_WRITE=1` to write the list anew.
#[test]
fn conform_yrs() {
    conforms::<YrsGraph>();
}

/// A list with an entry too few is found.
#[test]
fn canary_a_failure_that_is_not_listed_is_found() {
    let cases = cases().unwrap();
    let ids: Vec<String> = cases.iter().map(|case| case.id.clone()).collect();
    let (report, mut known) = (report::<YrsGraph>(&cases), read("yrs"));
    let left_out = known.expected.remove(0);
    let found = differences(&report, &known, &ids);
    assert!(found.iter().any(|difference| difference.starts_with(&left_out.case)), "{found:?}");
}
