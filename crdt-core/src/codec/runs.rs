//! Sets of dots as runs, per replica of the table. `[spec: ENC-5]`
//!
//! A run is written as its distance from the one before, less the one dot that must be missing between two
//! maximal runs, and its length less one: runs that overlap, touch or are empty have no spelling.

use super::error::DecodeError;
use super::reader::Reader;
use super::writer;
use crate::context::Run;
use crate::dot::ReplicaId;
use crate::limits;
use alloc::vec::Vec;

/// What a sequence is called in errors.
const SEQUENCE: &str = "a sequence";

/// Writes the runs of every replica of the table; `runs` must be ascending, and of no other replicas.
pub(super) fn write(out: &mut Vec<u8>, replicas: &[ReplicaId], mut runs: impl Iterator<Item = Run> + Clone) {
    for &replica in replicas {
        let own = runs.clone().take_while(|run| run.replica == replica).count();
        writer::count(out, own);
        let mut least = 1_u64;
        for run in runs.by_ref().take(own) {
            // Wraps only for what is no set of runs; such bytes are then refused.
            writer::varint(out, run.first.wrapping_sub(least));
            writer::varint(out, run.last.wrapping_sub(run.first));
            least = run.last.wrapping_add(2);
        }
    }
}

/// Reads the runs of a replica of the table, and hands each to `found` with the offset at which it begins.
pub(super) fn read(
    reader: &mut Reader<'_>,
    replica: ReplicaId,
    mut found: impl FnMut(usize, Run) -> Result<(), DecodeError>,
) -> Result<(), DecodeError> {
    // Two bytes a run at least.
    let count = reader.count(usize::MAX, 2, "a number of runs")?;
    let mut least = 1_u64;
    for _ in 0..count {
        let offset = reader.offset();
        let too_great = DecodeError::TooGreat { offset, what: SEQUENCE, max: limits::SEQUENCE_MAX };
        let start = least.checked_add(reader.varint()?);
        let length = reader.varint()?;
        let end = start.and_then(|start| start.checked_add(length));
        let Some((first, end)) = start.zip(end).filter(|&(_, end)| end <= limits::SEQUENCE_MAX) else {
            return Err(too_great);
        };
        found(offset, Run { replica, first, last: end })?;
        least = end + 2;
    }
    Ok(())
}
