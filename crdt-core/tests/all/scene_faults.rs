//! Every fault of a graph: told with its place when read strictly, dropped and listed when read leniently.

use crate::scene_support::{check_lossless, fault_lines, faults, link, scene, symbol, with_attributes};
use dsr_core::scene::{FaultKind, Scene, Strictness};
use dsr_core::{Dictionary, ValueType, view};

/// Reads leniently; what is left is sound, and these are its vertices' names, joined.
#[track_caller]
fn lenient(text: &str, dictionary: &Dictionary) -> (String, usize) {
    let imported =
        Scene::read(text, dictionary, Strictness::Lenient).unwrap_or_else(|error| panic!("{error}"));
    let sound = check_lossless(&imported.scene.write(dictionary), dictionary);
    assert!(sound == imported.scene);
    let graph = view(&imported.scene.state, dictionary);
    let names: Vec<&str> =
        graph.vertices().iter().filter_map(|&v| graph.vertex(v)).map(|v| &*v.name).collect();
    (names.join(" "), imported.dropped.len())
}

/// The lines of the faults; and, read leniently, the vertices left and the number of things dropped.
#[track_caller]
fn check(text: &str, expected: &[&str], left: &str, dropped: usize) {
    assert_eq!(fault_lines(text), expected);
    assert_eq!(lenient(text, &Dictionary::open()), (left.to_owned(), dropped));
}

/// [spec: SCENE-12]
#[test]
fn regress_dangling_link() {
    let text = scene(&link(1, "RT", 2), &symbol(2, "hub", "", &link(2, "has", 7)));
    let told = "line 3, column 77, symbol 2 \"hub\", link 0 (has to 7): the link is dangling: the file has no symbol 7";
    check(&text, &[told], "hub", 1);
}

/// [spec: SCENE-12]
#[test]
fn regress_self_loop() {
    let text = scene(&link(1, "RT", 2), &symbol(2, "hub", "", &link(2, "near", 2)));
    let told = "line 3, column 77, symbol 2 \"hub\", link 0 (near to 2): the link joins the symbol to itself";
    check(&text, &[told], "hub", 1);
}

/// [spec: SCENE-12]
#[test]
fn regress_rt_link_into_the_root() {
    let text = scene(&link(1, "RT", 2), &symbol(2, "hub", "", &link(2, "RT", 1)));
    let told = "line 3, column 77, symbol 2 \"hub\", link 0 (RT to 1): an RT link enters the root, which has no kinematic parent";
    check(&text, &[told], "hub", 1);
}

/// [spec: SCENE-12]
#[test]
fn regress_repeated_link() {
    let twice = format!("{}, {}", link(1, "RT", 2), link(1, "RT", 2));
    let lines = fault_lines(&scene(&twice, &symbol(2, "hub", "", "")));
    assert_eq!(lines.len(), 1);
    assert!(
        lines[0].ends_with("link 1 (RT to 2): an earlier link of this symbol has the same label and target")
    );
    assert_eq!(
        lenient(&scene(&twice, &symbol(2, "hub", "", "")), &Dictionary::open()),
        ("hub".to_owned(), 1)
    );
}

/// [spec: SCENE-13]
#[test]
fn regress_two_rt_parents() {
    let claims = format!("{}, {}, {}", link(1, "RT", 2), link(1, "RT", 3), link(1, "RT", 4));
    let symbols = [
        symbol(2, "left", "", &link(2, "RT", 4)),
        symbol(3, "right", "", &link(3, "RT", 4)),
        symbol(4, "cup", "", ""),
    ];
    let text = scene(&claims, &symbols.join(",\n"));
    let told = [
        "symbol 1 \"world\", link 2 (RT to 4): 4 \"cup\" has two RT parents: 1 \"world\" and 3 \"right\"",
        "symbol 2 \"left\", link 0 (RT to 4): 4 \"cup\" has two RT parents: 2 \"left\" and 3 \"right\"",
    ];
    let lines = fault_lines(&text);
    assert_eq!(lines.len(), 2);
    for (line, told) in lines.iter().zip(told) {
        assert!(line.ends_with(told), "{line}");
    }
    assert_eq!(lenient(&text, &Dictionary::open()), ("left right cup".to_owned(), 2));
}

