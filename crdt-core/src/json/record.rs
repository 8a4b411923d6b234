//! Records: one object whose only key is the record's kind. `[spec: JSON-10]`
//!
//! ```json
//! {"vertex": {"type": "room", "name": "kitchen", "stamp": 1}}
//! {"edge": {"from": "root", "label": "RT", "to": "r1.1", "stamp": 1}}
//! {"write": {"target": "r1.1", "name": "level", "value": {"type": "int", "value": 5}, "timestamp_ns": "0", "stamp": 1}}
//! ```

use super::number::Integer;
use crate::dot::VertexId;
use crate::record::{Edge, Name, Record, Vertex, Write};
use crate::value::Value;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Serialize, Deserialize)]
#[serde(rename = "Record", rename_all = "snake_case", deny_unknown_fields)]
enum Form {
    Vertex(VertexForm),
    Edge(EdgeForm),
    Write(WriteForm),
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "vertex", deny_unknown_fields)]
struct VertexForm {
    #[serde(rename = "type")]
    vertex_type: Name,
    name: Name,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    external_id: Option<Integer>,
    stamp: u64,
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "edge", deny_unknown_fields)]
struct EdgeForm {
    from: VertexId,
    label: Name,
    to: VertexId,
    stamp: u64,
}

/// The target is a vertex, an edge or `root`; their dots are spelt alike.
#[derive(Serialize, Deserialize)]
#[serde(rename = "write", deny_unknown_fields)]
struct WriteForm {
    target: VertexId,
    name: Name,
    value: Value,
    #[serde(default)]
    timestamp_ns: Integer,
    stamp: u64,
}

impl Serialize for Record {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let form = match self.clone() {
            Self::Vertex(Vertex { vertex_type, name, external_id, stamp }) => {
                Form::Vertex(VertexForm { vertex_type, name, external_id: external_id.map(Integer), stamp })
            }
            Self::Edge(Edge { from, to, label, stamp }) => Form::Edge(EdgeForm { from, label, to, stamp }),
            Self::Write(Write { target, name, value, timestamp_ns, stamp }) => Form::Write(WriteForm {
                target: VertexId(target),
                name,
                value,
                timestamp_ns: Integer(timestamp_ns),
                stamp,
            }),
        };
        form.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Record {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(match Form::deserialize(deserializer)? {
            Form::Vertex(VertexForm { vertex_type, name, external_id, stamp }) => {
                Self::Vertex(Vertex { vertex_type, name, external_id: external_id.map(|id| id.0), stamp })
            }
            Form::Edge(EdgeForm { from, label, to, stamp }) => Self::Edge(Edge { from, to, label, stamp }),
            Form::Write(WriteForm { target, name, value, timestamp_ns, stamp }) => {
                Self::Write(Write { target: target.0, name, value, timestamp_ns: timestamp_ns.0, stamp })
            }
        })
    }
}
