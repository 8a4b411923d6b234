//! Records: a kind, the stamp, then what the kind needs. `[spec: ENC-8]`

use super::error::DecodeError;
use super::names::{NamesRead, NamesWritten};
use super::reader::Reader;
use super::replicas::{ReplicasRead, ReplicasWritten};
use super::{value, writer};
use crate::dot::VertexId;
use crate::record::{Edge, Record, Vertex, Write};
use crate::value::ValueType;
use alloc::vec::Vec;

const VERTEX: u8 = 0;
const VERTEX_WITH_EXTERNAL_ID: u8 = 1;
const EDGE: u8 = 2;
/// Of a write of type 0; those of the other types follow.
const WRITE: u8 = 3;

/// What the record before said: mutations give several records one stamp and one time.
#[derive(Default, Debug)]
pub(super) struct Before {
    stamp: u64,
    timestamp_ns: u64,
}

pub(super) fn write(
    out: &mut Vec<u8>,
    replicas: &ReplicasWritten,
    names: &NamesWritten<'_>,
    before: &mut Before,
    record: &Record,
) {
    out.push(match record {
        Record::Vertex(Vertex { external_id: None, .. }) => VERTEX,
        Record::Vertex(_) => VERTEX_WITH_EXTERNAL_ID,
        Record::Edge(_) => EDGE,
        Record::Write(write) => WRITE + write.value.value_type().number(),
    });
    writer::difference(out, &mut before.stamp, record.stamp());
    match record {
        Record::Vertex(vertex) => {
            names.write_name(out, &vertex.vertex_type);
            names.write_name(out, &vertex.name);
            if let Some(id) = vertex.external_id {
                writer::varint(out, id);
            }
        }
        Record::Edge(edge) => {
            replicas.write_anchor(out, edge.from.0);
            replicas.write_anchor(out, edge.to.0);
            names.write_name(out, &edge.label);
        }
        Record::Write(write) => {
            replicas.write_anchor(out, write.target);
            names.write_name(out, &write.name);
            writer::difference(out, &mut before.timestamp_ns, write.timestamp_ns);
            value::write(out, &write.value);
        }
    }
}

pub(super) fn read(
    reader: &mut Reader<'_>,
    replicas: &mut ReplicasRead,
    names: &mut NamesRead,
    before: &mut Before,
) -> Result<Record, DecodeError> {
    let offset = reader.offset();
    let kind = reader.byte()?;
    let written = kind.checked_sub(WRITE).map(ValueType::from_number);
    if written == Some(None) {
        return Err(DecodeError::Tag { offset, what: "record kind", found: kind });
    }
    let stamp = reader.difference(&mut before.stamp)?;
    if let Some(value_type) = written.flatten() {
        return Ok(Record::Write(Write {
            target: replicas.read_anchor(reader)?,
            name: names.read_name(reader)?,
            timestamp_ns: reader.difference(&mut before.timestamp_ns)?,
            value: value::read(reader, value_type)?,
            stamp,
        }));
    }
    Ok(if kind == EDGE {
        Record::Edge(Edge {
            from: VertexId(replicas.read_anchor(reader)?),
            to: VertexId(replicas.read_anchor(reader)?),
            label: names.read_name(reader)?,
            stamp,
        })
    } else {
        Record::Vertex(Vertex {
            vertex_type: names.read_name(reader)?,
            name: names.read_name(reader)?,
            external_id: if kind == VERTEX { None } else { Some(reader.varint()?) },
            stamp,
        })
    })
}