/// [spec: SCENE-13]
#[test]
fn regress_cycle_of_rt_links() {
    let symbols = [
        symbol(2, "a", "", &format!("{}, {}", link(2, "RT", 3), link(2, "in", 1))),
        symbol(3, "b", "", &link(3, "RT", 4)),
        symbol(4, "c", "", &link(4, "RT", 2)),
    ];
    let text = scene("", &symbols.join(",\n"));
    let lines = fault_lines(&text);
    assert_eq!(lines.len(), 1, "{lines:?}");
    assert!(
        lines[0].ends_with("link 0 (RT to 3): RT links form a cycle: 3 \"b\" → 4 \"c\" → 2 \"a\" → 3 \"b\""),
        "{lines:?}"
    );
    // Without the link that closes it, the chain b → c → a still hangs from nothing, so its links go too.
    assert_eq!(lenient(&text, &Dictionary::open()), ("a".to_owned(), 4));
}

/// [spec: SCENE-13]
#[test]
fn regress_cycle_apart_from_the_root_is_told_as_both() {
    let symbols = [symbol(2, "a", "", &link(2, "RT", 3)), symbol(3, "b", "", &link(3, "RT", 2))];
    let kinds: Vec<FaultKind> =
        faults(&scene("", &symbols.join(",\n"))).into_iter().map(|fault| fault.kind).collect();
    let no_path = kinds.iter().filter(|kind| matches!(kind, FaultKind::NoPath)).count();
    let cycles = kinds.iter().filter(|kind| matches!(kind, FaultKind::Cycle { .. })).count();
    assert_eq!((no_path, cycles, kinds.len()), (2, 1, 3), "{kinds:?}");
}

/// [spec: SCENE-13]
#[test]
fn regress_symbol_without_path_to_the_root() {
    let symbols =
        [symbol(2, "hub", "", ""), symbol(3, "lost", "", &link(3, "near", 4)), symbol(4, "too", "", "")];
    let text = scene(&link(1, "RT", 2), &symbols.join(",\n"));
    check(
        &text,
        &[
            "line 4, column 1, symbol 3 \"lost\": the symbol has no path to the root, over links of any label in any direction",
            "line 5, column 1, symbol 4 \"too\": the symbol has no path to the root, over links of any label in any direction",
        ],
        "hub",
        2,
    );
}

/// [spec: SCENE-13]
#[test]
fn regress_tree_that_does_not_hang_from_the_root() {
    let symbols = [
        symbol(2, "mind", "", &format!("{}, {}", link(2, "in", 1), link(2, "RT", 3))),
        symbol(3, "idea", "", &link(3, "in", 1)),
    ];
    let text = scene("", &symbols.join(",\n"));
    check(
        &text,
        &[
            "line 3, column 1, symbol 2 \"mind\": the symbol has RT children but no RT parent, so its tree of 1 RT links does not hang from the root: 2 \"mind\" → 3 \"idea\"",
        ],
        "mind idea",
        1,
    );
}

/// [spec: SCENE-13]
#[test]
fn regress_two_links_under_a_functional_label() {
    let links = format!("{}, {}, {}", link(1, "RT", 2), link(1, "RT", 3), link(1, "RT", 4));
    let both = format!("{}, {}", link(4, "in", 2), link(4, "in", 3));
    let symbols = [symbol(2, "hall", "", ""), symbol(3, "yard", "", ""), symbol(4, "robot", "", &both)];
    let text = scene(&links, &symbols.join(",\n"));
    check_lossless(&text, &Dictionary::open());
    let dictionary = Dictionary::open().with_functional("in");
    let refused = Scene::read(&text, &dictionary, Strictness::Strict).unwrap_err();
    assert_eq!(refused.faults.len(), 1);
    let told = refused.faults[0].to_string();
    assert!(
        told.ends_with(
            "symbol 4 \"robot\", link 0 (in to 2): \"in\" is functional, so one symbol has one such link; another goes to 3 \"yard\""
        ),
        "{told}"
    );
    assert_eq!(lenient(&text, &dictionary), ("hall yard robot".to_owned(), 1));
}

