//! Facts: what is asked of a program, and what the core answers. `[spec: ORACLE-2]`

mod question;
mod read;
mod view_text;

pub use question::{Kind, Question, hex, made, refused};
pub use read::{Unreadable, read};
pub use view_text::view_text;

use dsr_core::{Author, Dictionary, Digest, Mutation, State, digest};

/// The two facts of a state: what it shows, and what of it others are told. `[spec: ORACLE-2]`
pub fn of_state(state: &State) -> [Question; 2] {
    [Question::View(state.clone()), Question::Digest(state.clone())]
}

/// The fact of an answer to a digest.
pub fn of_answer(state: &State, theirs: &State) -> Question {
    of_answer_to(state, &digest(theirs))
}

/// The same, where the digest has come from somewhere.
pub fn of_answer_to(state: &State, theirs: &Digest) -> Question {
    Question::Answer { state: state.clone(), digest: theirs.clone() }
}

/// The fact of a mutation: its delta and the state after it, or why it is refused.
pub fn of_mutation(state: &State, author: Author, mutation: &Mutation) -> Question {
    Question::Delta { author, state: state.clone(), mutation: mutation.clone() }
}

/// The fact of a join.
pub fn of_join(states: &[&State]) -> Question {
    Question::Join(states.iter().map(|&state| state.clone()).collect())
}

/// The line that sets the dictionary. `[spec: ORACLE-2]`
pub fn dictionary_line(dictionary: &Dictionary) -> String {
    // A dictionary is maps of strings: writing it cannot fail.
    format!("dictionary {}", serde_json::to_string(dictionary).unwrap_or_default())
}

/// What is answered to [`dictionary_line`].
pub const TAKEN: &str = "ok";
