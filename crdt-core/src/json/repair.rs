//! Repairs: `{"kind": "same-key", "hidden": "r1.2", "shown": "r2.1"}`. `[spec: JSON-14]`

use crate::dot::{Dot, EdgeId, VertexId};
use crate::record::Name;
use crate::view::{Repair, Rule};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The kinds are those of [`Repair::kind`].
#[derive(Serialize, Deserialize)]
#[serde(tag = "kind", rename = "Repair", rename_all = "kebab-case", deny_unknown_fields)]
enum Form {
    SameKey { hidden: EdgeId, shown: EdgeId },
    Functional { hidden: EdgeId, shown: EdgeId },
    RtParent { hidden: EdgeId, shown: EdgeId },
    CycleBroken { hidden: EdgeId },
    Detached { vertex: VertexId },
    Reattached { vertex: VertexId },
    NameClash { name: Name, shown: VertexId, hidden: VertexId },
    Undeclared { write: Dot },
}

impl Serialize for Repair {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let form = match self.clone() {
            Self::Superseded { hidden, shown, rule: Rule::SameKey } => Form::SameKey { hidden, shown },
            Self::Superseded { hidden, shown, rule: Rule::Functional } => Form::Functional { hidden, shown },
            Self::Superseded { hidden, shown, rule: Rule::RtParent } => Form::RtParent { hidden, shown },
            Self::CycleBroken { hidden } => Form::CycleBroken { hidden },
            Self::Detached { vertex } => Form::Detached { vertex },
            Self::Reattached { vertex } => Form::Reattached { vertex },
            Self::NameClash { name, shown, hidden } => Form::NameClash { name, shown, hidden },
            Self::Undeclared { write } => Form::Undeclared { write },
        };
        form.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Repair {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(match Form::deserialize(deserializer)? {
            Form::SameKey { hidden, shown } => Self::Superseded { hidden, shown, rule: Rule::SameKey },
            Form::Functional { hidden, shown } => Self::Superseded { hidden, shown, rule: Rule::Functional },
            Form::RtParent { hidden, shown } => Self::Superseded { hidden, shown, rule: Rule::RtParent },
            Form::CycleBroken { hidden } => Self::CycleBroken { hidden },
            Form::Detached { vertex } => Self::Detached { vertex },
            Form::Reattached { vertex } => Self::Reattached { vertex },
            Form::NameClash { name, shown, hidden } => Self::NameClash { name, shown, hidden },
            Form::Undeclared { write } => Self::Undeclared { write },
        })
    }
}
