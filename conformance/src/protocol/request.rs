//! What the harness asks. `[spec: CONF-4]`

use super::{Feature, Hex, Mutation, Need, Profile};
use dsr_core::Dictionary;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One line from the harness to the adapter. `[spec: CONF-2]`
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Request {
    /// Which reply belongs to it.
    pub id: u64,
    /// What is asked.
    pub r#do: Command,
}

/// What is asked.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Command {
    /// The handshake.
    Hello(Hello),
    /// A case begins: its replicas are empty.
    CaseBegin(CaseBegin),
    /// A replica makes mutations as one group; the delta stays in the adapter, under the name replied.
    Mutate(Mutate),
    /// A delta arrives at a replica.
    Deliver(Deliver),
    /// What a replica shows.
    Read(Read),
    /// A replica stops and starts anew. Feature `restart`.
    Restart(Restart),
    /// One replica makes the delta that another lacks. Feature `resynchronisation`.
    Answer(AnswerFor),
    /// Deltas become one message. Feature `grouping`.
    Group(Group),
    /// Which vertex a name finds. Feature `lookup`.
    Lookup(Lookup),
    /// A replica's state. Profile `causal`.
    State(Read),
    /// A delta, as the state that it is. Profile `causal`.
    Delta(DeltaName),
    /// A replica's digest. Profile `causal`.
    Digest(Read),
    /// A delta from outside. Profile `causal`.
    Load(Load),
    /// The bytes of a delta. Profile `wire`.
    Encode(DeltaName),
    /// The bytes of a replica's digest. Profile `wire`.
    EncodeDigest(Read),
    /// A replica's fingerprint. Profile `wire`.
    Fingerprint(Read),
    /// A delta from outside, as bytes. Profile `wire`.
    Decode(Decode),
    /// The delta for a digest from outside, as bytes. Profile `wire`.
    AnswerDigest(AnswerDigest),
}

impl Command {
    /// What an adapter must have announced to be asked this, beyond the profile `observe`; see also
    /// [`CaseBegin::dictionary`]. `[spec: CONF-4]`
    pub const fn needs(&self) -> Option<Need> {
        match self {
            Self::Hello(_) | Self::Mutate(_) | Self::Deliver(_) | Self::Read(_) => None,
            Self::CaseBegin(begin) => {
                if begin.dictionary.is_some() {
                    Some(Need::Feature(Feature::Dictionary))
                } else {
                    None
                }
            }
            Self::Restart(_) => Some(Need::Feature(Feature::Restart)),
            Self::Answer(_) => Some(Need::Feature(Feature::Resynchronisation)),
            Self::Group(_) => Some(Need::Feature(Feature::Grouping)),
            Self::Lookup(_) => Some(Need::Feature(Feature::Lookup)),
            Self::State(_) | Self::Delta(_) | Self::Digest(_) | Self::Load(_) => {
                Some(Need::Profile(Profile::Causal))
            }
            Self::Encode(_)
            | Self::EncodeDigest(_)
            | Self::Fingerprint(_)
            | Self::Decode(_)
            | Self::AnswerDigest(_) => Some(Need::Profile(Profile::Wire)),
        }
    }
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

/// See [`Command::Group`].
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// Two or more, as the adapter named them.
    pub deltas: Vec<String>,
}

/// See [`Command::Lookup`].
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lookup {
    /// Who looks.
    pub replica: ReplicaName,
    /// A vertex's name.
    pub name: String,
}

/// See [`Command::Delta`] and [`Command::Encode`].
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DeltaName {
    /// As the adapter named it.
    pub delta: String,
}

/// See [`Command::Load`].
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// What should be a state: the adapter is to find out whether it is.
    pub state: serde_json::Value,
}

/// See [`Command::Decode`].
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Decode {
    /// What should be a state.
    pub bytes: Hex,
}

/// See [`Command::AnswerDigest`].
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AnswerDigest {
    /// Who makes the delta.
    pub from: ReplicaName,
    /// What should be a digest.
    pub bytes: Hex,
}
