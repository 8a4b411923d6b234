//! Logs, expectations and comparisons.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use dsr_conformance::adapter::Core;
use dsr_conformance::case::Case;
use dsr_conformance::corpus;
use dsr_conformance::expect::{ExpectError, Expectations, Surprise, update};
use dsr_conformance::log::{Log, LogWriter, compare, read};
use dsr_conformance::report::{Outcome, Report, Summary, Verdict};
use dsr_conformance::run::{ChildLimits, InProcess, Open, Program, run, run_watched};
use std::time::Duration;

fn cases(pattern: &str) -> Vec<Case> {
    corpus::cases().unwrap().into_iter().filter(|case| corpus::matches(pattern, &case.id)).collect()
}

fn ids() -> Vec<String> {
    corpus::cases().unwrap().into_iter().map(|case| case.id).collect()
}

fn broken(how: &str) -> Program {
    let command = vec![env!("CARGO_BIN_EXE_conform-broken").into(), how.into()];
    let limits = ChildLimits { reply: Duration::from_secs(60), ..ChildLimits::default() };
    Program { command, limits }
}

fn logged(open: &mut dyn Open, cases: &[Case], known: Option<&Expectations>) -> (Report, Vec<u8>) {
    let mut bytes = Vec::new();
    let mut log = LogWriter::new(&mut bytes, &["it".into()], ("*", None), cases.len(), known);
    let report = run_watched(open, cases, &mut log);
    log.finish(&report, report.outcome()).unwrap();
    (report, bytes)
}

fn core_log() -> Vec<u8> {
    logged(&mut InProcess(Core::default), &cases("universal/delivery/*"), None).1
}

fn parsed(bytes: &[u8]) -> Log {
    read("a.ndjson", bytes).unwrap()
}

/// `[spec: CONF-13]`
#[test]
fn law_a_log_says_what_the_report_says() {
    let cases = cases("universal/delivery/*");
    let (report, bytes) = logged(&mut broken("forgets-removals"), &cases, None);
    let log = parsed(&bytes);
    assert_eq!((log.incomplete.as_deref(), log.header.cases), (None, cases.len()));
    assert_eq!(log.header.implementation, report.implementation);
    let verdicts: Vec<_> = report.results.iter().map(|result| (&result.id, result.verdict)).collect();
    assert_eq!(log.cases.iter().map(|case| (&case.id, case.verdict)).collect::<Vec<_>>(), verdicts);
    let failed = log.cases.iter().find(|case| case.verdict == Verdict::Fail).unwrap();
    assert!(failed.step.is_some() && !(failed.expected.is_empty() && failed.got.is_empty()), "{failed:?}");
}

/// `[spec: CONF-13]`
#[test]
fn law_a_run_that_never_begins_has_a_whole_log_that_is_incomplete() {
    let (_, bytes) = logged(&mut broken("dead"), &cases("universal/*"), None);
    let log = parsed(&bytes);
    assert_eq!((log.cases.len(), log.header.implementation), (3, None));
    assert!(log.incomplete.unwrap().ends_with("were not run"));
}

/// Cut anywhere, a log is incomplete or refused, and never whole. `[spec: CONF-13]`
#[test]
fn law_a_log_that_is_cut_is_never_complete() {
    let bytes = core_log();
    assert_eq!(parsed(&bytes).incomplete, None);
    for end in 0..bytes.len() {
        if let Ok(log) = read("a", &bytes[..end]) {
            assert!(log.incomplete.is_some(), "{end}");
        }
    }
}

/// `[spec: CONF-13]`
#[test]
fn law_no_bytes_crash_the_reader() {
    let bytes = core_log();
    // Each byte in turn becomes another; a fault is told or the log means something else.
    for at in 0..bytes.len() {
        for with in [0, b'"', b'{', b'\n', 0xff] {
            let mut other = bytes.clone();
            other[at] = with;
            let _ = read("a", &other);
        }
    }
    let deep = format!("{{\"header\":{}", "[".repeat(100_000));
    for wrong in [&b""[..], b"\n", b"{}\n", b"\xff\n", b"[]\n", deep.as_bytes(), b"{\"footer\":{}}\n"] {
        assert!(read("a", wrong).is_err());
    }
}

