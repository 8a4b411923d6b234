//! Attribute values: a type number, then the payload. `[spec: ENC-7]`

use super::error::DecodeError;
use super::reader::Reader;
use super::writer;
use crate::limits;
use crate::value::{Value, ValueType};
use alloc::vec::Vec;

pub(super) fn write(out: &mut Vec<u8>, value: &Value) {
    out.push(value.value_type().number());
    match value {
        Value::String(text) => writer::bytes(out, text.as_bytes()),
        Value::Int(item) => writer::varint(out, zigzag(*item).into()),
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

pub(super) fn read(reader: &mut Reader<'_>) -> Result<Value, DecodeError> {
    let offset = reader.offset();
    let found = reader.byte()?;
    let tag = DecodeError::Tag { offset, what: "value type", found };
    Ok(match ValueType::from_number(found).ok_or(tag)? {
        ValueType::String => {
            let count = length(reader, 1)?;
            Value::String(reader.text(count)?.into())
        }
        ValueType::Int => Value::Int(unzigzag(word(reader, "an int")?)),
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
        ValueType::UInt => Value::UInt(word(reader, "a uint")?),
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

fn word(reader: &mut Reader<'_>, what: &'static str) -> Result<u32, DecodeError> {
    let offset = reader.offset();
    u32::try_from(reader.varint()?).or(Err(DecodeError::TooGreat { offset, what, max: u32::MAX.into() }))
}

/// Folds the sign into the lowest bit, so that small numbers stay short: 0, -1, 1, -2, … to 0, 1, 2, 3, …
fn zigzag(item: i32) -> u32 {
    ((item << 1) ^ (item >> 31)).cast_unsigned()
}

fn unzigzag(item: u32) -> i32 {
    (item >> 1).cast_signed() ^ -(item & 1).cast_signed()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `[spec: ENC-7]`
    #[test]
    fn law_zigzag_is_a_bijection_that_keeps_small_numbers_short() {
        for (item, folded) in
            [(0, 0), (-1, 1), (1, 2), (-2, 3), (i32::MAX, u32::MAX - 1), (i32::MIN, u32::MAX)]
        {
            assert_eq!(zigzag(item), folded);
            assert_eq!(unzigzag(folded), item);
        }
    }
}
