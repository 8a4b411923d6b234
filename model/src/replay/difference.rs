//! Where two values of one form differ.

use serde::Serialize;
use serde_json::Value;
use std::fmt;

/// The first place where what is written and what comes out differ.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Difference {
    /// The path there, as in `changes[1].after.attributes.x`.
    pub path: String,
    /// What is written there, as JSON; `nothing` if nothing is.
    pub written: String,
    /// What comes out, as JSON.
    pub found: String,
}

/// As in `changes[0].after.name is "bed", but comes out as "chair"`.
impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is {}, but comes out as {}", self.path, self.written, self.found)
    }
}

/// The most characters of a value in a difference.
const VALUE_MAX: usize = 200;

impl Difference {
    /// The first difference between two values of one type, if there is any.
    pub fn between<T: Serialize>(written: &T, found: &T) -> Option<Self> {
        let json = |value: &T| serde_json::to_value(value).unwrap_or_default();
        first(String::new(), Some(&json(written)), Some(&json(found)))
    }
}

fn first(path: String, written: Option<&Value>, found: Option<&Value>) -> Option<Difference> {
    match (written, found) {
        (written, found) if written == found => None,
        (Some(Value::Object(left)), Some(Value::Object(right))) => {
            let mut keys: Vec<&String> = left.keys().chain(right.keys()).collect();
            keys.sort_unstable();
            keys.dedup();
            let dot = if path.is_empty() { "" } else { "." };
            keys.into_iter().find_map(|key| first(format!("{path}{dot}{key}"), left.get(key), right.get(key)))
        }
        (Some(Value::Array(left)), Some(Value::Array(right))) => (0..left.len().max(right.len()))
            .find_map(|at| first(format!("{path}[{at}]"), left.get(at), right.get(at))),
        _ => Some(Difference { path, written: short(written), found: short(found) }),
    }
}

fn short(value: Option<&Value>) -> String {
    let Some(value) = value else { return "nothing".into() };
    let text = value.to_string();
    if text.chars().count() <= VALUE_MAX {
        return text;
    }
    text.chars().take(VALUE_MAX).chain(['…']).collect()
}
