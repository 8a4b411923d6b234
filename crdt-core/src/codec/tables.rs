//! The tables at the front: each replica and each name once, in order, and each used. `[spec: ENC-4]`
//! `[spec: ENC-6]`

use super::error::DecodeError;
use super::reader::Reader;
use super::writer;
use crate::context::Run;
use crate::dot::{Dot, ReplicaId, VertexId};
use crate::limits;
use crate::record::{Name, Record};
use alloc::vec;
use alloc::vec::Vec;

/// What a replica is called in errors.
const REPLICA: &str = "replica";
/// What a name is called in errors.
const NAME: &str = "name";

/// The replicas of a message, ascending, and which of them were referred to.
#[derive(Debug)]
pub(super) struct Replicas {
    pub(super) ids: Vec<ReplicaId>,
    used: Vec<bool>,
}

impl Replicas {
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
        Self { ids, used: Vec::new() }
    }

    pub(super) fn write(&self, out: &mut Vec<u8>) {
        writer::count(out, self.ids.len());
        for id in &self.ids {
            writer::varint(out, id.agent.into());
            writer::varint(out, id.incarnation.into());
        }
    }

    pub(super) fn read(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
        // Two bytes an entry, and one at least for its number of runs.
        let count = reader.count(usize::MAX, 3, "a number of replicas")?;
        let mut ids: Vec<ReplicaId> = Vec::with_capacity(count);
        for index in 0..count {
            let offset = reader.offset();
            let id =
                ReplicaId { agent: half(reader, "an agent")?, incarnation: half(reader, "an incarnation")? };
            if ids.last().is_some_and(|&before| before >= id) {
                return Err(DecodeError::Unsorted { offset, what: REPLICA, index });
            }
            ids.push(id);
        }
        Ok(Self { ids, used: vec![false; count] })
    }

    /// Marks the replica of a run as used.
    pub(super) fn mark(&mut self, run: Run) {
        if let Ok(index) = self.ids.binary_search(&run.replica) {
            self.used[index] = true;
        }
    }

    pub(super) fn check_used(&self) -> Result<(), DecodeError> {
        check_used(&self.used, REPLICA)
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

    pub(super) fn read_anchor(&mut self, reader: &mut Reader<'_>) -> Result<Dot, DecodeError> {
        let offset = reader.offset();
        let Some(index) = reader.varint()?.checked_sub(1) else { return Ok(VertexId::ROOT.0) };
        let at = at(index, self.ids.len()).ok_or(DecodeError::Index {
            offset,
            what: REPLICA,
            index,
            count: self.ids.len(),
        })?;
        self.used[at] = true;
        let offset = reader.offset();
        match reader.varint()? {
            0 => Err(DecodeError::NoEvent { offset }),
            sequence => Ok(Dot::new(self.ids[at], sequence)),
        }
    }
}

fn half(reader: &mut Reader<'_>, what: &'static str) -> Result<u32, DecodeError> {
    let offset = reader.offset();
    u32::try_from(reader.varint()?).or(Err(DecodeError::TooGreat { offset, what, max: u32::MAX.into() }))
}

fn at(index: u64, count: usize) -> Option<usize> {
    usize::try_from(index).ok().filter(|&at| at < count)
}

fn check_used(used: &[bool], what: &'static str) -> Result<(), DecodeError> {
    match used.iter().position(|used| !used) {
        Some(index) => Err(DecodeError::Unused { what, index }),
        None => Ok(()),
    }
}

/// The names of a message, ascending by bytes, and which of them were referred to.
#[derive(Debug)]
pub(super) struct Names {
    names: Vec<Name>,
    used: Vec<bool>,
}

impl Names {
    pub(super) fn of<'r>(records: impl Iterator<Item = &'r Record>) -> Self {
        let mut names: Vec<&Name> = Vec::new();
        // A type, a label, an attribute is mostly the one before again; a vertex's name is its own.
        let mut before: [Option<&Name>; 3] = [None; 3];
        let mut name_again = |names: &mut Vec<_>, kind: usize, name| {
            if before[kind].replace(name) != Some(name) {
                names.push(name);
            }
        };
        for record in records {
            match record {
                Record::Vertex(vertex) => {
                    name_again(&mut names, 0, &vertex.vertex_type);
                    names.push(&vertex.name);
                }
                Record::Edge(edge) => name_again(&mut names, 1, &edge.label),
                Record::Write(write) => name_again(&mut names, 2, &write.name),
            }
        }
        names.sort_unstable();
        names.dedup();
        Self { names: names.into_iter().cloned().collect(), used: Vec::new() }
    }

    pub(super) fn write(&self, out: &mut Vec<u8>) {
        writer::count(out, self.names.len());
        for name in &self.names {
            writer::bytes(out, name.as_bytes());
        }
    }

    pub(super) fn read(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
        let count = reader.count(usize::MAX, 2, "a number of names")?;
        let mut names: Vec<Name> = Vec::with_capacity(count);
        for index in 0..count {
            let offset = reader.offset();
            let bytes = reader.varint()?;
            let length =
                usize::try_from(bytes).ok().filter(|length| (1..=limits::NAME_BYTES_MAX).contains(length));
            let name = reader.text(length.ok_or(DecodeError::NameLength { offset, bytes })?)?;
            if names.last().is_some_and(|before| &**before >= name) {
                return Err(DecodeError::Unsorted { offset, what: NAME, index });
            }
            names.push(name.into());
        }
        Ok(Self { names, used: vec![false; count] })
    }

    /// A reference to a name: its index. `[spec: ENC-8]`
    pub(super) fn write_name(&self, out: &mut Vec<u8>, name: &Name) {
        writer::count(out, self.names.partition_point(|known| known < name));
    }

    pub(super) fn read_name(&mut self, reader: &mut Reader<'_>) -> Result<Name, DecodeError> {
        let offset = reader.offset();
        let index = reader.varint()?;
        let count = self.names.len();
        let at = at(index, count).ok_or(DecodeError::Index { offset, what: NAME, index, count })?;
        self.used[at] = true;
        Ok(self.names[at].clone())
    }

    pub(super) fn check_used(&self) -> Result<(), DecodeError> {
        check_used(&self.used, NAME)
    }
}
