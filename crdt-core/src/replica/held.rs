//! What is kept of a record, and what it is shown as.

use super::names::NameId;
use crate::dot::{Dot, VertexId};
use crate::record::Name;
use crate::value::Value;

/// The dot of no event: "none" where a dot is kept. It is the root's, which no edge and no write has.
pub(super) const NONE: Dot = VertexId::ROOT.0;

/// A record, by its dot. A write's fields are in its register.
#[derive(Clone, Debug)]
pub(super) enum Held {
    Vertex(HeldVertex),
    Edge(HeldEdge),
    Write(WriteAt),
}

#[derive(Clone, Debug)]
pub(super) struct HeldVertex {
    pub(super) name: Name,
    pub(super) vertex_type: NameId,
    /// How many accepted kinematic edges leave it.
    pub(super) children: u32,
    pub(super) stamp: u64,
    /// See [`Link`].
    pub(super) link: Link,
    pub(super) linked_by: Dot,
}

/// What edge a vertex is linked by: the accepted kinematic one into it, and the shown one that begins its way
/// to the root. Mostly it has one of the two, or they are the same.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Link {
    /// Neither.
    None,
    /// The kinematic one, and it has no way.
    Parent,
    /// The kinematic one, and it begins its way.
    ParentUp,
    /// The kinematic one; its way is begun by another, found apart.
    ParentAndWay,
    /// It has no kinematic one; this begins its way.
    Up,
}

impl HeldVertex {
    /// The accepted kinematic edge into it, or [`NONE`].
    pub(super) fn parent(&self) -> Dot {
        if self.link == Link::Up { NONE } else { self.linked_by }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct HeldEdge {
    pub(super) from: Dot,
    pub(super) to: Dot,
    pub(super) label: NameId,
    pub(super) status: Status,
    pub(super) stamp: u64,
}

/// What is shown of an edge claim.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Status {
    /// An end is not in the graph.
    Invisible,
    /// Visible, and another claim is shown in its place, or none.
    Hidden,
    /// Shown.
    Shown,
}

/// Where a write is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct WriteAt {
    pub(super) target: Dot,
    pub(super) name: NameId,
}

/// A write in its register; its payload is shared with whoever made or reads it. `[spec: REPLICA-3]`
#[derive(Clone, Debug)]
pub(super) struct HeldWrite {
    pub(super) value: Value,
    pub(super) timestamp_ns: u64,
    pub(super) stamp: u64,
    pub(super) exposure: Exposure,
}

/// What is shown of a write.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Exposure {
    /// Its target is not in the graph.
    Invisible,
    /// The dictionary does not declare it so.
    Undeclared,
    /// Shown.
    Shown,
}

/// A write's place: target, attribute, its own dot.
pub(super) type WriteKey = (Dot, NameId, Dot);

/// What edge claims compete on: the end that is shared, the label, and the other end, or [`NONE`] where all
/// other ends compete. `[spec: STAMP-4]`
pub(super) type RegisterKey = (Dot, NameId, Dot);

/// A claim's place: its register, with a mix of the other end in place of it, and its own dot.
pub(super) type ClaimKey = (Dot, NameId, u32, Dot);

/// A quarter of the bytes of a dot, in a form that tells most dots apart; the root's is 0.
pub(super) fn mix(dot: Dot) -> u32 {
    let Dot { replica, sequence } = dot;
    let replica = replica.agent.wrapping_mul(0x9e37_79b9) ^ replica.incarnation.wrapping_mul(0x85eb_ca6b);
    // The lower half: an author rarely has two ends that are 2³² events apart.
    let [lowest, low, high, highest, ..] = sequence.to_le_bytes();
    u32::from_le_bytes([lowest, low, high, highest]) ^ replica
}
