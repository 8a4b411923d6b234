//! Records: a kind, the stamp, then what the kind needs. `[spec: ENC-8]`

use super::error::DecodeError;
use super::reader::Reader;
use super::tables::{Names, Replicas};
use super::{value, writer};
use crate::dot::VertexId;
use crate::record::{Edge, Record, Vertex, Write};
use alloc::vec::Vec;

const VERTEX: u8 = 0;
const VERTEX_WITH_EXTERNAL_ID: u8 = 1;
const EDGE: u8 = 2;
const WRITE: u8 = 3;

pub(super) fn write(out: &mut Vec<u8>, replicas: &Replicas, names: &Names, record: &Record) {
    out.push(match record {
        Record::Vertex(Vertex { external_id: None, .. }) => VERTEX,
        Record::Vertex(_) => VERTEX_WITH_EXTERNAL_ID,
        Record::Edge(_) => EDGE,
        Record::Write(_) => WRITE,
    });
    writer::varint(out, record.stamp());
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
            writer::varint(out, write.timestamp_ns);
            value::write(out, &write.value);
        }
    }
}

pub(super) fn read(
    reader: &mut Reader<'_>,
    replicas: &mut Replicas,
    names: &mut Names,
) -> Result<Record, DecodeError> {
    let offset = reader.offset();
    let kind = reader.byte()?;
    if kind > WRITE {
        return Err(DecodeError::Tag { offset, what: "record kind", found: kind });
    }
    let stamp = reader.varint()?;
    Ok(match kind {
        EDGE => Record::Edge(Edge {
            from: VertexId(replicas.read_anchor(reader)?),
            to: VertexId(replicas.read_anchor(reader)?),
            label: names.read_name(reader)?,
            stamp,
        }),
        WRITE => Record::Write(Write {
            target: replicas.read_anchor(reader)?,
            name: names.read_name(reader)?,
            timestamp_ns: reader.varint()?,
            value: value::read(reader)?,
            stamp,
        }),
        _ => Record::Vertex(Vertex {
            vertex_type: names.read_name(reader)?,
            name: names.read_name(reader)?,
            external_id: if kind == VERTEX { None } else { Some(reader.varint()?) },
            stamp,
        }),
    })
}
