//! A library in JavaScript against the cases, and its failures against those that are explained.

mod common;

use common::dsr;
use std::collections::BTreeSet;
use std::path::Path;

/// The verdicts other than a pass: the verdict and the id of the case.
fn verdicts(text: &str) -> BTreeSet<(String, String)> {
    let known = ["fail", "error", "crash", "timeout", "protocol_error", "skip"];
    let lines = text.lines().filter_map(|line| {
        let mut words = line.split(' ');
        let (verdict, id) = (words.next()?, words.next()?);
        known.contains(&verdict).then(|| (verdict.to_owned(), id.to_owned()))
    });
    lines.collect()
}

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
    let run = dsr(&["conform", "run", "--", "node", &format!("{folder}/adapter.js")]);
    assert_eq!(run.err, "", "{run:?}");
    let text = include_str!("../../peers-js/expected.json");
    let file: serde_json::Value = serde_json::from_str(text).unwrap();
    let expected: Vec<(&str, &str)> = file["expected"].as_array().unwrap().iter().map(pair).collect();
    let found = verdicts(&run.out);
    assert_eq!(disagreements(&found, &expected), Vec::<String>::new(), "{}", run.out);
    assert!(run.out.contains("(\"delta-crdts\" \"0.10.3\"): "), "{run:?}");
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
    let found = verdicts("fail universal/a/b [X-1]\n    step 1\nunsupported wire/a/b [X-1]\n");
    assert_eq!(found.len(), 1);
    assert_eq!(disagreements(&found, &[("fail", "universal/a/*")]), Vec::<String>::new());
    assert_eq!(disagreements(&found, &[]), ["fail universal/a/b is not explained"]);
    assert_eq!(disagreements(&found, &[("crash", "universal/a/b")]).len(), 2);
}

fn pair(entry: &serde_json::Value) -> (&str, &str) {
    assert!(entry["reason"].as_str().is_some_and(|reason| reason.len() > 40), "{entry} explains nothing");
    let text = |member: &str| entry[member].as_str().unwrap_or_default();
    (text("verdict"), text("case"))
}
