//! Mutations: any arguments, so most are refused in most views; the pools are small enough that many are not.

use super::data::{label, name};
use crate::mutation::{AttributeMap, Mutation, MutationKind, NewVertex, VertexLink};
use crate::record::Name;
use alloc::collections::BTreeMap;
use arbitrary::{Arbitrary, Result, Unstructured};

/// At most two attributes.
fn attributes<'a, V: Arbitrary<'a>>(u: &mut Unstructured<'a>) -> Result<BTreeMap<Name, V>> {
    let count = u.int_in_range(0..=2)?;
    (0..count).map(|_| Ok((name(u)?, u.arbitrary()?))).collect()
}

impl<'a> Arbitrary<'a> for MutationKind {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        u.choose(&Self::ALL).copied()
    }
}

impl<'a> Arbitrary<'a> for NewVertex {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        Ok(Self {
            vertex_type: name(u)?,
            name: name(u)?,
            external_id: u.arbitrary()?,
            attributes: attributes(u)?,
        })
    }
}

impl<'a> Arbitrary<'a> for VertexLink {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let label = label(u)?;
        // A kinematic link must enter the new vertex.
        let outgoing = &*label != crate::RT && u.arbitrary()?;
        Ok(Self { other: u.arbitrary()?, label, outgoing, attributes: AttributeMap::new() })
    }
}

impl<'a> Arbitrary<'a> for Mutation {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        Ok(match u.arbitrary()? {
            MutationKind::AddVertex => Self::AddVertex { vertex: u.arbitrary()?, link: u.arbitrary()? },
            MutationKind::AddEdge => Self::AddEdge { key: u.arbitrary()?, attributes: attributes(u)? },
            MutationKind::UpdateAttributes => {
                Self::UpdateAttributes { target: u.arbitrary()?, updates: attributes(u)? }
            }
            MutationKind::RemoveEdge => Self::RemoveEdge { key: u.arbitrary()? },
            MutationKind::MoveEdge => {
                Self::MoveEdge { from: u.arbitrary()?, to: u.arbitrary()?, attributes: attributes(u)? }
            }
            MutationKind::RemoveVertex => Self::RemoveVertex { vertex: u.arbitrary()? },
        })
    }
}
