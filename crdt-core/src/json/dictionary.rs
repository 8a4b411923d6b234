//! Dictionaries as data files. `[spec: JSON-7]`

use super::map::{UniqueMap, UniqueSet};
use crate::dictionary::Dictionary;
use crate::limits;
use crate::record::{Name, RT};
use crate::value::ValueType;
use alloc::format;
use alloc::string::String;
use serde::de::Error;
use serde::ser::SerializeStruct;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

impl Serialize for Dictionary {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut form = serializer.serialize_struct("Dictionary", 5)?;
        form.serialize_field("closed", &self.closed)?;
        form.serialize_field("vertex_types", &self.vertex_types)?;
        form.serialize_field("edge_labels", &self.edge_labels)?;
        form.serialize_field("functional_labels", &self.functional_labels)?;
        form.serialize_field("attributes", &self.attributes)?;
        form.end()
    }
}

/// What is read: a part that is left out is empty, and `closed` left out is false.
#[derive(Deserialize)]
#[serde(rename = "Dictionary", deny_unknown_fields)]
struct Form {
    #[serde(default)]
    closed: bool,
    #[serde(default)]
    vertex_types: UniqueSet<Name>,
    #[serde(default)]
    edge_labels: UniqueSet<Name>,
    #[serde(default)]
    functional_labels: UniqueSet<Name>,
    #[serde(default)]
    attributes: UniqueMap<Name, ValueType>,
}

impl<'de> Deserialize<'de> for Dictionary {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let form = Form::deserialize(deserializer)?;
        let dictionary = Self {
            closed: form.closed,
            vertex_types: form.vertex_types.0,
            edge_labels: form.edge_labels.0,
            functional_labels: form.functional_labels.0,
            attributes: form.attributes.0,
        };
        match fault(&dictionary) {
            Some(fault) => Err(D::Error::custom(fault)),
            None => Ok(dictionary),
        }
    }
}

/// What cannot be meant in a dictionary, as a message.
fn fault(dictionary: &Dictionary) -> Option<String> {
    let Dictionary { vertex_types, edge_labels, functional_labels, attributes, closed } = dictionary;
    let names = vertex_types.iter().chain(edge_labels).chain(functional_labels).chain(attributes.keys());
    for name in names {
        let bytes = name.len();
        if bytes == 0 || bytes > limits::NAME_BYTES_MAX {
            return Some(format!(
                "the name {name:?} has {bytes} bytes; allowed are 1 to {}",
                limits::NAME_BYTES_MAX
            ));
        }
    }
    if functional_labels.contains(RT) {
        return Some(format!("{RT:?} is never functional: it is unique per child instead [DICT-3]"));
    }
    let undeclared = functional_labels.iter().find(|label| *closed && !edge_labels.contains(*label));
    undeclared.map(|label| {
        format!("functional label {label:?} is not among the edge_labels of this closed dictionary")
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    const SMALL: &str = r#"{"closed":true,"vertex_types":["robot","room"],"edge_labels":["RT","in"],"functional_labels":["in"],"attributes":{"level":"int","pose":"vec6"}}"#;

    /// `[spec: JSON-7]`
    #[test]
    fn law_dictionaries_round_trip() {
        let dictionary: Dictionary = serde_json::from_str(SMALL).unwrap();
        assert!(dictionary.closed && dictionary.is_functional("in"));
        assert_eq!(dictionary.attribute_type("level"), Some(ValueType::Int));
        assert_eq!(serde_json::to_string(&dictionary).unwrap(), SMALL);
        assert_eq!(serde_json::from_str::<Dictionary>("{}").unwrap(), Dictionary::open());
    }

    /// `[spec: JSON-2]` `[spec: JSON-7]`
    #[test]
    fn law_dictionaries_that_cannot_be_meant_are_refused() {
        for (text, expected) in [
            (r#"{"attributes": {"level": "int", "level": "int"}}"#, "twice"),
            (r#"{"vertex_types": ["robot", "robot"]}"#, "twice"),
            (r#"{"attribute": {}}"#, "unknown field"),
            (r#"{"attributes": {"level": "integer"}}"#, "a value type such as"),
            (r#"{"functional_labels": ["RT"]}"#, "never functional"),
            (r#"{"closed": true, "functional_labels": ["in"]}"#, "not among the edge_labels"),
            (r#"{"edge_labels": [""]}"#, "has 0 bytes"),
        ] {
            let error = serde_json::from_str::<Dictionary>(text).unwrap_err().to_string();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }
}
