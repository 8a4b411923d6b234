//! Authors: `{"replica": "r1", "timestamp_ns": "0"}`. `[spec: JSON-8]`

use super::number::Integer;
use crate::dot::ReplicaId;
use crate::mutation::Author;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// `timestamp_ns` left out is 0.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Author", deny_unknown_fields)]
struct Form {
    replica: ReplicaId,
    #[serde(default)]
    timestamp_ns: Integer,
}

impl Serialize for Author {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Form { replica: self.replica, timestamp_ns: Integer(self.timestamp_ns) }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Author {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Form { replica, timestamp_ns } = Form::deserialize(deserializer)?;
        Ok(Self { replica, timestamp_ns: timestamp_ns.0 })
    }
}
