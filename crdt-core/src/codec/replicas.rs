//! The replicas of a message: each once, in order, and each used. `[spec: ENC-4]`

use super::error::DecodeError;
use super::reader::Reader;
use super::writer;
use crate::dot::{Dot, ReplicaId, VertexId};
use alloc::vec::Vec;

/// What a replica is called in errors.
const REPLICA: &str = "replica";
/// The greatest first number of an entry: an agent and a bit.
const AGENT_AND_BIT_MAX: u64 = (1 << 33) - 1;
/// The greatest second number of an entry: 0 has an entry without one.
const INCARNATION_LESS_ONE_MAX: u64 = u32::MAX as u64 - 1;

/// The replicas of a message to be written, ascending.
#[derive(Debug)]
pub(super) struct ReplicasWritten {
    pub(super) ids: Vec<ReplicaId>,
}

impl ReplicasWritten {
    /// Of replicas that come in any order, any number of times.
    pub(super) fn of(named: impl Iterator<Item = ReplicaId>) -> Self {
        let mut ids: Vec<ReplicaId> = Vec::new();
        for id in named {
            // Most name the one before again.
            if ids.last() != Some(&id) {
                ids.push(id);
            }
        }
        ids.sort_unstable();
        ids.dedup();
        Self { ids }
    }

    pub(super) fn write(&self, out: &mut Vec<u8>) {
        writer::count(out, self.ids.len());
        for &ReplicaId { agent, incarnation } in &self.ids {
            let later = incarnation.checked_sub(1);
            writer::varint(out, u64::from(agent) << 1 | u64::from(later.is_some()));
            if let Some(less_one) = later {
                writer::varint(out, less_one.into());
            }
        }
    }

    /// A reference to an anchor: 0 for the root, or 1 + the replica's index and then the sequence.
    /// `[spec: ENC-8]`
    pub(super) fn write_anchor(&self, out: &mut Vec<u8>, anchor: Dot) {
        if anchor == VertexId::ROOT.0 {
            return writer::varint(out, 0);
        }
        let index = self.ids.partition_point(|&id| id < anchor.replica);
        writer::count(out, index.saturating_add(1));
        writer::varint(out, anchor.sequence);
    }
}

/// The replicas of a message that is read, ascending.
#[derive(Debug)]
pub(super) struct ReplicasRead {
    entries: Vec<Entry>,
}

#[derive(Debug)]
struct Entry {
    id: ReplicaId,
    is_used: bool,
}

impl ReplicasRead {
    pub(super) fn read(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
        // One byte an entry, and one at least for its number of runs.
        let count = reader.count(usize::MAX, 2, "a number of replicas")?;
        let mut entries: Vec<Entry> = Vec::with_capacity(count);
        for index in 0..count {
            let offset = reader.offset();
            let id = read_id(reader)?;
            if entries.last().is_some_and(|before| before.id >= id) {
                return Err(DecodeError::Unsorted { offset, what: REPLICA, index });
            }
            entries.push(Entry { id, is_used: false });
        }
        Ok(Self { entries })
    }

    pub(super) fn len(&self) -> usize {
        self.entries.len()
    }

    /// The replica of an index below [`len`](Self::len).
    pub(super) fn id(&self, at: usize) -> ReplicaId {
        self.entries[at].id
    }

    /// Marks an entry as used.
    pub(super) fn mark(&mut self, at: usize) {
        self.entries[at].is_used = true;
    }

    pub(super) fn check_used(&self) -> Result<(), DecodeError> {
        match self.entries.iter().position(|entry| !entry.is_used) {
            Some(index) => Err(DecodeError::Unused { what: REPLICA, index }),
            None => Ok(()),
        }
    }

    pub(super) fn read_anchor(&mut self, reader: &mut Reader<'_>) -> Result<Dot, DecodeError> {
        let offset = reader.offset();
        let Some(index) = reader.varint()?.checked_sub(1) else { return Ok(VertexId::ROOT.0) };
        let count = self.entries.len();
        let at = usize::try_from(index).ok();
        let Some(entry) = at.and_then(|at| self.entries.get_mut(at)) else {
            return Err(DecodeError::Index { offset, what: REPLICA, index, count });
        };
        entry.is_used = true;
        let offset = reader.offset();
        match reader.varint()? {
            0 => Err(DecodeError::NoEvent { offset }),
            sequence => Ok(Dot::new(entry.id, sequence)),
        }
    }
}

/// An agent and whether an incarnation follows, in one number.
fn read_id(reader: &mut Reader<'_>) -> Result<ReplicaId, DecodeError> {
    let (offset, what) = (reader.offset(), "twice an agent");
    let agent_and_bit = reader.varint()?;
    let too_great = DecodeError::TooGreat { offset, what, max: AGENT_AND_BIT_MAX };
    let agent = u32::try_from(agent_and_bit >> 1).or(Err(too_great))?;
    if agent_and_bit & 1 == 0 {
        return Ok(ReplicaId::agent(agent));
    }
    let (offset, what) = (reader.offset(), "an incarnation less one");
    let less_one = u32::try_from(reader.varint()?).ok();
    let too_great = DecodeError::TooGreat { offset, what, max: INCARNATION_LESS_ONE_MAX };
    let incarnation = less_one.and_then(|less_one| less_one.checked_add(1)).ok_or(too_great)?;
    Ok(ReplicaId { agent, incarnation })
}