/// `[spec: CONF-13]`
#[test]
fn canary_a_log_with_a_fault_is_told() {
    let text = String::from_utf8(core_log()).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let joined = |lines: &[&str]| lines.join("\n") + "\n";
    let less = [&lines[..2], &lines[3..]].concat();
    assert_eq!(parsed(joined(&less).as_bytes()).incomplete.unwrap(), "its footer does not count its lines");
    let no_footer = joined(&lines[..lines.len() - 1]);
    assert_eq!(parsed(no_footer.as_bytes()).incomplete.unwrap(), "it has no footer");
    let refused = |text: String, piece: &str| {
        let error = read("a.ndjson", text.as_bytes()).unwrap_err().to_string();
        assert!(error.starts_with("a.ndjson:") && error.contains(piece), "{error}");
    };
    refused(joined(&[&lines[..2], &lines[1..]].concat()), "stands twice");
    refused(joined(&[lines[0], lines[0]]), "a second header");
    refused(joined(&lines[1..]), "no header");
    refused(text.clone() + lines[1] + "\n", "after the footer");
    refused(text.clone() + "x", "after the footer");
    refused(text.replacen("\"format\":1", "\"format\":2", 1), "format 2");
    refused(text.replacen("\"level\"", "\"lever\"", 1), "lever");
    let mut more = text.replacen("\"cases\":", "\"cases\":1", 1);
    assert!(parsed(more.as_bytes()).incomplete.is_some());
    more = text.replacen("\"pass\":", "\"pass\":1", 1);
    assert!(parsed(more.as_bytes()).incomplete.is_some());
}

