//! The scenario's file: what is refused, and what the error says.

use dsr_model::scenario::{Options, Scenario};

/// A scenario that is fine, to be spoiled in one place.
const FINE: &str = r#"{"format": 1, "name": "fine", "about": "A test.", "scene": "@flat",
    "setup": [{"update_attributes": {"vertex": "robot", "attributes": {"level": 3}}}],
    "focus": ["robot"],
    "replicas": [
        {"name": "camera", "script": [
            {"when": {"edge": {"from": "person", "label": "in", "to": "bedroom"}},
             "do": {"add_edge": {"from": "person", "label": "with", "to": "robot"}}, "else": "skip"},
            {"do": {"add_vertex": {"type": "cup", "name": "mug", "attributes": {"color": "blue"},
                "link": {"from": "bed", "label": "RT"}}}}]},
        {"name": "free", "alphabet": ["remove_vertex"], "budget": 1}],
    "properties": [{"name": "mug", "why": "A test.", "sometimes": {"vertex": {"name": "mug"}}}]}"#;

#[test]
fn law_the_fine_scenario_is_fine() {
    let scenario = Scenario::read(FINE, "fine.json").unwrap();
    assert_eq!(scenario.replicas().collect::<Vec<_>>(), ["camera", "free"]);
    assert!(scenario.check(Options::default()).is_as_expected());
}

/// Replaces one text in the fine scenario, and expects this error.
#[track_caller]
#[allow(clippy::unwrap_used, reason = "a spoiled scenario that is read is a test that fails")]
fn check(old: &str, new: &str, expected: &str) {
    assert_eq!(FINE.matches(old).count(), 1, "{old} is not there once");
    let error = Scenario::read(&FINE.replace(old, new), "fine.json").unwrap_err().to_string();
    assert!(error.starts_with(&format!("fine.json: {expected}")), "{error}");
}

/// `[spec: SCEN-14]` `[spec: SCEN-1]`
#[test]
fn law_errors_name_place_values_and_remedy() {
    check(
        r#""to": "bedroom""#,
        r#""to": "bedrom""#,
        r#"replicas[0].script[0].when.edge.to: there is no vertex in the scene, the setup or any script called "bedrom" (did you mean "bedroom"?)"#,
    );
    check(
        r#""label": "with""#,
        r#""label": "wiht""#,
        r#"replicas[0].script[0].do.add_edge.label: there is no edge label in the dictionary called "wiht" (did you mean "with"?)"#,
    );
    check(
        r#""type": "cup""#,
        r#""type": "cupp""#,
        r#"replicas[0].script[1].do.add_vertex.type: there is no vertex type in the dictionary called "cupp" (did you mean "cup"?)"#,
    );
    check(
        r#""color": "blue""#,
        r#""colour": "blue""#,
        r#"replicas[0].script[1].do.add_vertex.attributes.colour: there is no attribute in the dictionary called "colour" (did you mean "color"?)"#,
    );
    check(
        r#""color": "blue""#,
        r#""color": 5"#,
        r#"replicas[0].script[1].do.add_vertex.attributes.color: not a value of "color": "#,
    );
    check(
        r#""color": "blue""#,
        r#""color": {"type": "int", "value": 5}"#,
        r#"replicas[0].script[1].do.add_vertex.attributes.color: not a value of "color": it is declared as string, not int"#,
    );
    check(
        r#""else": "skip""#,
        r#""else": "ignore""#,
        r#"replicas[0].script[0].else: "ignore" means nothing here; write one of wait, skip, stop"#,
    );
    check(
        r#""else": "skip""#,
        r#""otherwise": "skip""#,
        r#"replicas[0].script[0]: no field "otherwise" belongs here; the fields are note, when, do, else, refused, repeat"#,
    );
}