/// [spec: SCENE-12]
#[test]
fn regress_no_root_and_two_roots_are_refused_leniently_too() {
    let none = "{\"DSRModel\": {\"symbols\": {\"2\": {\"id\": 2, \"name\": \"hub\", \"type\": \"thing\"}}}}";
    assert_eq!(
        fault_lines(none),
        ["line 1, column 1: no symbol is the root: none is named or typed `root` or `world`"]
    );
    let named_root = scene(&link(1, "RT", 2), &symbol(2, "root", "", ""));
    let typed_world = scene(&link(1, "RT", 2), &symbol(2, "earth", "", "").replace("thing", "world"));
    for (text, second) in [(named_root, "root"), (typed_world, "earth")] {
        let told = format!(
            "line 3, column 1: more than one symbol is named or typed `root` or `world`: 1 \"world\", 2 \"{second}\""
        );
        assert_eq!(fault_lines(&text), [told]);
        assert!(Scene::read(&text, &Dictionary::open(), Strictness::Lenient).is_err());
    }
    assert!(Scene::read(none, &Dictionary::open(), Strictness::Lenient).is_err());
}

/// [spec: SCENE-12]
#[test]
fn law_the_root_is_named_or_typed_root_or_world() {
    for (name, vertex_type) in [("world", "world"), ("root", "root"), ("home", "root"), ("world", "place")] {
        let text = format!(
            "{{\"DSRModel\": {{\"symbols\": {{\"9\": {{\"id\": 9, \"name\": \"{name}\", \"type\": \"{vertex_type}\"}}}}}}}}"
        );
        let scene = check_lossless(&text, &Dictionary::open());
        assert_eq!(
            (&*scene.root.name, &*scene.root.vertex_type, scene.root.external_id),
            (name, vertex_type, Some(9))
        );
        assert!(scene.state.is_empty());
    }
}

/// [spec: SCENE-12] [spec: SCENE-7]
#[test]
fn regress_repeated_ids_names_and_mismatched_keys() {
    let claims = format!("{}, {}", link(1, "RT", 2), link(1, "RT", 3));
    let again = symbol(2, "again", "", "");
    let text = scene(&link(1, "RT", 2), &[symbol(2, "hub", "", ""), again].join(",\n"));
    check(
        &text,
        &["line 4, column 1, symbol 2 \"again\": the id 2 is taken by an earlier symbol, 2 \"hub\""],
        "hub",
        1,
    );
    let text = scene(&claims, &[symbol(2, "hub", "", ""), symbol(3, "hub", "", "")].join(",\n"));
    let lines = fault_lines(&text);
    assert_eq!(lines.len(), 2);
    assert!(lines[0].ends_with("link 1 (RT to 3): the link's target 3 is left out for a fault of its own"));
    assert_eq!(
        lines[1],
        "line 4, column 1, symbol 3 \"hub\": the name \"hub\" is taken by an earlier symbol, 2 \"hub\""
    );
    let text = scene("", &symbol(2, "hub", "", "").replacen("\"2\"", "\"02\"", 1));
    check(
        &text,
        &["line 3, column 1, symbol 02 \"hub\": the symbol is filed under the key \"02\", but its id is 2"],
        "",
        1,
    );
}

