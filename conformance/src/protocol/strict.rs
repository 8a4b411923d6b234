//! Objects are objects.

use serde::Serialize;
use serde::de::{DeserializeOwned, Error};
use serde_json::Value;

/// Reads a text as a `T`. Beyond what serde refuses, a list in the place of an object is refused: serde takes the items of
/// a list for the members of an object, in order. `[spec: CONF-2]`
pub fn read_strictly<T: DeserializeOwned + Serialize>(text: &str) -> Result<T, serde_json::Error> {
    let read: T = serde_json::from_str(text)?;
    let given: Value = serde_json::from_str(text)?;
    match list_for_object(&given, &serde_json::to_value(&read)?) {
        None => Ok(read),
        Some(place) => Err(Error::custom(format_args!("a list stands where an object is due, at `{place}`"))),
    }
}

/// Where `given` has something else than an object and `due` has one.
fn list_for_object(given: &Value, due: &Value) -> Option<String> {
    let below =
        |key: &str, place: String| if place.is_empty() { key.into() } else { format!("{key}.{place}") };
    match (given, due) {
        (Value::Object(given), Value::Object(due)) => given.iter().find_map(|(key, value)| {
            let place = list_for_object(value, due.get(key)?)?;
            Some(below(key, place))
        }),
        (_, Value::Object(_)) => Some(String::new()),
        (Value::Array(given), Value::Array(due)) => {
            given.iter().zip(due).enumerate().find_map(|(at, (value, due))| {
                let place = list_for_object(value, due)?;
                Some(below(&at.to_string(), place))
            })
        }
        _ => None,
    }
}
