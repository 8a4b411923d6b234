//! Attributes given to a mutation.

use super::Draft;
use super::error::AttributeError;
use crate::dictionary::Dictionary;
use crate::dot::Dot;
use crate::limits;
use crate::record::{Name, Record, Write};
use crate::value::Value;
use alloc::collections::BTreeMap;

/// The attributes of a new element.
pub type AttributeMap = BTreeMap<Name, Value>;
/// Attributes to set, or with `None` to unset.
pub type AttributeUpdates = BTreeMap<Name, Option<Value>>;

/// Whether these attributes may be written. `[spec: MUT-3.2]`
pub(super) fn check<'a>(
    dictionary: &Dictionary,
    attributes: impl ExactSizeIterator<Item = (&'a Name, &'a Value)>,
) -> Result<(), AttributeError> {
    if attributes.len() > limits::ATTRIBUTES_MAX {
        return Err(AttributeError::TooMany { count: attributes.len() });
    }
    for (name, value) in attributes {
        check_one(dictionary, name, value)?;
    }
    Ok(())
}

pub(super) fn check_one(dictionary: &Dictionary, name: &Name, value: &Value) -> Result<(), AttributeError> {
    let bytes = name.len();
    if bytes == 0 || bytes > limits::NAME_BYTES_MAX {
        return Err(AttributeError::NameLength { bytes });
    }
    match dictionary.attribute_type(name) {
        None if dictionary.closed => return Err(AttributeError::Undeclared { name: name.clone() }),
        Some(declared) if declared != value.value_type() => {
            return Err(AttributeError::WrongType {
                name: name.clone(),
                declared,
                given: value.value_type(),
            });
        }
        _ => {}
    }
    let bytes = value.payload_bytes();
    if bytes > limits::VALUE_BYTES_MAX {
        return Err(AttributeError::ValueSize { name: name.clone(), bytes });
    }
    Ok(())
}

impl Draft {
    /// Files a write.
    pub(super) fn write(&mut self, target: Dot, name: &Name, value: &Value) {
        let value = value.clone().with_canonical_nans();
        let (timestamp_ns, stamp) = (self.author.timestamp_ns, self.stamp);
        self.add(Record::Write(Write { target, name: name.clone(), value, timestamp_ns, stamp }));
    }

    /// Files the writes of a new element.
    pub(super) fn write_all(&mut self, target: Dot, attributes: &AttributeMap) {
        for (name, value) in attributes {
            self.write(target, name, value);
        }
    }
}
