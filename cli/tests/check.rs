//! `dsr check`: exit statuses, the JSON that scripts read, and what wrong usage is told.

#![expect(clippy::expect_used, reason = "helpers of tests: what they expect is what they test")]

use serde_json::Value;
use std::process::{Command, Output};

/// What `dsr` does with some arguments, in an empty directory.
fn dsr(arguments: &[&str]) -> Output {
    let directory = std::env::temp_dir().join(format!("dsr-check-{}", std::process::id()));
    std::fs::create_dir_all(&directory).expect("a directory for traces");
    let mut command = Command::new(env!("CARGO_BIN_EXE_dsr"));
    command.args(arguments).current_dir(directory).output().expect("the program runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[track_caller]
fn refused(arguments: &[&str], says: &[&str]) {
    let output = dsr(arguments);
    let errors = text(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{errors}");
    for part in says {
        assert!(errors.contains(part), "{part:?} is not in: {errors}");
    }
}

#[test]
fn a_scene_is_checked_exhaustively() {
    let output = dsr(&["check", "@tiny", "--focus", "robot,cup", "--format", "json"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(report["verdict"], "exhaustive");
    let run = &report["runs"][0];
    for key in ["name", "layer", "semantics", "replicas", "mutations", "states", "seconds", "properties"] {
        assert!(!run[key].is_null(), "{key} is missing");
    }
    assert_eq!((run["replicas"].as_u64(), run["mutations"].as_u64()), (Some(2), Some(1)));
    assert!(run["states"]["unique"].as_u64() > Some(10) && run["states"]["generated"].as_u64() > Some(10));
    let properties = run["properties"].as_array().expect("a list");
    let kinds: Vec<&str> = properties.iter().filter_map(|property| property["kind"].as_str()).collect();
    assert!(kinds.contains(&"always") && kinds.contains(&"sometimes"));
    assert!(
        properties.iter().all(|property| property["verdict"] == "exhaustive" && property["trace"].is_null())
    );
}

/// `[spec: TRACE-5]`
#[test]
fn a_result_has_a_page_also_where_all_holds() {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("result.html");
    let name = path.to_str().expect("a path in UTF-8");
    let output = dsr(&["check", "@tiny", "--focus", "robot,cup", "--report", name]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let page = std::fs::read_to_string(&path).expect("it was written");
    assert!(page.contains("\"verdict\":\"exhaustive\"") && page.contains("\"assumed\":["));
    refused(
        &["check", "@tiny", "--focus", "robot,cup", "--report", "/no/such/folder/result.html"],
        &["cannot write", "remedy: "],
    );
}

#[test]
fn a_scenario_is_explored() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../model/data/scenarios/two-parents.json");
    let output = dsr(&["check", file]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("verdict: exhaustive"));
}

/// A sample shows less than a search, and says so; a seed says what it was. `[spec: CHECK-13]`
#[test]
fn random_walks_are_bounded_and_told_by_their_seed() {
    let walks = |seed: &str| {
        let output = dsr(&["check", "--layer", "walks", "--walks", "3", "--seed", seed, "--format", "json"]);
        assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
        let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(report["verdict"], "bounded");
        let runs = report["runs"].as_array().expect("a list").clone();
        assert!(!runs.is_empty() && runs.iter().all(|run| run["layer"] == "L3"));
        runs.iter().map(|run| (run["states"].clone(), run["notes"].clone())).collect::<Vec<_>>()
    };
    let first = walks("9");
    assert!(first[0].1.to_string().contains("seed 9, walks 0 to 2 of 3"), "{}", first[0].1);
    assert_eq!(walks("9"), first);
    assert_ne!(walks("10"), first);
}

#[test]
fn a_run_that_is_cut_short_is_incomplete() {
    let output = dsr(&["check", "@tiny", "--mutations", "2", "--states-max", "20"]);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("before its end"));
}

#[test]
fn a_false_property_is_violated_with_a_trace() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../model/data/scenarios/two-parents.json");
    let scenario = std::fs::read_to_string(file).expect("a shipped scenario");
    let mut scenario: Value = serde_json::from_str(&scenario).expect("JSON");
    let wrong = serde_json::json!({ "name": "no table", "why": "a false claim", "always": { "not": { "vertex": { "name": "dining_table" } } } });
    scenario["properties"].as_array_mut().expect("a list").push(wrong);
    let path = std::env::temp_dir().join(format!("dsr-false-{}.json", std::process::id()));
    std::fs::write(&path, scenario.to_string()).expect("a scenario of our own");
    let output = dsr(&["check", &path.display().to_string(), "--format", "json"]);
    let report: Value =
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", text(&output.stderr)));
    assert_eq!(output.status.code(), Some(1), "{report}");
    assert_eq!(report["verdict"], "violated");
    let properties = report["runs"][0]["properties"].as_array().expect("a list");
    let broken = properties.iter().find(|property| property["clause"] == "no table").expect("the property");
    assert_eq!(broken["verdict"], "violated");
    assert!(broken["trace"].as_str().is_some_and(|trace| trace.ends_with(".trace.json")));
}

#[test]
fn wrong_usage_and_input_say_what_to_do() {
    refused(&["check", "no-such-file.json"], &["no-such-file.json", "check the path"]);
    refused(&["check", "@tiny", "--focus", "robto"], &["robto", "robot"]);
    refused(&["check", "@tiny", "--focus", "robot,robot"], &["twice"]);
    refused(&["check", "@tiny", "--alphabet", "fly"], &["add_vertex", "remove_vertex"]);
    refused(&["check", "@tiny", "--replicas", "9"], &["--replicas"]);
    refused(&["check", "--focus", "robot"], &["@flat"]);
    refused(&["check", "@nowhere"], &["@flat or @tiny"]);
    refused(&["check", "--layer", "L9"], &["l0, l1, l2, walks, scenario"]);
}

/// `[spec: CHECK-12]`
#[test]
fn the_published_semantics_is_violated_clause_by_clause() {
    let output = dsr(&["check", "--semantics", "published", "--layer", "l1", "--format", "json"]);
    let report: Value =
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", text(&output.stderr)));
    assert_eq!(output.status.code(), Some(1));
    let runs = report["runs"].as_array().expect("a list");
    let count = |verdict: &str| runs.iter().filter(|run| run["verdict"] == verdict).count();
    assert_eq!((runs.len(), count("violated"), count("exhaustive")), (25, 23, 2));
    assert!(runs.iter().all(|run| run["semantics"] == "published (upstream, agent 0 in all that is new)"));
    let skipped = report["not_applicable"].as_array().expect("a list");
    assert!(skipped.iter().any(|line| line.as_str().is_some_and(|line| line.starts_with("L0: "))));
    let alone = &runs[0];
    assert_eq!(alone["name"], "JOIN-3 alone, 2 × 1");
    let trace = alone["properties"][0]["trace"].as_str().expect("a file");
    let shown = dsr(&["trace", trace]);
    assert!(shown.status.success(), "{}", text(&shown.stderr));
    assert!(text(&shown.stdout).contains("finds #"), "{}", text(&shown.stdout));
}

#[test]
fn the_checked_semantics_has_nothing_that_does_not_apply() {
    let output = dsr(&["check", "@tiny", "--semantics", "checked", "--format", "json"]);
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(report["not_applicable"].as_array().map(Vec::len), Some(0));
}

#[test]
fn flags_of_the_published_semantics_need_it() {
    refused(&["check", "--variant", "fork"], &["add --semantics published"]);
    refused(&["check", "--agent-id", "zero", "@tiny"], &["add --semantics published"]);
    refused(&["check", "--semantics", "published", "@tiny"], &["leave out FILE"]);
    refused(&["check", "--semantics", "published", "--deep"], &["leave out --deep"]);
    refused(&["check", "--semantics", "published", "--layer", "l0"], &["contexts and records", "l1,l2"]);
    refused(
        &["check", "--semantics", "published", "--layer", "l1,scenario"],
        &["mutations of the checked", "l1,l2"],
    );
    refused(&["check", "--semantics", "mine"], &["checked, published"]);
}
