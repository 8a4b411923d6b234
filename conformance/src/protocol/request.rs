//! What the harness asks. `[spec: CONF-4]`

use super::Mutation;
use dsr_core::Dictionary;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One line from the harness to the adapter. `[spec: CONF-2]`
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Request {
    /// Which reply belongs to it.
    pub id: u64,
    /// What is asked.
    pub r#do: Command,
}

/// What is asked.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Command {
    /// The handshake.
    Hello(Hello),
    /// A case begins: its replicas are empty.
    CaseBegin(CaseBegin),
    /// A replica makes mutations as one group; the delta stays in the adapter, under the handle replied.
    Mutate(Mutate),
    /// A delta arrives at a replica.
    Deliver(Deliver),
    /// What a replica shows.
    Read(Read),
    /// A replica stops and starts anew. Feature `restart`.
    Restart(Restart),
    /// One replica makes the delta that another lacks. Feature `resynchronisation`.
    Answer(AnswerFor),
    /// The case is over: everything of it may be forgotten.
    CaseEnd(Nothing),
    /// No request follows.
    Bye(Nothing),
}

/// The name of a replica within a case.
pub type ReplicaName = String;

/// See [`Command::Hello`].
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hello {
    /// The versions of the protocol that the harness speaks.
    pub protocols: Vec<u32>,
    /// The version of the specification.
    pub spec: String,
    /// The version of the corpus.
    pub corpus: String,
}

/// See [`Command::CaseBegin`].
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CaseBegin {
    /// The case's id.
    pub case: String,
    /// The replicas, in ascending order of their identity.
    pub replicas: Vec<ReplicaName>,
    /// The dictionary that all of them share; left out, everything is allowed and no label functional. Feature
    /// `dictionary`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<serde_json::Map<String, serde_json::Value>>")]
    pub dictionary: Option<Dictionary>,
}

/// See [`Command::Mutate`].
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mutate {
    /// Who mutates.
    pub replica: ReplicaName,
    /// The mutations, one after the other.
    pub mutations: Vec<Mutation>,
}

/// See [`Command::Deliver`].
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Deliver {
    /// Where it arrives.
    pub replica: ReplicaName,
    /// The delta's handle, as the adapter named it.
    pub delta: String,
}

/// See [`Command::Read`].
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Read {
    /// Whose view.
    pub replica: ReplicaName,
}

/// See [`Command::Restart`].
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Restart {
    /// Who.
    pub replica: ReplicaName,
    /// Whether it still has its state.
    pub keeps: bool,
}

/// See [`Command::Answer`].
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AnswerFor {
    /// Who makes the delta.
    pub from: ReplicaName,
    /// For whom.
    pub to: ReplicaName,
}

/// A command without arguments.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Nothing {}
