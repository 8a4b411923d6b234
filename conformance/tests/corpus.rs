//! The corpus is sound, and the core passes it.

use dsr_conformance::adapter::Core;
use dsr_conformance::case::{CaseFile, read};
use dsr_conformance::corpus;
use dsr_conformance::expect::Expectations;
use dsr_conformance::log::Line;
use dsr_conformance::protocol::{Answer, Reply, Request};
use dsr_conformance::report::{Outcome, Summary, Verdict};
use dsr_conformance::run::{InProcess, run};
use std::collections::BTreeSet;
use std::path::Path;

fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// `[spec: CONF-4]` `[spec: CONF-5]` `[spec: CONF-6]` `[spec: CONF-7]` `[spec: CONF-8]`
#[test]
fn conform_the_core_passes_every_case() {
    let cases = corpus::cases().unwrap();
    let report = run(&mut InProcess(Core::default), &cases);
    let bad: Vec<_> = report.results.iter().filter(|result| result.verdict != Verdict::Pass).collect();
    assert!(bad.is_empty(), "{bad:#?}");
    assert_eq!((report.results.len(), report.outcome()), (cases.len(), Outcome::Expected));
}

/// `[spec: CONF-11]`
#[test]
fn law_the_corpus_is_what_is_in_its_folder_and_each_id_is_one() {
    let mut found = BTreeSet::new();
    for family in std::fs::read_dir(folder().join("corpus/v1")).unwrap() {
        let family = family.unwrap();
        if family.file_name() == "choices.json" {
            continue;
        }
        for file in std::fs::read_dir(family.path()).unwrap() {
            let name = file.unwrap().file_name().into_string().unwrap();
            found.insert(format!("{}/{name}", family.file_name().into_string().unwrap()));
        }
    }
    let listed: BTreeSet<String> = corpus::FILES.iter().map(|(path, _)| (*path).into()).collect();
    assert_eq!(found, listed);
    let cases = corpus::cases().unwrap();
    let ids: BTreeSet<&str> = cases.iter().map(|case| case.id.as_str()).collect();
    assert_eq!(ids.len(), cases.len());
    assert!(cases.iter().all(|case| !case.title.is_empty() && !case.why.is_empty()));
}

/// `[spec: CONF-11]`
#[test]
fn law_every_clause_that_a_case_cites_is_one() {
    let inputs = dsr_spec::read_inputs(&folder().join("..")).unwrap();
    let clauses = dsr_spec::trace(&inputs.texts, &[]).clauses;
    for case in corpus::cases().unwrap() {
        for id in &case.spec {
            let found = id.parse().ok().and_then(|id| clauses.get(&id));
            assert!(found.is_some(), "{}: {id} is no clause", case.id);
        }
    }
}

/// Set `DSR_WRITE=1` to write the files anew. `[spec: CONF-2]`
#[test]
fn law_the_schemas_are_those_of_the_types() {
    let schemas = [
        ("request", schemars::schema_for!(Request)),
        ("reply", schemars::schema_for!(Reply<Answer>)),
        ("case", schemars::schema_for!(CaseFile)),
        ("summary", schemars::schema_for!(Summary)),
        ("log", Line::schema()),
        ("expectations", Expectations::schema()),
    ];
    for (name, schema) in schemas {
        let text = serde_json::to_string_pretty(&schema).unwrap() + "\n";
        let file = folder().join(format!("schema/{name}.json"));
        if std::env::var_os("DSR_WRITE").is_some() {
            std::fs::write(&file, &text).unwrap();
        }
        let written = std::fs::read_to_string(&file).unwrap_or_default();
        assert!(written == text, "schema/{name}.json is out of date: run this test with DSR_WRITE=1");
    }
}

