//! `dsr conform` as users run it.

mod common;

use common::{dsr, dsr_with};

const DSR: &str = env!("CARGO_BIN_EXE_dsr");

/// `[spec: CONF-10]` `[spec: CONF-18]`
#[test]
fn law_the_core_passes_in_both_ways() {
    let run = dsr(&["conform", "--format", "json"]);
    assert_eq!((run.status, run.err.as_str()), (0, ""), "{run:?}");
    assert_eq!(run.out.lines().count(), 1);
    let summary: serde_json::Value = serde_json::from_str(&run.out).unwrap();
    for key in ["verdict", "protocol", "corpus", "spec", "implementation", "counts", "families"] {
        assert!(!summary[key].is_null(), "{key}: {run:?}");
    }
    assert_eq!(summary["verdict"], "expected");
    assert_eq!(summary["implementation"]["name"], "dsr-core");
    let runs = summary["runs"].as_array().unwrap();
    assert_eq!([&runs[0]["transport"], &runs[1]["transport"]], ["in-process", "stdio"]);
    assert_eq!([&runs[0]["counts"], &runs[1]["counts"]], [&summary["counts"], &summary["counts"]]);
    let listed = dsr(&["conform", "list"]).out.lines().count();
    assert_eq!(summary["counts"]["pass"], listed);
}

#[test]
fn law_cases_are_chosen_by_a_pattern() {
    let run = dsr(&["conform", "run", "--only", "universal/delivery/*", "--", DSR, "conform", "adapter"]);
    assert_eq!((run.status, run.err.as_str()), (0, ""), "{run:?}");
    let listed = dsr(&["conform", "list", "--only", "universal/delivery/*"]).out.lines().count();
    assert!(run.out.ends_with(&format!("(\"dsr-core\" \"0.1.0\"): {listed} pass\n")), "{run:?}");
    let none = dsr(&["conform", "list", "--only", "delivery"]);
    assert_eq!(none.status, 3, "{none:?}");
    assert!(none.err.contains("no case matches \"delivery\""), "{none:?}");
}

/// `[spec: CONF-10]`
#[test]
fn canary_what_is_no_adapter_fails_with_its_verdict() {
    let run = dsr(&["conform", "run", "--", DSR, "--version"]);
    assert_eq!(run.status, 1, "{run:?}");
    assert!(run.out.starts_with("protocol_error "), "{run:?}");
    assert!(run.out.contains("\n  replay: dsr conform replay "), "{run:?}");
    assert!(run.out.contains("it never said what it is): 3 protocol_error, "), "{run:?}");
    assert!(run.out.ends_with(" not run\n"), "{run:?}");
    assert_eq!(dsr(&["conform", "run"]).status, 3);
}

/// `[spec: CONF-1]` `[spec: CONF-2]`
#[test]
fn law_the_adapter_answers_line_by_line_and_ends_with_its_input() {
    let input = concat!(
        r#"{"id":1,"do":{"hello":{"protocols":[1],"spec":"0.1","corpus":"1.0.0"}}}"#,
        "\n",
        r#"{"id":2,"do":{"fly":{}}}"#,
        "\n",
        r#"{"id":3,"do":{"case_begin":{"case":"c","replicas":["a"]}}}"#,
        "\n",
        r#"{"id":4,"do":{"read":{"replica":"b"}}}"#,
        "\n",
        r#"{"id":5,"do":{"read":{"replica":"a"}}}"#,
        "\n",
    );
    let run = dsr_with(&["conform", "adapter"], input.as_bytes());
    assert_eq!((run.status, run.err.as_str()), (0, ""), "{run:?}");
    let replies: Vec<&str> = run.out.lines().collect();
    assert!(replies[0].starts_with(r#"{"id":1,"ok":{"protocol":1,"#), "{run:?}");
    assert!(replies[1].starts_with(r#"{"id":2,"error":{"code":"rejected_input","#), "{run:?}");
    assert_eq!(replies[2], r#"{"id":3,"ok":{}}"#);
    assert!(replies[3].starts_with(r#"{"id":4,"error":{"code":"unknown","#), "{run:?}");
    assert_eq!(replies[4], r#"{"id":5,"ok":{"view":{"vertices":{},"edges":[],"root":{},"repairs":[]}}}"#);
    let garbage = dsr_with(&["conform", "adapter"], b"hello\n");
    assert_eq!((garbage.status, garbage.out.as_str()), (3, ""));
    assert!(garbage.err.contains("line 1 is no request"), "{garbage:?}");
}

/// `[spec: CONF-19]`
#[test]
fn conform_the_score_is_full_and_both_forms_say_so() {
    let run = dsr(&["conform", "score"]);
    assert_eq!(run.status, 0, "{run:?}");
    assert!(run.out.lines().last().unwrap().starts_with("31 of 31 found by "), "{run:?}");
    assert!(run.out.ends_with(": 100 %\n"), "{run:?}");
    let run = dsr(&["conform", "score", "--format", "json"]);
    let scores: serde_json::Value = serde_json::from_str(&run.out).unwrap();
    assert_eq!((run.status, &scores["found"]), (0, &serde_json::json!(31)));
    assert_eq!(scores["cores"].as_array().unwrap().len(), 31);
}
