//! Scenarios: agents as replicas. `[spec: SCEN-1]`
//!
//! A scenario is a JSON file: a graph, what each agent does on its own copy of it, and what ought to hold. All
//! interleavings of the agents and all deliveries between them are explored; every state that anybody can
//! reach is judged by the clauses of the specification and by the scenario's own properties.
//!
//! ```
//! use dsr_model::scenario::{Options, Scenario, Verdict};
//!
//! let text = r#"{"format": 1, "name": "two rooms", "about": "Two agents move one robot.", "scene": "@flat",
//!   "replicas": [
//!     {"name": "left", "script": [{"do": {"move_edge": {"old": {"from": "robot", "label": "in"},
//!         "new": {"from": "robot", "label": "in", "to": "bedroom"}}}}]},
//!     {"name": "right", "script": [{"do": {"move_edge": {"old": {"from": "robot", "label": "in"},
//!         "new": {"from": "robot", "label": "in", "to": "bathroom"}}}}]}],
//!   "properties": [{"name": "in one room", "why": "A robot has one body.",
//!       "always": {"count": {"edges": {"from": "robot", "label": "in"}, "exactly": 1}}}]}"#;
//! let scenario = Scenario::read(text, "two-rooms.json")?;
//! let report = scenario.check(Options::default());
//! assert!(report.complete);
//! assert_eq!(report.properties[0].verdict, Verdict::Holds);
//! # Ok::<(), dsr_model::scenario::ScenarioError>(())
//! ```
//!
//! | room | step |
//! |---|---|
//! | `cursor`, `scope`, `error` | JSON with places; which names mean something; what is wrong |
//! | `format`, `stage`, `script`, `mutation`, `property`, `predicate`, `atom`, `pattern` | the file's parts |
//! | `memo` | interned states, memoised joins, answers and moves |
//! | `space`, `judge` | histories and their successors; every delivered subset and diamond |
//! | `model`, `explore` | the search by stateright, and the report |
//! | `shortest`, `trace` | a second search, breadth first: counterexamples and witnesses |
//! | `reduce`, `follow` | what they found without what it does not need; whether that is a run of the scenario |

mod atom;
mod cursor;
mod error;
mod explore;
mod follow;
mod format;
mod judge;
mod memo;
mod model;
mod mutation;
mod pattern;
mod predicate;
mod property;
mod reduce;
mod report;
mod scope;
mod script;
mod shipped;
mod shortest;
mod space;
mod stage;
mod trace;

pub use error::{Fault, ScenarioError};
pub use explore::{Options, Replicated};
pub use mutation::{NamedKey, NamedMutation, NamedTarget, Unresolved};
pub use pattern::{EdgePattern, VertexPattern};
pub use property::PropertyKind;
pub use report::{Coverage, IdleStep, PropertyReport, Report, ScenarioBreach, Verdict};
pub use shipped::shipped;
pub use trace::{ScenarioStep, Trace};

use crate::checked::Checked;
use crate::checked::alphabet::Alphabet;
use crate::semantics::{Clause, GROUPS, WHOLE};
use dsr_core::{Dictionary, State, VertexId};
use predicate::Atoms;
use property::Property;
use script::{Conduct, Replica};
use std::path::Path;
use std::sync::Arc;

/// What is judged besides a scenario's own properties: as in L1, and of groups; agents do not resynchronise.
pub fn clauses() -> Vec<Clause> {
    WHOLE.into_iter().filter(|clause| clause.id != "SYNC-3").chain([GROUPS]).collect()
}

/// A scenario that was read. `[spec: SCEN-1]`
#[derive(Clone, Debug)]
pub struct Scenario {
    name: String,
    about: String,
    dictionary: Dictionary,
    initial: State,
    focus: Vec<VertexId>,
    replicas: Vec<Replica>,
    atoms: Atoms,
    properties: Vec<Property>,
}

impl Scenario {
    /// Reads a scenario whose scene is shipped or inside it; `file` is its name in errors. `[spec: SCEN-1]`
    pub fn read(text: &str, file: &str) -> Result<Self, ScenarioError> {
        Self::read_with(text, file, &|_| Err("only a scenario that is itself a file can name one".into()))
    }

    /// Reads a scenario; `open` finds the text of a scene that it names by its path. `[spec: SCEN-1]`
    pub fn read_with(
        text: &str,
        file: &str,
        open: &dyn Fn(&str) -> Result<String, String>,
    ) -> Result<Self, ScenarioError> {
        format::read(text, file, open)
    }

    /// Opens a scenario's file; a scene's path in it is relative to that file. `[spec: SCEN-1]`
    pub fn open(path: &Path) -> Result<Self, ScenarioError> {
        let file = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|error| ScenarioError {
            file: file.clone(),
            path: String::new(),
            fault: Fault::Unreadable { reason: error.to_string() },
        })?;
        let beside = path.parent().unwrap_or(Path::new(""));
        Self::read_with(&text, &file, &|scene| {
            std::fs::read_to_string(beside.join(scene)).map_err(|error| error.to_string())
        })
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What it is about.
    pub fn about(&self) -> &str {
        &self.about
    }

    /// The names of its replicas; the first of them is r1.
    pub fn replicas(&self) -> impl ExactSizeIterator<Item = &str> {
        self.replicas.iter().map(|replica| replica.name.as_str())
    }

    /// What all replicas start from. `[spec: SCEN-2]`
    pub fn initial(&self) -> &State {
        &self.initial
    }

    /// The dictionary of all replicas.
    pub fn dictionary(&self) -> &Dictionary {
        &self.dictionary
    }

    /// Explores everything under the checked semantics. `[spec: SCEN-9]`
    pub fn check(&self, options: Options) -> Report {
        self.check_under(self.checked(Alphabet::of(&[], Vec::new())), options)
    }

    /// Explores everything under some semantics of the same graphs: the checker's alarms are tested with broken
    /// ones.
    pub fn check_under<S: Replicated>(&self, semantics: S, options: Options) -> Report {
        explore::explore(&Arc::new(self.clone()), semantics, options)
    }

    fn checked(&self, alphabet: Alphabet) -> Checked {
        Checked { dictionary: self.dictionary.clone(), initial: self.initial.clone(), alphabet }
    }

    /// What a free replica may do; `None` for one with a script. `[spec: SCEN-6]`
    fn alphabet(&self, replica: &Replica) -> Option<Checked> {
        let Conduct::Free { kinds, .. } = &replica.conduct else { return None };
        Some(self.checked(Alphabet { kinds: kinds.clone(), focus: self.focus.clone(), at_last: false }))
    }
}
