//! The file of cases. `[spec: CONF-11]`

mod check;
mod read;

pub use read::{CaseError, read};

use crate::protocol::{Feature, Mutation, ReplicaName, View};
use dsr_core::Dictionary;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The format of case files.
pub const FORMAT: u32 = 1;

/// A file of cases on one topic.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CaseFile {
    /// 1.
    pub format: u32,
    /// `universal`: whatever conflicts are decided by; `resolution`: by this specification's rules.
    pub family: String,
    /// What the cases are about.
    pub topic: String,
    /// The cases.
    pub cases: Vec<Case>,
}

/// One case.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// `family/topic/slug`; never changed, never used again.
    pub id: String,
    /// In a few words.
    pub title: String,
    /// What goes wrong where it fails.
    pub why: String,
    /// The clauses that it witnesses.
    pub spec: Vec<String>,
    /// How binding it is.
    pub level: Level,
    /// What the adapter must be able to do.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub requires: Vec<Feature>,
    /// The replicas, in ascending order of their identity.
    pub replicas: Vec<ReplicaName>,
    /// The dictionary that they share.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<serde_json::Map<String, serde_json::Value>>")]
    pub dictionary: Option<Dictionary>,
    /// What happens, and what is expected.
    pub steps: Vec<Step>,
    /// Where the case is from.
    pub provenance: Provenance,
}

/// How binding a case is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// Whoever fails does not conform.
    Must,
    /// Whoever fails says why.
    Should,
    /// Nothing may depend on it.
    May,
}

/// Where a case is from.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// How it came about.
    pub kind: Origin,
}

/// How a case came about.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Origin {
    /// Written by hand, from the specification.
    Hand,
}

/// One step.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Step {
    /// A replica mutates; this must succeed.
    Mutate {
        /// Who.
        replica: ReplicaName,
        /// As one group.
        mutations: Vec<Mutation>,
        /// The case's name for the delta.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        r#as: Option<String>,
    },
    /// A delta arrives; this must succeed.
    Deliver {
        /// Where.
        replica: ReplicaName,
        /// The case's name for it.
        delta: String,
    },
    /// A replica restarts.
    Restart {
        /// Who.
        replica: ReplicaName,
        /// Whether it still has its state.
        keeps: bool,
    },
    /// A replica makes the delta that another lacks.
    Answer {
        /// Who.
        from: ReplicaName,
        /// For whom.
        to: ReplicaName,
        /// The case's name for the delta.
        r#as: String,
    },
    /// A replica shows this.
    Expect {
        /// Who.
        replica: ReplicaName,
        /// What; `repairs` only count where the adapter has the feature.
        view: View,
    },
    /// Replicas show the same.
    ExpectEqual {
        /// Which.
        replicas: Vec<ReplicaName>,
    },
    /// Mutations are refused, and nothing that the replica shows changes.
    ExpectRefused {
        /// Who.
        replica: ReplicaName,
        /// What it tries.
        mutations: Vec<Mutation>,
        /// The error's name; compared only where the adapter has the feature `error-kinds`.
        kind: String,
    },
}

impl CaseFile {
    /// The schema of case files.
    pub fn schema() -> schemars::Schema {
        schemars::schema_for!(Self)
    }
}
