//! Ids and names of kinds as strings. `[spec: JSON-3]`

use crate::dot::{Dot, EdgeId, ReplicaId, VertexId};
use crate::mutation::MutationKind;
use crate::value::ValueType;
use core::fmt;
use serde::de::{Error, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Reads a string with a parser; `None` means that it is not the form expected.
pub(super) struct Text<T> {
    pub(super) expected: &'static str,
    pub(super) parse: fn(&str) -> Option<T>,
}

impl<T> Visitor<'_> for Text<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.expected)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<T, E> {
        (self.parse)(text).ok_or_else(|| E::invalid_value(Unexpected::Str(text), &self))
    }
}

macro_rules! text_form {
    ($($name:ty, $expected:literal, $parse:expr;)*) => {
        $(
            impl Serialize for $name {
                fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                    serializer.collect_str(self)
                }
            }

            impl<'de> Deserialize<'de> for $name {
                fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                    deserializer.deserialize_str(Text { expected: $expected, parse: $parse })
                }
            }
        )*
    };
}

text_form! {
    ReplicaId, "a replica such as `r3`, or `r3+1` for a later incarnation", |text| text.parse().ok();
    Dot, "a dot such as `r3.17`", |text| text.parse().ok();
    VertexId, "a vertex such as `r3.17`, or `root`", |text| text.parse().ok();
    EdgeId, "an edge such as `r3.17`", |text| text.parse().ok();
    ValueType, "a value type such as `int` or `float_vec`", ValueType::from_name;
}

impl Serialize for MutationKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for MutationKind {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a mutation such as `add_vertex`";
        deserializer.deserialize_str(Text { expected, parse: Self::from_name })
    }
}
