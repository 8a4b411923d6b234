//! What is around a run: logs, expectations, reports, explanations, the corpus's form.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on says where")]

mod common;

use common::{Run, dsr};
use std::path::PathBuf;

const DSR: &str = env!("CARGO_BIN_EXE_dsr");
const TWICE: &str = "universal/delivery/twice";

/// A folder of a test's own, empty.
fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("conform-{name}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn text(path: &std::path::Path) -> String {
    std::fs::read_to_string(path).unwrap()
}

/// Runs the core's cases of deliveries with more arguments.
fn run(more: &[&str]) -> Run {
    let mut arguments = vec!["conform", "run", "--only", "universal/delivery/*"];
    arguments.extend(more);
    arguments.extend(["--", DSR, "conform", "adapter"]);
    dsr(&arguments)
}

/// `[spec: CONF-13]` `[spec: CONF-16]` `[spec: CONF-17]`
#[test]
fn law_a_log_becomes_every_report_and_can_be_compared() {
    let folder = folder("log");
    let path = folder.join("a.ndjson");
    let log = path.to_str().unwrap();
    assert_eq!(run(&["--log", log]).status, 0);
    for (to, piece) in [
        ("html", "<!doctype html>"),
        ("junit", "<testsuites name=\"dsr conform\">"),
        ("markdown", "| family | dsr-core 0.1.0 |"),
        ("badge", "\"color\":\"brightgreen\""),
    ] {
        let report = dsr(&["conform", "report", log, "--to", to]);
        assert_eq!((report.status, report.err.as_str()), (0, ""), "{to}");
        assert!(report.out.contains(piece), "{to}: {}", report.out);
    }
    assert_eq!(dsr(&["conform", "report", log, log, "--to", "badge"]).status, 3);
    let same = dsr(&["conform", "compare", log, log]);
    assert_eq!((same.status, same.out.starts_with("0 worse, 0 better")), (0, true), "{same:?}");
    let other = folder.join("b.ndjson");
    std::fs::write(&other, text(&path).replacen("\"verdict\":\"pass\"", "\"verdict\":\"skip\"", 1)).unwrap();
    let incomplete = dsr(&["conform", "compare", log, other.to_str().unwrap()]);
    assert_eq!(incomplete.status, 2, "{incomplete:?}");
    let repaired = text(&other).replace("\"pass\":", "\"PASS\":").replace("\"skip\":0", "\"skip\":1");
    let count: usize =
        repaired.split("\"PASS\":").nth(1).unwrap().split(',').next().unwrap().parse().unwrap();
    let repaired = repaired.replace(&format!("\"PASS\":{count}"), &format!("\"pass\":{}", count - 1));
    std::fs::write(&other, repaired).unwrap();
    let worse = dsr(&["conform", "compare", log, other.to_str().unwrap()]);
    assert_eq!((worse.status, worse.err.as_str()), (1, ""), "{worse:?}");
    assert!(worse.out.contains("worse  universal/delivery/"), "{worse:?}");
    assert_eq!(dsr(&["conform", "compare", other.to_str().unwrap(), log]).status, 0);
    let cut = folder.join("cut.ndjson");
    let whole = text(&path);
    std::fs::write(&cut, &whole[..whole.len() - 30]).unwrap();
    let report = dsr(&["conform", "report", cut.to_str().unwrap(), "--to", "markdown"]);
    assert_eq!(report.status, 2);
    assert!(report.err.contains("incomplete: its last line is cut off"), "{report:?}");
    let replayed = dsr(&["conform", "replay", TWICE, "--log", log]);
    assert_eq!(replayed.status, 0, "{replayed:?}");
}

