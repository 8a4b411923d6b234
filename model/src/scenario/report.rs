//! What an exploration found. `[spec: SCEN-12]`

use super::property::PropertyKind;
use super::trace::Trace;
use serde::Serialize;
use std::fmt;

/// What an exploration covered and found. `[spec: SCEN-12]`
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Report {
    /// The scenario.
    pub name: String,
    /// Its replicas; the first is r1.
    pub replicas: Vec<String>,
    /// Mutations in its longest history, at most; a group counts as one.
    pub mutations: usize,
    /// Different histories.
    pub histories: u64,
    /// Histories generated, repeated ones included.
    pub generated: u64,
    /// Histories that ended.
    pub ends: u64,
    /// Different replica states, each judged.
    pub states: u64,
    /// Different deliveries of a delta to a state, each judged.
    pub deliveries: u64,
    /// How long it took, traces included.
    pub seconds: f64,
    /// Whether all histories were explored.
    pub complete: bool,
    /// Of which subsets of the deltas the states were judged.
    pub coverage: Coverage,
    /// The kinds of repair that some view reports.
    pub repairs: Vec<&'static str>,
    /// Steps that no replica ever takes: most likely a guard that never holds.
    pub idle: Vec<IdleStep>,
    /// The clause that is broken, if one is; then nothing else is complete.
    pub breach: Option<ScenarioBreach>,
    /// The scenario's properties, in its order.
    pub properties: Vec<PropertyReport>,
}

impl Report {
    /// Whether all is as it ought to be: complete, no clause broken, every property holds or is witnessed, and
    /// every step is taken.
    pub fn is_as_expected(&self) -> bool {
        let good =
            |property: &PropertyReport| matches!(property.verdict, Verdict::Holds | Verdict::Witnessed);
        self.complete && self.breach.is_none() && self.idle.is_empty() && self.properties.iter().all(good)
    }
}

/// Of which subsets of the broadcast deltas the states were judged. `[spec: SCEN-11]`
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Coverage {
    /// Of every subset of every history's.
    EverySubset,
    /// Some maximal histories have too many deltas: of these, only the states that replicas reached.
    ReachedOnly {
        /// How many sets of deltas are too large.
        histories: usize,
    },
}

/// A step that no replica ever takes.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct IdleStep {
    /// Whose.
    pub replica: String,
    /// Its index in the script, from 0; for a free replica 0, its whole alphabet.
    pub step: usize,
}

/// A clause that is broken.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ScenarioBreach {
    /// The clause.
    pub clause: &'static str,
    /// How.
    pub detail: String,
    /// A shortest way there.
    pub trace: Option<Trace>,
}

/// What was found of one property.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct PropertyReport {
    /// Its name.
    pub name: String,
    /// Why it is asked.
    pub why: String,
    /// When it is asked.
    pub kind: PropertyKind,
    /// The verdict.
    pub verdict: Verdict,
    /// A shortest counterexample or witness.
    pub trace: Option<Trace>,
}

/// The verdict on a property.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It holds in all that was to be asked.
    Holds,
    /// It does not: there is a counterexample.
    Violated,
    /// It was seen.
    Witnessed,
    /// It is never seen: a finding.
    NotWitnessed,
    /// The exploration was not complete and has met neither a counterexample nor a witness.
    Undecided,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Holds => "holds",
            Self::Violated => "violated",
            Self::Witnessed => "witnessed",
            Self::NotWitnessed => "not witnessed",
            Self::Undecided => "undecided",
        })
    }
}
