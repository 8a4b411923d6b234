//! Attribute values: `{"type": "int", "value": 5}`. `[spec: JSON-6]`

use super::number::{Float32, Float64, Integer};
use crate::value::Value;
use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::de::Error;
use serde::ser::SerializeStruct;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A list of items, each in its own form.
struct List<'a, T, F>(&'a [T], fn(T) -> F);

impl<T: Copy, F: Serialize> Serialize for List<'_, T, F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.iter().map(|&item| (self.1)(item)))
    }
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut form = serializer.serialize_struct("Value", 2)?;
        form.serialize_field("type", self.value_type().name())?;
        match self {
            Self::String(text) => form.serialize_field("value", &**text),
            Self::Int(item) => form.serialize_field("value", item),
            Self::Bool(item) => form.serialize_field("value", item),
            Self::ByteVec(bytes) => form.serialize_field("value", &STANDARD.encode(bytes)),
            Self::UInt(item) => form.serialize_field("value", item),
            Self::UInt64(item) => form.serialize_field("value", &Integer(*item)),
            Self::Float(item) => form.serialize_field("value", &Float32(*item)),
            Self::Double(item) => form.serialize_field("value", &Float64(*item)),
            Self::U64Vec(items) => form.serialize_field("value", &List(items, Integer)),
            Self::FloatVec(_) | Self::Vec2(_) | Self::Vec3(_) | Self::Vec4(_) | Self::Vec6(_) => {
                form.serialize_field("value", &List(self.floats().unwrap_or_default(), Float32))
            }
        }?;
        form.end()
    }
}

/// What is read. The names are those of [`crate::ValueType::name`].
#[derive(Deserialize)]
#[serde(tag = "type", content = "value", rename = "value", deny_unknown_fields)]
enum Form {
    #[serde(rename = "string")]
    String(Arc<str>),
    #[serde(rename = "int")]
    Int(i32),
    #[serde(rename = "float")]
    Float(Float32),
    #[serde(rename = "float_vec")]
    FloatVec(Vec<Float32>),
    #[serde(rename = "bool")]
    Bool(bool),
    #[serde(rename = "byte_vec")]
    ByteVec(String),
    #[serde(rename = "uint")]
    UInt(u32),
    #[serde(rename = "uint64")]
    UInt64(Integer),
    #[serde(rename = "double")]
    Double(Float64),
    #[serde(rename = "u64_vec")]
    U64Vec(Vec<Integer>),
    #[serde(rename = "vec2")]
    Vec2([Float32; 2]),
    #[serde(rename = "vec3")]
    Vec3([Float32; 3]),
    #[serde(rename = "vec4")]
    Vec4([Float32; 4]),
    #[serde(rename = "vec6")]
    Vec6([Float32; 6]),
}

