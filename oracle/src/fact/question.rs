//! Questions as lines, and the core's answers. `[spec: ORACLE-2]`

use super::view_text;
use dsr_core::{
    Author, Delta, Dictionary, Digest, Mutation, State, decode, delta_for, digest, encode, encode_digest,
    fingerprint, view,
};

/// What is asked.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Question {
    /// What two or more states become, left to right.
    Join(Vec<State>),
    /// What a mutation makes, or why it is refused.
    Delta {
        /// Who mutates.
        author: Author,
        /// Where.
        state: State,
        /// What.
        mutation: Mutation,
    },
    /// What is shown.
    View(State),
    /// What others are told.
    Digest(State),
    /// What is sent to the owner of a digest.
    Answer {
        /// Who answers.
        state: State,
        /// What was told.
        digest: Digest,
    },
    /// Whether bytes are a state.
    Accepts(Vec<u8>),
}

/// The kinds of question.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Kind {
    /// See [`Question::Join`].
    Join,
    /// See [`Question::Delta`].
    Delta,
    /// See [`Question::View`].
    View,
    /// See [`Question::Digest`].
    Digest,
    /// See [`Question::Answer`].
    Answer,
    /// See [`Question::Accepts`].
    Accepts,
}

impl Kind {
    /// All six.
    pub const ALL: [Self; 6] =
        [Self::Join, Self::Delta, Self::View, Self::Digest, Self::Answer, Self::Accepts];

    /// The first word of its lines.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Join => "join",
            Self::Delta => "delta",
            Self::View => "view",
            Self::Digest => "digest",
            Self::Answer => "answer",
            Self::Accepts => "accepts",
        }
    }

    /// The kind of a question's line.
    pub fn of_line(line: &str) -> Option<Self> {
        let word = line.split(' ').next()?;
        Self::ALL.into_iter().find(|kind| kind.name() == word)
    }
}

impl Question {
    /// Its kind.
    pub const fn kind(&self) -> Kind {
        match self {
            Self::Join(_) => Kind::Join,
            Self::Delta { .. } => Kind::Delta,
            Self::View(_) => Kind::View,
            Self::Digest(_) => Kind::Digest,
            Self::Answer { .. } => Kind::Answer,
            Self::Accepts(_) => Kind::Accepts,
        }
    }

    /// The line that asks it, without its end.
    pub fn line(&self) -> String {
        let word = self.kind().name();
        match self {
            Self::Join(states) => states.iter().fold(word.into(), |mut line: String, state| {
                line.push(' ');
                line.push_str(&hex(&encode(state)));
                line
            }),
            Self::Delta { author, state, mutation } => {
                let Author { replica, timestamp_ns } = author;
                let (state, mutation) = (hex(&encode(state)), serde_json::to_string(mutation));
                // A mutation is strings and numbers: writing it cannot fail.
                format!("{word} {replica}@{timestamp_ns} {state} {}", mutation.unwrap_or_default())
            }
            Self::View(state) | Self::Digest(state) => format!("{word} {}", hex(&encode(state))),
            Self::Answer { state, digest } => {
                format!("{word} {} {}", hex(&encode(state)), hex(&encode_digest(digest)))
            }
            Self::Accepts(bytes) => format!("{word} {}", hex(bytes)),
        }
    }

    /// What the core answers, under a dictionary.
    pub fn answer(&self, dictionary: &Dictionary) -> String {
        match self {
            Self::Join(states) => {
                let mut states = states.iter();
                let mut joined = states.next().cloned().unwrap_or_default();
                states.for_each(|state| joined.join(state));
                hex(&encode(&joined))
            }
            Self::Delta { author, state, mutation } => {
                match mutation.delta(&view(state, dictionary), *author) {
                    Ok(delta) => made(&delta, &state.joined(&delta)),
                    Err(error) => refused(&error.kind()),
                }
            }
            Self::View(state) => view_text(&view(state, dictionary)),
            Self::Digest(state) => format!("{} {}", hex(&encode_digest(&digest(state))), fingerprint(state)),
            Self::Answer { state, digest } => hex(&encode(&delta_for(state, digest))),
            Self::Accepts(bytes) => if decode(bytes).is_ok() { "yes" } else { "no" }.into(),
        }
    }
}

/// The answer to a mutation that succeeds.
pub fn made(delta: &Delta, after: &State) -> String {
    format!("made {} {}", hex(&encode(delta)), hex(&encode(after)))
}

/// The answer to a mutation that is refused, with the name of its error. `[spec: CONF-8]`
pub fn refused(kind: &str) -> String {
    format!("refused {kind}")
}

/// Bytes as two lower-case hexadecimal digits each.
pub fn hex(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 16] = b"0123456789abcdef";
    let mut text = String::with_capacity(2 * bytes.len());
    for &byte in bytes {
        for digit in [byte >> 4, byte & 15] {
            text.push(char::from(DIGITS[usize::from(digit)]));
        }
    }
    text
}
