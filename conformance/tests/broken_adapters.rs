//! Adapters broken on purpose get exactly their verdict, and nobody else's case suffers.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use dsr_conformance::case::{Case, Level, Step};
use dsr_conformance::corpus;
use dsr_conformance::report::{Outcome, Report, Verdict};
use dsr_conformance::run::{ChildLimits, Program, hello, run};
use std::time::{Duration, Instant};

fn program(arguments: &[&str]) -> Program {
    let command = std::iter::once(env!("CARGO_BIN_EXE_conform-broken")).chain(arguments.iter().copied());
    let hangs = matches!(arguments, ["hangs" | "deaf" | "too-slow" | "grandchild", ..] | ["silent"]);
    let limits =
        ChildLimits { reply: Duration::from_secs(if hangs { 3 } else { 60 }), ..ChildLimits::default() };
    Program { command: command.map(String::from).collect(), limits }
}

fn cases(patterns: &[&str]) -> Vec<Case> {
    let is_wanted = |case: &Case| patterns.iter().any(|pattern| corpus::matches(pattern, &case.id));
    let cases: Vec<Case> = corpus::cases().unwrap().into_iter().filter(is_wanted).collect();
    assert!(cases.len() >= patterns.len());
    cases
}

/// Two cases of four or five requests each.
fn two() -> Vec<Case> {
    cases(&["universal/mutations/add-edge", "universal/mutations/remove-edge"])
}

#[track_caller]
fn verdicts(report: &Report, expected: &[(&str, Verdict)]) {
    let found: Vec<_> =
        report.results.iter().map(|result| (result.id.rsplit('/').next().unwrap(), result.verdict)).collect();
    assert_eq!(found, expected, "{report:#?}");
}

/// The third reply is broken, so the first case gets the verdict; started anew, the adapter breaks in the same
/// place of the second.
#[track_caller]
fn breaks(how: &str, verdict: Verdict, piece: &str) {
    let report = run(&mut program(&[how, "3"]), &two());
    verdicts(&report, &[("add-edge", verdict), ("remove-edge", verdict)]);
    assert!(report.results.iter().all(|result| result.failure.what.contains(piece)), "{report:#?}");
    assert_eq!(report.outcome(), Outcome::Unexpected);
}

/// `[spec: CONF-1]` `[spec: CONF-2]` `[spec: CONF-9]` `[spec: CONF-12]`
#[test]
fn canary_what_is_no_reply_is_a_protocol_error() {
    breaks("garbage", Verdict::ProtocolError, "Traceback");
    breaks("wrong-id", Verdict::ProtocolError, "request 3 is answered with id 2");
    breaks("cut-off", Verdict::ProtocolError, "not UTF-8 from byte 19 on");
    breaks("half-line", Verdict::ProtocolError, "the last line has no end");
    breaks("deep", Verdict::ProtocolError, "no reply: EOF");
    breaks("list", Verdict::ProtocolError, "a list stands where an object is due, at `ok`");
    breaks("neither", Verdict::ProtocolError, "not exactly one of");
    breaks("too-long", Verdict::ProtocolError, "more than 1048576 bytes");
    breaks("twice", Verdict::ProtocolError, "");
    breaks("bomb", Verdict::ProtocolError, "no reply: ");
    breaks("nul", Verdict::ProtocolError, "no reply: ");
    breaks("one-behind", Verdict::ProtocolError, "request 3 is answered with id 4");
}

/// `[spec: CONF-9]` `[spec: CONF-12]`
#[test]
fn canary_an_adapter_that_dies_or_hangs_is_started_anew() {
    breaks("dies", Verdict::Crash, "101");
    let started = Instant::now();
    breaks("hangs", Verdict::Timeout, "no reply within 3 s");
    assert!(started.elapsed() < Duration::from_secs(60));
    // Reply 7 is the first of the second case.
    let report = run(&mut program(&["dies", "7"]), &two());
    verdicts(&report, &[("add-edge", Verdict::Pass), ("remove-edge", Verdict::Crash)]);
}

/// `[spec: CONF-12]`
#[test]
fn canary_a_line_after_the_last_reply_of_a_case_is_found() {
    // Reply 8 is that of the first case's end; the other case has fewer. The surplus line may come only after the next
    // case has begun, and counts against that one then.
    let cases = cases(&["universal/mutations/update-attributes", "universal/mutations/remove-edge"]);
    let report = run(&mut program(&["twice", "8"]), &cases);
    assert_eq!(report.count(Verdict::ProtocolError), 1, "{report:#?}");
    assert_eq!(report.count(Verdict::Pass), 1, "{report:#?}");
}