fn expecting(entries: &str) -> Expectations {
    let text = format!(r#"{{"implementation": "dsr-core", "expected": [{entries}]}}"#);
    Expectations::read("e.json", &text).unwrap()
}

/// `[spec: CONF-14]`
#[test]
fn law_what_is_expected_is_not_counted_and_what_is_not_is_told() {
    let cases = cases("universal/delivery/*");
    let report = run(&mut broken("forgets-removals"), &cases);
    assert_eq!(report.outcome(), Outcome::Unexpected);
    let failed: Vec<String> = report
        .results
        .iter()
        .filter(|result| result.verdict.is_bad())
        .map(|result| result.id.clone())
        .collect();
    let entry = |case: &str| format!(r#"{{"case": "{case}", "verdict": "fail", "reason": "later"}}"#);
    let all = expecting(&failed.iter().map(|id| entry(id)).collect::<Vec<_>>().join(","));
    assert_eq!(report.outcome_but(&|result| all.excuses(result)), Outcome::Expected);
    assert!(all.surprises(&report, &ids()).is_empty());
    let surprises = expecting(&entry("universal/delivery/*")).surprises(&report, &ids());
    assert_eq!(surprises.len(), cases.len() - failed.len());
    assert!(surprises.iter().all(|surprise| matches!(surprise, Surprise::Passes { .. })));
    let nothing = expecting(&entry("universal/nowhere/*")).surprises(&report, &ids());
    assert!(matches!(&nothing[..], [Surprise::MatchesNothing { .. }]), "{nothing:?}");
    // A pattern for cases that this run did not choose is no surprise.
    assert!(expecting(&entry("universal/recovery/newcomer")).surprises(&report, &ids()).is_empty());
    let other = expecting(&entry(&failed[0]).replace("\"fail\"", "\"crash\"")).surprises(&report, &ids());
    assert!(matches!(&other[..], [Surprise::Otherwise { verdict: "fail", .. }]), "{other:?}");
}

/// `[spec: CONF-14]`
#[test]
fn law_updates_keep_reasons_and_leave_new_ones_empty() {
    let cases = cases("universal/delivery/*");
    let report = run(&mut broken("forgets-removals"), &cases);
    let first = update(None, &report, &ids());
    assert_eq!(first.implementation, "dsr-core");
    assert_eq!(first.expected.len(), report.count(Verdict::Fail));
    assert!(matches!(first.have_reasons("e"), Err(ExpectError::NoReason { .. })));
    let mut reasoned = first.clone();
    for entry in &mut reasoned.expected {
        entry.reason = "known".into();
    }
    reasoned.have_reasons("e").unwrap();
    assert_eq!(update(Some(&reasoned), &report, &ids()), reasoned);
    let read_again = Expectations::read("e", &reasoned.text().unwrap()).unwrap();
    assert_eq!(read_again, reasoned);
    // All is repaired, and what was not run stays.
    let mut with_other = reasoned.clone();
    with_other.expected.push(dsr_conformance::expect::Expected {
        case: "universal/recovery/newcomer".into(),
        verdict: Verdict::Fail,
        reason: "elsewhere".into(),
        issue: None,
    });
    let sound = run(&mut InProcess(Core::default), &cases);
    let repaired = update(Some(&with_other), &sound, &ids());
    assert_eq!(
        repaired.expected.iter().map(|entry| entry.reason.as_str()).collect::<Vec<_>>(),
        ["elsewhere"]
    );
    // A pattern that holds only in part leaves its reason to that part.
    let wide =
        expecting(r#"{"case": "universal/delivery/*", "verdict": "fail", "reason": "wide", "issue": "n1"}"#);
    let narrowed = update(Some(&wide), &report, &ids());
    assert_eq!(narrowed.expected.len(), first.expected.len());
    assert!(narrowed.expected.iter().all(|entry| entry.reason == "wide" && entry.issue.is_some()));
}

/// `[spec: CONF-14]`
#[test]
fn canary_expectations_of_another_form_are_refused() {
    for wrong in [
        "",
        "[]",
        r#"{"implementation": "x"}"#,
        r#"{"implementation": "x", "expected": [], "more": 1}"#,
        r#"{"implementation": "x", "expected": [{"case": "a", "verdict": "green", "reason": "r"}]}"#,
        r#"{"implementation": "x", "expected": [["a", "fail", "r"]]}"#,
    ] {
        assert!(matches!(Expectations::read("e", wrong), Err(ExpectError::Form { .. })), "{wrong}");
    }
    let entry = r#"{"case": "a", "verdict": "fail", "reason": "r"}"#;
    let twice = format!(r#"{{"implementation": "x", "expected": [{entry}, {entry}]}}"#);
    assert!(matches!(Expectations::read("e", &twice), Err(ExpectError::Twice { .. })));
}

/// `[spec: CONF-17]`
#[test]
fn law_what_got_worse_is_told_and_durations_do_not_count() {
    let cases = cases("universal/delivery/*");
    let sound = parsed(&logged(&mut InProcess(Core::default), &cases, None).1);
    let wrong = parsed(&logged(&mut broken("forgets-removals"), &cases, None).1);
    let failed = wrong.cases.iter().filter(|case| case.verdict == Verdict::Fail).count();
    let worse = compare(&sound, &wrong);
    assert!(worse.is_worse());
    assert_eq!((worse.changes.len(), worse.same), (failed, cases.len() - failed));
    let better = compare(&wrong, &sound);
    assert!(!better.is_worse() && better.changes.iter().all(dsr_conformance::log::Change::is_better));
    let mut later = sound.clone();
    later.cases.reverse();
    for case in &mut later.cases {
        case.milliseconds += 1000;
    }
    assert_eq!(compare(&sound, &later).changes, []);
    later.cases.pop();
    assert!(compare(&sound, &later).is_worse());
    assert!(!compare(&later, &sound).is_worse());
}

/// `[spec: CONF-18]`
#[test]
fn law_two_runs_are_as_good_as_the_worse_and_must_agree() {
    let cases = cases("universal/delivery/*");
    let sound = run(&mut InProcess(Core::default), &cases).summary();
    let wrong = run(&mut broken("forgets-removals"), &cases).summary();
    let both = Summary::together(vec![("in-process", sound.clone()), ("stdio", sound.clone())]).unwrap();
    assert_eq!((both.verdict, both.runs.len(), &both.counts), (Outcome::Expected, 2, &sound.counts));
    let differ = Summary::together(vec![("in-process", sound.clone()), ("stdio", wrong.clone())]).unwrap();
    assert_eq!((differ.verdict, &differ.counts), (Outcome::Unexpected, &wrong.counts));
    let mut fewer = sound.clone();
    *fewer.counts.get_mut("pass").unwrap() -= 1;
    assert_eq!(Summary::together(vec![("a", sound), ("b", fewer)]).unwrap().verdict, Outcome::Unexpected);
    assert_eq!(Summary::together(Vec::new()), None);
}
