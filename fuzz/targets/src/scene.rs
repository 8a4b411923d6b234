//! Any text into the reader of scene files. `[spec: SCENE-1]` to `[spec: SCENE-15]`

use crate::laws;
use crate::target::{Broken, Marks, Outcome, equal, holds, variant};
use dsr_core::scene::{Fault, Imported, Scene, SceneError, Strictness};
use dsr_core::{Dictionary, check_well_formed, view};

/// A scene file, strictly and leniently, under an open dictionary and a closed one.
pub(crate) fn text(bytes: &[u8]) -> Outcome {
    let mut marks = Marks::default();
    let Ok(text) = std::str::from_utf8(bytes) else { return Ok(marks) };
    for dictionary in [Dictionary::open(), Dictionary::aal()] {
        let strict = Scene::read(text, &dictionary, Strictness::Strict);
        let lenient = Scene::read(text, &dictionary, Strictness::Lenient);
        faults_are_told(&strict, &lenient, &mut marks)?;
        for imported in [strict, lenient].into_iter().flatten() {
            marks.add(if imported.dropped.is_empty() { "accepted" } else { "accepted-in-part" });
            read_and_written(&imported.scene, &dictionary, &mut marks)?;
        }
    }
    Ok(marks)
}

/// What is refused strictly is refused or dropped leniently, and the other way round. `[spec: SCENE-4]`
/// `[spec: SCENE-5]`
fn faults_are_told(
    strict: &Result<Imported, SceneError>,
    lenient: &Result<Imported, SceneError>,
    marks: &mut Marks,
) -> Result<(), Broken> {
    let dropped: &[Fault] = match lenient {
        Ok(imported) => &imported.dropped,
        Err(error) => &error.faults,
    };
    for fault in dropped.iter().chain(strict.as_ref().err().map_or(&[][..], |error| &error.faults)) {
        marks.add(format!("fault-{}", variant(&fault.kind)));
        let is_told = fault.to_string().len() > 10 && fault.kind.remedy().len() > 10;
        holds("SCENE-4", is_told, || format!("no explanation or remedy: {fault:?}"))?;
    }
    match (strict, lenient) {
        (Ok(imported), _) => {
            holds("SCENE-4", imported.dropped.is_empty() && dropped.is_empty(), || format!("{dropped:#?}"))
        }
        (Err(refused), _) => {
            holds("SCENE-4", !refused.faults.is_empty(), || "refused without a fault".into())?;
            holds("SCENE-5", !dropped.is_empty(), || format!("dropped in silence: {refused}"))
        }
    }
}

/// A scene that was read is sound, and written it is read again as the same. `[spec: SCENE-14]`
/// `[spec: SCENE-15]`
pub(crate) fn read_and_written(
    scene: &Scene,
    dictionary: &Dictionary,
    marks: &mut Marks,
) -> Result<(), Broken> {
    equal("SCENE-14", "a state that was read", &check_well_formed(&scene.state), &Ok(()))?;
    let shown = view(&scene.state, dictionary);
    equal("SCENE-14", "its repairs", &shown.repairs(), &&[][..])?;
    laws::of_view(&shown)?;
    let written = scene.written(dictionary);
    equal("SCENE-15", "notes on a scene that was read", &written.notes, &Vec::new())?;
    let again = Scene::read(&written.text, dictionary, Strictness::Strict);
    let again = again.map_err(|error| Broken::new("SCENE-15", format!("{error}\n{}", written.text)))?;
    marks.add_if(scene.state.len() > 1, "written");
    equal("SCENE-15", "a scene, and what was written of it", scene, &again.scene)?;
    equal("SCENE-15", "what is written twice", &again.scene.write(dictionary), &written.text)
}
