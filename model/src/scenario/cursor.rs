//! A JSON tree that knows where it is, so that every error names its place. `[spec: SCEN-14]`

use super::error::{Fault, Misfit, nearest};
use serde::de::{Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Number, Value as Json};
use std::fmt;

/// The result of reading one part.
pub(super) type Read<T> = Result<T, Box<Misfit>>;

/// A value and the path to it.
#[derive(Clone, Debug)]
pub(super) struct Cursor<'j> {
    pub(super) value: &'j Json,
    pub(super) path: String,
}

impl<'j> Cursor<'j> {
    /// The whole document.
    pub(super) fn top(value: &'j Json) -> Self {
        Self { value, path: String::new() }
    }

    /// An error here.
    pub(super) fn fault<T>(&self, fault: Fault) -> Read<T> {
        Err(Box::new(Misfit { path: self.path.clone(), fault }))
    }

    fn wrong_form<T>(&self, expected: &'static str) -> Read<T> {
        let found = match self.value {
            Json::Null => "null",
            Json::Bool(_) => "true or false",
            Json::Number(_) => "a number",
            Json::String(_) => "text",
            Json::Array(_) => "a list",
            Json::Object(_) => "an object",
        };
        self.fault(Fault::WrongForm { expected, found })
    }

    /// An object with no other fields than these. `[spec: SCEN-1]`
    pub(super) fn object(&self, allowed: &'static [&'static str]) -> Read<Object<'j>> {
        let Json::Object(map) = self.value else { return self.wrong_form("an object") };
        if let Some(field) = map.keys().find(|key| !allowed.contains(&key.as_str())) {
            let nearest = nearest(field, allowed.iter().copied());
            return self.fault(Fault::UnknownField { field: field.clone(), allowed, nearest });
        }
        Ok(Object { map, path: self.path.clone() })
    }

    /// An object with exactly one field, one of these.
    pub(super) fn variant(&self, allowed: &'static [&'static str]) -> Read<(&'j str, Self)> {
        let object = self.object(allowed)?;
        let mut fields = object.map.keys();
        match (fields.next(), fields.next()) {
            (Some(field), None) => Ok((field, object.need(field)?)),
            _ => self.fault(Fault::NotOneOf { allowed, found: object.map.len() }),
        }
    }

    /// Text.
    pub(super) fn text(&self) -> Read<&'j str> {
        if let Json::String(text) = self.value { Ok(text) } else { self.wrong_form("text") }
    }

    /// Text that is not empty.
    pub(super) fn title(&self) -> Read<&'j str> {
        let text = self.text()?;
        if text.trim().is_empty() { self.fault(Fault::Empty { what: "text" }) } else { Ok(text) }
    }

    /// One of some words.
    pub(super) fn word<T: Copy>(&self, words: &'static [(&'static str, T)]) -> Read<T> {
        let text = self.text()?;
        if let Some((_, meaning)) = words.iter().find(|(word, _)| *word == text) {
            return Ok(*meaning);
        }
        let allowed = words.iter().map(|(word, _)| *word).collect();
        self.fault(Fault::UnknownWord { word: text.into(), allowed })
    }

    /// True or false.
    pub(super) fn flag(&self) -> Read<bool> {
        if let Json::Bool(flag) = self.value { Ok(*flag) } else { self.wrong_form("true or false") }
    }

    /// A number.
    pub(super) fn number(&self) -> Read<f64> {
        self.value.as_f64().map_or_else(|| self.wrong_form("a number"), Ok)
    }

    /// A whole number in a range.
    pub(super) fn whole(&self, least: u64, most: u64) -> Read<u64> {
        match self.value.as_u64() {
            Some(number) if (least..=most).contains(&number) => Ok(number),
            Some(number) => self.fault(Fault::OutOfRange { number, least, most }),
            None => self.wrong_form("a whole number"),
        }
    }

    /// A list of at least `least` and at most `most` items.
    pub(super) fn list(&self, what: &'static str, least: usize, most: usize) -> Read<Vec<Self>> {
        let Json::Array(items) = self.value else { return self.wrong_form("a list") };
        if items.len() < least {
            return self.fault(Fault::Empty { what });
        }
        if items.len() > most {
            return self.fault(Fault::TooMany { what, count: items.len(), most });
        }
        let item = |(at, value)| Self { value, path: format!("{}[{at}]", self.path) };
        Ok(items.iter().enumerate().map(item).collect())
    }
}

/// An object whose fields were checked.
#[derive(Debug)]
pub(super) struct Object<'j> {
    map: &'j Map<String, Json>,
    path: String,
}

impl<'j> Object<'j> {
    /// A field that may be left out.
    pub(super) fn get(&self, field: &str) -> Option<Cursor<'j>> {
        let dot = if self.path.is_empty() { "" } else { "." };
        self.map.get(field).map(|value| Cursor { value, path: format!("{}{dot}{field}", self.path) })
    }

    /// A field that must be there.
    pub(super) fn need(&self, field: &str) -> Read<Cursor<'j>> {
        let missing = || {
            Box::new(Misfit { path: self.path.clone(), fault: Fault::MissingField { field: field.into() } })
        };
        self.get(field).ok_or_else(missing)
    }
}

/// Every field of an object, whatever its name.
pub(super) fn entries<'j>(cursor: &Cursor<'j>) -> Read<Vec<(&'j str, Cursor<'j>)>> {
    let Json::Object(map) = cursor.value else { return cursor.wrong_form("an object") };
    let entry = |(key, value): (&'j String, &'j Json)| {
        (key.as_str(), Cursor { value, path: format!("{}.{key}", cursor.path) })
    };
    Ok(map.iter().map(entry).collect())
}

/// A JSON tree in which no object names a field twice. `[spec: SCEN-1]`
#[derive(Debug)]
pub(super) struct Unique(pub(super) Json);

impl<'de> Deserialize<'de> for Unique {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(UniqueVisitor).map(Self)
    }
}

struct UniqueVisitor;

impl<'de> Visitor<'de> for UniqueVisitor {
    type Value = Json;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Json, E> {
        Ok(Json::Null)
    }

    fn visit_bool<E>(self, flag: bool) -> Result<Json, E> {
        Ok(Json::Bool(flag))
    }

    fn visit_u64<E>(self, number: u64) -> Result<Json, E> {
        Ok(Json::Number(number.into()))
    }

    fn visit_i64<E>(self, number: i64) -> Result<Json, E> {
        Ok(Json::Number(number.into()))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Json, E> {
        Number::from_f64(number).map(Json::Number).ok_or_else(|| E::custom("a number beyond 64-bit floats"))
    }

    fn visit_str<E>(self, text: &str) -> Result<Json, E> {
        Ok(Json::String(text.into()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Json, A::Error> {
        let mut items = Vec::new();
        while let Some(Unique(item)) = access.next_element()? {
            items.push(item);
        }
        Ok(Json::Array(items))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<Json, A::Error> {
        let mut map = Map::new();
        while let Some(key) = access.next_key::<String>()? {
            if map.contains_key(&key) {
                return Err(A::Error::custom(format_args!("the field {key:?} is there twice")));
            }
            map.insert(key, access.next_value::<Unique>()?.0);
        }
        Ok(Json::Object(map))
    }
}
