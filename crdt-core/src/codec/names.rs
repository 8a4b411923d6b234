//! The names of a message: those of the static table by their index there; each other once, in order, and
//! each used. `[spec: ENC-6]`

use super::error::DecodeError;
use super::reader::Reader;
use super::{vocabulary, writer};
use crate::limits;
use crate::record::{Name, Record};
use alloc::vec::Vec;

/// What a name is called in errors.
const NAME: &str = "name";
/// The index of a message's first own name.
const FIRST: usize = vocabulary::NAMES.len();

/// A message's own names when it is written, ascending by bytes.
#[derive(Debug)]
pub(super) struct NamesWritten<'r> {
    own: Vec<&'r str>,
}

impl<'r> NamesWritten<'r> {
    pub(super) fn of(records: impl Iterator<Item = &'r Record>) -> Self {
        let mut own: Vec<&str> = Vec::new();
        // A type, a label, an attribute is mostly the one before again; a vertex's name is its own.
        let mut before: [Option<&str>; 3] = [None; 3];
        let mut add = |name: &'r str| {
            if vocabulary::index_of(name).is_none() {
                own.push(name);
            }
        };
        for record in records {
            let (kind, name) = match record {
                Record::Vertex(vertex) => {
                    add(&vertex.name);
                    (0, &*vertex.vertex_type)
                }
                Record::Edge(edge) => (1, &*edge.label),
                Record::Write(write) => (2, &*write.name),
            };
            if before[kind].replace(name) != Some(name) {
                add(name);
            }
        }
        own.sort_unstable();
        own.dedup();
        Self { own }
    }

    pub(super) fn write(&self, out: &mut Vec<u8>) {
        writer::count(out, self.own.len());
        for name in &self.own {
            writer::bytes(out, name.as_bytes());
        }
    }

    /// A reference to a name: its index. `[spec: ENC-6]`
    pub(super) fn write_name(&self, out: &mut Vec<u8>, name: &str) {
        let index = vocabulary::index_of(name);
        let own = || FIRST.saturating_add(self.own.partition_point(|&known| known < name));
        writer::count(out, index.unwrap_or_else(own));
    }
}

/// The names of a message that is read.
#[derive(Debug)]
pub(super) struct NamesRead {
    /// The own ones, then those of the static table that were referred to.
    names: Vec<Entry>,
    /// How many are own.
    own: usize,
    /// Where in `names` a name of the static table stands, counted from the end of the own ones and from 1.
    places: [u8; FIRST],
}

#[derive(Debug)]
struct Entry {
    name: Name,
    is_used: bool,
}

impl NamesRead {
    pub(super) fn read(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
        let own = reader.count(usize::MAX, 2, "a number of names")?;
        let mut names: Vec<Entry> = Vec::with_capacity(own);
        for index in 0..own {
            let offset = reader.offset();
            let bytes = reader.varint()?;
            let length =
                usize::try_from(bytes).ok().filter(|length| (1..=limits::NAME_BYTES_MAX).contains(length));
            let name = reader.text(length.ok_or(DecodeError::NameLength { offset, bytes })?)?;
            if names.last().is_some_and(|before| &*before.name >= name) {
                return Err(DecodeError::Unsorted { offset, what: NAME, index });
            }
            if let Some(index) = vocabulary::index_of(name) {
                return Err(DecodeError::Static { offset, name: vocabulary::NAMES[index], index });
            }
            names.push(Entry { name: name.into(), is_used: false });
        }
        Ok(Self { names, own, places: [0; FIRST] })
    }

    pub(super) fn read_name(&mut self, reader: &mut Reader<'_>) -> Result<Name, DecodeError> {
        let offset = reader.offset();
        let index = reader.varint()?;
        let at = usize::try_from(index).unwrap_or(usize::MAX);
        match at.checked_sub(FIRST) {
            None => Ok(self.of_vocabulary(at)),
            Some(at) if at < self.own => {
                let entry = &mut self.names[at];
                entry.is_used = true;
                Ok(entry.name.clone())
            }
            Some(_) => {
                Err(DecodeError::Index { offset, what: NAME, index, count: FIRST.saturating_add(self.own) })
            }
        }
    }

    /// A name of the static table; all records of a message share one copy.
    fn of_vocabulary(&mut self, index: usize) -> Name {
        if let Some(place) = usize::from(self.places[index]).checked_sub(1) {
            return self.names[self.own + place].name.clone();
        }
        let name: Name = vocabulary::NAMES[index].into();
        self.names.push(Entry { name: name.clone(), is_used: true });
        // At most as many as the static table has.
        self.places[index] = u8::try_from(self.names.len() - self.own).unwrap_or(0);
        name
    }

    pub(super) fn check_used(&self) -> Result<(), DecodeError> {
        match self.names.iter().position(|entry| !entry.is_used) {
            Some(at) => Err(DecodeError::Unused { what: NAME, index: FIRST.saturating_add(at) }),
            None => Ok(()),
        }
    }
}
