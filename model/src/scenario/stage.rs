//! The initial state: a scene, and mutations that dress it. `[spec: SCEN-2]`

use super::cursor::{Cursor, Read};
use super::error::Fault;
use super::format::Open;
use super::mutation::NamedMutation;
use super::scope::Scope;
use dsr_core::scene::{FLAT, Scene, Strictness, TINY};
use dsr_core::{Author, Dictionary, Name, Record, ReplicaId, State, view};
use std::collections::BTreeSet;

/// The scene that a scenario names or holds.
pub(super) fn read_scene(cursor: &Cursor<'_>, dictionary: &Dictionary, open: Open<'_>) -> Read<State> {
    let text = if cursor.value.is_object() {
        cursor.value.to_string()
    } else {
        match cursor.title()? {
            "@empty" => return Ok(State::new()),
            "@flat" => FLAT.to_owned(),
            "@tiny" => TINY.to_owned(),
            shipped if shipped.starts_with('@') => {
                let allowed = vec!["@flat", "@tiny", "@empty", "a path"];
                return cursor.fault(Fault::UnknownWord { word: shipped.into(), allowed });
            }
            path => open(path).or_else(|reason| {
                cursor.fault(Fault::Unreadable { reason: format!("the scene {path:?}: {reason}") })
            })?,
        }
    };
    match Scene::read(&text, dictionary, Strictness::Strict) {
        Ok(imported) => Ok(imported.scene.state),
        Err(error) => cursor.fault(Fault::Scene { reason: error.to_string() }),
    }
}

/// The names of all vertices.
pub(super) fn names_of(state: &State) -> BTreeSet<Name> {
    let vertices = state.records().filter_map(|(_, record)| match record {
        Record::Vertex(vertex) => Some(vertex.name.clone()),
        _ => None,
    });
    vertices.collect()
}

/// Makes one mutation of the setup, by the scene's author.
pub(super) fn set_up(state: &mut State, cursor: &Cursor<'_>, scope: &Scope) -> Read<()> {
    let named = NamedMutation::read(cursor, scope)?;
    let delta = {
        let view = view(state, &scope.dictionary);
        let mutation = match named.resolve(&view) {
            Ok(mutation) => mutation,
            Err(error) => return cursor.fault(Fault::Setup { reason: error.to_string() }),
        };
        match mutation.delta(&view, Author::new(ReplicaId::SCENE)) {
            Ok(delta) => delta,
            Err(error) => return cursor.fault(Fault::Setup { reason: error.to_string() }),
        }
    };
    state.join(&delta);
    Ok(())
}
