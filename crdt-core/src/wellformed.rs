//! What every state must be before it may be joined. Of the laws of join idempotence needs it, and the neutral
//! element: a state that is not closed is not its own join.

use crate::dot::{Dot, ReplicaId};
use crate::limits;
use crate::record::{Edge, Record};
use crate::state::State;

/// How a state is not well-formed. `[spec: WF-1]`
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Malformed {
    /// WF-1: a held dot is missing in the context.
    #[error("[WF-1] {dot} is held but its context has not seen it")]
    HeldUnseen {
        /// The dot.
        dot: Dot,
    },
    /// WF-2: a record's anchor is dead, so the state is not closed.
    #[error("[WF-2] {dot} is anchored to {anchor}, which is dead")]
    NotClosed {
        /// The record's dot.
        dot: Dot,
        /// The dead anchor.
        anchor: Dot,
    },
    /// WF-3: an anchor that is held is of the wrong kind.
    #[error("[WF-3] {dot} is anchored to {anchor}, which is no {expected}")]
    WrongAnchor {
        /// The record's dot.
        dot: Dot,
        /// The anchor.
        anchor: Dot,
        /// What it should be.
        expected: &'static str,
    },
    /// WF-3: an anchor has sequence 0 and is not the root.
    #[error("[WF-3] {dot} is anchored to {anchor}: sequence 0 names no event")]
    NoSuchAnchor {
        /// The record's dot.
        dot: Dot,
        /// The anchor.
        anchor: Dot,
    },
    /// WF-4: an edge joins a vertex to itself.
    #[error("[WF-4] edge {dot} is a self-loop on {vertex}")]
    SelfLoop {
        /// The edge's dot.
        dot: Dot,
        /// Both of its ends.
        vertex: Dot,
    },
    /// WF-4: a kinematic edge enters the root.
    #[error("[WF-4] RT edge {dot} enters the root")]
    IntoRoot {
        /// The edge's dot.
        dot: Dot,
    },
    /// WF-5: a name is empty or over [`limits::NAME_BYTES_MAX`].
    #[error("[WF-5] {dot}: a name has {bytes} bytes; allowed are 1 to {}", limits::NAME_BYTES_MAX)]
    NameLength {
        /// The record's dot.
        dot: Dot,
        /// Its length.
        bytes: usize,
    },
    /// WF-5: a value is over [`limits::VALUE_BYTES_MAX`].
    #[error("[WF-5] {dot}: the value has {bytes} bytes; allowed are {}", limits::VALUE_BYTES_MAX)]
    ValueSize {
        /// The record's dot.
        dot: Dot,
        /// Its size.
        bytes: usize,
    },
    /// WF-5: a stamp is 0 or over [`limits::STAMP_MAX`].
    #[error("[WF-5] {dot}: stamp {stamp} is outside 1 to {}", limits::STAMP_MAX)]
    Stamp {
        /// The record's dot.
        dot: Dot,
        /// Its stamp.
        stamp: u64,
    },
    /// WF-5: a replica's sequence is over [`limits::SEQUENCE_MAX`].
    #[error("[WF-5] the context has seen {replica} up to {sequence}; allowed are {}", limits::SEQUENCE_MAX)]
    Sequence {
        /// The replica.
        replica: ReplicaId,
        /// Its greatest sequence.
        sequence: u64,
    },
    /// WF-6: a value holds a NaN other than the canonical one.
    #[error("[WF-6] {dot}: a NaN is not the canonical one")]
    Nan {
        /// The record's dot.
        dot: Dot,
    },
}

impl Malformed {
    /// The fault's name in the chapter on well-formedness, such as `HeldUnseen`.
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::HeldUnseen { .. } => "HeldUnseen",
            Self::NotClosed { .. } => "NotClosed",
            Self::WrongAnchor { .. } => "WrongAnchor",
            Self::NoSuchAnchor { .. } => "NoSuchAnchor",
            Self::SelfLoop { .. } => "SelfLoop",
            Self::IntoRoot { .. } => "IntoRoot",
            Self::NameLength { .. } => "NameLength",
            Self::ValueSize { .. } => "ValueSize",
            Self::Stamp { .. } => "Stamp",
            Self::Sequence { .. } => "Sequence",
            Self::Nan { .. } => "Nan",
        }
    }
}

/// Whether `state` is well-formed; names the first fault. `[spec: WF-1]` to `[spec: WF-6]`
///
/// Every decoder calls this. Joins of well-formed states in which no dot was used twice keep WF-1, WF-2 and
/// WF-4 to WF-6. They keep WF-3 too unless an author anchored a record to a dot whose record it did not
/// know, which honest authors do not; the view shows nothing that is anchored so. O(records + runs) · log n.
pub fn check_well_formed(state: &State) -> Result<(), Malformed> {
    if let Some(run) = state.context().runs().find(|run| run.last > limits::SEQUENCE_MAX) {
        let sequence = state.context().greatest(run.replica);
        return Err(Malformed::Sequence { replica: run.replica, sequence });
    }
    for (dot, record) in state.records() {
        check_record(state, dot, record)?;
    }
    Ok(())
}

fn check_record(state: &State, dot: Dot, record: &Record) -> Result<(), Malformed> {
    if !state.context().contains(dot) {
        return Err(Malformed::HeldUnseen { dot });
    }
    let stamp = record.stamp();
    if stamp == 0 || stamp > limits::STAMP_MAX {
        return Err(Malformed::Stamp { dot, stamp });
    }
    for anchor in record.anchors() {
        check_anchor(state, dot, record, anchor)?;
    }
    match record {
        Record::Vertex(vertex) => {
            check_name(dot, &vertex.vertex_type)?;
            check_name(dot, &vertex.name)
        }
        Record::Edge(edge) => check_edge(dot, edge),
        Record::Write(write) => {
            let bytes = write.value.payload_bytes();
            if bytes > limits::VALUE_BYTES_MAX {
                return Err(Malformed::ValueSize { dot, bytes });
            }
            if !write.value.has_canonical_nans() {
                return Err(Malformed::Nan { dot });
            }
            check_name(dot, &write.name)
        }
    }
}

fn check_edge(dot: Dot, edge: &Edge) -> Result<(), Malformed> {
    if edge.from == edge.to {
        return Err(Malformed::SelfLoop { dot, vertex: edge.to.0 });
    }
    if edge.is_rt() && edge.to.is_root() {
        return Err(Malformed::IntoRoot { dot });
    }
    check_name(dot, &edge.label)
}

fn check_name(dot: Dot, name: &str) -> Result<(), Malformed> {
    let bytes = name.len();
    if bytes == 0 || bytes > limits::NAME_BYTES_MAX {
        Err(Malformed::NameLength { dot, bytes })
    } else {
        Ok(())
    }
}

fn check_anchor(state: &State, dot: Dot, record: &Record, anchor: Dot) -> Result<(), Malformed> {
    if anchor == crate::VertexId::ROOT.0 {
        return Ok(());
    }
    if anchor.sequence == 0 {
        return Err(Malformed::NoSuchAnchor { dot, anchor });
    }
    if state.is_dead(anchor) {
        return Err(Malformed::NotClosed { dot, anchor });
    }
    match (record, state.get(anchor)) {
        (_, None | Some(Record::Vertex(_))) | (Record::Write(_), Some(Record::Edge(_))) => Ok(()),
        (Record::Write(_), Some(_)) => {
            Err(Malformed::WrongAnchor { dot, anchor, expected: "vertex or edge" })
        }
        (_, Some(_)) => Err(Malformed::WrongAnchor { dot, anchor, expected: "vertex" }),
    }
}