fn items<const N: usize>(items: [Float32; N]) -> [f32; N] {
    items.map(|item| item.0)
}

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(match Form::deserialize(deserializer)? {
            Form::String(text) => Self::String(text),
            Form::Int(item) => Self::Int(item),
            Form::Float(item) => Self::Float(item.0),
            Form::FloatVec(items) => Self::FloatVec(items.into_iter().map(|item| item.0).collect()),
            Form::Bool(item) => Self::Bool(item),
            Form::ByteVec(text) => {
                let bytes = STANDARD.decode(text);
                let bytes = bytes
                    .map_err(|error| D::Error::custom(format_args!("byte_vec is not base64: {error}")))?;
                Self::ByteVec(bytes.into())
            }
            Form::UInt(item) => Self::UInt(item),
            Form::UInt64(item) => Self::UInt64(item.0),
            Form::Double(item) => Self::Double(item.0),
            Form::U64Vec(items) => Self::U64Vec(items.into_iter().map(|item| item.0).collect()),
            Form::Vec2(pair) => Self::Vec2(items(pair)),
            Form::Vec3(triple) => Self::Vec3(items(triple)),
            Form::Vec4(four) => Self::Vec4(items(four)),
            Form::Vec6(six) => Self::Vec6(items(six)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    /// Reads a text, and checks that it is what is written back.
    #[track_caller]
    fn check(value: &Value, text: &str) {
        assert_eq!(serde_json::to_string(value).unwrap(), text);
        assert_eq!(
            serde_json::to_value(value).unwrap().to_string().parse::<serde_json::Value>().unwrap(),
            text.parse::<serde_json::Value>().unwrap()
        );
        assert_eq!(&serde_json::from_str::<Value>(text).unwrap(), value);
    }

    /// `[spec: JSON-6]` `[spec: JSON-4]` `[spec: JSON-5]`
    #[test]
    fn law_each_type_has_one_text() {
        check(&"a\"b".into(), r#"{"type":"string","value":"a\"b"}"#);
        check(&Value::Int(-5), r#"{"type":"int","value":-5}"#);
        check(&Value::Float(0.1), r#"{"type":"float","value":0.1}"#);
        check(&Value::Float(-0.0), r#"{"type":"float","value":-0.0}"#);
        check(
            &vec_of(&[f32::MIN_POSITIVE, f32::MAX]),
            r#"{"type":"float_vec","value":[1.1754944e-38,3.4028235e+38]}"#,
        );
        check(&Value::Bool(true), r#"{"type":"bool","value":true}"#);
        check(&Value::ByteVec([0, 255, 7].as_slice().into()), r#"{"type":"byte_vec","value":"AP8H"}"#);
        check(&Value::UInt(7), r#"{"type":"uint","value":7}"#);
        check(&Value::UInt64(u64::MAX), r#"{"type":"uint64","value":"18446744073709551615"}"#);
        check(&Value::Double(0.1), r#"{"type":"double","value":0.1}"#);
        check(&Value::Double(f64::NEG_INFINITY), r#"{"type":"double","value":"-inf"}"#);
        check(
            &Value::U64Vec([1, u64::MAX].as_slice().into()),
            r#"{"type":"u64_vec","value":["1","18446744073709551615"]}"#,
        );
        check(&Value::Vec2([1.0, f32::INFINITY]), r#"{"type":"vec2","value":[1.0,"inf"]}"#);
        let nan = Value::Vec3([1.0, 2.0, f32::NAN]).with_canonical_nans();
        check(&nan, r#"{"type":"vec3","value":[1.0,2.0,"NaN"]}"#);
        check(&Value::Vec4([1.0, 2.0, 3.0, 4.5]), r#"{"type":"vec4","value":[1.0,2.0,3.0,4.5]}"#);
        check(&Value::Vec6([0.0; 6]), r#"{"type":"vec6","value":[0.0,0.0,0.0,0.0,0.0,0.0]}"#);
    }

    fn vec_of(items: &[f32]) -> Value {
        Value::FloatVec(items.into())
    }

    #[track_caller]
    fn check_read(text: &str, expected: Result<Value, &str>) {
        match (serde_json::from_str::<Value>(text), expected) {
            (Ok(value), Ok(expected)) => assert_eq!(value, expected),
            (Err(error), Err(expected)) => assert!(error.to_string().contains(expected), "{error}"),
            (found, expected) => panic!("{text}: found {found:?}, expected {expected:?}"),
        }
    }

    /// `[spec: JSON-2]` `[spec: JSON-4]` `[spec: JSON-5]` `[spec: JSON-6]`
    #[test]
    fn law_reading_is_lenient_only_where_it_is_exact() {
        check_read(r#"{"value":5,"type":"uint64"}"#, Ok(Value::UInt64(5)));
        check_read(r#"{"type":"uint64","value":9007199254740991}"#, Ok(Value::UInt64((1 << 53) - 1)));
        check_read(
            r#"{"type":"uint64","value":9007199254740992}"#,
            Err("invalid value: integer `9007199254740992`"),
        );
        check_read(r#"{"type":"uint64","value":"05"}"#, Err("decimal string"));
        check_read(r#"{"type":"uint64","value":"18446744073709551616"}"#, Err("decimal string"));
        check_read(r#"{"type":"float","value":5}"#, Ok(Value::Float(5.0)));
        check_read(r#"{"type":"float","value":1e39}"#, Err("beyond the range of a 32-bit float"));
        check_read(r#"{"type":"float","value":"nan"}"#, Err("\"NaN\""));
        check_read(r#"{"type":"int","value":2147483648}"#, Err("i32"));
        check_read(r#"{"type":"int","value":5.0}"#, Err("floating point"));
        check_read(r#"{"type":"vec2","value":[1,2,3]}"#, Err("trailing"));
        check_read(r#"{"type":"byte_vec","value":"AP8"}"#, Err("not base64"));
        check_read(r#"{"type":"byte_vec","value":"AP9="}"#, Err("not base64"));
        check_read(r#"{"type":"int32","value":5}"#, Err("unknown variant"));
        check_read(r#"{"type":"int","value":5,"unit":"m"}"#, Err("unit"));
        check_read(r#"{"type":"int","value":5,"value":6}"#, Err("duplicate field"));
    }
}
