//! What ought to hold. `[spec: SCEN-8]`

use super::cursor::{Cursor, Read};
use super::error::Fault;
use super::predicate::{Atoms, Predicate};
use super::scope::Scope;
use serde::Serialize;
use std::fmt;

/// When a property is asked, and of how many. `[spec: SCEN-8]`
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PropertyKind {
    /// In every view of every replica.
    Always,
    /// At every end.
    AtEnd,
    /// In some view of some replica.
    Sometimes,
    /// At some end.
    SometimesAtEnd,
}

impl PropertyKind {
    /// The key in the file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Always => "always",
            Self::AtEnd => "at_end",
            Self::Sometimes => "sometimes",
            Self::SometimesAtEnd => "sometimes_at_end",
        }
    }

    /// Whether it is asked at ends only.
    pub const fn is_of_ends(self) -> bool {
        matches!(self, Self::AtEnd | Self::SometimesAtEnd)
    }

    /// Whether it is asked of all, so that one counterexample decides; otherwise one witness does.
    pub const fn is_universal(self) -> bool {
        matches!(self, Self::Always | Self::AtEnd)
    }
}

impl fmt::Display for PropertyKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A property of a scenario.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) why: String,
    pub(super) kind: PropertyKind,
    pub(super) predicate: Predicate,
}

const KINDS: [PropertyKind; 4] =
    [PropertyKind::Always, PropertyKind::AtEnd, PropertyKind::Sometimes, PropertyKind::SometimesAtEnd];
const NAMES: &[&str] = &["always", "at_end", "sometimes", "sometimes_at_end"];

impl Property {
    pub(super) fn read(cursor: &Cursor<'_>, scope: &Scope, atoms: &mut Atoms) -> Read<Self> {
        let object = cursor.object(&["name", "why", "always", "at_end", "sometimes", "sometimes_at_end"])?;
        let name = object.need("name")?.title()?.to_owned();
        let why = object.need("why")?.title()?.to_owned();
        let mut found = KINDS.into_iter().filter_map(|kind| object.get(kind.name()).map(|body| (kind, body)));
        let (Some((kind, body)), None) = (found.next(), found.next()) else {
            let found = KINDS.into_iter().filter(|kind| object.get(kind.name()).is_some()).count();
            return cursor.fault(Fault::NotOneOf { allowed: NAMES, found });
        };
        let predicate = Predicate::read(&body, scope, atoms, kind.is_of_ends())?;
        Ok(Self { name, why, kind, predicate })
    }

    /// Whether what was asked here decides the property: a counterexample, or a witness.
    pub(super) fn is_decided_by(&self, holds: bool) -> bool {
        holds != self.kind.is_universal()
    }
}
