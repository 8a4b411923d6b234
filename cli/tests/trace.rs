//! `dsr trace` as users run it: exit statuses and texts.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that cannot go on says where"
)]

mod common;

use common::dsr;
use dsr_core::MutationKind;
use dsr_model::alarms::{self, A, B};
use dsr_model::histories::{Bound, HistoryRun};
use dsr_model::progress::{Limits, Progress};
use std::path::PathBuf;
use std::sync::Arc;

/// A counterexample as `dsr check` writes it, from a core broken on purpose.
fn counterexample() -> String {
    let alarm = alarms::all().into_iter().find(|alarm| alarm.name == "last-delivered-wins").unwrap();
    let run = HistoryRun {
        name: alarm.name.into(),
        semantics: Arc::new(alarm.core(&MutationKind::ALL, &[A, B])),
        focus: 2,
        bound: Bound { replicas: 2, mutations: 1 },
        symmetry: false,
        second_engine: false,
    };
    let report = run.run(&Arc::new(Progress::new(Limits::default())));
    serde_json::to_string_pretty(&report.traces.first().unwrap().json).unwrap()
}

/// A path in an empty folder of this test's own.
fn path(test: &str, file: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder.join(file)
}

#[track_caller]
fn refused(test: &str, content: &str, told: &[&str]) {
    let file = path(test, "bad.trace.json");
    std::fs::write(&file, content).unwrap();
    let name = file.to_str().unwrap();
    let run = dsr(&["trace", name]);
    assert_eq!((run.status, run.out.as_str()), (3, ""), "{run:?}");
    assert!(run.err.starts_with(&format!("{name}: ")) && run.err.contains("\n  remedy: "), "{run:?}");
    for piece in told {
        assert!(run.err.contains(piece), "{piece}\n{}", run.err);
    }
}

#[test]
fn law_a_counterexample_is_drawn_as_each_target() {
    let file = path("drawn", "good.trace.json");
    std::fs::write(&file, counterexample()).unwrap();
    let name = file.to_str().unwrap();
    let text = dsr(&["trace", name]);
    assert_eq!((text.status, text.err.as_str()), (0, ""));
    assert!(text.out.starts_with("JOIN-3 is broken: "), "{}", text.out);
    assert!(text.out.contains("observer 2") && text.out.contains("✗"), "{}", text.out);
    assert_eq!(dsr(&["trace", name, "--to", "text"]).out, text.out);
    for (target, start, piece) in [
        ("mermaid", "sequenceDiagram\n", "->>"),
        ("svg", "<svg ", "</svg>\n"),
        ("html", "<!doctype html>\n", "JOIN-3"),
        ("shiviz", "step 1: ", "observer_2 {\"r1\": 1, \"r2\": 1, \"observer_2\": 2}\n"),
    ] {
        let run = dsr(&["trace", name, "--to", target]);
        assert_eq!((run.status, run.err.as_str()), (0, ""), "{target}");
        assert!(run.out.starts_with(start) && run.out.contains(piece), "{target}\n{}", run.out);
    }
}

#[test]
fn law_output_goes_to_a_file_or_is_told_why_not() {
    let file = path("output", "good.trace.json");
    std::fs::write(&file, counterexample()).unwrap();
    let (name, drawing) = (file.to_str().unwrap(), file.with_file_name("drawing.svg"));
    let run = dsr(&["trace", name, "--to", "svg", "--output", drawing.to_str().unwrap()]);
    assert_eq!((run.status, run.out.as_str(), run.err.as_str()), (0, "", ""));
    assert_eq!(std::fs::read_to_string(&drawing).unwrap(), dsr(&["trace", name, "--to", "svg"]).out);
    let nowhere = file.with_file_name("none").join("drawing.svg");
    let run = dsr(&["trace", name, "--output", nowhere.to_str().unwrap()]);
    assert_eq!((run.status, run.out.as_str()), (3, ""));
    assert!(run.err.contains("drawing.svg: cannot write: ") && run.err.contains("remedy"), "{run:?}");
}

#[test]
fn law_what_is_no_file_or_no_json_is_told_with_its_place() {
    let missing = path("missing", "none.json");
    let name = missing.to_str().unwrap();
    let run = dsr(&["trace", name]);
    assert_eq!((run.status, run.out.as_str()), (3, ""));
    assert!(run.err.starts_with(&format!("{name}: cannot read: ")), "{run:?}");
    assert!(run.err.contains("remedy: check the path"), "{run:?}");
    refused("syntax", "{\n  \"format\" 7\n}", &["line 2, column 12: not JSON: expected `:`"]);
    refused("empty", "", &["line 1, column 0: not JSON: EOF"]);
    let cut = counterexample();
    refused("cut", &cut[..cut.len() / 2], &["not JSON: ", "check that the file is complete"]);
}

/// `[spec: TRACE-3]`
#[test]
fn law_another_format_version_or_form_is_told_with_what_was_found() {
    let scenario = r#"{"mutations": 0, "steps": []}"#;
    refused(
        "scenario",
        scenario,
        &["found no `format`, expected \"dsr-trace\"", "L0 finds states, not runs"],
    );
    refused("format", r#"{"format": "other"}"#, &["found the format \"other\", expected \"dsr-trace\""]);
    let newer = counterexample().replace("\"version\": 2", "\"version\": 3");
    refused("version", &newer, &["found version 3 of the trace format, only version 2 is understood"]);
    refused("none", r#"{"format": "dsr-trace"}"#, &["found version none"]);
    refused(
        "form",
        r#"{"format": "dsr-trace", "version": 2}"#,
        &["line 1, column 37: not the form of a trace"],
    );
}

/// `[spec: TRACE-3]`
#[test]
fn law_a_message_that_nobody_sent_is_told_with_its_step() {
    let torn = counterexample().replacen("\"message\": \"m1\"", "\"message\": \"m7\"", 1);
    refused("torn", &torn, &["speaks of the message \"m1\", which no step before it sends", "step 4"]);
}

#[test]
fn law_help_names_targets_remedies_and_statuses() {
    let run = dsr(&["trace", "--help"]);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    for piece in
        ["mermaid", "shiviz", "(?<host>\\S*)", "Exit status: 0 printed, 3 otherwise", "--output <FILE>"]
    {
        assert!(run.out.contains(piece), "{piece}\n{}", run.out);
    }
    assert_eq!(dsr(&["trace", "x", "--to", "pdf"]).status, 3);
}
