//! Attribute values: the fourteen types of the published system, with its type numbers. `[spec: VALUE-1]`

use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::cmp::Ordering;
use core::fmt;
use core::hash::{Hash, Hasher};

/// The type of a value; the discriminant is the published type number. `[spec: VALUE-1]`
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[repr(u8)]
pub enum ValueType {
    /// UTF-8 text.
    String = 0,
    /// Signed 32-bit integer.
    Int = 1,
    /// 32-bit float.
    Float = 2,
    /// Vector of 32-bit floats.
    FloatVec = 3,
    /// Truth value.
    Bool = 4,
    /// Bytes.
    ByteVec = 5,
    /// Unsigned 32-bit integer.
    UInt = 6,
    /// Unsigned 64-bit integer.
    UInt64 = 7,
    /// 64-bit float.
    Double = 8,
    /// Vector of unsigned 64-bit integers.
    U64Vec = 9,
    /// Two 32-bit floats.
    Vec2 = 10,
    /// Three 32-bit floats.
    Vec3 = 11,
    /// Four 32-bit floats.
    Vec4 = 12,
    /// Six 32-bit floats.
    Vec6 = 13,
}

impl ValueType {
    /// All fourteen, in the order of their numbers.
    pub const ALL: [Self; 14] = [
        Self::String,
        Self::Int,
        Self::Float,
        Self::FloatVec,
        Self::Bool,
        Self::ByteVec,
        Self::UInt,
        Self::UInt64,
        Self::Double,
        Self::U64Vec,
        Self::Vec2,
        Self::Vec3,
        Self::Vec4,
        Self::Vec6,
    ];

    /// The published type number, 0 to 13.
    pub const fn number(self) -> u8 {
        self as u8
    }

    /// The type of a published number.
    pub fn from_number(number: u8) -> Option<Self> {
        Self::ALL.get(usize::from(number)).copied()
    }

    /// The name used in dictionaries and messages, such as `float_vec`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::String => "string",
            Self::Int => "int",
            Self::Float => "float",
            Self::FloatVec => "float_vec",
            Self::Bool => "bool",
            Self::ByteVec => "byte_vec",
            Self::UInt => "uint",
            Self::UInt64 => "uint64",
            Self::Double => "double",
            Self::U64Vec => "u64_vec",
            Self::Vec2 => "vec2",
            Self::Vec3 => "vec3",
            Self::Vec4 => "vec4",
            Self::Vec6 => "vec6",
        }
    }

    /// The type of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|value_type| value_type.name() == name)
    }
}

impl fmt::Display for ValueType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// An attribute's value. Cloning never copies a payload: text and vectors are shared. `[spec: VALUE-2]`
///
/// Equality and order are by type number and then by bits (floats by IEEE 754 total order), so that they
/// agree with the canonical encoding: `0.0` and `-0.0` differ, and a NaN equals itself. `[spec: VALUE-3]`
#[derive(Clone, Debug)]
pub enum Value {
    /// Type 0.
    String(Arc<str>),
    /// Type 1.
    Int(i32),
    /// Type 2.
    Float(f32),
    /// Type 3.
    FloatVec(Arc<[f32]>),
    /// Type 4.
    Bool(bool),
    /// Type 5.
    ByteVec(Arc<[u8]>),
    /// Type 6.
    UInt(u32),
    /// Type 7.
    UInt64(u64),
    /// Type 8.
    Double(f64),
    /// Type 9.
    U64Vec(Arc<[u64]>),
    /// Type 10.
    Vec2([f32; 2]),
    /// Type 11.
    Vec3([f32; 3]),
    /// Type 12.
    Vec4([f32; 4]),
    /// Type 13.
    Vec6([f32; 6]),
}

impl Value {
    /// Which of the fourteen types this is.
    pub const fn value_type(&self) -> ValueType {
        match self {
            Self::String(_) => ValueType::String,
            Self::Int(_) => ValueType::Int,
            Self::Float(_) => ValueType::Float,
            Self::FloatVec(_) => ValueType::FloatVec,
            Self::Bool(_) => ValueType::Bool,
            Self::ByteVec(_) => ValueType::ByteVec,
            Self::UInt(_) => ValueType::UInt,
            Self::UInt64(_) => ValueType::UInt64,
            Self::Double(_) => ValueType::Double,
            Self::U64Vec(_) => ValueType::U64Vec,
            Self::Vec2(_) => ValueType::Vec2,
            Self::Vec3(_) => ValueType::Vec3,
            Self::Vec4(_) => ValueType::Vec4,
            Self::Vec6(_) => ValueType::Vec6,
        }
    }

