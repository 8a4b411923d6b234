//! What is wrong with a scenario's file: where, with what values, and what to do. `[spec: SCEN-14]`

use std::fmt;

/// A scenario that cannot be read. `[spec: SCEN-14]`
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ScenarioError {
    /// The file's name, as it was given.
    pub file: String,
    /// Where in it, such as `replicas[1].script[0].when.edge.to`; empty for the whole.
    pub path: String,
    /// What is wrong.
    pub fault: Fault,
}

impl fmt::Display for ScenarioError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.file)?;
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        self.fault.fmt(f)
    }
}

impl std::error::Error for ScenarioError {}

/// A fault and its path, before the file's name is known.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Misfit {
    pub(super) path: String,
    pub(super) fault: Fault,
}

impl Misfit {
    pub(super) fn in_file(self, file: &str) -> ScenarioError {
        ScenarioError { file: file.into(), path: self.path, fault: self.fault }
    }
}

/// What is wrong with a scenario's file. `[spec: SCEN-14]`
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// The file, or one that it names, cannot be opened.
    #[error("cannot be opened: {reason}")]
    Unreadable {
        /// Why, as the system says.
        reason: String,
    },
    /// The file is too large.
    #[error(
        "has {bytes} bytes; allowed are {most}: a scenario is written by hand, large graphs go into a scene file"
    )]
    TooLarge {
        /// Its size.
        bytes: usize,
        /// The limit.
        most: usize,
    },
    /// The text is not JSON, or names a field twice.
    #[error("not a JSON object that names each field once: {reason}")]
    Syntax {
        /// What the parser says, with line and column.
        reason: String,
    },
    /// A value of another form.
    #[error("expected {expected}, found {found}")]
    WrongForm {
        /// What is expected.
        expected: &'static str,
        /// What is there.
        found: &'static str,
    },
    /// A field that the format does not have.
    #[error("no field {field:?} belongs here{}; the fields are {}", hint(nearest.as_deref()), allowed.join(", "))]
    UnknownField {
        /// The field.
        field: String,
        /// What the format has.
        allowed: &'static [&'static str],
        /// What may have been meant.
        nearest: Option<String>,
    },
    /// A field is missing.
    #[error("the field {field:?} is missing")]
    MissingField {
        /// The field.
        field: String,
    },
    /// Exactly one of some fields is needed.
    #[error("expected exactly one of {}, found {found}", allowed.join(", "))]
    NotOneOf {
        /// The fields.
        allowed: &'static [&'static str],
        /// How many are there.
        found: usize,
    },
    /// A word that has no meaning here.
    #[error("{word:?} means nothing here; write one of {}", allowed.join(", "))]
    UnknownWord {
        /// The word.
        word: String,
        /// The words that do.
        allowed: Vec<&'static str>,
    },
    /// A number out of its range.
    #[error("{number} is out of range; allowed are {least} to {most}")]
    OutOfRange {
        /// The number.
        number: u64,
        /// The least allowed.
        least: u64,
        /// The greatest allowed.
        most: u64,
    },
    /// Nothing where something is needed.
    #[error("empty {what}: write at least one")]
    Empty {
        /// What is empty.
        what: &'static str,
    },
    /// Too many.
    #[error("{count} {what}; allowed are {most}")]
    TooMany {
        /// What.
        what: &'static str,
        /// How many.
        count: usize,
        /// The limit.
        most: usize,
    },
    /// A name that means nothing.
    #[error("there is no {what} {name:?}{}", hint(nearest.as_deref()))]
    UnknownName {
        /// What it should name, such as `vertex in the scene, the setup or any script`.
        what: &'static str,
        /// The name.
        name: String,
        /// What may have been meant.
        nearest: Option<String>,
    },
    /// A name that is taken.
    #[error("{name:?} is the name of another {what}: give this one a name of its own")]
    Repeated {
        /// Of what.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A value that its attribute cannot have.
    #[error("not a value of {name:?}: {reason}")]
    BadValue {
        /// The attribute.
        name: String,
        /// Why.
        reason: String,
    },
    /// A field without another that it needs.
    #[error("{field:?} needs {needed} beside it")]
    Needs {
        /// The field.
        field: &'static str,
        /// What it needs.
        needed: &'static str,
    },
    /// A predicate that does not belong here.
    #[error("`done` speaks of the end: use it in `at_end` or `sometimes_at_end` only")]
    DoneBeforeEnd,
    /// The dictionary cannot be read.
    #[error("not a dictionary: {reason}")]
    Dictionary {
        /// Why.
        reason: String,
    },
    /// The scene has faults.
    #[error("the scene has faults: {reason}")]
    Scene {
        /// All of them.
        reason: String,
    },
    /// A mutation of the setup is refused.
    #[error("the setup cannot do this: {reason}")]
    Setup {
        /// Why.
        reason: String,
    },
}

fn hint(nearest: Option<&str>) -> String {
    nearest.map(|name| format!(" (did you mean {name:?}?)")).unwrap_or_default()
}

/// The known name most like this one, if any is alike.
pub(super) fn nearest<'n>(name: &str, known: impl Iterator<Item = &'n str>) -> Option<String> {
    let alike = known.map(|other| (distance(name, other), other)).min()?;
    let most = name.chars().count() / 3 + 1;
    (alike.0 <= most).then(|| alike.1.to_owned())
}

/// Levenshtein's distance.
fn distance(left: &str, right: &str) -> usize {
    let right: Vec<char> = right.chars().collect();
    let mut row: Vec<usize> = (0..=right.len()).collect();
    for (at, from) in left.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = at + 1;
        for (column, to) in right.iter().enumerate() {
            let replaced = diagonal + usize::from(from != *to);
            diagonal = row[column + 1];
            row[column + 1] = replaced.min(diagonal + 1).min(row[column] + 1);
        }
    }
    row[right.len()]
}
