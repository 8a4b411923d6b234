//! Numbers that JSON's readers would bend: 64-bit integers and floats. `[spec: JSON-4]` `[spec: JSON-5]`

use alloc::format;
use core::fmt;
use serde::de::{Error, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The greatest integer up to which every JSON reader is exact: 2⁵³ − 1.
const EXACT_MAX: u64 = (1 << 53) - 1;

/// A 64-bit integer: written as a decimal string, read from one or from an exact number.
#[derive(Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Integer(pub(super) u64);

impl Serialize for Integer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&self.0)
    }
}

struct IntegerVisitor;

impl Visitor<'_> for IntegerVisitor {
    type Value = Integer;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a decimal string such as \"17\", or an integer from 0 to 2^53 - 1")
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Integer, E> {
        if number <= EXACT_MAX {
            Ok(Integer(number))
        } else {
            Err(E::invalid_value(Unexpected::Unsigned(number), &self))
        }
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Integer, E> {
        decimal(text).map(Integer).ok_or_else(|| E::invalid_value(Unexpected::Str(text), &self))
    }
}

impl<'de> Deserialize<'de> for Integer {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(IntegerVisitor)
    }
}

/// A decimal number in its one spelling: digits, no sign, no leading zero.
pub(super) fn decimal(text: &str) -> Option<u64> {
    let one_spelling =
        text == "0" || (!text.starts_with('0') && text.bytes().all(|byte| byte.is_ascii_digit()));
    if one_spelling { text.parse().ok() } else { None }
}

/// A 32-bit float, by its shortest decimal; what JSON has no number for is a string.
#[derive(Clone, Copy)]
pub(super) struct Float32(pub(super) f32);

/// A 64-bit float, by its shortest decimal; what JSON has no number for is a string.
#[derive(Clone, Copy)]
pub(super) struct Float64(pub(super) f64);

impl Serialize for Float32 {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if !self.0.is_finite() {
            return Float64(self.0.into()).serialize(serializer);
        }
        // By way of the decimal: widening 0.1 to 64 bits would print 0.10000000149011612 wherever the
        // serialiser keeps all floats in 64 bits.
        let shortest = format!("{}", self.0).parse().unwrap_or_else(|_| f64::from(self.0));
        serializer.serialize_f64(shortest)
    }
}

impl Serialize for Float64 {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.0.is_finite() {
            serializer.serialize_f64(self.0)
        } else if self.0.is_nan() {
            serializer.serialize_str("NaN")
        } else {
            serializer.serialize_str(if self.0 > 0.0 { "inf" } else { "-inf" })
        }
    }
}

struct FloatVisitor;

impl Visitor<'_> for FloatVisitor {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, \"NaN\", \"inf\" or \"-inf\"")
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<f64, E> {
        if number.is_finite() { Ok(number) } else { Err(E::invalid_value(Unexpected::Float(number), &self)) }
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<f64, E> {
        #[allow(clippy::cast_precision_loss, reason = "a decimal is read as the float nearest to it")]
        Ok(number as f64)
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<f64, E> {
        #[allow(clippy::cast_precision_loss, reason = "a decimal is read as the float nearest to it")]
        Ok(number as f64)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<f64, E> {
        match text {
            "NaN" => Ok(f64::from_bits(0x7ff8_0000_0000_0000)),
            "inf" => Ok(f64::INFINITY),
            "-inf" => Ok(f64::NEG_INFINITY),
            _ => Err(E::invalid_value(Unexpected::Str(text), &self)),
        }
    }
}

impl<'de> Deserialize<'de> for Float64 {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(FloatVisitor).map(Self)
    }
}

impl<'de> Deserialize<'de> for Float32 {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let wide = Float64::deserialize(deserializer)?.0;
        if wide.is_nan() {
            return Ok(Self(f32::from_bits(0x7fc0_0000)));
        }
        #[allow(clippy::cast_possible_truncation, reason = "a decimal is read as the float nearest to it")]
        let narrow = wide as f32;
        if narrow.is_infinite() && wide.is_finite() {
            return Err(D::Error::custom(format!("{wide:e} is beyond the range of a 32-bit float")));
        }
        Ok(Self(narrow))
    }
}