    /// The payload's size in bytes, without its type number or length.
    pub fn payload_bytes(&self) -> usize {
        match self {
            Self::String(text) => text.len(),
            Self::Bool(_) => 1,
            Self::Int(_) | Self::Float(_) | Self::UInt(_) => 4,
            Self::FloatVec(items) => size_of_val::<[f32]>(items),
            Self::ByteVec(bytes) => bytes.len(),
            Self::UInt64(_) | Self::Double(_) | Self::Vec2(_) => 8,
            Self::U64Vec(items) => size_of_val::<[u64]>(items),
            Self::Vec3(_) => 12,
            Self::Vec4(_) => 16,
            Self::Vec6(_) => 24,
        }
    }

    /// The 32-bit floats of the value, if its type is made of them.
    pub fn floats(&self) -> Option<&[f32]> {
        match self {
            Self::Float(item) => Some(core::slice::from_ref(item)),
            Self::FloatVec(items) => Some(items),
            Self::Vec2(items) => Some(items),
            Self::Vec3(items) => Some(items),
            Self::Vec4(items) => Some(items),
            Self::Vec6(items) => Some(items),
            _ => None,
        }
    }

    /// Whether every NaN in the value is the one canonical NaN. `[spec: VALUE-4]`
    pub fn has_canonical_nans(&self) -> bool {
        if let Self::Double(item) = self {
            return !item.is_nan() || item.to_bits() == CANONICAL_NAN_64;
        }
        self.floats().is_none_or(|items| items.iter().all(|item| is_canonical(*item)))
    }

    /// The same value with every NaN replaced by the canonical one. Copies a vector only if it must.
    /// `[spec: VALUE-4]`
    #[must_use]
    pub fn with_canonical_nans(self) -> Self {
        if self.has_canonical_nans() {
            return self;
        }
        match self {
            Self::Float(item) => Self::Float(canonical(item)),
            Self::FloatVec(items) => Self::FloatVec(items.iter().map(|&item| canonical(item)).collect()),
            Self::Double(_) => Self::Double(f64::from_bits(CANONICAL_NAN_64)),
            Self::Vec2(items) => Self::Vec2(items.map(canonical)),
            Self::Vec3(items) => Self::Vec3(items.map(canonical)),
            Self::Vec4(items) => Self::Vec4(items.map(canonical)),
            Self::Vec6(items) => Self::Vec6(items.map(canonical)),
            other => other,
        }
    }
}

const CANONICAL_NAN_32: u32 = 0x7fc0_0000;
const CANONICAL_NAN_64: u64 = 0x7ff8_0000_0000_0000;

fn is_canonical(item: f32) -> bool {
    !item.is_nan() || item.to_bits() == CANONICAL_NAN_32
}

fn canonical(item: f32) -> f32 {
    if item.is_nan() { f32::from_bits(CANONICAL_NAN_32) } else { item }
}

fn compare_floats(left: &[f32], right: &[f32]) -> Ordering {
    let by_item = left.iter().zip(right).map(|(l, r)| l.total_cmp(r)).find(|order| order.is_ne());
    by_item.unwrap_or_else(|| left.len().cmp(&right.len()))
}

impl Ord for Value {
    fn cmp(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Self::String(l), Self::String(r)) => l.cmp(r),
            (Self::Int(l), Self::Int(r)) => l.cmp(r),
            (Self::Bool(l), Self::Bool(r)) => l.cmp(r),
            (Self::ByteVec(l), Self::ByteVec(r)) => l.cmp(r),
            (Self::UInt(l), Self::UInt(r)) => l.cmp(r),
            (Self::UInt64(l), Self::UInt64(r)) => l.cmp(r),
            (Self::Double(l), Self::Double(r)) => l.total_cmp(r),
            (Self::U64Vec(l), Self::U64Vec(r)) => l.cmp(r),
            _ => match (self.floats(), other.floats()) {
                (Some(l), Some(r)) if self.value_type() == other.value_type() => compare_floats(l, r),
                _ => self.value_type().cmp(&other.value_type()),
            },
        }
    }
}

