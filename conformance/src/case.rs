//! The file of cases. `[spec: CONF-11]`

mod check;
mod read;
mod write;

pub use read::{CaseError, read};
pub use write::write;

use crate::protocol::{Feature, Hex, Mutation, Profile, ReplicaName, View};
use dsr_core::Dictionary;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The format of case files.
pub const FORMAT: u32 = 1;

/// A file of cases on one topic.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CaseFile {
    /// 1.
    pub format: u32,
    /// `universal`: whatever conflicts are decided by; `resolution`: by this specification's rules; `causal`, `wire`:
    /// what is seen in these profiles.
    pub family: String,
    /// What the cases are about.
    pub topic: String,
    /// The cases.
    pub cases: Vec<Case>,
}

/// One case.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
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
    /// How deep it looks.
    #[serde(default, skip_serializing_if = "Profile::is_default")]
    pub profile: Profile,
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
    /// What it settles that could have been settled otherwise: one of the choices that the corpus explains.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub choice: Option<String>,
    /// The version of the corpus that brought it; left out, 1.0.0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub since: Option<String>,
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
    /// The row of the gallery.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub row: Option<String>,
    /// Of the model: how many replicas make how many mutations each at most.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bound: Option<String>,
    /// Of the model: by which rule of the chapter the history was kept.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rule: Option<String>,
}

/// How a case came about.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Origin {
    /// Written by hand, from the specification.
    Hand,
    /// The schedule of a known anomaly of the published system: a row of the checker's gallery.
    Gallery,
    /// One of all histories of the model within a bound, kept because it tells something apart.
    Model,
}

/// One step.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
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
    /// Deltas become one message.
    Group {
        /// The case's names for them.
        deltas: Vec<String>,
        /// The case's name for what they become.
        r#as: String,
    },
    /// A delta comes from outside, as JSON.
    Load {
        /// What it is: JSON-12.
        state: Value,
        /// The case's name for it.
        r#as: String,
    },
    /// A delta comes from outside, as bytes.
    Decode {
        /// What it is.
        bytes: Hex,
        /// The case's name for it.
        r#as: String,
    },
    /// A digest comes from outside, as bytes, and a replica makes the delta that its sender lacks.
    AnswerDigest {
        /// Who.
        from: ReplicaName,
        /// The digest.
        bytes: Hex,
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
    /// A name finds this vertex.
    ExpectVertex {
        /// Who looks.
        replica: ReplicaName,
        /// The name.
        name: String,
        /// The vertex's handle; null if there is none.
        #[serde(deserialize_with = "Option::deserialize")]
        #[schemars(required)]
        vertex: Option<String>,
    },
    /// A replica has this state.
    ExpectState {
        /// Who.
        replica: ReplicaName,
        /// What: JSON-12.
        state: Value,
    },
    /// A delta is this.
    ExpectDelta {
        /// The case's name for it.
        delta: String,
        /// What: JSON-12.
        state: Value,
    },
    /// A replica has this digest.
    ExpectDigest {
        /// Who.
        replica: ReplicaName,
        /// What: JSON-13.
        digest: Value,
    },
    /// Something has these bytes.
    ExpectBytes {
        /// What.
        of: Encoded,
        /// The bytes.
        bytes: Hex,
    },
    /// What has the form of a state in JSON is refused.
    ExpectUnloadable {
        /// What comes.
        state: Value,
        /// The fault's name, if it has one; compared only where the adapter has the feature `error-kinds`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        kind: Option<String>,
    },
    /// Bytes are refused where a state or delta is due.
    ExpectUndecodable {
        /// What comes.
        bytes: Hex,
        /// The fault's name, if it has one; compared only where the adapter has the feature `error-kinds`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        kind: Option<String>,
    },
    /// Bytes are refused where a digest is due.
    ExpectUnanswerable {
        /// Who is asked.
        from: ReplicaName,
        /// What comes.
        bytes: Hex,
    },
}

/// What has bytes.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Encoded {
    /// A delta, by the case's name for it.
    Delta(String),
    /// A replica's digest.
    Digest(ReplicaName),
    /// A replica's fingerprint.
    Fingerprint(ReplicaName),
}

impl Step {
    /// The replicas that it names: who is asked first.
    pub fn replicas(&self) -> Vec<&str> {
        match self {
            Self::Mutate { replica, .. }
            | Self::Deliver { replica, .. }
            | Self::Restart { replica, .. }
            | Self::Expect { replica, .. }
            | Self::ExpectRefused { replica, .. }
            | Self::ExpectVertex { replica, .. }
            | Self::ExpectState { replica, .. }
            | Self::ExpectDigest { replica, .. }
            | Self::ExpectBytes { of: Encoded::Digest(replica) | Encoded::Fingerprint(replica), .. }
            | Self::AnswerDigest { from: replica, .. }
            | Self::ExpectUnanswerable { from: replica, .. } => vec![replica],
            Self::Answer { from, to, .. } => vec![from, to],
            Self::ExpectEqual { replicas } => replicas.iter().map(String::as_str).collect(),
            Self::Group { .. }
            | Self::Load { .. }
            | Self::Decode { .. }
            | Self::ExpectDelta { .. }
            | Self::ExpectBytes { of: Encoded::Delta(_), .. }
            | Self::ExpectUnloadable { .. }
            | Self::ExpectUndecodable { .. } => Vec::new(),
        }
    }

    /// Whether it says what must be.
    pub const fn expects(&self) -> bool {
        match self {
            Self::Mutate { .. }
            | Self::Deliver { .. }
            | Self::Restart { .. }
            | Self::Answer { .. }
            | Self::Group { .. }
            | Self::Load { .. }
            | Self::Decode { .. }
            | Self::AnswerDigest { .. } => false,
            Self::Expect { .. }
            | Self::ExpectEqual { .. }
            | Self::ExpectRefused { .. }
            | Self::ExpectVertex { .. }
            | Self::ExpectState { .. }
            | Self::ExpectDelta { .. }
            | Self::ExpectDigest { .. }
            | Self::ExpectBytes { .. }
            | Self::ExpectUnloadable { .. }
            | Self::ExpectUndecodable { .. }
            | Self::ExpectUnanswerable { .. } => true,
        }
    }
}

impl CaseFile {
    /// The schema of case files.
    pub fn schema() -> schemars::Schema {
        schemars::schema_for!(Self)
    }
}
