//! The verdict: one place decides what a run has shown. `[spec: CHECK-1]`
//!
//! A checker that stops early and says nothing is worse than none, and stateright 0.31 can be made to do
//! so: a state or depth target that is reached, or a timeout, counts as done; with no property nothing is
//! explored; with two, the first violation is overwritten by later ones; breadth-first search ignores
//! symmetry. So a run here sets no target and no timeout, has one property and counts for itself whether
//! every state it reached was expanded.

use crate::trace::{CannotHappen, Trace};
use serde::{Deserialize, Serialize};
use std::fmt;

/// What a run has shown, best first. `[spec: CHECK-1]`
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Every state within the bound was judged, and all is well.
    Exhaustive,
    /// All is well as far as the run went, but it stopped before the bound.
    Bounded,
    /// The run was complete, but something it had to see never occurred: the check proves nothing.
    Vacuous,
    /// A clause does not hold.
    Violated,
}

impl Verdict {
    /// The verdict on a run. `[spec: CHECK-1]`
    pub fn of(evidence: Evidence) -> Self {
        if evidence.violated {
            Self::Violated
        } else if !evidence.complete() {
            Self::Bounded
        } else if evidence.unseen > 0 {
            Self::Vacuous
        } else {
            Self::Exhaustive
        }
    }

    /// The word in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Exhaustive => "exhaustive",
            Self::Bounded => "bounded",
            Self::Vacuous => "vacuous",
            Self::Violated => "violated",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// What a run must lay before the judge.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Evidence {
    /// Whether a clause broke, or two engines disagree.
    pub violated: bool,
    /// Whether the search was told to stop early, by anything.
    pub cut: bool,
    /// Different states reached.
    pub unique: u64,
    /// States whose successors were generated.
    pub expanded: u64,
    /// Witnesses that the run had to see and did not.
    pub unseen: usize,
}

impl Evidence {
    /// Whether every state reached was expanded, and at least one was.
    pub fn complete(&self) -> bool {
        !self.cut && self.unique > 0 && self.expanded == self.unique
    }
}

/// A clause judged by a run, or a witness that it had to see.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct PropertyReport {
    /// The clause, or the witness.
    pub clause: String,
    /// `always`: it must hold everywhere. `sometimes`: it must be seen somewhere.
    pub kind: PropertyKind,
    /// What was shown of it.
    pub verdict: Verdict,
    /// The claim that it belongs to, such as `L3`; empty for a witness.
    pub claim: String,
    /// In words.
    pub what: String,
    /// A counterexample's file, if one was written.
    pub trace: Option<String>,
}

/// Whether a property must hold everywhere or be seen somewhere.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PropertyKind {
    /// Everywhere.
    Always,
    /// Somewhere.
    Sometimes,
}

/// How many states a run met.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
pub struct StateCounts {
    /// Different ones.
    pub unique: u64,
    /// Generated, repeated ones included.
    pub generated: u64,
    /// Replica states judged, one of each shape where shapes save judging.
    pub judged: u64,
    /// Delivered subsets of histories that they stand for.
    pub subsets: u64,
    /// Sets that their shapes saved, and that were judged all the same to try the shapes.
    pub sampled: u64,
    /// Deliveries compared in another order.
    pub diamonds: u64,
}

/// What one run has shown.
#[derive(Clone, Debug, Serialize)]
pub struct RunReport {
    /// Which run.
    pub name: String,
    /// `L0`, `L1`, `L2`, `L3` or `scenario`.
    pub layer: String,
    /// Whose semantics.
    pub semantics: String,
    /// How many replicas.
    pub replicas: usize,
    /// Mutations per replica, at most.
    pub mutations: usize,
    /// Vertices in focus and concrete mutations enabled at the start.
    pub focus: usize,
    /// Concrete mutations enabled at the start.
    pub operations: usize,
    /// How many states.
    pub states: StateCounts,
    /// How long it took.
    pub seconds: f64,
    /// How long the first engine took of that, where there are two.
    pub search_seconds: f64,
    /// The verdict on all properties together.
    pub verdict: Verdict,
    /// Clause by clause.
    pub properties: Vec<PropertyReport>,
    /// What the second engine counted, where it ran.
    pub second_engine: Option<StateCounts>,
    /// The chance that a fingerprint collision hid a state.
    pub collision_bound: f64,
    /// Remarks, such as why a run stopped.
    pub notes: Vec<String>,
    /// Counterexamples.
    #[serde(skip)]
    pub traces: Vec<RunTrace>,
    /// Runs that show what a scenario had to see.
    #[serde(skip)]
    pub witnesses: Vec<RunTrace>,
}

