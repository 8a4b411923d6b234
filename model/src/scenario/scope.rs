//! The names that mean something in a scenario. `[spec: SCEN-14]`

use super::cursor::{Cursor, Read, entries};
use super::error::{Fault, nearest};
use dsr_core::{AttributeMap, AttributeUpdates, Dictionary, Name, Value, is_root_name, limits};
use serde_json::{Value as Json, json};
use std::collections::BTreeSet;

/// What replicas can ever name: a name outside matches nothing for ever, which is never meant.
#[derive(Clone, Debug)]
pub(super) struct Scope {
    /// The dictionary.
    pub(super) dictionary: Dictionary,
    /// Vertices' names, of the initial graph and of whatever scripts add.
    pub(super) names: BTreeSet<Name>,
    /// Whether free alphabets add vertices, whose names are made up.
    pub(super) invented: bool,
    /// Replicas' names.
    pub(super) replicas: Vec<String>,
}

impl Scope {
    /// A vertex's name.
    pub(super) fn vertex(&self, cursor: &Cursor<'_>) -> Read<Name> {
        let name = cursor.title()?;
        let invented = self.invented && (name.starts_with('@') || name == "twin");
        if is_root_name(name) || invented || self.names.contains(name) {
            return Ok(name.into());
        }
        let what = "vertex in the scene, the setup or any script called";
        let nearest = nearest(name, self.names.iter().map(|name| &**name));
        cursor.fault(Fault::UnknownName { what, name: name.into(), nearest })
    }

    /// The name of a vertex to add.
    pub(super) fn new_vertex(cursor: &Cursor<'_>) -> Read<Name> {
        let name = cursor.title()?;
        if is_root_name(name) {
            return cursor.fault(Fault::Repeated { what: "vertex, the root,", name: name.into() });
        }
        checked_length(cursor, name)
    }

    /// An edge's label.
    pub(super) fn label(&self, cursor: &Cursor<'_>) -> Read<Name> {
        let label = cursor.title()?;
        if self.dictionary.allows_label(label) {
            return checked_length(cursor, label);
        }
        let nearest = nearest(label, self.dictionary.edge_labels.iter().map(|name| &**name));
        cursor.fault(Fault::UnknownName {
            what: "edge label in the dictionary called",
            name: label.into(),
            nearest,
        })
    }

    /// A vertex's type.
    pub(super) fn vertex_type(&self, cursor: &Cursor<'_>) -> Read<Name> {
        let name = cursor.title()?;
        if self.dictionary.allows_type(name) {
            return checked_length(cursor, name);
        }
        let nearest = nearest(name, self.dictionary.vertex_types.iter().map(|name| &**name));
        cursor.fault(Fault::UnknownName {
            what: "vertex type in the dictionary called",
            name: name.into(),
            nearest,
        })
    }

    /// An attribute's name.
    pub(super) fn attribute(&self, cursor: &Cursor<'_>, name: &str) -> Read<Name> {
        if !self.dictionary.closed || self.dictionary.attribute_type(name).is_some() {
            return checked_length(cursor, name);
        }
        let nearest = nearest(name, self.dictionary.attributes.keys().map(|name| &**name));
        cursor.fault(Fault::UnknownName {
            what: "attribute in the dictionary called",
            name: name.into(),
            nearest,
        })
    }

    /// A value of an attribute: typed, or plain where the dictionary or the form says the type. `[spec: SCEN-3]`
    pub(super) fn value(&self, name: &str, cursor: &Cursor<'_>) -> Read<Value> {
        let bad = |reason: String| cursor.fault(Fault::BadValue { name: name.into(), reason });
        let declared = self.dictionary.attribute_type(name);
        let typed = match (cursor.value, declared) {
            (Json::Object(_), _) => cursor.value.clone(),
            (plain, Some(declared)) => json!({ "type": declared.name(), "value": plain }),
            (Json::String(_), None) => json!({ "type": "string", "value": cursor.value }),
            (Json::Bool(_), None) => json!({ "type": "bool", "value": cursor.value }),
            _ => return bad(r#"the dictionary declares no type: write {"type": "int", "value": 5}"#.into()),
        };
        let value: Value = match serde_json::from_value(typed) {
            Ok(value) => value,
            Err(error) => {
                let declared = declared.map(|it| format!(" (it is declared as {it})")).unwrap_or_default();
                return bad(format!("{error}{declared}"));
            }
        };
        match declared {
            Some(declared) if declared != value.value_type() => {
                bad(format!("it is declared as {declared}, not {}", value.value_type()))
            }
            _ => Ok(value.with_canonical_nans()),
        }
    }

    /// The attributes of a new element; none if they are left out.
    pub(super) fn attributes(&self, cursor: Option<&Cursor<'_>>) -> Read<AttributeMap> {
        let Some(cursor) = cursor else { return Ok(AttributeMap::new()) };
        let read = |(name, value): (&str, Cursor<'_>)| {
            Ok((self.attribute(&value, name)?, self.value(name, &value)?))
        };
        entries(cursor)?.into_iter().map(read).collect()
    }

    /// Attributes to set, or with `null` to unset.
    pub(super) fn updates(&self, cursor: &Cursor<'_>) -> Read<AttributeUpdates> {
        let read = |(name, value): (&str, Cursor<'_>)| {
            let set = if value.value.is_null() { None } else { Some(self.value(name, &value)?) };
            Ok((self.attribute(&value, name)?, set))
        };
        let updates: AttributeUpdates = entries(cursor)?.into_iter().map(read).collect::<Read<_>>()?;
        if updates.is_empty() { cursor.fault(Fault::Empty { what: "attributes" }) } else { Ok(updates) }
    }

    /// A replica's index.
    pub(super) fn replica(&self, cursor: &Cursor<'_>) -> Read<usize> {
        let name = cursor.text()?;
        if let Some(at) = self.replicas.iter().position(|known| known == name) {
            return Ok(at);
        }
        let nearest = nearest(name, self.replicas.iter().map(String::as_str));
        cursor.fault(Fault::UnknownName { what: "replica called", name: name.into(), nearest })
    }
}

fn checked_length(cursor: &Cursor<'_>, name: &str) -> Read<Name> {
    if name.len() > limits::NAME_BYTES_MAX {
        return cursor.fault(Fault::TooMany {
            what: "bytes in a name",
            count: name.len(),
            most: limits::NAME_BYTES_MAX,
        });
    }
    Ok(name.into())
}
