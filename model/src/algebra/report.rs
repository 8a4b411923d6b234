//! What a run of L0 found.

use serde::Serialize;

/// Whether a law is about all instances or asks for one.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantifier {
    /// It must hold of every instance.
    All,
    /// An instance must exist.
    Some,
}

/// A law by name.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Law {
    pub(super) clause: &'static str,
    pub(super) says: &'static str,
    pub(super) quantifier: Quantifier,
}

/// States that break a law, or that witness it where one instance is asked for.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Example {
    /// The family of records.
    pub family: &'static str,
    /// The clause that is broken: the law's, or the one that judging a state named.
    pub clause: &'static str,
    /// The states for people, by the names that the law gives them.
    pub states: Vec<(&'static str, String)>,
    /// The same states as JSON.
    pub json: Vec<serde_json::Value>,
    /// What was found.
    pub detail: String,
}

/// One law on all instances.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct LawReport {
    /// The clause that states it.
    pub clause: &'static str,
    /// The law in words.
    pub law: &'static str,
    /// Whether it is about all instances or asks for one.
    pub quantifier: Quantifier,
    /// How many instances were looked at.
    pub instances: u64,
    /// The first counterexample; for a law that asks for an instance, the first witness.
    pub example: Option<Example>,
}

impl LawReport {
    /// Whether it was checked on anything at all. A semantics without a means (no resynchronisation, say)
    /// has no instances of the laws about it.
    pub fn is_vacuous(&self) -> bool {
        self.instances == 0
    }

    /// Whether a counterexample was found, or the witness asked for was not.
    pub fn is_violated(&self) -> bool {
        match self.quantifier {
            Quantifier::All => self.example.is_some(),
            Quantifier::Some => !self.is_vacuous() && self.example.is_none(),
        }
    }
}

/// Every law on every state over some records.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Report {
    /// Of which semantics.
    pub semantics: String,
    /// Records of each family.
    pub records: usize,
    /// Families of records.
    pub families: usize,
    /// States enumerated, in all families.
    pub states: usize,
    /// Each law.
    pub laws: Vec<LawReport>,
}

impl Report {
    /// The first law that is broken.
    pub fn violation(&self) -> Option<&LawReport> {
        self.laws.iter().find(|law| law.is_violated())
    }

    /// Instances of all laws together.
    pub fn instances(&self) -> u64 {
        self.laws.iter().map(|law| law.instances).sum()
    }
}

/// Counts instances of one law and keeps the first example.
#[derive(Debug)]
pub(super) struct Tally {
    law: Law,
    instances: u64,
    example: Option<Example>,
}

impl Tally {
    pub(super) fn new(law: Law) -> Self {
        Self { law, instances: 0, example: None }
    }

    /// One instance: `holds` says whether the law's condition is true of it.
    pub(super) fn instance(&mut self, holds: bool, example: impl FnOnce(&'static str) -> Example) {
        self.instances += 1;
        let noteworthy = holds == (self.law.quantifier == Quantifier::Some);
        if noteworthy && self.example.is_none() {
            self.example = Some(example(self.law.clause));
        }
    }

    pub(super) fn finish(self) -> LawReport {
        let Law { clause, says, quantifier } = self.law;
        LawReport { clause, law: says, quantifier, instances: self.instances, example: self.example }
    }
}
