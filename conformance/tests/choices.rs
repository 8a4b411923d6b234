//! What the corpus says of the choices of the specification.

use dsr_conformance::case::Origin;
use dsr_conformance::corpus;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::path::Path;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    format: u32,
    choices: Vec<Choice>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Choice {
    name: String,
    question: String,
    ours: String,
    others: String,
    every: String,
    spec: Vec<String>,
}

/// `[spec: CONF-11]`
#[test]
fn law_every_choice_is_explained_once_and_settled_by_a_case() {
    let file: File = serde_json::from_str(corpus::CHOICES).unwrap();
    assert_eq!(file.format, 1);
    let names: BTreeSet<&str> = file.choices.iter().map(|choice| choice.name.as_str()).collect();
    assert_eq!(names.len(), file.choices.len());
    let inputs = dsr_spec::read_inputs(&Path::new(env!("CARGO_MANIFEST_DIR")).join("..")).unwrap();
    let clauses = dsr_spec::trace(&inputs.texts, &[]).clauses;
    for choice in &file.choices {
        let texts = [&choice.question, &choice.ours, &choice.others, &choice.every];
        assert!(texts.iter().all(|text| !text.is_empty()), "{}", choice.name);
        for id in &choice.spec {
            assert!(
                id.parse().is_ok_and(|id| clauses.get(&id).is_some()),
                "{}: {id} is no clause",
                choice.name
            );
        }
    }
    let cases = corpus::cases().unwrap();
    let settled: BTreeSet<&str> = cases.iter().filter_map(|case| case.choice.as_deref()).collect();
    assert_eq!(settled, names);
}

/// Cases of family `resolution` that are written by hand, and no others, settle a choice. `[spec: CONF-11]`
#[test]
fn law_a_case_settles_a_choice_where_it_could_be_otherwise() {
    for case in corpus::cases().unwrap() {
        let by_choice = case.id.starts_with("resolution/");
        assert!(by_choice || case.choice.is_none(), "{}", case.id);
        assert!(case.choice.is_some() || !by_choice || case.provenance.kind != Origin::Hand, "{}", case.id);
    }
}
