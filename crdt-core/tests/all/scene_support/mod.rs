//! What the scene tests share: small scenes as text, and the check that reading and writing lose nothing.

#![allow(dead_code, reason = "each test file uses a part")]

use dsr_core::scene::{Fault, Scene, Strictness};
use dsr_core::{Dictionary, check_well_formed, invariant, view};

/// A scene of a root 1 `world` and these further symbols, as `"id": {…}` entries, with these links of the root.
pub(crate) fn scene(root_links: &str, symbols: &str) -> String {
    let comma = if symbols.is_empty() { "" } else { ",\n" };
    format!(
        "{{\"DSRModel\": {{\"symbols\": {{\n\"1\": {{\"id\": \"1\", \"name\": \"world\", \"type\": \"world\", \"attribute\": {{}}, \"links\": [{root_links}]}}{comma}{symbols}\n}}}}}}"
    )
}

/// A symbol's entry.
pub(crate) fn symbol(id: u64, name: &str, attributes: &str, links: &str) -> String {
    format!(
        "\"{id}\": {{\"id\": \"{id}\", \"name\": \"{name}\", \"type\": \"thing\", \"attribute\": {{{attributes}}}, \"links\": [{links}]}}"
    )
}

/// A link without attributes.
pub(crate) fn link(source: u64, label: &str, target: u64) -> String {
    format!(
        "{{\"src\": \"{source}\", \"dst\": \"{target}\", \"label\": \"{label}\", \"linkAttribute\": {{}}}}"
    )
}

/// A scene of the root and one symbol 2 `hub` with these attributes.
pub(crate) fn with_attributes(attributes: &str) -> String {
    scene(&link(1, "RT", 2), &symbol(2, "hub", attributes, ""))
}

/// The faults of a text, read strictly under the open dictionary.
#[track_caller]
pub(crate) fn faults(text: &str) -> Vec<Fault> {
    Scene::read(text, &Dictionary::open(), Strictness::Strict)
        .expect_err("the scene should be refused")
        .faults
}

/// The faults of a text, as lines; each has a remedy.
#[track_caller]
pub(crate) fn fault_lines(text: &str) -> Vec<String> {
    let faults = faults(text);
    assert!(faults.iter().all(|fault| fault.kind.remedy().len() > 10));
    faults.iter().map(ToString::to_string).collect()
}

/// Reads strictly, writes, and reads again: the same state and root, the same text from then on, no note, a
/// well-formed state whose view needs no repair. `[property: SCENE-14]` `[property: SCENE-15]`
#[track_caller]
pub(crate) fn check_lossless(text: &str, dictionary: &Dictionary) -> Scene {
    let imported =
        Scene::read(text, dictionary, Strictness::Strict).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(imported.dropped, []);
    let scene = imported.scene;
    check_well_formed(&scene.state).unwrap();
    let graph = view(&scene.state, dictionary);
    assert_eq!(graph.repairs(), []);
    invariant::check_view(&graph).unwrap();
    let written = scene.written(dictionary);
    assert_eq!(written.notes, []);
    let again = Scene::read(&written.text, dictionary, Strictness::Strict).unwrap().scene;
    assert!(again == scene, "the state changed:\n{}", written.text);
    assert_eq!(again.write(dictionary), written.text);
    scene
}