/// `[spec: CONF-9]` `[spec: CONF-10]`
#[test]
fn canary_an_adapter_that_never_begins_ends_the_run() {
    let all = cases(&["*"]);
    for (how, verdict) in
        [("dead", Verdict::Crash), ("silent", Verdict::Timeout), ("endless-line", Verdict::ProtocolError)]
    {
        let report = run(&mut program(&[how]), &all);
        assert_eq!(report.results.len(), 3, "{how}");
        assert!(report.results.iter().all(|result| result.verdict == verdict), "{report:#?}");
        assert_eq!(report.summary().counts["not_run"], all.len() - 3);
        assert!(report.implementation.is_none());
    }
    let mut missing = Program { command: vec!["/no/such/adapter".into()], limits: ChildLimits::default() };
    let report = run(&mut missing, &two());
    verdicts(&report, &[("add-edge", Verdict::Crash), ("remove-edge", Verdict::Crash)]);
    assert!(hello(&mut missing).unwrap_err().to_string().contains("/no/such/adapter"));
}

/// `[spec: CONF-1]`
#[test]
fn law_standard_error_is_no_verdict() {
    let report = run(&mut program(&["chatty"]), &two());
    verdicts(&report, &[("add-edge", Verdict::Pass), ("remove-edge", Verdict::Pass)]);
}

/// `[spec: CONF-1]` `[spec: CONF-10]`
#[test]
fn conform_the_core_passes_every_case_over_a_pipe() {
    let report = run(&mut program(&["sound"]), &cases(&["*"]));
    assert!(report.results.iter().all(|result| result.verdict == Verdict::Pass), "{report:#?}");
    assert_eq!(report.outcome(), Outcome::Expected);
}

/// `[spec: CONF-3]`
#[test]
fn canary_who_lies_about_features_breaks_the_protocol() {
    let report = run(&mut program(&["liar"]), &cases(&["universal/recovery/*"]));
    let expected = [
        ("restart-keeps", Verdict::ProtocolError),
        ("restart-loses", Verdict::ProtocolError),
        ("newcomer", Verdict::Pass),
        ("both-ways", Verdict::Pass),
        ("lost-replacement", Verdict::Pass),
    ];
    verdicts(&report, &expected);
    assert!(report.results[0].failure.what.contains("announced, the feature restart"), "{report:#?}");
}

/// `[spec: CONF-3]` `[spec: CONF-8]` `[spec: CONF-9]` `[spec: CONF-10]`
#[test]
fn law_what_is_left_out_is_no_pass() {
    let patterns = ["universal/recovery/*", "universal/delivery/twice", "universal/refusals/group"];
    let report = run(&mut program(&["modest"]), &cases(&patterns));
    let counted = [Verdict::Unsupported, Verdict::Skip, Verdict::Pass].map(|verdict| report.count(verdict));
    assert_eq!((counted, report.outcome()), ([5, 1, 1], Outcome::Incomplete), "{report:#?}");
    let summary = report.summary();
    assert_eq!(summary.families["universal"]["unsupported"], 5);
    let announced =
        run(&mut program(&["modest"]), &cases(&["universal/recovery/*", "universal/refusals/group"]));
    assert_eq!(announced.outcome(), Outcome::Expected);
    let left_out = run(&mut program(&["modest"]), &cases(&["universal/recovery/*"]));
    assert_eq!(left_out.outcome(), Outcome::Incomplete);
}

/// `[spec: CONF-3]`
#[test]
fn law_who_takes_less_is_asked_less() {
    let unsupported = |how: &str, patterns: &[&str]| {
        let report = run(&mut program(&[how]), &cases(patterns));
        assert_eq!(report.count(Verdict::Pass) + report.count(Verdict::Unsupported), report.results.len());
        let left_out = report.results.into_iter().filter(|result| result.verdict == Verdict::Unsupported);
        left_out.map(|result| (result.id, result.failure.what)).collect::<Vec<_>>()
    };
    let few = unsupported("few-replicas", &["universal/convergence/*"]);
    let needs = "needs 3 replicas; the adapter takes 2";
    let expected = ["one-attribute", "cycle"].map(|slug| format!("universal/convergence/{slug}"));
    assert_eq!(few, expected.map(|id| (id, needs.to_owned())));
    let short =
        unsupported("short-lines", &["universal/mutations/all-values", "universal/convergence/names"]);
    let what = "has a line of more than 300 bytes";
    assert_eq!(short, [("universal/mutations/all-values".to_owned(), what.to_owned())]);
}

/// `[spec: CONF-8]` `[spec: CONF-9]` `[spec: CONF-10]`
#[test]
fn canary_an_error_is_an_error_and_counts_by_its_level() {
    let mut cases = two();
    let report = run(&mut program(&["errs"]), &cases);
    verdicts(&report, &[("add-edge", Verdict::Error), ("remove-edge", Verdict::Error)]);
    assert_eq!(report.outcome(), Outcome::Unexpected);
    for case in &mut cases {
        case.level = Level::Should;
    }
    assert_eq!(run(&mut program(&["errs"]), &cases).outcome(), Outcome::Incomplete);
}

/// `[spec: CONF-9]`
#[test]
fn canary_a_join_that_counts_fails_where_deltas_come_twice() {
    let report = run(&mut program(&["twice-delivered"]), &cases(&["universal/delivery/*"]));
    let failed: Vec<&str> = failures(&report);
    assert_eq!(failed, ["universal/delivery/twice"]);
    let failure = report.results.iter().find(|result| result.verdict == Verdict::Fail).unwrap();
    assert_eq!(failure.failure.broken, Some("INV-6"), "{report:#?}");
}

