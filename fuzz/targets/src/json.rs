//! Any text into the readers of JSON forms: what is accepted is written again as the same value, and is
//! well-formed; what is refused is explained. `[spec: JSON-1]` `[spec: JSON-2]`

use crate::laws;
use crate::target::{Marks, Outcome, equal, holds};
use dsr_core::{
    Author, Dictionary, Digest, Mutation, Record, Repair, State, Value, check_digest, check_well_formed,
};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;

/// A state, a digest, a record or a repair.
pub(crate) fn state(bytes: &[u8]) -> Outcome {
    let mut marks = Marks::default();
    if let Some(state) = read::<State>("JSON-12", "state", bytes, &mut marks)? {
        equal("JSON-12", "a state that was read", &check_well_formed(&state), &Ok(()))?;
        laws::of_state(&state)?;
    }
    if let Some(digest) = read::<Digest>("JSON-13", "digest", bytes, &mut marks)? {
        equal("JSON-13", "a digest that was read", &check_digest(&digest), &Ok(()))?;
    }
    read::<Record>("JSON-10", "record", bytes, &mut marks)?;
    read::<Repair>("JSON-14", "repair", bytes, &mut marks)?;
    Ok(marks)
}

/// A mutation, an author or a value.
pub(crate) fn mutation(bytes: &[u8]) -> Outcome {
    let mut marks = Marks::default();
    if let Some(mutation) = read::<Mutation>("JSON-9", "mutation", bytes, &mut marks)? {
        marks.add(format!("accepted-{}", mutation.kind().name()));
    }
    read::<Author>("JSON-8", "author", bytes, &mut marks)?;
    if let Some(value) = read::<Value>("JSON-4", "value", bytes, &mut marks)? {
        marks.add(format!("value-{}", value.value_type()));
        holds("WF-6", value.has_canonical_nans(), || format!("{value:?}"))?;
    }
    Ok(marks)
}

/// A dictionary.
pub(crate) fn dictionary(bytes: &[u8]) -> Outcome {
    let mut marks = Marks::default();
    if let Some(dictionary) = read::<Dictionary>("JSON-7", "dictionary", bytes, &mut marks)? {
        marks.add_if(dictionary.closed, "closed");
        marks.add_if(!dictionary.functional_labels.is_empty(), "functional");
        marks.add_if(!dictionary.attributes.is_empty(), "attributes");
        holds("DICT-3", !dictionary.is_functional("RT"), || format!("{dictionary:?}"))?;
    }
    Ok(marks)
}

/// Reads a text as a `T`; what is accepted is written and read again.
fn read<T: Serialize + DeserializeOwned + PartialEq + Debug>(
    clause: &'static str,
    what: &str,
    bytes: &[u8],
    marks: &mut Marks,
) -> Result<Option<T>, crate::Broken> {
    match serde_json::from_slice::<T>(bytes) {
        Ok(value) => {
            laws::json_round_trip(clause, &value)?;
            marks.add(format!("accepted-{what}"));
            Ok(Some(value))
        }
        Err(error) => {
            let text = error.to_string();
            holds("JSON-2", text.len() > 10, || format!("no explanation: {text}"))?;
            refused(what, &text, &error, marks);
            Ok(None)
        }
    }
}

/// Why: the clause at either end of the message, one of its beginnings or ends, or what serde calls it. What stands
/// in between may be the input's own words.
fn refused(what: &str, text: &str, error: &serde_json::Error, marks: &mut Marks) {
    let tail = format!(" at line {} column {}", error.line(), error.column());
    let text = text.strip_suffix(&tail).unwrap_or(text);
    let begins = [
        ("unknown field", "unknown-field"),
        ("unknown variant", "unknown-variant"),
        ("missing field", "missing-field"),
        ("duplicate field", "duplicate-field"),
        ("an object names a key twice", "key-twice"),
        ("a list names an item twice", "item-twice"),
        ("the name \"\" has 0 bytes", "empty-name"),
    ];
    let ends = [
        ("maximal runs of sequences such as \"1-5,7\"", "runs"),
        ("not among the edge_labels of this closed dictionary", "undeclared-functional"),
    ];
    let begin = begins.iter().find(|(begin, _)| text.starts_with(begin));
    let end = ends.iter().find(|(end, _)| text.ends_with(end));
    if let Some(clause) = clause_of(text) {
        marks.add(format!("refused-{what}-{clause}"));
    } else if let Some((_, mark)) = begin.or(end) {
        marks.add(format!("refused-{what}-{mark}"));
    } else {
        // Each category once for all forms: the reader of JSON text is one.
        match error.classify() {
            serde_json::error::Category::Syntax => marks.add("refused-syntax"),
            serde_json::error::Category::Eof => marks.add("refused-end"),
            _ => marks.add(format!("refused-{what}")),
        }
    }
}

/// The clause in square brackets with which a message begins or ends.
fn clause_of(text: &str) -> Option<&str> {
    let first = text.strip_prefix('[').and_then(|rest| rest.split_once(']')).map(|(clause, _)| clause);
    let last = text.strip_suffix(']').and_then(|rest| rest.rsplit_once('[')).map(|(_, clause)| clause);
    let is_clause = |clause: &&str| {
        let parts = clause.split_once('-');
        parts.is_some_and(|(chapter, number)| {
            !chapter.is_empty()
                && chapter.bytes().all(|byte| byte.is_ascii_uppercase())
                && number.parse::<u8>().is_ok()
        })
    };
    first.filter(is_clause).or(last.filter(is_clause))
}
