//! `dsr replay` as users run it.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

mod common;

use common::dsr;
use std::path::PathBuf;

/// A folder of its own with the traces of one row.
fn gallery(test: &str, row: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    let run = dsr(&["gallery", "--row", row, "--traces", folder.to_str().unwrap()]);
    assert_eq!(run.status, 0, "{run:?}");
    folder
}

#[test]
fn law_what_was_written_comes_out_again() {
    let folder = gallery("replayed", "15");
    let files = ["row-15.trace.json", "row-15.checked.trace.json"].map(|file| folder.join(file));
    let run = dsr(&["replay", files[0].to_str().unwrap(), files[1].to_str().unwrap()]);
    assert_eq!((run.status, run.err.as_str()), (0, ""), "{run:?}");
    assert_eq!(run.out.lines().count(), 2);
    assert!(run.out.contains("8 steps came out as written; ✗ [JOIN-5]"), "{run:?}");
    assert!(run.out.contains("8 steps came out as written; ✓ [JOIN-5]"), "{run:?}");
}

/// `[spec: TRACE-6]`
#[test]
fn canary_a_changed_step_value_or_delivery_is_told_with_its_step() {
    let file = gallery("changed", "15").join("row-15.trace.json");
    let (name, right) = (file.to_str().unwrap(), std::fs::read_to_string(&file).unwrap());
    let told = |wrong: String, what: &[&str]| {
        assert_ne!(wrong, right);
        std::fs::write(&file, wrong).unwrap();
        let run = dsr(&["replay", name]);
        assert_eq!((run.status, run.out.as_str()), (1, ""), "{run:?}");
        assert!(run.err.starts_with(&format!("{name}: ")), "{run:?}");
        assert!(what.iter().all(|piece| run.err.contains(piece)), "{run:?}");
    };
    // The last delivery; a value of the last; the call of the fifth step.
    told(
        right.replacen("\"x\": \"2\"", "\"x\": \"8\"", 1),
        &["step 1 of agent 1", "changes[0]", "\"8\"", "\"2\""],
    );
    let state = right.rfind("\"state\": \"").unwrap() + 10;
    let other = if right[state..].starts_with('0') { "1" } else { "0" };
    told(format!("{}{other}{}", &right[..state], &right[state + 1..]), &["step 8 of agent 3", "state is"]);
    let mut trace: serde_json::Value = serde_json::from_str(&right).unwrap();
    trace["steps"].as_array_mut().unwrap().remove(2);
    told(trace.to_string(), &["step 6 cannot happen: agent 3", "what can happen is"]);
}

#[test]
fn law_what_cannot_be_read_or_run_is_wrong_usage() {
    let file = gallery("unknown", "2").join("row-2.trace.json");
    let name = file.to_str().unwrap();
    let text = std::fs::read_to_string(&file).unwrap().replace("\"published\"", "\"mine\"");
    std::fs::write(&file, text).unwrap();
    let run = dsr(&["replay", name]);
    assert_eq!((run.status, run.out.as_str()), (3, ""));
    assert!(run.err.contains("no semantics is named \"mine\"") && run.err.contains("replay_with"), "{run:?}");
    assert_eq!(dsr(&["replay", "none.json"]).status, 3);
    assert_eq!(dsr(&["replay"]).status, 3);
}