/// A counterexample, for people and for programs.
#[derive(Clone, PartialEq, Debug)]
pub struct RunTrace {
    /// The clause that breaks, or the name of a scenario's property.
    pub clause: String,
    /// What is wrong, with the values.
    pub detail: String,
    /// How many steps lead there.
    pub steps: usize,
    /// For people.
    pub text: String,
    /// For programs.
    pub json: serde_json::Value,
}

impl RunReport {
    /// A report without counts and properties, to be filled in.
    pub fn new(name: String, layer: &str, semantics: String, seconds: f64) -> Self {
        Self {
            name,
            layer: layer.into(),
            semantics,
            replicas: 0,
            mutations: 0,
            focus: 0,
            operations: 0,
            states: StateCounts::default(),
            seconds,
            search_seconds: seconds,
            verdict: Verdict::Vacuous,
            properties: Vec::new(),
            second_engine: None,
            collision_bound: 0.0,
            notes: Vec::new(),
            traces: Vec::new(),
            witnesses: Vec::new(),
        }
    }
}

impl RunReport {
    /// Adds a counterexample, or a note on why there is none to show.
    #[must_use]
    pub fn with_trace(mut self, trace: Option<Result<Trace, CannotHappen>>) -> Self {
        match trace {
            Some(Ok(trace)) => self.traces.push(trace.into()),
            Some(Err(why)) => self.notes.push(format!("the counterexample cannot be shown: {why}")),
            None => {}
        }
        self
    }
}

impl PropertyReport {
    /// A clause that holds everywhere.
    pub fn always(clause: &str, claim: &str, what: &str) -> Self {
        Self {
            clause: clause.into(),
            kind: PropertyKind::Always,
            verdict: Verdict::Exhaustive,
            claim: claim.into(),
            what: what.into(),
            trace: None,
        }
    }
}

/// The chance that two of `unique` states share one 64-bit fingerprint: at most n²/2⁶⁵.
pub fn collision_bound(unique: u64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "an estimate")]
    let states = unique as f64;
    states * states / 2f64.powi(65)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOUND: Evidence = Evidence { violated: false, cut: false, unique: 7, expanded: 7, unseen: 0 };

    /// `[spec: CHECK-1]`
    #[test]
    fn law_only_a_complete_witnessed_unbroken_run_is_exhaustive() {
        assert_eq!(Verdict::of(SOUND), Verdict::Exhaustive);
        assert_eq!(Verdict::of(Evidence { unseen: 1, ..SOUND }), Verdict::Vacuous);
        assert_eq!(Verdict::of(Evidence { expanded: 6, ..SOUND }), Verdict::Bounded);
        assert_eq!(Verdict::of(Evidence { cut: true, ..SOUND }), Verdict::Bounded);
        assert_eq!(Verdict::of(Evidence { unique: 0, expanded: 0, ..SOUND }), Verdict::Bounded);
        assert_eq!(
            Verdict::of(Evidence { violated: true, cut: true, unseen: 3, ..SOUND }),
            Verdict::Violated
        );
    }

    /// People and programs read the same word.
    #[test]
    fn law_a_verdict_has_one_name() {
        for verdict in [Verdict::Exhaustive, Verdict::Bounded, Verdict::Vacuous, Verdict::Violated] {
            assert_eq!(serde_json::to_value(verdict).unwrap(), verdict.name());
            assert_eq!(format!("{verdict:>12}|"), format!("{:>12}|", verdict.name()));
        }
    }

    /// Half of the square of the number, over the number of fingerprints.
    #[test]
    fn oracle_the_chance_of_a_collision_is_that_of_birthdays() {
        let bound = |unique| collision_bound(unique).to_bits();
        assert_eq!(bound(0), 0f64.to_bits());
        assert_eq!(bound(1 << 32), 0.5f64.to_bits());
        assert_eq!(bound(1 << 31), 0.125f64.to_bits());
        assert_eq!(bound(3 << 20), (9.0 * 2f64.powi(-25)).to_bits());
    }
}
