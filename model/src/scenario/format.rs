//! The file. `[spec: SCEN-1]` `[spec: SCEN-2]`

use super::Scenario;
use super::cursor::{Cursor, Read, Unique, entries};
use super::error::{Fault, Misfit, ScenarioError};
use super::mutation::NamedMutation;
use super::predicate::Atoms;
use super::property::Property;
use super::scope::Scope;
use super::script::{Replica, read_kinds};
use super::stage;
use dsr_core::{Dictionary, MutationKind, VertexId, view};
use std::collections::BTreeSet;

/// The largest scenario file, in bytes.
const BYTES_MAX: usize = 1 << 20;
/// The most replicas.
const REPLICAS_MAX: usize = 6;
/// The most mutations of a setup.
const SETUP_MAX: usize = 64;
/// The most properties.
const PROPERTIES_MAX: usize = 64;
/// The most vertices in focus.
const FOCUS_MAX: usize = 16;

const FIELDS: &[&str] =
    &["format", "name", "about", "scene", "dictionary", "setup", "focus", "replicas", "properties"];

/// Opens a scene file that a scenario names by its path.
pub(super) type Open<'o> = &'o dyn Fn(&str) -> Result<String, String>;

/// Reads a scenario. `[spec: SCEN-1]`
pub(super) fn read(text: &str, file: &str, open: Open<'_>) -> Result<Scenario, ScenarioError> {
    let whole = |fault| ScenarioError { file: file.into(), path: String::new(), fault };
    if text.len() > BYTES_MAX {
        return Err(whole(Fault::TooLarge { bytes: text.len(), most: BYTES_MAX }));
    }
    let Unique(json) =
        serde_json::from_str(text).map_err(|error| whole(Fault::Syntax { reason: error.to_string() }))?;
    read_scenario(&Cursor::top(&json), open).map_err(|misfit: Box<Misfit>| misfit.in_file(file))
}

fn read_scenario(top: &Cursor<'_>, open: Open<'_>) -> Read<Scenario> {
    let object = top.object(FIELDS)?;
    object.need("format")?.whole(1, 1)?;
    let name = object.need("name")?.title()?.to_owned();
    let about = object.need("about")?.text()?.to_owned();
    let dictionary = match object.get("dictionary") {
        Some(cursor) => read_dictionary(&cursor)?,
        None => Dictionary::aal(),
    };
    let replicas = object.need("replicas")?.list("list of replicas", 1, REPLICAS_MAX)?;
    let mut initial = match object.get("scene") {
        Some(scene) => stage::read_scene(&scene, &dictionary, open)?,
        None => dsr_core::State::new(),
    };
    let mut scope = Scope { dictionary, names: BTreeSet::new(), invented: false, replicas: Vec::new() };
    scope.names = stage::names_of(&initial);
    if let Some(setup) = object.get("setup") {
        for mutation in setup.list("setup", 0, SETUP_MAX)? {
            stage::set_up(&mut initial, &mutation, &scope)?;
            scope.names = stage::names_of(&initial);
        }
    }
    let mut focus = Vec::new();
    if let Some(list) = object.get("focus") {
        let known = view(&initial, &scope.dictionary);
        for item in list.list("focus", 0, FOCUS_MAX)? {
            // A name that the scope knows at this point is in the initial graph.
            focus.push(known.vertex_by_name(&scope.vertex(&item)?).unwrap_or(VertexId::ROOT));
        }
    }
    for replica in &replicas {
        foresee(replica, &mut scope)?;
    }
    let mut atoms = Atoms::default();
    let replicas = replicas
        .iter()
        .map(|replica| Replica::read(replica, &scope, &mut atoms))
        .collect::<Read<Vec<_>>>()?;
    let properties = read_properties(&object.need("properties")?, &scope, &mut atoms)?;
    Ok(Scenario { name, about, dictionary: scope.dictionary, initial, focus, replicas, atoms, properties })
}

/// What a replica is called and which vertices it will add: others may name both.
fn foresee(replica: &Cursor<'_>, scope: &mut Scope) -> Read<()> {
    let object = replica.object(&["name", "about", "script", "alphabet", "budget"])?;
    let cursor = object.need("name")?;
    let name = cursor.title()?;
    if scope.replicas.iter().any(|known| known == name) {
        return cursor.fault(Fault::Repeated { what: "replica", name: name.into() });
    }
    scope.replicas.push(name.into());
    if let Some(alphabet) = object.get("alphabet") {
        scope.invented |= read_kinds(&alphabet)?.contains(&MutationKind::AddVertex);
    }
    // Forms are judged later; here only names are wanted.
    let steps = object.get("script").and_then(|script| script.list("script", 0, usize::MAX).ok());
    for step in steps.unwrap_or_default() {
        let Ok(fields) = entries(&step) else { continue };
        for (_, group) in fields.iter().filter(|(field, _)| *field == "do") {
            let list = group.list("list of mutations", 0, usize::MAX).unwrap_or_else(|_| vec![group.clone()]);
            scope.names.extend(list.iter().filter_map(NamedMutation::name_added));
        }
    }
    Ok(())
}

fn read_properties(cursor: &Cursor<'_>, scope: &Scope, atoms: &mut Atoms) -> Read<Vec<Property>> {
    let mut properties: Vec<Property> = Vec::new();
    for item in cursor.list("list of properties", 1, PROPERTIES_MAX)? {
        let property = Property::read(&item, scope, atoms)?;
        if properties.iter().any(|known| known.name == property.name) {
            return item.fault(Fault::Repeated { what: "property", name: property.name });
        }
        properties.push(property);
    }
    Ok(properties)
}

fn read_dictionary(cursor: &Cursor<'_>) -> Read<Dictionary> {
    if cursor.value.is_object() {
        return serde_json::from_value(cursor.value.clone())
            .or_else(|error| cursor.fault(Fault::Dictionary { reason: error.to_string() }));
    }
    let shipped: fn() -> Dictionary = cursor.word(&[
        ("@aal", Dictionary::aal as fn() -> Dictionary),
        ("@published", Dictionary::published),
        ("@open", Dictionary::open),
    ])?;
    Ok(shipped())
}
