//! What a file expects, beside what the program would have written there. `[spec: ORACLE-4]`

use super::script::Said;
use dsr_conformance::protocol::{Hex, View};
use dsr_core::{Digest, State};
use serde::Deserialize;
use serde_json::{Value, json};

/// The expectation of a step.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Expected {
    /// This view; `repairs` only if there.
    View(View),
    /// A refusal, of this kind if one is named.
    Refused(Option<String>),
    /// This handle, or none.
    Vertex(Option<String>),
    /// This state, in JSON.
    State(Value),
    /// This digest, in JSON.
    Digest(Value),
    /// These bytes.
    Bytes(Hex),
}

impl Expected {
    /// What the file says and what the program says, if these differ.
    pub(super) fn differs(&self, said: &Said) -> Option<(String, String)> {
        let ok = match said {
            Said::Ok(ok) => Some(ok),
            Said::Declined(..) => None,
        };
        let of = |key: &str| ok.and_then(|ok| ok.get(key)).cloned();
        let (due, came) = match self {
            Self::View(expected) => {
                let mut came = of("view");
                let due = expected.clone().canonical();
                if let (None, Some(Value::Object(view))) = (&due.repairs, &mut came) {
                    view.remove("repairs");
                }
                (serde_json::to_value(due).ok(), came)
            }
            Self::Refused(kind) => {
                let came = match said {
                    Said::Declined(code, Value::Null) => Some(json!([code])),
                    Said::Declined(code, found) if kind.is_some() => Some(json!([code, found])),
                    Said::Declined(code, _) => Some(json!([code])),
                    Said::Ok(ok) => Some(ok.clone()),
                };
                let due = kind.as_ref().map_or_else(|| json!(["refused"]), |kind| json!(["refused", kind]));
                (Some(due), came)
            }
            Self::Vertex(vertex) => (Some(json!(vertex)), of("vertex")),
            Self::State(expected) => return differ::<State>(expected, of("state")),
            Self::Digest(expected) => return differ::<Digest>(expected, of("digest")),
            Self::Bytes(bytes) => (Some(json!(bytes)), of("bytes")),
        };
        (due != came).then(|| (text(due), text(came)))
    }
}

/// Compared as what they mean: whether each of them is written as it should be, the reply's own comparison tells.
fn differ<T: PartialEq + for<'de> Deserialize<'de>>(
    due: &Value,
    came: Option<Value>,
) -> Option<(String, String)> {
    let is_equal = match (T::deserialize(due), came.as_ref().map(T::deserialize)) {
        (Ok(due), Some(Ok(came))) => due == came,
        _ => false,
    };
    (!is_equal).then(|| (due.to_string(), text(came)))
}

fn text(value: Option<Value>) -> String {
    value.map_or_else(|| "nothing".into(), |value| value.to_string())
}
