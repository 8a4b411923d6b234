//! A library in JavaScript against the cases, and its failures against those that are explained.

mod common;

use common::dsr;
use std::collections::BTreeSet;
use std::path::Path;

/// `[spec: CONF-9]`
#[test]
fn conform_delta_crdts_fails_as_explained() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../peers-js");
    let has_node = std::process::Command::new("node").arg("--version").output().is_ok();
    if !has_node || !Path::new(folder).join("node_modules").is_dir() {
        let required = std::env::var("DSR_TOOLCHAINS").is_ok_and(|value| value == "required");
        assert!(!required, "node is missing, or `npm ci` has not been run in peers-js");
        println!("skipped: node is missing, or `npm ci` has not been run in peers-js");
        return;
    }
    let log = std::env::temp_dir().join(format!("dsr-peers-js-{}.ndjson", std::process::id()));
    let adapter = format!("{folder}/adapter.js");
    let run = dsr(&["conform", "run", "--log", &log.to_string_lossy(), "--", "node", &adapter]);
    assert_eq!(run.err, "", "{run:?}");
    assert!(run.out.contains("(\"delta-crdts\" \"0.10.3\"): "), "{run:?}");
    let lines = dsr_conformance::log::read("log", &std::fs::read(&log).unwrap()).unwrap().cases;
    std::fs::remove_file(log).unwrap();
    let (of_the_model, others): (Vec<_>, Vec<_>) = lines
        .into_iter()
        .partition(|line| line.id.split('/').nth(1).is_some_and(|topic| topic.starts_with("model-")));
    let text = include_str!("../../peers-js/expected.json");
    let file: serde_json::Value = serde_json::from_str(text).unwrap();
    let expected: Vec<(&str, &str)> = file["expected"].as_array().unwrap().iter().map(pair).collect();
    let bad = others.iter().filter(|line| line.verdict.is_bad());
    let found = bad.map(|line| (line.verdict.name().to_owned(), line.id.clone())).collect();
    assert_eq!(disagreements(&found, &expected), Vec::<String>::new(), "{}", run.out);
    // Of the hundreds of the model no list has the reasons: what any sound implementation passes fails by cycles alone.
    for line in of_the_model.iter().filter(|line| line.verdict.is_bad()) {
        let by_a_cycle = line.broken.as_deref() == Some("INV-3");
        assert!(line.verdict.name() == "fail" && (line.family() == "resolution" || by_a_cycle), "{line:#?}");
    }
}

/// What is found and not explained, and what is explained and not found.
fn disagreements(found: &BTreeSet<(String, String)>, expected: &[(&str, &str)]) -> Vec<String> {
    let agree = |(found, id): &(String, String), (verdict, glob): &(&str, &str)| {
        found == verdict && dsr_conformance::corpus::matches(glob, id)
    };
    let unexplained = found.iter().filter(|one| !expected.iter().any(|entry| agree(one, entry)));
    let stale = expected.iter().filter(|entry| !found.iter().any(|one| agree(one, entry)));
    let unexplained = unexplained.map(|(verdict, id)| format!("{verdict} {id} is not explained"));
    unexplained.chain(stale.map(|(verdict, glob)| format!("nothing is a {verdict} for {glob:?}"))).collect()
}

#[test]
fn canary_what_is_not_explained_and_what_is_stale_are_told() {
    let found = BTreeSet::from([("fail".to_owned(), "universal/a/b".to_owned())]);
    assert_eq!(disagreements(&found, &[("fail", "universal/a/*")]), Vec::<String>::new());
    assert_eq!(disagreements(&found, &[]), ["fail universal/a/b is not explained"]);
    assert_eq!(disagreements(&found, &[("crash", "universal/a/b")]).len(), 2);
}

fn pair(entry: &serde_json::Value) -> (&str, &str) {
    assert!(entry["reason"].as_str().is_some_and(|reason| reason.len() > 40), "{entry} explains nothing");
    let text = |member: &str| entry[member].as_str().unwrap_or_default();
    (text("verdict"), text("case"))
}