#[test]
fn law_patterns_match_whole_ids() {
    for (pattern, id, expected) in [
        ("*", "universal/a/b", true),
        ("universal/*", "universal/a/b", true),
        ("*/b", "universal/a/b", true),
        ("u*/a/*", "universal/a/b", true),
        ("a/b", "a/b", true),
        ("a/b", "a/bc", false),
        ("universal/*/c", "universal/a/b", false),
        ("*a*a", "a", false),
        ("", "a", false),
    ] {
        assert_eq!(corpus::matches(pattern, id), expected, "{pattern} {id}");
    }
}

const SOUND: &str = r#"{
  "format": 1, "family": "universal", "topic": "t",
  "cases": [{
    "id": "universal/t/one",
    "title": "t", "why": "w", "spec": ["MUT-1"], "level": "must", "requires": ["restart"], "replicas": ["a", "b"],
    "steps": [
      {"mutate": {"replica": "a", "mutations": [{"add_vertex": {"as": "v", "type": "t", "name": "n", "link": {"from": "root", "label": "RT"}}}], "as": "d"}},
      {"deliver": {"replica": "b", "delta": "d"}},
      {"restart": {"replica": "b", "keeps": true}},
      {"expect_equal": {"replicas": ["a", "b"]}}
    ],
    "provenance": {"kind": "hand"}
  }]
}"#;

/// `[spec: CONF-11]`
#[test]
fn canary_a_file_with_a_fault_is_refused_with_place_and_remedy() {
    read("universal/t.json", SOUND).unwrap();
    let refused = |old: &str, new: &str, line: usize, pieces: [&str; 2]| {
        let text = SOUND.replacen(old, new, 1);
        assert_ne!(text, SOUND, "{old}");
        let error = read("universal/t.json", &text).unwrap_err();
        assert_eq!((error.file.as_str(), error.line), ("universal/t.json", line), "{error}");
        assert!(pieces.iter().all(|piece| error.to_string().contains(piece)), "{error}");
    };
    refused("\"format\": 1", "\"format\": 2", 1, ["format 2", "knows format 1"]);
    refused("\"topic\": \"t\"", "\"topic\": \"u\"", 1, ["topic \"u\"", "name it"]);
    refused("universal/t/one", "f/t/One", 4, ["\"f/t/One\"", "lower-case"]);
    refused("universal/t/one", "g/t/one", 4, ["\"g/t/one\"", "<family>/<topic>/<slug>"]);
    refused("[\"restart\"]", "[]", 4, ["\"restart\"", "`requires`"]);
    refused("[\"a\", \"b\"],", "[\"a\", \"a\"],", 4, ["twice", "once"]);
    refused("\"delta\": \"d\"", "\"delta\": \"e\"", 4, ["step 2", "\"e\""]);
    refused("\"replica\": \"b\"", "\"replica\": \"c\"", 4, ["step 2", "\"c\""]);
    refused("\"as\": \"v\"", "\"as\": \"root\"", 4, ["step 1", "\"root\""]);
    refused("[\"a\", \"b\"]}", "[\"a\"]}", 4, ["step 4", "two or more"]);
    refused("\"why\"", "\"whom\"", 5, ["unknown field `whom`", "schema/case.json"]);
    refused("\"universal\"", "\"mine\"", 1, ["\"mine\"", "families are"]);
    refused("\"provenance\"", "\"profile\": \"wire\", \"provenance\"", 1, ["profile wire", "observe"]);
    refused(
        "{\"expect_equal\": {\"replicas\": [\"a\", \"b\"]}}",
        "{\"expect_digest\": {\"replica\": \"a\", \"digest\": 1}}",
        4,
        ["profile \"causal\"", "`profile`"],
    );
    refused("[\"MUT-1\"]", "[]", 4, ["no clause", "`spec`"]);
    let nothing = SOUND.find(",\n      {\"expect_equal\"").unwrap();
    let end = SOUND[nothing + 1..].find('\n').unwrap();
    let rest = &SOUND[nothing + 1 + end + 1..];
    let line_end = rest.find('\n').unwrap();
    let text = format!("{}{}", &SOUND[..nothing], &rest[line_end..]);
    assert!(read("universal/t.json", &text).unwrap_err().to_string().contains("nothing is expected"));
}
