//! The published system's own scenes, where they are at hand, and the scenes that ship with the crate.

use crate::scene_support::check_lossless;
use dsr_core::scene::{FLAT, FaultKind, Scene, Strictness, TINY};
use dsr_core::{Dictionary, Record, ValueType, view};
use std::collections::BTreeSet;
use std::path::PathBuf;

/// Every shared scene by its file's name; none, with a printed reason, where the folder is absent.
fn shared() -> Vec<(String, String)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../shared/scenes");
    let Ok(entries) = std::fs::read_dir(&folder) else {
        println!("skipped: there is no folder ../shared/scenes beside the workspace");
        return Vec::new();
    };
    let mut files: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    files.sort();
    assert!(!files.is_empty(), "the folder of shared scenes is empty");
    let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
    files.iter().map(|path| (name(path), std::fs::read_to_string(path).unwrap())).collect()
}

/// Symbols, links and attributes of a file, counted without this crate.
fn counts(text: &str) -> (usize, usize, usize) {
    let document: serde_json::Value = serde_json::from_str(text).unwrap();
    let symbols = document["DSRModel"]["symbols"].as_object().unwrap();
    let links = symbols.values().flat_map(|symbol| symbol["links"].as_array().unwrap());
    let attributes =
        symbols.values().map(|symbol| symbol["attribute"].as_object().unwrap().len()).sum::<usize>();
    let on_links = links.clone().map(|link| link["linkAttribute"].as_object().unwrap().len()).sum::<usize>();
    (symbols.len(), links.count(), attributes + on_links)
}

fn counts_of(scene: &Scene) -> (usize, usize, usize) {
    let count = |kind: fn(&Record) -> bool| scene.state.records().filter(|(_, record)| kind(record)).count();
    let vertices = count(|record| matches!(record, Record::Vertex(_)));
    (
        vertices + 1,
        count(|record| matches!(record, Record::Edge(_))),
        count(|record| matches!(record, Record::Write(_))),
    )
}

/// [spec: SCENE-1] [spec: SCENE-7] [spec: SCENE-14] [spec: SCENE-15]
#[test]
fn law_sound_shared_scenes_are_read_and_written_without_loss() {
    for (name, text) in shared() {
        if name.contains("dangling") || name.starts_with("apartment_objects") {
            continue;
        }
        let scene = check_lossless(&text, &Dictionary::open());
        assert_eq!(counts_of(&scene), counts(&text), "{name}");
    }
}

/// [spec: SCENE-4] [spec: SCENE-5]
#[test]
fn law_the_shared_scene_with_dangling_links_is_refused_with_each_of_them() {
    let Some((_, text)) = shared().into_iter().find(|(name, _)| name.contains("dangling")) else { return };
    let refused = Scene::read(&text, &Dictionary::open(), Strictness::Strict).unwrap_err();
    let named: Vec<_> = refused
        .faults
        .iter()
        .map(|fault| {
            let (symbol, link) = (fault.place.symbol.as_ref().unwrap(), fault.place.link.as_ref().unwrap());
            assert!(matches!(fault.kind, FaultKind::UnknownTarget { .. }), "{fault}");
            (symbol.id.as_str(), link.label.as_deref().unwrap(), link.target.unwrap())
        })
        .collect();
    let expected = [
        ("1", "RT", 300),
        ("1", "RT", 302),
        ("1", "RT", 304),
        ("1", "RT", 310),
        ("1000", "has", 1_694_498_851),
    ];
    assert_eq!(named, expected);
    let lenient = Scene::read(&text, &Dictionary::open(), Strictness::Lenient).unwrap();
    assert_eq!(lenient.dropped, refused.faults);
    let (symbols, links, attributes) = counts_of(&lenient.scene);
    assert_eq!((symbols, links), (38, 38));
    assert!(attributes <= counts(&text).2);
    check_lossless(&lenient.scene.write(&Dictionary::open()), &Dictionary::open());
}

/// A finding of this reader: two symbols of this file are linked to themselves, against INV-4.
/// [spec: SCENE-12]
#[test]
fn law_the_shared_scene_with_self_loops_is_refused_with_each_of_them() {
    let Some((_, text)) = shared().into_iter().find(|(name, _)| name.starts_with("apartment_objects")) else {
        return;
    };
    let refused = Scene::read(&text, &Dictionary::open(), Strictness::Strict).unwrap_err();
    let named: Vec<_> = refused
        .faults
        .iter()
        .map(|fault| (fault.kind.clone(), fault.place.symbol.as_ref().unwrap().to_string()))
        .collect();
    let self_loop = |symbol: &str| (FaultKind::SelfLoop, symbol.to_owned());
    assert_eq!(named, [self_loop("72 \"fridge\""), self_loop("74 \"table\"")]);
    let lenient = Scene::read(&text, &Dictionary::open(), Strictness::Lenient).unwrap();
    assert_eq!(lenient.dropped, refused.faults);
    let (symbols, links, attributes) = counts(&text);
    assert_eq!(counts_of(&lenient.scene), (symbols, links - 2, attributes));
}

/// [spec: SCENE-16] [spec: SCENE-17]
#[test]
fn law_shipped_scenes_are_sound_closed_and_in_canonical_form() {
    for text in [FLAT, TINY] {
        let scene = check_lossless(text, &Dictionary::aal());
        assert_eq!(scene.write(&Dictionary::aal()), text);
        assert_eq!(counts_of(&scene), counts(text));
    }
    let flat = Scene::read(FLAT, &Dictionary::aal(), Strictness::Strict).unwrap().scene;
    let dictionary = Dictionary::aal();
    let graph = view(&flat.state, &dictionary);
    for name in ["bedroom", "dining-kitchen", "bathroom", "robot", "person", "bed", "walker", "bed_radar"] {
        assert!(graph.vertex_by_name(name).is_some(), "{name}");
    }
    let robot = graph.vertex_by_name("robot").unwrap();
    let room = graph.vertex_by_name("dining-kitchen").unwrap();
    assert!(graph.edge(robot, "in", room).is_some());
}

/// [spec: SCENE-17]
#[test]
fn law_the_dictionaries_hold_the_published_names() {
    let published = Dictionary::published();
    assert!(published.closed);
    assert_eq!(published.edge_labels.len(), 32);
    assert_eq!(published.vertex_types.len(), 95, "94 and the fork's `world`");
    assert_eq!(published.attributes.len(), 231);
    assert!(published.is_functional("in"));
    assert_eq!(published.functional_labels.len(), 1);
    let count =
        |value_type| published.attributes.values().filter(|declared| **declared == value_type).count();
    let counts: Vec<usize> = ValueType::ALL.into_iter().map(count).collect();
    assert_eq!(counts, [22, 55, 58, 53, 21, 5, 4, 6, 1, 2, 1, 1, 1, 1]);
    let aal = Dictionary::aal();
    assert!(aal.closed);
    assert!(aal.vertex_types.is_superset(&published.vertex_types));
    assert!(aal.edge_labels.is_superset(&published.edge_labels));
    assert_eq!(aal.functional_labels, published.functional_labels);
    for (name, declared) in &published.attributes {
        assert_eq!(aal.attribute_type(name), Some(*declared), "{name}");
    }
    let added: BTreeSet<_> =
        aal.edge_labels.difference(&published.edge_labels).map(|label| &**label).collect();
    assert!(added.contains("wants_to") && added.contains("is_with"), "{added:?}");
}
