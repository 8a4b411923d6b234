//! Every case of the corpus against each library, in this process: what fails is what is written down, with its reason.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use dsr_conformance::corpus::{cases, matches};
use dsr_conformance::report::{Report, Verdict};
use dsr_conformance::run::{InProcess, run};
use dsr_peers::replica::Replica;
use dsr_peers::{AutomergeGraph, LoroGraph, Peer, YrsGraph};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// What of the corpus a library is known not to do.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Expectations {
    implementation: String,
    expected: Vec<Expectation>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Expectation {
    /// A case's id, or a pattern of ids.
    case: String,
    /// `fail`: nothing else is ever expected.
    verdict: String,
    /// What in the library causes it.
    reason: String,
}

fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("expected").join(format!("{name}.json"))
}

fn read(name: &str) -> Expectations {
    let text = std::fs::read_to_string(file(name)).unwrap_or_default();
    if text.is_empty() {
        return Expectations { implementation: name.into(), expected: Vec::new() };
    }
    serde_json::from_str(&text).unwrap()
}

/// The ids that fail and are not expected, then the entries by which nothing fails, or not everything that they name.
fn differences(report: &Report, expected: &[Expectation]) -> (Vec<String>, Vec<String>) {
    let unexpected = report.results.iter().filter(|result| {
        result.verdict == Verdict::Fail && !expected.iter().any(|entry| matches(&entry.case, &result.id))
    });
    let stale = expected.iter().filter(|entry| {
        let mut named = report.results.iter().filter(|result| matches(&entry.case, &result.id)).peekable();
        named.peek().is_none() || named.any(|result| result.verdict != Verdict::Fail)
    });
    let told = |id: &str, step: usize, what: &str| format!("{id}, step {step}: {what}");
    (
        unexpected.map(|result| told(&result.id, result.failure.step, &result.failure.what)).collect(),
        stale.map(|entry| entry.case.clone()).collect(),
    )
}

/// Writes the list anew: entries that are still right keep their reasons, new ones have none yet.
fn write(name: &str, report: &Report, mut known: Expectations) {
    let (_, stale) = differences(report, &known.expected);
    known.expected.retain(|entry| !stale.contains(&entry.case));
    for result in &report.results {
        let is_known = known.expected.iter().any(|entry| matches(&entry.case, &result.id));
        if result.verdict == Verdict::Fail && !is_known {
            known.expected.push(Expectation {
                case: result.id.clone(),
                verdict: "fail".into(),
                reason: String::new(),
            });
        }
    }
    known.expected.sort_by(|one, other| one.case.cmp(&other.case));
    std::fs::write(file(name), serde_json::to_string_pretty(&known).unwrap() + "\n").unwrap();
}

fn report<R: Replica + 'static>() -> Report {
    run(&mut InProcess(Peer::<R>::default), &cases().unwrap())
}

fn conforms<R: Replica + 'static>() {
    let report = report::<R>();
    let name = R::implementation().name;
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
        write(&name, &report, read(&name));
    }
    let known = read(&name);
    assert_eq!(known.implementation, name);
    let unreasoned: Vec<_> = known
        .expected
        .iter()
        .filter(|entry| entry.reason.trim().is_empty() || entry.verdict != "fail")
        .map(|entry| entry.case.as_str())
        .collect();
    let (unexpected, stale) = differences(&report, &known.expected);
    assert!(unexpected.is_empty(), "{name} fails, and nothing says why:\n{}", unexpected.join("\n"));
    assert!(stale.is_empty(), "{name} does not fail as is expected: {stale:#?}");
    assert!(unreasoned.is_empty(), "{name}: write what in the library causes these: {unreasoned:#?}");
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

/// An expectation that is too narrow, too wide, or about nothing is found.
#[test]
fn canary_a_wrong_list_is_found() {
    let report = report::<YrsGraph>();
    let fail = report.results.iter().find(|result| result.verdict == Verdict::Fail).unwrap();
    let pass = report.results.iter().find(|result| result.verdict == Verdict::Pass).unwrap();
    let entry = |case: &str| Expectation { case: case.into(), verdict: "fail".into(), reason: "any".into() };
    let (unexpected, stale) = differences(&report, &[entry(&pass.id), entry("no/such/case")]);
    assert_eq!(unexpected.len(), report.count(Verdict::Fail));
    assert_eq!(stale, [pass.id.clone(), "no/such/case".into()]);
    let (unexpected, stale) = differences(&report, &[entry(&fail.id), entry("*")]);
    assert_eq!((unexpected.len(), stale), (0, vec!["*".into()]));
}