/// [spec: SCENE-7]
#[test]
fn regress_ids_that_are_no_ids() {
    for id in ["-1", "1.0", "1e3", "18446744073709551616", "\"007\"", "\"\"", "\"x\""] {
        let text =
            scene("", &symbol(2, "hub", "", "").replacen("\"id\": \"2\"", &format!("\"id\": {id}"), 1));
        let shown = id.trim_matches('"');
        let told = format!(
            "line 3, column 13, symbol 2 \"hub\": {shown:?} is no id: ids are whole numbers from 0 to 18446744073709551615"
        );
        check(&text, &[&told], "", 1);
    }
    let text = scene(&link(1, "RT", u64::MAX), &symbol(u64::MAX, "far", "", ""));
    check_lossless(&text, &Dictionary::open());
    let text = scene(&link(7, "RT", 2), &symbol(2, "hub", "", &link(2, "in", 1)));
    let told = "line 2, column 79, symbol 1 \"world\", link 0 (RT to 2): the link's `src` is 7, but it stands in another symbol";
    check(&text, &[told], "hub", 1);
}

/// [spec: SCENE-6]
#[test]
fn regress_keys_unknown_repeated_and_missing() {
    let hub = symbol(2, "hub", "", "");
    let root = link(1, "RT", 2);
    let extra = hub.replacen("\"type\"", "\"colour\": 1, \"type\"", 1);
    check(
        &scene(&root, &extra),
        &["line 3, column 33, symbol 2 \"hub\": the format has no key \"colour\" here"],
        "hub",
        1,
    );
    let twice = hub.replacen("\"type\"", "\"type\": \"x\", \"type\"", 1);
    check(
        &scene(&root, &twice),
        &["line 3, column 46, symbol 2 \"hub\": the key \"type\" stands twice in one object"],
        "hub",
        1,
    );
    let without = hub.replacen("\"type\": \"thing\", ", "", 1);
    let lines = fault_lines(&scene(&root, &without));
    assert!(lines[1].ends_with("symbol 2 \"hub\": the key `type` is missing"), "{lines:?}");
    for (key, text) in [
        ("extra", scene(&root, &hub).replacen("{\"DSRModel\"", "{\"extra\": [], \"DSRModel\"", 1)),
        ("meta", scene(&root, &hub).replacen("{\"symbols\"", "{\"meta\": 0, \"symbols\"", 1)),
        ("w", scene(&root.replacen("\"src\"", "\"w\": 1, \"src\"", 1), &hub)),
        ("unit", scene(&root, &symbol(2, "hub", "\"a\": {\"type\": 4, \"value\": true, \"unit\": 0}", ""))),
    ] {
        let lines = fault_lines(&text);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].ends_with(&format!("the format has no key {key:?} here")), "{lines:?}");
        assert_eq!(lenient(&text, &Dictionary::open()), ("hub".to_owned(), 1));
    }
    let attribute = "\"a\": {\"type\": 4, \"value\": true}";
    let lines = fault_lines(&with_attributes(&format!("{attribute}, {attribute}")));
    assert!(lines[0].ends_with("attribute \"a\": the key \"a\" stands twice in one object"), "{lines:?}");
}

