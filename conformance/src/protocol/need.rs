//! What adapters announce. `[spec: CONF-3]`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// How deep the harness may look.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Profile {
    /// At graphs alone.
    #[default]
    Observe,
    /// Also at dots and contexts.
    Causal,
    /// Also at bytes.
    Wire,
}

impl Profile {
    /// All three, the shallowest first.
    pub const ALL: [Self; 3] = [Self::Observe, Self::Causal, Self::Wire];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Observe => "observe",
            Self::Causal => "causal",
            Self::Wire => "wire",
        }
    }

    /// Whether it is the one that every adapter has.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// The features that cases may require.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Feature {
    /// `case_begin` takes a dictionary.
    Dictionary,
    /// A refused mutation names the kind of its error.
    ErrorKinds,
    /// The command `group`.
    Grouping,
    /// The command `lookup`.
    Lookup,
    /// A view names its repairs.
    Repairs,
    /// The command `restart`.
    Restart,
    /// The command `answer`.
    Resynchronisation,
}

impl Feature {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Dictionary,
        Self::ErrorKinds,
        Self::Grouping,
        Self::Lookup,
        Self::Repairs,
        Self::Restart,
        Self::Resynchronisation,
    ];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dictionary => "dictionary",
            Self::ErrorKinds => "error-kinds",
            Self::Grouping => "grouping",
            Self::Lookup => "lookup",
            Self::Repairs => "repairs",
            Self::Restart => "restart",
            Self::Resynchronisation => "resynchronisation",
        }
    }
}

/// What must be announced before something is asked.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Need {
    /// A feature.
    Feature(Feature),
    /// A profile.
    Profile(Profile),
}

impl fmt::Display for Need {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Feature(feature) => write!(f, "the feature {}", feature.name()),
            Self::Profile(profile) => write!(f, "the profile {}", profile.name()),
        }
    }
}