/// `[spec: CONF-14]`
#[test]
fn law_expectations_are_written_refused_without_reason_and_kept() {
    let folder = folder("expect");
    let path = folder.join("e.json");
    let file = path.to_str().unwrap();
    let entry = |case: &str, reason: &str| {
        let entry = format!(r#"{{"case": "{case}", "verdict": "fail", "reason": "{reason}"}}"#);
        std::fs::write(&path, format!(r#"{{"implementation": "dsr-core", "expected": [{entry}]}}"#)).unwrap();
    };
    entry(TWICE, "");
    let refused = run(&["--expect", file]);
    assert_eq!(refused.status, 3, "{refused:?}");
    assert!(refused.err.contains("has no `reason`; write why"), "{refused:?}");
    assert_eq!(dsr(&["conform", "expect", "--check", file]).status, 3);
    entry(TWICE, "once");
    assert_eq!(dsr(&["conform", "expect", "--check", file]).status, 0);
    let passes = run(&["--expect", file]);
    assert_eq!(passes.status, 1, "{passes:?}");
    assert!(passes.out.contains("not as expected: universal/delivery/twice passes"), "{passes:?}");
    let json = run(&["--expect", file, "--format", "json"]);
    assert!(json.status == 1 && json.out.starts_with("{\"verdict\":\"unexpected\""), "{json:?}");
    entry("universal/nowhere/*", "once");
    let nothing = run(&["--expect", file]);
    assert_eq!(nothing.status, 1, "{nothing:?}");
    assert!(nothing.out.contains("matches no case of the corpus"), "{nothing:?}");
    let only = ["conform", "expect", "--update", "--to", file, "--only", "universal/delivery/*", "--"];
    let updated = dsr(&[&only[..], &[DSR, "conform", "adapter"]].concat());
    assert_eq!((updated.status, updated.err.as_str()), (0, ""), "{updated:?}");
    assert!(text(&path).contains("\"expected\": []"), "{}", text(&path));
    assert_eq!(run(&["--expect", file]).status, 0);
    std::fs::write(&path, r#"{"implementation": "other", "expected": []}"#).unwrap();
    let other = run(&["--expect", file]);
    assert_eq!(other.status, 3, "{other:?}");
    assert_eq!(dsr(&["conform", "expect", "--update", "--to", file, "--", DSR, "--version"]).status, 3);
    assert_eq!(dsr(&["conform", "expect"]).status, 3);
}

/// `[spec: CONF-16]`
#[test]
fn law_a_case_is_explained_drawn_and_replayed() {
    let explained = dsr(&["conform", "explain", TWICE]);
    assert_eq!((explained.status, explained.err.as_str()), (0, ""));
    for piece in [TWICE, "level must", "●", "▶◆", "a reply to `read`", "spec/", "**JOIN-"] {
        assert!(explained.out.contains(piece), "{piece}: {}", explained.out);
    }
    assert!(dsr(&["conform", "explain", TWICE, "--to", "mermaid"]).out.starts_with("sequenceDiagram\n"));
    let json: serde_json::Value =
        serde_json::from_str(&dsr(&["conform", "explain", TWICE, "--to", "json"]).out).unwrap();
    assert_eq!(json["id"], TWICE);
    let unknown = dsr(&["conform", "explain", "universal/delivery/twise"]);
    assert_eq!(unknown.status, 3);
    assert!(unknown.err.contains("did you mean \"universal/delivery/twice\""), "{unknown:?}");
    let replayed = dsr(&["conform", "replay", TWICE, "--", DSR, "conform", "adapter"]);
    assert_eq!((replayed.status, replayed.err.as_str()), (0, ""));
    for piece in
        ["  → {\"id\":1,\"do\":{\"hello\"", "  ← {\"id\":1,\"ok\"", "step 1: ", "  as expected\n", "\npass\n"]
    {
        assert!(replayed.out.contains(piece), "{piece}: {}", replayed.out);
    }
    assert_eq!(dsr(&["conform", "replay", TWICE]).status, 3);
}

#[test]
fn law_a_first_look_tells_a_broken_adapter_from_a_sound_one() {
    let sound = dsr(&["conform", "smoke", "--", DSR, "conform", "adapter"]);
    assert_eq!((sound.status, sound.err.as_str()), (0, ""), "{sound:?}");
    for piece in
        ["start: ", "handshake: dsr-core", "announced: profiles observe", "first mutation", "first delivery"]
    {
        assert!(sound.out.contains(piece), "{piece}: {}", sound.out);
    }
    assert!(sound.out.ends_with("go on with `dsr conform run`\n"), "{sound:?}");
    let broken = dsr(&["conform", "smoke", "--", DSR, "--version"]);
    assert_eq!(broken.status, 1, "{broken:?}");
    assert!(
        broken.out.contains("  request: {\"id\":1,") && broken.out.contains("  reply:   dsr 0.1.0"),
        "{broken:?}"
    );
    assert!(broken.out.ends_with("nothing is known of the implementation\n"), "{broken:?}");
}

#[test]
fn law_lists_are_chosen_by_clause_and_profile() {
    let json = dsr(&["conform", "list", "--clause", "JOIN-3", "--format", "json"]);
    let listed: Vec<serde_json::Value> = serde_json::from_str(&json.out).unwrap();
    assert!(!listed.is_empty());
    assert!(listed.iter().all(|case| case["clauses"].as_array().unwrap().contains(&"JOIN-3".into())));
    assert!(dsr(&["conform", "list", "--clause", "JOIN-999"]).err.contains("there is no clause"));
    let observe = dsr(&["conform", "list", "--profile", "observe"]).out;
    assert!(
        !observe.contains("wire/") && dsr(&["conform", "list", "--profile", "wire"]).out.contains("wire/")
    );
}

/// `[spec: CONF-15]`
#[test]
fn law_the_corpus_is_validated_and_repaired() {
    let whole = dsr(&["conform", "validate"]);
    assert_eq!((whole.status, whole.err.as_str()), (0, ""), "{whole:?}");
    let folder = folder("validate").join("universal");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("delivery.json");
    let source = concat!(env!("CARGO_MANIFEST_DIR"), "/../conformance/corpus/v1/universal/delivery.json");
    let sound = text(source.as_ref());
    std::fs::write(&path, sound.replace("  ", " ")).unwrap();
    let file = path.to_str().unwrap();
    let loose = dsr(&["conform", "validate", file]);
    assert_eq!(loose.status, 1);
    assert!(loose.err.contains("not in canonical form; run `dsr conform validate --fix`"), "{loose:?}");
    assert_eq!(dsr(&["conform", "validate", "--fix", file]).status, 0);
    assert_eq!(text(&path), sound);
    assert_eq!(dsr(&["conform", "validate", "/no/such/file.json"]).status, 3);
}

#[test]
fn law_wrong_usage_is_told_with_status_3() {
    for arguments in [
        &["conform", "run"][..],
        &["conform", "smoke"],
        &["conform", "explain"],
        &["conform", "report", "/no/such/log", "--to", "html"],
        &["conform", "report", "Cargo.toml", "--to", "html"],
        &["conform", "compare", "/no/such/log", "/no/such/log"],
        &["conform", "run", "--log", "/no/such/folder/log", "--", "true"],
        &["conform", "run", "--profile", "deep", "--", "true"],
    ] {
        let run = dsr(arguments);
        assert!(run.status == 3 && !run.err.is_empty(), "{arguments:?}: {run:?}");
    }
    for command in ["run", "smoke", "list", "explain", "replay", "expect", "report", "compare", "validate"] {
        let help = dsr(&["conform", command, "--help"]);
        assert!(help.status == 0 && help.out.contains("Examples:\n  dsr conform"), "{command}: {help:?}");
    }
}
