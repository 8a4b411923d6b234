//! The six mutations: one object whose only key is the mutation's name. `[spec: JSON-9]`
//!
//! ```json
//! {"add_vertex": {"type": "room", "name": "kitchen", "link": {"from": "root", "label": "RT"}}}
//! {"add_edge": {"from": "r1.1", "label": "in", "to": "r1.3"}}
//! {"update_attributes": {"vertex": "r1.1", "attributes": {"level": {"type": "int", "value": 5}, "old": null}}}
//! {"remove_edge": {"from": "r1.1", "label": "in", "to": "r1.3"}}
//! {"move_edge": {"old": {"from": "r1.1", "label": "in", "to": "r1.3"}, "new": {"from": "r1.1", "label": "in", "to": "r1.5"}}}
//! {"remove_vertex": {"vertex": "r1.1"}}
//! ```

use super::map::UniqueMap;
use super::number::Integer;
use crate::dot::{EdgeId, VertexId};
use crate::mutation::{ElementId, Mutation, NewVertex, VertexLink};
use crate::record::{EdgeKey, Name};
use crate::value::Value;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Attributes to set; left out when there are none.
type Attributes = UniqueMap<Name, Value>;

#[derive(Serialize, Deserialize)]
#[serde(rename = "Mutation", rename_all = "snake_case", deny_unknown_fields)]
enum Form {
    AddVertex(VertexForm),
    AddEdge(EdgeForm),
    UpdateAttributes(UpdateForm),
    RemoveEdge(EdgeKey),
    MoveEdge(MoveForm),
    RemoveVertex(RemoveVertexForm),
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "add_vertex", deny_unknown_fields)]
struct VertexForm {
    #[serde(rename = "type")]
    vertex_type: Name,
    name: Name,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    external_id: Option<Integer>,
    #[serde(default, skip_serializing_if = "UniqueMap::is_empty")]
    attributes: Attributes,
    link: LinkForm,
}

/// `from`: the edge enters the new vertex; `to`: it leaves it. One of the two.
#[derive(Serialize, Deserialize)]
#[serde(rename = "link", deny_unknown_fields)]
struct LinkForm {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    from: Option<VertexId>,
    label: Name,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    to: Option<VertexId>,
    #[serde(default, skip_serializing_if = "UniqueMap::is_empty")]
    attributes: Attributes,
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "add_edge", deny_unknown_fields)]
struct EdgeForm {
    from: VertexId,
    label: Name,
    to: VertexId,
    #[serde(default, skip_serializing_if = "UniqueMap::is_empty")]
    attributes: Attributes,
}

/// `vertex` or `edge`, and what becomes of its attributes; `null` unsets.
#[derive(Serialize, Deserialize)]
#[serde(rename = "update_attributes", deny_unknown_fields)]
struct UpdateForm {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    vertex: Option<VertexId>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    edge: Option<EdgeId>,
    attributes: UniqueMap<Name, Option<Value>>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "move_edge", deny_unknown_fields)]
struct MoveForm {
    old: EdgeKey,
    new: EdgeKey,
    #[serde(default, skip_serializing_if = "UniqueMap::is_empty")]
    attributes: Attributes,
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "remove_vertex", deny_unknown_fields)]
struct RemoveVertexForm {
    vertex: VertexId,
}

impl From<&Mutation> for Form {
    fn from(mutation: &Mutation) -> Self {
        match mutation {
            Mutation::AddVertex { vertex, link } => Self::AddVertex(VertexForm {
                vertex_type: vertex.vertex_type.clone(),
                name: vertex.name.clone(),
                external_id: vertex.external_id.map(Integer),
                attributes: UniqueMap(vertex.attributes.clone()),
                link: LinkForm {
                    from: (!link.outgoing).then_some(link.other),
                    label: link.label.clone(),
                    to: link.outgoing.then_some(link.other),
                    attributes: UniqueMap(link.attributes.clone()),
                },
            }),
            Mutation::AddEdge { key, attributes } => Self::AddEdge(EdgeForm {
                from: key.from,
                label: key.label.clone(),
                to: key.to,
                attributes: UniqueMap(attributes.clone()),
            }),
            Mutation::UpdateAttributes { target, updates } => {
                let (vertex, edge) = match *target {
                    ElementId::Vertex(vertex) => (Some(vertex), None),
                    ElementId::Edge(edge) => (None, Some(edge)),
                };
                Self::UpdateAttributes(UpdateForm { vertex, edge, attributes: UniqueMap(updates.clone()) })
            }
            Mutation::RemoveEdge { key } => Self::RemoveEdge(key.clone()),
            Mutation::MoveEdge { from, to, attributes } => Self::MoveEdge(MoveForm {
                old: from.clone(),
                new: to.clone(),
                attributes: UniqueMap(attributes.clone()),
            }),
            Mutation::RemoveVertex { vertex } => Self::RemoveVertex(RemoveVertexForm { vertex: *vertex }),
        }
    }
}

