//! What the view repaired, as values that users see. `[spec: VIEW-9]`

use crate::dot::{Dot, EdgeId, VertexId};
use crate::record::Name;
use core::fmt;

/// One repair: concurrent legal mutations together broke what each had kept. `[spec: VIEW-9]`
///
/// Repairs are a function of the state, the same on every replica, and absent where nothing is broken
/// (`[spec: VIEW-10]`).
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Repair {
    /// Two claims on one register: the greater is shown. `[spec: VIEW-2]`, `[spec: VIEW-3]`, `[spec: VIEW-6]`
    Superseded {
        /// The claim not shown.
        hidden: EdgeId,
        /// The claim shown in its place.
        shown: EdgeId,
        /// On what they compete.
        rule: Rule,
    },
    /// A kinematic claim would have closed a cycle. `[spec: VIEW-3]`
    CycleBroken {
        /// The claim not shown.
        hidden: EdgeId,
    },
    /// The top of a tree that is not the root's hangs from the root, its pose unknown. `[spec: VIEW-4]`
    Detached {
        /// The top.
        vertex: VertexId,
    },
    /// A component without a path to the root is linked to it by its oldest vertex. `[spec: VIEW-5]`
    Reattached {
        /// The oldest vertex.
        vertex: VertexId,
    },
    /// Two live vertices with one name: the older is found by it, and by `root` and `world` the root.
    /// `[spec: VIEW-7]`
    NameClash {
        /// The name.
        name: Name,
        /// The vertex found by it.
        shown: VertexId,
        /// The other.
        hidden: VertexId,
    },
    /// An attribute that the dictionary does not declare so is not shown. `[spec: VIEW-8]`
    Undeclared {
        /// The write not shown.
        write: Dot,
    },
}

/// On what two edge claims compete. `[spec: STAMP-4]`
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Rule {
    /// The same source, target and label.
    SameKey,
    /// A functional label of one source.
    Functional,
    /// The kinematic parent of one child.
    RtParent,
}

impl Repair {
    /// The kind's name, as reports and witnesses print it.
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::Superseded { rule: Rule::SameKey, .. } => "same-key",
            Self::Superseded { rule: Rule::Functional, .. } => "functional",
            Self::Superseded { rule: Rule::RtParent, .. } => "rt-parent",
            Self::CycleBroken { .. } => "cycle-broken",
            Self::Detached { .. } => "detached",
            Self::Reattached { .. } => "reattached",
            Self::NameClash { .. } => "name-clash",
            Self::Undeclared { .. } => "undeclared",
        }
    }
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Superseded { hidden, shown, rule } => {
                let on = match rule {
                    Rule::SameKey => "the same edge",
                    Rule::Functional => "a functional label",
                    Rule::RtParent => "the kinematic parent",
                };
                write!(f, "edge {hidden} is hidden: {shown} is the greater claim on {on}")
            }
            Self::CycleBroken { hidden } => write!(f, "RT edge {hidden} is hidden: it would close a cycle"),
            Self::Detached { vertex } => {
                write!(f, "{vertex} lost its kinematic parent: it hangs from the root, pose unknown")
            }
            Self::Reattached { vertex } => write!(f, "{vertex} had no path to the root: it is linked to it"),
            Self::NameClash { name, shown, hidden } => {
                write!(f, "{hidden} is named {name:?} as well: the name finds {shown}")?;
                if shown.is_root() { Ok(()) } else { f.write_str(", which is older") }
            }
            Self::Undeclared { write } => {
                write!(f, "write {write} is hidden: the dictionary does not declare it so")
            }
        }
    }
}
