//! Bytes as text. `[spec: CONF-4]`

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

/// Bytes, written as two lower-case hexadecimal digits each.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Default)]
pub struct Hex(pub Vec<u8>);

impl Hex {
    /// Reads digits; `None` if they are not pairs of lower-case ones.
    pub fn read(digits: &str) -> Option<Self> {
        let digit = |byte: u8| match byte {
            b'0'..=b'9' => Some(byte - b'0'),
            b'a'..=b'f' => Some(byte - b'a' + 10),
            _ => None,
        };
        let pair = |pair: &[u8]| match pair {
            &[high, low] => Some(digit(high)? << 4 | digit(low)?),
            _ => None,
        };
        digits.as_bytes().chunks(2).map(pair).collect::<Option<_>>().map(Self)
    }
}

impl fmt::Display for Hex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl Serialize for Hex {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Hex {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let digits = Cow::<str>::deserialize(deserializer)?;
        Self::read(&digits).ok_or_else(|| D::Error::custom("no pairs of lower-case hexadecimal digits"))
    }
}

impl JsonSchema for Hex {
    fn schema_name() -> Cow<'static, str> {
        "Hex".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Bytes, as two lower-case hexadecimal digits each.",
            "type": "string",
            "pattern": "^([0-9a-f]{2})*$"
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Hex;

    #[test]
    fn law_bytes_are_read_as_they_are_written_and_nothing_else_is() {
        for bytes in [vec![], vec![0], (0..=255).collect()] {
            let text = Hex(bytes.clone()).to_string();
            assert_eq!(Hex::read(&text), Some(Hex(bytes)));
        }
        for wrong in ["0", "0A", "0g", "000", " 00", "é"] {
            assert_eq!(Hex::read(wrong), None, "{wrong:?}");
        }
    }
}
