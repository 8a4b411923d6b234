//! Attribute values.

use dsr_core::Value;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

/// A value as the project writes it: `{"type": "uint64", "value": "7"}`. Reading makes NaNs canonical, so that equal
/// means equal. `[spec: CONF-6]`
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, JsonSchema)]
#[serde(transparent)]
pub struct Tagged(#[schemars(with = "Form")] pub Value);

/// What the schema says of a value; the members are read by the core.
#[derive(JsonSchema)]
#[schemars(rename = "Value", deny_unknown_fields)]
#[expect(dead_code, reason = "only its schema is used")]
struct Form {
    /// One of the fourteen types.
    r#type: TypeName,
    /// As in the chapter on encodings, JSON-4 to JSON-6.
    value: serde_json::Value,
}

#[derive(JsonSchema)]
#[schemars(rename = "ValueType", rename_all = "snake_case")]
#[expect(dead_code, reason = "only its schema is used")]
enum TypeName {
    String,
    Int,
    Float,
    FloatVec,
    Bool,
    ByteVec,
    Uint,
    Uint64,
    Double,
    U64Vec,
    Vec2,
    Vec3,
    Vec4,
    Vec6,
}

impl<'de> Deserialize<'de> for Tagged {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Value::deserialize(deserializer).map(|value| Self(value.with_canonical_nans()))
    }
}
