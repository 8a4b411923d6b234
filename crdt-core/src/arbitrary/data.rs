//! Ids, values and keys.

use crate::dot::{Dot, EdgeId, ReplicaId, VertexId};
use crate::mutation::{Author, ElementId};
use crate::record::{EdgeKey, Name};
use crate::value::{Value, ValueType};
use alloc::string::String;
use alloc::vec::Vec;
use arbitrary::{Arbitrary, Result, Unstructured};

/// Agents 1 to this.
pub(super) const AGENTS_MAX: u32 = 3;
/// Sequences 1 to this.
pub(super) const SEQUENCES_MAX: u64 = 8;

pub(super) fn name(u: &mut Unstructured<'_>) -> Result<Name> {
    Ok((*u.choose(&["a", "b", "c", "kitchen"])?).into())
}

pub(super) fn label(u: &mut Unstructured<'_>) -> Result<Name> {
    Ok((*u.choose(&[crate::RT, crate::RT, "in", "near"])?).into())
}

impl<'a> Arbitrary<'a> for ReplicaId {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let incarnation = u32::from(u.ratio(1_u8, 8_u8)?);
        Ok(Self { agent: u.int_in_range(1..=AGENTS_MAX)?, incarnation })
    }
}

impl<'a> Arbitrary<'a> for Dot {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        Ok(Self::new(u.arbitrary()?, u.int_in_range(1..=SEQUENCES_MAX)?))
    }
}

impl<'a> Arbitrary<'a> for VertexId {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        if u.ratio(1_u8, 4_u8)? { Ok(Self::ROOT) } else { u.arbitrary().map(Self) }
    }
}

impl<'a> Arbitrary<'a> for EdgeId {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        u.arbitrary().map(Self)
    }
}

impl<'a> Arbitrary<'a> for ElementId {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        if u.arbitrary()? { u.arbitrary().map(Self::Vertex) } else { u.arbitrary().map(Self::Edge) }
    }
}

impl<'a> Arbitrary<'a> for EdgeKey {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        Ok(Self { from: u.arbitrary()?, to: u.arbitrary()?, label: label(u)? })
    }
}

impl<'a> Arbitrary<'a> for Author {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        Ok(Self { replica: u.arbitrary()?, timestamp_ns: u.arbitrary()? })
    }
}

impl<'a> Arbitrary<'a> for ValueType {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        u.choose(&Self::ALL).copied()
    }
}

/// Any value; every NaN is the canonical one.
impl<'a> Arbitrary<'a> for Value {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let value: Self = match u.arbitrary()? {
            ValueType::String => u.arbitrary::<String>()?.into(),
            ValueType::Int => Self::Int(u.arbitrary()?),
            ValueType::Float => Self::Float(u.arbitrary()?),
            ValueType::FloatVec => u.arbitrary::<Vec<f32>>()?.into(),
            ValueType::Bool => Self::Bool(u.arbitrary()?),
            ValueType::ByteVec => u.arbitrary::<Vec<u8>>()?.into(),
            ValueType::UInt => Self::UInt(u.arbitrary()?),
            ValueType::UInt64 => Self::UInt64(u.arbitrary()?),
            ValueType::Double => Self::Double(u.arbitrary()?),
            ValueType::U64Vec => u.arbitrary::<Vec<u64>>()?.into(),
            ValueType::Vec2 => Self::Vec2(u.arbitrary()?),
            ValueType::Vec3 => Self::Vec3(u.arbitrary()?),
            ValueType::Vec4 => Self::Vec4(u.arbitrary()?),
            ValueType::Vec6 => Self::Vec6(u.arbitrary()?),
        };
        Ok(value.with_canonical_nans())
    }
}
