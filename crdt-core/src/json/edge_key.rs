//! Edge keys: `{"from": "r1.1", "label": "in", "to": "r1.3"}`. `[spec: JSON-8]`

use crate::dot::VertexId;
use crate::record::{EdgeKey, Name};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Serialize, Deserialize)]
#[serde(rename = "EdgeKey", deny_unknown_fields)]
struct Form {
    from: VertexId,
    label: Name,
    to: VertexId,
}

impl Serialize for EdgeKey {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Form { from: self.from, label: self.label.clone(), to: self.to }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for EdgeKey {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Form { from, label, to } = Form::deserialize(deserializer)?;
        Ok(Self { from, to, label })
    }
}
