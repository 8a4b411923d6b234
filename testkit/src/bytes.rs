//! The same universes, states and histories from bytes, for fuzzers.
//!
//! Whatever the bytes, something comes out; where they end, the rest is small. So a fuzzer can cut, join and
//! change inputs as it likes, and short inputs are small cases.

use crate::history::Step;
use crate::universe::{Anchors, Fate, Seed, Universe, grow};
use arbitrary::{Result, Unstructured};
use dsr_core::{Dot, MutationKind, Name, ReplicaId, Value};
use std::collections::BTreeMap;

/// A dot of sequence 1 to 6 of three agents, rarely of a later incarnation.
pub fn dot(u: &mut Unstructured<'_>) -> Result<Dot> {
    let byte: u8 = u.arbitrary()?;
    let incarnation = u32::from(byte >= 240);
    let replica = ReplicaId { agent: 1 + u32::from(byte % 3), incarnation };
    Ok(Dot::new(replica, 1 + u64::from(byte / 3 % 6)))
}

fn name(u: &mut Unstructured<'_>) -> Result<Name> {
    Ok((*u.choose(&["a", "b", "c", "kitchen", "root"])?).into())
}

fn seed(u: &mut Unstructured<'_>) -> Result<Seed> {
    let kind = *u.choose(&[0, 1, 2, 0, 1, 2, 0, 1, 1, 1])?;
    let value = match u.int_in_range(0..=5_u8)? {
        0 => u.arbitrary()?,
        small => Value::Int(i32::from(small)),
    };
    Ok(Seed {
        kind,
        ends: u.arbitrary()?,
        label: (*u.choose(&["RT", "RT", "in", "near"])?).into(),
        names: (name(u)?, name(u)?),
        value,
        stamp: u.int_in_range(1..=4)?,
        external_id: if u.ratio(1_u8, 5_u8)? { Some(u.arbitrary()?) } else { None },
        timestamp_ns: u64::from(u.arbitrary::<u8>()?),
    })
}

/// A universe of at most `records_max` records. See [`universes`](crate::universes).
pub fn universe(u: &mut Unstructured<'_>, records_max: usize, anchors: Anchors) -> Result<Universe> {
    let count = u.int_in_range(0..=records_max)?;
    let mut seeds = BTreeMap::new();
    for _ in 0..count {
        seeds.insert(dot(u)?, seed(u)?);
    }
    Ok(grow(&seeds, anchors))
}

/// What a state knows of each record of a universe: held, unless the bytes say otherwise.
pub fn fates(u: &mut Unstructured<'_>, universe: &Universe) -> Result<Vec<Fate>> {
    let fate = |byte: u8| match byte % 8 {
        6 => Fate::Unseen,
        7 => Fate::Dead,
        _ => Fate::Held,
    };
    universe.records.iter().map(|_| u.arbitrary().map(fate)).collect()
}

/// One step of `replicas` replicas: additions more often than the rest, or nothing would be there to change.
pub fn step(u: &mut Unstructured<'_>, replicas: usize) -> Result<Step> {
    let replica = |u: &mut Unstructured<'_>| u.int_in_range(0..=replicas.max(1) - 1);
    let delta = |u: &mut Unstructured<'_>| u.arbitrary::<u8>().map(usize::from);
    Ok(match u.int_in_range(0..=15_u8)? {
        0..=5 => {
            let additions = [MutationKind::AddVertex; 3];
            let kinds = [&additions[..], &MutationKind::ALL].concat();
            let (replica, kind) = (replica(u)?, *u.choose(&kinds)?);
            Step::Mutate { replica, kind, choice: usize::from(u.arbitrary::<u16>()?) }
        }
        6 => {
            let (replica, kind) = (replica(u)?, *u.choose(&MutationKind::ALL)?);
            Step::Attempt { replica, kind, choice: usize::from(u.arbitrary::<u16>()?) }
        }
        7 => Step::Try { replica: replica(u)?, mutation: Box::new(u.arbitrary()?) },
        8..=11 => Step::Deliver { delta: delta(u)?, to: replica(u)? },
        12 => {
            let count = u.int_in_range(1..=3_u8)?;
            let deltas = (0..count).map(|_| delta(u)).collect::<Result<_>>()?;
            Step::Group { deltas, to: replica(u)? }
        }
        13 | 14 => Step::Resynchronise { from: replica(u)?, to: replica(u)? },
        _ => Step::Restart { replica: replica(u)?, keeps: u.arbitrary()? },
    })
}
