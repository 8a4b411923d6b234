//! What the adapter replies. `[spec: CONF-8]`

use super::{Hex, View};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One line from the adapter to the harness: `ok` with what was asked for, or `skip`, or `error`. Exactly one of the
/// three is there. `[spec: CONF-2]`
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reply<T> {
    /// The request's.
    pub id: u64,
    /// What was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ok: Option<T>,
    /// The case cannot be judged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub skip: Option<Skip>,
    /// Why not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<ErrorReply>,
}

impl<T> Reply<T> {
    /// The reply to a request.
    pub fn new(id: u64, result: Result<T, Decline>) -> Self {
        let (ok, skip, error) = match result {
            Ok(ok) => (Some(ok), None, None),
            Err(Decline::Skip(skip)) => (None, Some(skip), None),
            Err(Decline::Error(error)) => (None, None, Some(error)),
        };
        Self { id, ok, skip, error }
    }

    /// Which of the three it is; `None` if there is none of them, or more than one.
    pub fn result(self) -> Option<Result<T, Decline>> {
        match (self.ok, self.skip, self.error) {
            (Some(ok), None, None) => Some(Ok(ok)),
            (None, Some(skip), None) => Some(Err(Decline::Skip(skip))),
            (None, None, Some(error)) => Some(Err(Decline::Error(error))),
            _ => None,
        }
    }
}

/// What an adapter gives instead of what was asked for.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Decline {
    /// The case cannot be judged.
    Skip(Skip),
    /// Why not.
    Error(ErrorReply),
}

impl Decline {
    /// An error without a kind.
    pub fn error(code: ErrorCode, message: impl Into<String>) -> Self {
        Self::Error(ErrorReply { code, message: message.into(), kind: None })
    }
}

/// What each command gives if it succeeds.
#[derive(Clone, PartialEq, Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Answer {
    /// Of `hello`.
    Hello(HelloReply),
    /// Of `mutate`, `group`, `answer`, `load`, `decode` and `answer_digest`.
    Delta(MadeDelta),
    /// Of `read`.
    View(Shown),
    /// Of `lookup`.
    Vertex(Found),
    /// Of `state` and `delta`.
    State(StateShown),
    /// Of `digest`.
    Digest(DigestShown),
    /// Of `encode`, `encode_digest` and `fingerprint`.
    Bytes(BytesShown),
    /// Of every other.
    Done(Done),
}

/// The adapter's side of the handshake. `[spec: CONF-3]`
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HelloReply {
    /// One of the versions offered.
    pub protocol: u32,
    /// What is tested.
    pub implementation: Implementation,
    /// How deep the adapter lets the harness look; `observe` is one.
    pub profiles: Vec<String>,
    /// What it can do beyond the profile. The harness ignores features that it does not know.
    pub features: Vec<String>,
    /// What it takes.
    pub limits: Limits,
}

/// What is tested.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Implementation {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// The language that it is written in.
    pub language: String,
    /// Where its source is.
    pub source: String,
}

/// What an adapter takes.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// The most bytes of a request's line.
    pub line_bytes: usize,
    /// The most replicas of a case.
    pub replicas: usize,
}

/// A delta that the adapter keeps.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MadeDelta {
    /// The adapter's name for it.
    pub delta: String,
}

/// What a replica shows.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Shown {
    /// The graph.
    pub view: View,
}

/// Which vertex a name finds.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Found {
    /// Its handle; null if none has the name.
    #[serde(deserialize_with = "Option::deserialize")]
    #[schemars(required)]
    pub vertex: Option<String>,
}

/// A state, or a delta: JSON-12.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StateShown {
    /// The state.
    pub state: serde_json::Value,
}

/// A digest: JSON-13.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DigestShown {
    /// The digest.
    pub digest: serde_json::Value,
}

/// Bytes.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BytesShown {
    /// As hexadecimal digits.
    pub bytes: Hex,
}

/// Done, with nothing to tell.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Done {}

/// A case that the adapter cannot run.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Skip {
    /// Why, in words.
    pub reason: String,
    /// The feature that it lacks, if it is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feature: Option<String>,
}

/// Why a request is not done.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ErrorReply {
    /// Which of the five.
    pub code: ErrorCode,
    /// In words.
    pub message: String,
    /// With the code `refused`: the error's name in the chapter on mutations. Feature `error-kinds`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<String>,
}

/// The closed list of codes. `[spec: CONF-8]`
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ErrorCode {
    /// The adapter does not have this command or feature.
    Unsupported,
    /// The implementation refuses the mutations, as it should or not; nothing has changed.
    Refused,
    /// A replica, delta or handle that nobody has named.
    Unknown,
    /// A request that is not as the protocol says.
    RejectedInput,
    /// Anything else.
    Internal,
}