impl PartialOrd for Value {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Value {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Value {}

impl Hash for Value {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.value_type().hash(state);
        match self {
            Self::String(text) => text.hash(state),
            Self::Int(item) => item.hash(state),
            Self::Bool(item) => item.hash(state),
            Self::ByteVec(bytes) => bytes.hash(state),
            Self::UInt(item) => item.hash(state),
            Self::UInt64(item) => item.hash(state),
            Self::Double(item) => item.to_bits().hash(state),
            Self::U64Vec(items) => items.hash(state),
            Self::Float(_)
            | Self::FloatVec(_)
            | Self::Vec2(_)
            | Self::Vec3(_)
            | Self::Vec4(_)
            | Self::Vec6(_) => {
                for item in self.floats().unwrap_or_default() {
                    item.to_bits().hash(state);
                }
            }
        }
    }
}

macro_rules! value_from {
    ($($from:ty => $variant:ident),* $(,)?) => {
        $(impl From<$from> for Value {
            fn from(value: $from) -> Self {
                Self::$variant(value.into())
            }
        })*
    };
}

value_from! {
    &str => String, String => String, Arc<str> => String,
    i32 => Int, f32 => Float, bool => Bool, u32 => UInt, u64 => UInt64, f64 => Double,
    Vec<f32> => FloatVec, Arc<[f32]> => FloatVec, Vec<u8> => ByteVec, Arc<[u8]> => ByteVec,
    Vec<u64> => U64Vec, Arc<[u64]> => U64Vec,
    [f32; 2] => Vec2, [f32; 3] => Vec3, [f32; 4] => Vec4, [f32; 6] => Vec6,
}

/// Prints for people: text quoted, long vectors by their length.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const SHOWN_MAX: usize = 8;
        match self {
            Self::String(text) => write!(f, "{text:?}"),
            Self::Int(item) => item.fmt(f),
            Self::Bool(item) => item.fmt(f),
            Self::UInt(item) => item.fmt(f),
            Self::UInt64(item) => item.fmt(f),
            Self::Float(item) => item.fmt(f),
            Self::Double(item) => item.fmt(f),
            Self::ByteVec(bytes) => write!(f, "<{} bytes>", bytes.len()),
            Self::U64Vec(items) if items.len() <= SHOWN_MAX => write!(f, "{items:?}"),
            Self::U64Vec(items) => write!(f, "<{} integers>", items.len()),
            Self::FloatVec(_) | Self::Vec2(_) | Self::Vec3(_) | Self::Vec4(_) | Self::Vec6(_) => {
                let items = self.floats().unwrap_or_default();
                if items.len() <= SHOWN_MAX {
                    write!(f, "{items:?}")
                } else {
                    write!(f, "<{} floats>", items.len())
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn law_type_numbers_and_names_are_those_published() {
        for (number, value_type) in ValueType::ALL.into_iter().enumerate() {
            assert_eq!(usize::from(value_type.number()), number);
            assert_eq!(ValueType::from_number(value_type.number()), Some(value_type));
            assert_eq!(ValueType::from_name(value_type.name()), Some(value_type));
        }
        assert_eq!(ValueType::from_number(14), None);
    }

    #[test]
    fn law_equality_is_by_bits_after_canonical_nans() {
        assert_ne!(Value::Float(0.0), Value::Float(-0.0));
        let odd_nan = Value::Vec2([f32::from_bits(0x7fc0_0001), 1.0]);
        assert!(!odd_nan.has_canonical_nans());
        assert_eq!(odd_nan.with_canonical_nans(), Value::Vec2([f32::from_bits(CANONICAL_NAN_32), 1.0]));
        assert_eq!(
            Value::Double(-f64::NAN).with_canonical_nans(),
            Value::Double(f64::from_bits(CANONICAL_NAN_64))
        );
    }
}
