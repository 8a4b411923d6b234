//! Every case of the corpus against each library, in this process: what fails is what is written down, with its reason.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use dsr_conformance::case::{Case, Origin};
use dsr_conformance::corpus::cases;
use dsr_conformance::expect::{Expectations, update};
use dsr_conformance::report::{Report, Verdict};
use dsr_conformance::run::{InProcess, run};
use dsr_peers::published_graph::{Fork, Upstream};
use dsr_peers::replica::Replica;
use dsr_peers::{AutomergeGraph, LoroGraph, Peer, PublishedGraph, YrsGraph};
use std::path::PathBuf;

fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("expected").join(format!("{name}.json"))
}

fn read(name: &str) -> Expectations {
    Expectations::read(name, &std::fs::read_to_string(file(name)).unwrap()).unwrap()
}

/// The cases that are not from the model, and those that are: of the hundreds of these that fail no list has the reasons.
fn split() -> (Vec<Case>, Vec<Case>) {
    cases().unwrap().into_iter().partition(|case| case.provenance.kind != Origin::Model)
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

/// Of the model's cases, those that any sound implementation passes fail only by these invariants.
fn conforms<R: Replica + 'static>(breaks: &[&str]) {
    let (cases, of_the_model) = split();
    let report_of_the_model = report::<R>(&of_the_model);
    for result in &report_of_the_model.results {
        assert!(matches!(result.verdict, Verdict::Pass | Verdict::Fail), "{result:#?}");
        let is_due = result.failure.broken.is_some_and(|clause| breaks.contains(&clause));
        let is_choice = result.id.starts_with("resolution/");
        assert!(result.verdict == Verdict::Pass || is_choice || is_due, "{result:#?}");
    }
    assert!(report_of_the_model.count(Verdict::Pass) > report_of_the_model.count(Verdict::Fail));
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
    conforms::<AutomergeGraph>(&["INV-1", "INV-3"]);
}

/// Set `DSR_WRITE=1` to write the list anew.
#[test]
fn conform_loro() {
    conforms::<LoroGraph>(&["INV-1"]);
}

/// Set `DSR_WRITE=1` to write the list anew.
#[test]
fn conform_yrs() {
    conforms::<YrsGraph>(&["INV-1", "INV-3"]);
}

/// A list with an entry too few is found.
#[test]
fn canary_a_failure_that_is_not_listed_is_found() {
    let (cases, _) = split();
    let ids: Vec<String> = cases.iter().map(|case| case.id.clone()).collect();
    let (report, mut known) = (report::<YrsGraph>(&cases), read("yrs"));
    let left_out = known.expected.remove(0);
    let found = differences(&report, &known, &ids);
    assert!(found.iter().any(|difference| difference.starts_with(&left_out.case)), "{found:?}");
}

/// The published system, as the checker has it: nothing but passes and failures, both of many.
#[test]
fn conform_the_published_system_fails_by_what_is_known_of_it() {
    let cases = cases().unwrap();
    for report in [report::<PublishedGraph<Upstream>>(&cases), report::<PublishedGraph<Fork>>(&cases)] {
        let odd = |verdict| !matches!(verdict, Verdict::Pass | Verdict::Fail | Verdict::Unsupported);
        let odd: Vec<_> = report.results.iter().filter(|result| odd(result.verdict)).collect();
        assert!(odd.is_empty(), "{odd:#?}");
        let of = |family: &str, verdict| {
            report
                .results
                .iter()
                .filter(|result| result.id.starts_with(family) && result.verdict == verdict)
                .count()
        };
        assert!(of("universal/gallery/", Verdict::Fail) >= 20, "{:?}", report.summary().families);
        assert!(of("universal/mutations/", Verdict::Fail) == 0, "{:?}", report.summary().families);
        assert!(of("universal/", Verdict::Pass) > 100, "{:?}", report.summary().families);
    }
}
