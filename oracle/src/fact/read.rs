//! Lines as questions: what a program that is asked does first. `[spec: ORACLE-2]`

use super::Question;
use dsr_conformance::protocol::Hex;
use dsr_core::{Author, DecodeError, Digest, State, decode, decode_digest};

/// A line that asks nothing.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Unreadable {
    /// The first word is none of the chapter's.
    #[error("no question begins with {word:?}")]
    Word {
        /// The word.
        word: String,
    },
    /// Something that a question needs is not there, or there is too much.
    #[error("a question `{word}` is: {form}")]
    Form {
        /// The first word.
        word: &'static str,
        /// What the chapter says.
        form: &'static str,
    },
    /// What should be bytes is not.
    #[error("no pairs of lower-case hexadecimal digits")]
    Hex,
    /// Bytes are no state, or no digest.
    #[error("{0}")]
    Bytes(#[from] DecodeError),
    /// A mutation is none.
    #[error("no mutation: {why}")]
    Mutation {
        /// Why.
        why: String,
    },
}

/// Reads the line of a question.
pub fn read(line: &str) -> Result<Question, Unreadable> {
    let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
    match word {
        "join" => {
            let states = rest.split(' ').map(state).collect::<Result<Vec<_>, _>>()?;
            let form = Unreadable::Form { word: "join", form: "two or more states" };
            if states.len() < 2 { Err(form) } else { Ok(Question::Join(states)) }
        }
        "delta" => delta(rest),
        "view" => state(rest).map(Question::View),
        "digest" => state(rest).map(Question::Digest),
        "answer" => {
            let form = Unreadable::Form { word: "answer", form: "a state and a digest" };
            let (ours, theirs) = rest.split_once(' ').ok_or(form)?;
            Ok(Question::Answer { state: state(ours)?, digest: digest(theirs)? })
        }
        "accepts" => bytes(rest).map(Question::Accepts),
        _ => Err(Unreadable::Word { word: word.chars().take(40).collect() }),
    }
}

fn delta(rest: &str) -> Result<Question, Unreadable> {
    let form = || Unreadable::Form { word: "delta", form: "an author such as `r1@0`, a state, a mutation" };
    let mut parts = rest.splitn(3, ' ');
    let (Some(who), Some(before), Some(mutation)) = (parts.next(), parts.next(), parts.next()) else {
        return Err(form());
    };
    let (replica, time) = who.split_once('@').ok_or_else(form)?;
    let (Ok(replica), Ok(timestamp_ns)) = (replica.parse(), time.parse()) else { return Err(form()) };
    let author = Author { replica, timestamp_ns };
    let mutation = serde_json::from_str(mutation);
    let mutation = mutation.map_err(|error| Unreadable::Mutation { why: error.to_string() })?;
    Ok(Question::Delta { author, state: state(before)?, mutation })
}

fn bytes(digits: &str) -> Result<Vec<u8>, Unreadable> {
    Hex::read(digits).map(|hex| hex.0).ok_or(Unreadable::Hex)
}

fn state(digits: &str) -> Result<State, Unreadable> {
    Ok(decode(&bytes(digits)?)?)
}

fn digest(digits: &str) -> Result<Digest, Unreadable> {
    Ok(decode_digest(&bytes(digits)?)?)
}
