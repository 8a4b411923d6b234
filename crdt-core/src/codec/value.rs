//! Attribute values. Their types stand in front of them: see the records. `[spec: ENC-7]`

use super::error::DecodeError;
use super::reader::Reader;
use super::{writer, zigzag};
use crate::limits;
use crate::value::{Value, ValueType};
use alloc::vec::Vec;

/// The payload of a value.
pub(super) fn write(out: &mut Vec<u8>, value: &Value) {
    match value {
        Value::String(text) => writer::bytes(out, text.as_bytes()),
        Value::Int(item) => writer::varint(out, zigzag::fold((*item).into())),
        Value::Bool(item) => out.push(u8::from(*item)),
        Value::ByteVec(bytes) => writer::bytes(out, bytes),
        Value::UInt(item) => writer::varint(out, (*item).into()),
        Value::UInt64(item) => writer::varint(out, *item),
        Value::Double(item) => out.extend_from_slice(&item.to_le_bytes()),
        Value::U64Vec(items) => {
            writer::count(out, items.len());
            for item in items.iter() {
                out.extend_from_slice(&item.to_le_bytes());
            }
        }
        Value::FloatVec(items) => {
            writer::count(out, items.len());
            floats(out, items);
        }
        Value::Float(_) | Value::Vec2(_) | Value::Vec3(_) | Value::Vec4(_) | Value::Vec6(_) => {
            floats(out, value.floats().unwrap_or_default());
        }
    }
}

fn floats(out: &mut Vec<u8>, items: &[f32]) {
    for item in items {
        out.extend_from_slice(&item.to_le_bytes());
    }
}

/// The value of a type whose payload follows.
pub(super) fn read(reader: &mut Reader<'_>, value_type: ValueType) -> Result<Value, DecodeError> {
    Ok(match value_type {
        ValueType::String => {
            let count = length(reader, 1)?;
            Value::String(reader.text(count)?.into())
        }
        ValueType::Int => Value::Int(int(reader)?),
        ValueType::Float => Value::Float(float(reader)?),
        ValueType::FloatVec => {
            let count = length(reader, size_of::<f32>())?;
            let bytes = reader.take(count.saturating_mul(size_of::<f32>()))?;
            Value::FloatVec(bytes.as_chunks().0.iter().map(|item| f32::from_le_bytes(*item)).collect())
        }
        ValueType::Bool => Value::Bool(truth(reader)?),
        ValueType::ByteVec => {
            let count = length(reader, 1)?;
            Value::ByteVec(reader.take(count)?.into())
        }
        ValueType::UInt => Value::UInt(word(reader)?),
        ValueType::UInt64 => Value::UInt64(reader.varint()?),
        ValueType::Double => Value::Double(f64::from_le_bytes(reader.array()?)),
        ValueType::U64Vec => {
            let count = length(reader, size_of::<u64>())?;
            let bytes = reader.take(count.saturating_mul(size_of::<u64>()))?;
            Value::U64Vec(bytes.as_chunks().0.iter().map(|item| u64::from_le_bytes(*item)).collect())
        }
        ValueType::Vec2 => Value::Vec2(vector(reader)?),
        ValueType::Vec3 => Value::Vec3(vector(reader)?),
        ValueType::Vec4 => Value::Vec4(vector(reader)?),
        ValueType::Vec6 => Value::Vec6(vector(reader)?),
    })
}

/// How many items a payload has, by their size.
fn length(reader: &mut Reader<'_>, bytes_each: usize) -> Result<usize, DecodeError> {
    reader.count(limits::VALUE_BYTES_MAX / bytes_each, bytes_each, "a length")
}

fn float(reader: &mut Reader<'_>) -> Result<f32, DecodeError> {
    Ok(f32::from_le_bytes(reader.array()?))
}

fn vector<const N: usize>(reader: &mut Reader<'_>) -> Result<[f32; N], DecodeError> {
    let mut items = [0.0; N];
    for item in &mut items {
        *item = float(reader)?;
    }
    Ok(items)
}

fn truth(reader: &mut Reader<'_>) -> Result<bool, DecodeError> {
    let offset = reader.offset();
    match reader.byte()? {
        0 => Ok(false),
        1 => Ok(true),
        found => Err(DecodeError::Tag { offset, what: "bool", found }),
    }
}

fn int(reader: &mut Reader<'_>) -> Result<i32, DecodeError> {
    let offset = reader.offset();
    let (what, max) = ("an int", u32::MAX.into());
    i32::try_from(zigzag::unfold(reader.varint()?)).or(Err(DecodeError::TooGreat { offset, what, max }))
}

fn word(reader: &mut Reader<'_>) -> Result<u32, DecodeError> {
    let offset = reader.offset();
    let (what, max) = ("a uint", u32::MAX.into());
    u32::try_from(reader.varint()?).or(Err(DecodeError::TooGreat { offset, what, max }))
}
