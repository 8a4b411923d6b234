//! The six δ-mutations: functions of the local view that return a delta, or an error and change nothing.
//! `[spec: MUT-0]`
//!
//! `apply(m) = join(state, delta)`. A delta's context holds only the dots that it makes and the dots that it
//! kills, so deltas may arrive in any order (`[spec: MUT-0.1]`); deltas compose by join (`[spec: MUT-0.4]`).
//! Nothing else changes a graph.

mod add_edge;
mod add_vertex;
mod attributes;
mod error;
mod error_kind;
mod ground;
mod move_edge;
pub(crate) mod new_edge;
mod remove_edge;
mod remove_vertex;
mod strand;
mod update_attributes;

pub use add_edge::add_edge;
pub(crate) use add_edge::add_edge_to;
pub(crate) use add_vertex::add_vertex_to;
pub use add_vertex::{NewVertex, VertexLink, add_vertex, is_root_name};
pub use attributes::{AttributeMap, AttributeUpdates};
pub use error::{
    AddEdgeError, AddVertexError, AttributeError, ExhaustedError, MoveEdgeError, MutationError, NewEdgeError,
    RemoveEdgeError, RemoveVertexError, StrandError, UpdateAttributesError,
};
pub(crate) use ground::Ground;
pub(crate) use move_edge::departure;
pub use move_edge::move_edge;
pub(crate) use remove_edge::removal_of_edge;
pub use remove_edge::remove_edge;
pub(crate) use remove_vertex::removal_of_vertex;
pub use remove_vertex::remove_vertex;
pub(crate) use update_attributes::update_attributes_of;
pub use update_attributes::{ElementId, update_attributes};

use crate::dot::{Dot, ReplicaId, VertexId};
use crate::limits;
use crate::record::{EdgeKey, Record};
use crate::state::Delta;
use crate::view::View;

/// Who mutates, and when by their clock.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Author {
    /// The replica whose dots the delta uses. `[spec: ID-3]`
    pub replica: ReplicaId,
    /// The caller's time in nanoseconds, copied into every write, for readers only. `[spec: STAMP-3]`
    pub timestamp_ns: u64,
}

impl Author {
    /// An author without a clock.
    pub const fn new(replica: ReplicaId) -> Self {
        Self { replica, timestamp_ns: 0 }
    }
}

/// One of the six mutations with its arguments, as data. `[spec: MUT-0]`
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Mutation {
    /// See [`add_vertex`].
    AddVertex {
        /// What to add.
        vertex: NewVertex,
        /// How it is linked to the graph.
        link: VertexLink,
    },
    /// See [`add_edge`].
    AddEdge {
        /// The new edge.
        key: EdgeKey,
        /// Its attributes.
        attributes: AttributeMap,
    },
    /// See [`update_attributes`].
    UpdateAttributes {
        /// The vertex or edge.
        target: ElementId,
        /// Name to new value, or to `None` to unset.
        updates: AttributeUpdates,
    },
    /// See [`remove_edge`].
    RemoveEdge {
        /// The edge shown under this key.
        key: EdgeKey,
    },
    /// See [`move_edge`].
    MoveEdge {
        /// The edge shown under this key.
        from: EdgeKey,
        /// Its new key.
        to: EdgeKey,
        /// The attributes of the edge under its new key.
        attributes: AttributeMap,
    },
    /// See [`remove_vertex`].
    RemoveVertex {
        /// The vertex.
        vertex: VertexId,
    },
}

/// The kinds of the six mutations, in the order of the papers.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum MutationKind {
    /// [`add_vertex`]
    AddVertex,
    /// [`add_edge`]
    AddEdge,
    /// [`update_attributes`]
    UpdateAttributes,
    /// [`remove_edge`]
    RemoveEdge,
    /// [`move_edge`]
    MoveEdge,
    /// [`remove_vertex`]
    RemoveVertex,
}

impl MutationKind {
    /// All six.
    pub const ALL: [Self; 6] = [
        Self::AddVertex,
        Self::AddEdge,
        Self::UpdateAttributes,
        Self::RemoveEdge,
        Self::MoveEdge,
        Self::RemoveVertex,
    ];

    /// The name used in command lines and files, such as `add_vertex`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::AddVertex => "add_vertex",
            Self::AddEdge => "add_edge",
            Self::UpdateAttributes => "update_attributes",
            Self::RemoveEdge => "remove_edge",
            Self::MoveEdge => "move_edge",
            Self::RemoveVertex => "remove_vertex",
        }
    }

    /// The kind of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

impl Mutation {
    /// Which of the six this is.
    pub const fn kind(&self) -> MutationKind {
        match self {
            Self::AddVertex { .. } => MutationKind::AddVertex,
            Self::AddEdge { .. } => MutationKind::AddEdge,
            Self::UpdateAttributes { .. } => MutationKind::UpdateAttributes,
            Self::RemoveEdge { .. } => MutationKind::RemoveEdge,
            Self::MoveEdge { .. } => MutationKind::MoveEdge,
            Self::RemoveVertex { .. } => MutationKind::RemoveVertex,
        }
    }

    /// The delta of this mutation in a view, or why it is refused.
    pub fn delta(&self, view: &View<'_>, author: Author) -> Result<Delta, MutationError> {
        Ok(match self {
            Self::AddVertex { vertex, link } => add_vertex(view, author, vertex, link)?,
            Self::AddEdge { key, attributes } => add_edge(view, author, key, attributes)?,
            Self::UpdateAttributes { target, updates } => update_attributes(view, author, *target, updates)?,
            Self::RemoveEdge { key } => remove_edge(view, key)?,
            Self::MoveEdge { from, to, attributes } => move_edge(view, author, from, to, attributes)?,
            Self::RemoveVertex { vertex } => remove_vertex(view, *vertex)?,
        })
    }
}

/// Makes the records of one delta: hands out fresh dots, all with one stamp. `[spec: MUT-0.2]`
pub(crate) struct Draft {
    pub(crate) delta: Delta,
    author: Author,
    next: Dot,
    stamp: u64,
}

impl Draft {
    /// Dots for so many records after every one that the author has used; a stamp above every one held.
    /// `[spec: ID-3]` `[spec: STAMP-1]` `[spec: MUT-0.3]`
    fn new(ground: &impl Ground, author: Author, records: usize) -> Result<Self, ExhaustedError> {
        let next = ground.next_dot(author.replica);
        let left =
            next.map_or(0, |next| limits::SEQUENCE_MAX.saturating_add(1).saturating_sub(next.sequence));
        let Some(next) = next.filter(|_| records as u64 <= left) else {
            return Err(ExhaustedError::Sequences { replica: author.replica });
        };
        let stamp = ground.greatest_stamp().saturating_add(1);
        if stamp > limits::STAMP_MAX {
            return Err(ExhaustedError::Stamps);
        }
        Ok(Self { delta: Delta::new(), author, next, stamp })
    }

    /// Files a record under the next dot.
    fn add(&mut self, record: Record) -> Dot {
        let dot = self.next;
        self.delta.insert(dot, record);
        self.next.sequence += 1;
        dot
    }
}
