//! `dsr gallery`: exit statuses, the JSON that scripts read, one row.

#![expect(clippy::expect_used, reason = "helpers of tests: what they expect is what they test")]

use serde_json::Value;
use std::process::{Command, Output};

fn dsr(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dsr")).args(arguments).output().expect("the program runs")
}

#[test]
fn every_row_is_found_and_holds_elsewhere() {
    let output = dsr(&["gallery", "--format", "json"]);
    assert_eq!(output.status.code(), Some(0));
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let rows = report["rows"].as_array().expect("a list");
    assert!(rows.len() >= 34);
    for row in rows {
        assert_eq!((&row["found"], &row["checked"]), (&Value::from("search"), &Value::from("holds")));
        for key in ["row", "title", "layer", "bound", "states", "steps", "seconds"] {
            assert!(!row[key].is_null(), "{key} is missing");
        }
    }
}

#[test]
fn one_row_comes_with_its_schedule() {
    let output = dsr(&["gallery", "--row", "2"]);
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("removes #1.x  → m1") && text.contains("✗") && text.contains("[JOIN-5]"), "{text}");
}

#[test]
fn a_row_that_is_none_is_wrong_usage() {
    assert_eq!(dsr(&["gallery", "--row", "99"]).status.code(), Some(3));
}

/// `[spec: TRACE-5]`
#[test]
fn a_row_has_a_page_with_both_runs() {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("row.html");
    let output = dsr(&["gallery", "--row", "22", "--report", path.to_str().expect("a path in UTF-8")]);
    assert_eq!(output.status.code(), Some(0));
    let page = std::fs::read_to_string(&path).expect("it was written");
    assert!(page.len() < 300_000, "{}", page.len());
    for piece in ["\"row\":\"22\"", "\"side\":\"published\"", "\"side\":\"checked\"", "INV-3"] {
        assert!(page.contains(piece), "{piece}");
    }
    let nowhere = dsr(&["gallery", "--row", "22", "--report", "/no/such/folder/row.html"]);
    assert_eq!(nowhere.status.code(), Some(3));
    assert!(String::from_utf8_lossy(&nowhere.stderr).contains("remedy: "));
}