/// `[spec: SCEN-14]` `[spec: SCEN-1]`
#[test]
fn law_errors_of_replicas_and_scenes() {
    check(r#""format": 1"#, r#""format": 2"#, "format: 2 is out of range; allowed are 1 to 1");
    check(r#""format": 1, "#, "", r#"the field "format" is missing"#);
    check(r#""budget": 1"#, r#""budget": "one""#, "replicas[1].budget: expected a whole number, found text");
    check(r#", "budget": 1"#, "", r#"replicas[1]: "alphabet" needs a `budget` beside it"#);
    check(
        r#""remove_vertex""#,
        r#""delete_vertex""#,
        r#"replicas[1].alphabet[0]: "delete_vertex" means nothing here"#,
    );
    check(
        r#""name": "free""#,
        r#""name": "camera""#,
        r#"replicas[1].name: "camera" is the name of another replica"#,
    );
    check(r#""name": "free", "alphabet""#, r#""name": "free", "script": [], "alphabet""#, "replicas[1]");
    check(r#"["robot"]"#, r#"["mug"]"#, "focus[0]: there is no vertex");
    check(
        r#""@flat""#,
        r#""@house""#,
        r#"scene: "@house" means nothing here; write one of @flat, @tiny, @empty, a path"#,
    );
    check(r#""@flat""#, r#""house.json""#, r#"scene: cannot be opened: the scene "house.json": "#);
    check(r#""@flat""#, r#"{"DSRModel": {}}"#, "scene: the scene has faults: ");
    check(r#""level": 3"#, r#""level": null, "priority": null"#, "setup[0]: the setup cannot do this: ");
}

/// `[spec: SCEN-14]` `[spec: SCEN-7]` `[spec: SCEN-8]`
#[test]
fn law_errors_of_properties_and_links() {
    check(
        r#"{"vertex": {"name": "mug"}}"#,
        r#"{"vertices": {}}"#,
        r#"properties[0].sometimes: no field "vertices" belongs here"#,
    );
    check(
        r#"{"vertex": {"name": "mug"}}"#,
        "{}",
        "properties[0].sometimes: expected exactly one of all, any, not",
    );
    check(
        r#"{"vertex": {"name": "mug"}}"#,
        r#"{"all": []}"#,
        "properties[0].sometimes.all: empty list of predicates",
    );
    check(
        r#"{"vertex": {"name": "mug"}}"#,
        r#"{"if": {"repair": "any"}}"#,
        r#"properties[0].sometimes: "if" needs `then` beside it"#,
    );
    check(
        r#"{"vertex": {"name": "mug"}}"#,
        r#"{"done": "camera"}"#,
        "properties[0].sometimes.done: `done` speaks of the end",
    );
    check(
        r#"{"vertex": {"name": "mug"}}"#,
        r#"{"count": {"edges": {}}}"#,
        "properties[0].sometimes.count: expected exactly one of exactly, at_least, at_most, found 0",
    );
    check(
        r#"{"vertex": {"name": "mug"}}"#,
        r#"{"repair": "broken"}"#,
        r#"properties[0].sometimes.repair: "broken" means nothing here"#,
    );
    check(
        r#"{"vertex": {"name": "mug"}}"#,
        r#"{"placement": {"of": "mug", "is": "outside", "parent": "bed"}}"#,
        r#"properties[0].sometimes.placement: "parent" needs `is`: "child" beside it"#,
    );
    check(
        r#""sometimes": {"#,
        r#""always": {"edge": {}}, "sometimes": {"#,
        "properties[0]: expected exactly one of always, at_end, sometimes, sometimes_at_end, found 2",
    );
    check(r#""why": "A test.", "#, "", r#"properties[0]: the field "why" is missing"#);
    check(
        r#"{"from": "bed", "label": "RT"}"#,
        r#"{"to": "bed", "label": "RT"}"#,
        r#"replicas[0].script[1].do.add_vertex.link: "label" needs `from`, its parent, for a kinematic link: `to`"#,
    );
    check(
        r#"{"from": "bed", "label": "RT"}"#,
        r#"{"label": "RT"}"#,
        "replicas[0].script[1].do.add_vertex.link: expected exactly one of from, to, found 0",
    );
    check(
        r#""name": "mug", "attributes""#,
        r#""name": "world", "attributes""#,
        "replicas[0].script[1].do.add_vertex.name: ",
    );
    check(
        r#""label": "with", "to": "robot""#,
        r#""label": "with", "to": "person""#,
        "replicas[0].script[0].do.add_edge: ",
    );
    check(r#""name": "fine""#, r#""name": """#, "name: empty text");
}

/// `[spec: SCEN-1]` `[spec: SCEN-14]`
#[test]
fn law_texts_that_are_no_scenario_are_refused() {
    for (text, expected) in [
        ("", "not a JSON object that names each field once: EOF"),
        ("[]", "expected an object, found a list"),
        ("{", "not a JSON object that names each field once: EOF"),
        (
            r#"{"name": "a", "name": "b"}"#,
            r#"not a JSON object that names each field once: the field "name" is there twice"#,
        ),
        ("{}", r#"the field "format" is missing"#),
    ] {
        let error = Scenario::read(text, "bad.json").unwrap_err().to_string();
        assert!(error.starts_with(&format!("bad.json: {expected}")), "{text}: {error}");
    }
    let large = " ".repeat((1 << 20) + 1);
    assert!(Scenario::read(&large, "x").unwrap_err().to_string().contains("allowed are 1048576"));
    let deep = "[".repeat(100_000);
    assert!(Scenario::read(&deep, "x").unwrap_err().to_string().contains("recursion limit"));
}

/// `[spec: SCEN-7]` `[spec: SCEN-14]`
#[test]
fn law_predicates_are_not_nested_without_end() {
    let nested = |depth: usize| {
        let inner = r#"{"repair": "any"}"#;
        format!("{}{inner}{}", r#"{"not": "#.repeat(depth), "}".repeat(depth))
    };
    let fine = FINE.replace(r#"{"vertex": {"name": "mug"}}"#, &nested(15));
    assert!(Scenario::read(&fine, "deep.json").is_ok());
    check(
        r#"{"vertex": {"name": "mug"}}"#,
        &nested(16),
        "properties[0].sometimes.not.not.not.not.not.not.not.not.not.not.not.not.not.not.not.not: 17 levels of predicates; allowed are 16",
    );
}

/// `[spec: SCEN-2]` `[spec: SCEN-1]`
#[test]
fn law_a_scenarios_file_names_its_scene_beside_it() {
    let folder = std::env::temp_dir().join(format!("dsr-scenario-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("scenes")).unwrap();
    std::fs::write(folder.join("scenes/flat.json"), dsr_core::scene::FLAT).unwrap();
    let path = folder.join("beside.json");
    std::fs::write(&path, FINE.replace("@flat", "scenes/flat.json")).unwrap();
    let beside = Scenario::open(&path).unwrap();
    let shipped = Scenario::read(FINE, "fine.json").unwrap();
    assert_eq!(beside.initial(), shipped.initial());
    let inline = Scenario::read(&FINE.replace("\"@flat\"", dsr_core::scene::FLAT), "inline.json").unwrap();
    let graph =
        |scenario: &Scenario| dsr_core::view(scenario.initial(), scenario.dictionary()).vertices().len();
    assert_eq!(graph(&inline), graph(&shipped));
    std::fs::remove_dir_all(&folder).unwrap();
    let missing = Scenario::open(&path).unwrap_err().to_string();
    assert!(missing.starts_with(&format!("{}: cannot be opened: ", path.display())), "{missing}");
}

/// Plain values take the declared type; an open dictionary needs types for numbers. `[spec: SCEN-3]`
#[test]
fn law_values_are_plain_where_their_type_is_known() {
    let open = |value: &str| {
        format!(
            r#"{{"format": 1, "name": "open", "about": "A test.", "dictionary": "@open",
            "setup": [{{"update_attributes": {{"vertex": "world", "attributes": {{"note": {value}}}}}}}],
            "replicas": [{{"name": "a", "script": [{{"when": {{"repair": "any"}}}}]}}],
            "properties": [{{"name": "p", "why": "A test.", "always": {{"attribute": {{"of": "root", "name": "note", "is": {value}}}}}}}]}}"#
        )
    };
    for value in
        [r#""text""#, "true", r#"{"type": "int", "value": 5}"#, r#"{"type": "uint64", "value": "5"}"#]
    {
        let report = Scenario::read(&open(value), "open.json").unwrap().check(Options::default());
        assert_eq!(report.properties[0].verdict.to_string(), "holds", "{value}");
    }
    let error = Scenario::read(&open("5"), "open.json").unwrap_err().to_string();
    let expected = r#"open.json: setup[0].update_attributes.attributes.note: not a value of "note": the dictionary declares no type: write {"type": "int", "value": 5}"#;
    assert_eq!(error, expected);
}