/// [spec: SCENE-6]
#[test]
fn regress_wrong_json_forms() {
    let hub = symbol(2, "hub", "", "");
    let cases = [
        (scene("", "\"2\": []"), "symbol 2: a symbol must be an object, but it is a list"),
        (scene("5", ""), "link 0: a link must be an object, but it is a number"),
        (
            scene("", &hub.replacen("\"name\": \"hub\"", "\"name\": 5", 1)),
            "the name must be text, but it is a number",
        ),
        (scene("", &hub.replacen("\"thing\"", "null", 1)), "the type must be text, but it is null"),
        (
            scene("", &hub.replacen("\"id\": \"2\"", "\"id\": true", 1)),
            "an id must be a whole number, plain or in quotes, but it is true or false",
        ),
        (
            scene("", &hub.replacen("\"links\": []", "\"links\": {}", 1)),
            "`links` must be a list, but it is an object",
        ),
        (
            scene("", &hub.replacen("\"attribute\": {}", "\"attribute\": []", 1)),
            "`attribute` must be an object, but it is a list",
        ),
        (with_attributes("\"a\": 5"), "attribute \"a\": an attribute must be an object, but it is a number"),
        (
            with_attributes("\"a\": {\"type\": \"1\", \"value\": 1}"),
            "`type` must be a number from 0 to 13, but it is text",
        ),
        (with_attributes("\"a\": {\"value\": 1}"), "attribute \"a\": the key `type` is missing"),
        (with_attributes("\"a\": {\"type\": 1}"), "attribute \"a\": the key `value` is missing"),
        (
            with_attributes("\"a\": {\"type\": 4, \"value\": true, \"timestamp_ns\": -1}"),
            "-1 is outside what an unsigned 64-bit integer can hold",
        ),
        (
            with_attributes("\"\": {\"type\": 4, \"value\": true}"),
            "the attribute's name has 0 bytes; allowed are 1 to 255",
        ),
        (
            scene("", &hub.replacen("\"hub\"", &format!("\"{}\"", "h".repeat(256)), 1)),
            "the name has 256 bytes; allowed are 1 to 255",
        ),
    ];
    for (text, told) in cases {
        let lines = fault_lines(&text);
        assert!(lines.iter().any(|line| line.ends_with(told)), "{told}: {lines:?}");
        Scene::read(&text, &Dictionary::open(), Strictness::Lenient).unwrap();
    }
}

/// [spec: SCENE-13] [spec: SCENE-17]
#[test]
fn regress_names_that_a_closed_dictionary_does_not_declare() {
    let mut dictionary = Dictionary { closed: true, ..Dictionary::open() };
    dictionary.vertex_types.insert("thing".into());
    dictionary.attributes.insert("level".into(), ValueType::Int);
    let attributes = "\"level\": {\"type\": 2, \"value\": 1}, \"other\": {\"type\": 1, \"value\": 1}";
    let links = format!("{}, {}", link(1, "RT", 2), link(1, "RT", 3));
    let symbols = [
        symbol(2, "hub", attributes, &link(2, "near", 1)),
        symbol(3, "odd", "", "").replace("thing", "ghost"),
    ];
    let text = scene(&links, &symbols.join(",\n"));
    let refused = Scene::read(&text, &dictionary, Strictness::Strict).unwrap_err();
    let told: Vec<String> = refused.faults.iter().map(|fault| fault.kind.to_string()).collect();
    assert_eq!(
        told,
        [
            "the link's target 3 is left out for a fault of its own",
            "the dictionary declares this attribute as int (type 1), not float (type 2)",
            "the dictionary declares no attribute of this name",
            "the dictionary declares no edge label \"near\"",
            "the dictionary declares no vertex type \"ghost\"",
        ]
    );
    assert_eq!(lenient(&text, &dictionary), ("hub".to_owned(), 5));
}

/// [spec: SCENE-4]
#[test]
fn law_every_fault_of_a_scene_is_named_at_once() {
    let symbols = [
        symbol(2, "hub", "\"a\": {\"type\": 1, \"value\": 3000000000}", &link(2, "near", 2)),
        symbol(3, "cup", "", &link(3, "on", 99)),
        symbol(4, "lost", "", ""),
    ];
    let links = format!("{}, {}", link(1, "RT", 2), link(1, "RT", 3));
    let kinds: Vec<FaultKind> =
        faults(&scene(&links, &symbols.join(",\n"))).into_iter().map(|fault| fault.kind).collect();
    assert_eq!(
        kinds,
        [
            FaultKind::OutOfRange { text: "3000000000".to_owned(), expected: "a 32-bit integer" },
            FaultKind::SelfLoop,
            FaultKind::UnknownTarget { target: 99 },
            FaultKind::NoPath,
        ]
    );
}
