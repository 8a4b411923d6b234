//! The parts of which every object of a scene file is made: keys, ids, names. `[spec: SCENE-6]`

use super::collect::Faults;
use super::fault::FaultKind;
use super::place::Place;
use super::syntax::{Entry, Form, Node};
use super::values;
use crate::dictionary::Dictionary;
use crate::limits;
use crate::record::Name;
use alloc::borrow::ToOwned;

/// Reads the parts of a file; what is wrong becomes a fault and nothing.
pub(super) struct Reader<'r> {
    pub(super) dictionary: &'r Dictionary,
    pub(super) faults: &'r mut Faults,
}

impl Reader<'_> {
    /// The values of the known keys; unknown and repeated keys become faults, and the first of several counts.
    pub(super) fn fields<'n, 't, const N: usize>(
        &mut self,
        entries: &'n [Entry<'t>],
        known: [&str; N],
        place: &Place,
    ) -> [Option<&'n Node<'t>>; N] {
        let mut found = [None; N];
        for entry in entries {
            let slot = known.iter().position(|key| *key == entry.key).and_then(|index| found.get_mut(index));
            match slot {
                Some(slot @ None) => *slot = Some(&entry.value),
                Some(Some(_)) => {
                    self.faults.push(
                        entry.at,
                        place,
                        FaultKind::RepeatedKey { key: (*entry.key).to_owned() },
                    );
                }
                None => {
                    self.faults.push(entry.at, place, FaultKind::UnknownKey { key: (*entry.key).to_owned() });
                }
            }
        }
        found
    }

    pub(super) fn wrong_form(
        &mut self,
        node: &Node<'_>,
        what: &'static str,
        expected: &'static str,
        place: &Place,
    ) {
        self.faults.push(node.at, place, FaultKind::WrongForm { what, expected, found: node.describe() });
    }

    pub(super) fn object<'n, 't>(
        &mut self,
        node: &'n Node<'t>,
        what: &'static str,
        place: &Place,
    ) -> Option<&'n [Entry<'t>]> {
        if let Form::Object(entries) = &node.form {
            return Some(entries);
        }
        self.wrong_form(node, what, "an object", place);
        None
    }

    pub(super) fn required<'n, 't>(
        &mut self,
        at: usize,
        node: Option<&'n Node<'t>>,
        key: &'static str,
        place: &Place,
    ) -> Option<&'n Node<'t>> {
        if node.is_none() {
            self.faults.push(at, place, FaultKind::MissingKey { key });
        }
        node
    }

    /// An id as a number or as its digits in quotes. `[spec: SCENE-7]`
    pub(super) fn id(&mut self, node: &Node<'_>, place: &Place) -> Option<u64> {
        let text = match &node.form {
            Form::Number(text) => *text,
            Form::Text(text) => text,
            _ => {
                self.wrong_form(node, "an id", "a whole number, plain or in quotes", place);
                return None;
            }
        };
        let id = if values::canonical_digits(text) { text.parse().ok() } else { None };
        if id.is_none() {
            self.faults.push(node.at, place, FaultKind::BadId { text: text.to_owned() });
        }
        id
    }

    /// A name, type or label: text of 1 to 255 bytes.
    pub(super) fn name(&mut self, node: &Node<'_>, what: &'static str, place: &Place) -> Option<Name> {
        let Form::Text(text) = &node.form else {
            self.wrong_form(node, what, "text", place);
            return None;
        };
        self.name_text(node.at, text, what, place)
    }

    pub(super) fn name_text(
        &mut self,
        at: usize,
        text: &str,
        what: &'static str,
        place: &Place,
    ) -> Option<Name> {
        let bytes = text.len();
        if bytes == 0 || bytes > limits::NAME_BYTES_MAX {
            self.faults.push(at, place, FaultKind::NameLength { what, bytes });
            return None;
        }
        Some(text.into())
    }
}
