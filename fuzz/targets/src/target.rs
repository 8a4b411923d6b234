//! What a target is, and what comes of an input.

use std::collections::BTreeSet;
use std::fmt::{Debug, Display};

/// A law that does not hold, found by an input. The fuzzer panics with it.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("[{clause}] {what}")]
pub struct Broken {
    /// The clause of the specification.
    pub clause: &'static str,
    /// What was found, with the values.
    pub what: String,
}

impl Broken {
    pub(crate) fn new(clause: &'static str, what: impl Display) -> Self {
        Self { clause, what: what.to_string() }
    }
}

/// The rare things that an input has brought about: what a run has really tried.
///
/// They are told by looking at what comes out, never by asking the code that is tried.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Marks(BTreeSet<String>);

impl Marks {
    pub(crate) fn add(&mut self, mark: impl Into<String>) {
        self.0.insert(mark.into());
    }

    pub(crate) fn add_if(&mut self, reached: bool, mark: &str) {
        if reached && !self.0.contains(mark) {
            self.0.insert(mark.into());
        }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// All, in order.
    pub fn iter(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(String::as_str)
    }

    /// Whether this one was reached.
    pub fn has(&self, mark: &str) -> bool {
        self.0.contains(mark)
    }
}

/// What comes of an input: what it has reached, or the law that it breaks.
pub type Outcome = Result<Marks, Broken>;

/// One thing that is fuzzed.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its name, as cargo-fuzz has it.
    pub name: &'static str,
    /// What is tried, in a few words.
    pub about: &'static str,
    /// Tries one input.
    pub run: fn(&[u8]) -> Outcome,
    /// Every mark that the seeds must reach.
    pub marks: &'static [&'static str],
    /// Inputs to begin with, made without chance.
    pub first: fn() -> Vec<Vec<u8>>,
}

impl Target {
    /// Whether any bytes spell something: then 0 is the simplest of them.
    pub fn is_structured(&self) -> bool {
        matches!(self.name, "history" | "view" | "answer")
    }
}

/// A law: what must hold, or what was found.
pub(crate) fn holds(clause: &'static str, is_so: bool, what: impl FnOnce() -> String) -> Result<(), Broken> {
    if is_so { Ok(()) } else { Err(Broken { clause, what: what() }) }
}

/// A law: two values are equal.
pub(crate) fn equal<T: PartialEq + Debug>(
    clause: &'static str,
    what: &str,
    left: &T,
    right: &T,
) -> Result<(), Broken> {
    holds(clause, left == right, || format!("{what}:\n{left:#?}\nand\n{right:#?}"))
}

/// The name of a variant: what `Debug` prints before the first sign that is no letter.
pub(crate) fn variant(value: &impl Debug) -> String {
    let text = format!("{value:?}");
    text.split(|sign: char| !sign.is_alphanumeric()).next().unwrap_or_default().to_owned()
}