impl TryFrom<Form> for Mutation {
    type Error = &'static str;

    fn try_from(form: Form) -> Result<Self, Self::Error> {
        Ok(match form {
            Form::AddVertex(VertexForm { vertex_type, name, external_id, attributes, link }) => {
                let external_id = external_id.map(|id| id.0);
                let vertex = NewVertex { vertex_type, name, external_id, attributes: attributes.0 };
                Self::AddVertex { vertex, link: link.try_into()? }
            }
            Form::AddEdge(EdgeForm { from, label, to, attributes }) => {
                Self::AddEdge { key: EdgeKey { from, to, label }, attributes: attributes.0 }
            }
            Form::UpdateAttributes(UpdateForm { vertex, edge, attributes }) => {
                let target = match (vertex, edge) {
                    (Some(vertex), None) => ElementId::Vertex(vertex),
                    (None, Some(edge)) => ElementId::Edge(edge),
                    _ => return Err("update_attributes names either a `vertex` or an `edge`"),
                };
                Self::UpdateAttributes { target, updates: attributes.0 }
            }
            Form::RemoveEdge(key) => Self::RemoveEdge { key },
            Form::MoveEdge(MoveForm { old, new, attributes }) => {
                Self::MoveEdge { from: old, to: new, attributes: attributes.0 }
            }
            Form::RemoveVertex(RemoveVertexForm { vertex }) => Self::RemoveVertex { vertex },
        })
    }
}

impl TryFrom<LinkForm> for VertexLink {
    type Error = &'static str;

    fn try_from(form: LinkForm) -> Result<Self, Self::Error> {
        let (other, outgoing) = match (form.from, form.to) {
            (Some(other), None) => (other, false),
            (None, Some(other)) => (other, true),
            _ => {
                return Err(
                    "a link names the other vertex either as `from` (other to new) or as `to` (new to other)",
                );
            }
        };
        Ok(Self { other, label: form.label, outgoing, attributes: form.attributes.0 })
    }
}

impl Serialize for Mutation {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Form::from(self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Mutation {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Form::deserialize(deserializer)?.try_into().map_err(D::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[track_caller]
    fn check(text: &str) {
        let mutation: Mutation = serde_json::from_str(text).unwrap();
        assert_eq!(serde_json::to_string(&mutation).unwrap(), text);
        assert!(text.starts_with(&alloc::format!("{{\"{}\":", mutation.kind().name())));
    }

    /// `[spec: JSON-9]`
    #[test]
    fn law_each_mutation_has_one_text() {
        check(r#"{"add_vertex":{"type":"room","name":"kitchen","link":{"from":"root","label":"RT"}}}"#);
        check(concat!(
            r#"{"add_vertex":{"type":"robot","name":"shadow","external_id":"7","attributes":{"level":{"type":"int","value":5}},"#,
            r#""link":{"label":"in","to":"r1.1","attributes":{"since":{"type":"uint64","value":"9"}}}}}"#
        ));
        check(r#"{"add_edge":{"from":"r1.1","label":"in","to":"r1+2.3"}}"#);
        check(
            r#"{"add_edge":{"from":"r1.1","label":"in","to":"r1.3","attributes":{"a":{"type":"bool","value":true}}}}"#,
        );
        check(
            r#"{"update_attributes":{"vertex":"root","attributes":{"level":{"type":"int","value":5},"old":null}}}"#,
        );
        check(r#"{"update_attributes":{"edge":"r1.2","attributes":{"old":null}}}"#);
        check(r#"{"remove_edge":{"from":"r1.1","label":"in","to":"r1.3"}}"#);
        check(concat!(
            r#"{"move_edge":{"old":{"from":"r1.1","label":"in","to":"r1.3"},"#,
            r#""new":{"from":"r1.1","label":"in","to":"r1.5"}}}"#
        ));
        check(r#"{"remove_vertex":{"vertex":"r1.1"}}"#);
    }

    /// `[spec: JSON-2]` `[spec: JSON-9]`
    #[test]
    fn law_unclear_mutations_are_refused() {
        for (text, expected) in [
            (r#"{"remove_vertex":{"vertex":"r1.1","force":true}}"#, "unknown field `force`"),
            (r#"{"remove_vertex":{"vertex":"r1.0"}}"#, "a vertex such as `r3.17`"),
            (r#"{"delete_vertex":{"vertex":"r1.1"}}"#, "unknown variant `delete_vertex`"),
            (r#"{"add_vertex":{"type":"room","name":"k","link":{"label":"RT"}}}"#, "either as `from`"),
            (
                r#"{"update_attributes":{"vertex":"r1.1","edge":"r1.2","attributes":{}}}"#,
                "either a `vertex` or an `edge`",
            ),
            (r#"{"update_attributes":{"vertex":"r1.1","attributes":{"a":null,"a":null}}}"#, "twice"),
        ] {
            let error = serde_json::from_str::<Mutation>(text).unwrap_err().to_string();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }
}