/// `[spec: CONF-9]`
#[test]
fn canary_an_empty_answer_fails_where_something_was_lost() {
    let report = run(&mut program(&["empty-answers"]), &cases(&["universal/recovery/*"]));
    let expected =
        ["newcomer", "both-ways", "lost-replacement"].map(|slug| format!("universal/recovery/{slug}"));
    assert_eq!(failures(&report), expected);
}

/// `[spec: CONF-9]`
#[test]
fn canary_a_forgotten_removal_fails_where_removals_travel() {
    let report = run(
        &mut program(&["forgets-removals"]),
        &cases(&["universal/convergence/*", "universal/delivery/*"]),
    );
    let expected = [
        "universal/convergence/removal-and-update",
        "universal/delivery/removal-first",
        "universal/delivery/late-write",
    ];
    assert_eq!(failures(&report), expected);
}

/// `[spec: CONF-1]` `[spec: CONF-12]`
#[test]
fn law_the_longest_line_is_a_line() {
    let report = run(&mut program(&["padded", "3"]), &two());
    verdicts(&report, &[("add-edge", Verdict::Pass), ("remove-edge", Verdict::Pass)]);
}

/// `[spec: CONF-7]`
#[test]
fn law_the_order_of_lists_means_nothing() {
    let report = run(&mut program(&["unordered"]), &cases(&["universal/mutations/*", "resolution/*"]));
    let left_out = report.count(Verdict::Unsupported);
    assert_eq!(report.count(Verdict::Pass) + left_out, report.results.len(), "{report:#?}");
    assert!(report.count(Verdict::Pass) > 20);
}

/// `[spec: CONF-9]`
#[test]
fn canary_a_join_without_contexts_fails_where_removals_travel() {
    let report = run(&mut program(&["contextless"]), &cases(&["universal/delivery/*"]));
    assert!(report.count(Verdict::Fail) > 0, "{report:#?}");
    assert_eq!(
        report.count(Verdict::Pass) + report.count(Verdict::Fail) + report.count(Verdict::Unsupported),
        report.results.len()
    );
    let late = report.results.iter().find(|result| result.id == "universal/delivery/removal-first").unwrap();
    assert_eq!(late.verdict, Verdict::Fail, "{report:#?}");
}

/// `[spec: CONF-9]` `[spec: CONF-12]`
#[test]
fn canary_slow_is_no_fault_and_too_slow_is_a_timeout() {
    verdicts(
        &run(&mut program(&["slow"]), &two()),
        &[("add-edge", Verdict::Pass), ("remove-edge", Verdict::Pass)],
    );
    let late = run(&mut program(&["too-slow"]), &two());
    verdicts(&late, &[("add-edge", Verdict::Timeout), ("remove-edge", Verdict::Timeout)]);
    let what = &late.results[0].failure.what;
    assert!(what.contains("request: `{\"id\":") && what.contains("read"), "{what}");
}

/// `[spec: CONF-12]`
#[test]
fn canary_who_reads_nothing_or_leaves_a_pipe_open_stops_nobody() {
    let started = Instant::now();
    let mut unlimited = program(&["deaf"]);
    unlimited.limits.reply = Duration::from_secs(2);
    // Its request is more than a pipe holds.
    let mut large = two();
    for case in &mut large {
        if let Some(Step::Mutate { mutations, .. }) = case.steps.first_mut() {
            *mutations = mutations.iter().cycle().take(2000).cloned().collect();
        }
    }
    let report = run(&mut unlimited, &large);
    verdicts(&report, &[("add-edge", Verdict::Timeout), ("remove-edge", Verdict::Timeout)]);
    let report = run(&mut program(&["grandchild", "3"]), &two());
    assert!(
        report.results.iter().all(|result| matches!(result.verdict, Verdict::Timeout | Verdict::Crash)),
        "{report:#?}"
    );
    assert!(started.elapsed() < Duration::from_secs(20), "{:?}", started.elapsed());
}

fn failures(report: &Report) -> Vec<&str> {
    assert!(report.results.iter().all(|result| matches!(result.verdict, Verdict::Pass | Verdict::Fail)));
    let failed = report.results.iter().filter(|result| result.verdict == Verdict::Fail);
    failed.map(|result| result.id.as_str()).collect()
}

/// `[spec: CONF-12]`
#[test]
fn canary_an_adapter_that_closes_its_output_and_lives_on_has_crashed() {
    let command = ["sh", "-c", "exec 1>&-; sleep 600"].map(String::from).to_vec();
    let limits = ChildLimits { reply: Duration::from_secs(60), ..ChildLimits::default() };
    let started = Instant::now();
    let report = run(&mut Program { command, limits }, &two());
    verdicts(&report, &[("add-edge", Verdict::Crash), ("remove-edge", Verdict::Crash)]);
    assert!(report.results[0].failure.what.contains("its output is closed"), "{report:#?}");
    assert!(started.elapsed() < Duration::from_secs(30));
}
