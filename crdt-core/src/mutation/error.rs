//! Why a mutation is refused: one enum per operation, with the values in it.

use super::update_attributes::ElementId;
use crate::dot::{EdgeId, ReplicaId, VertexId};
use crate::limits;
use crate::record::{EdgeKey, Name};
use crate::value::ValueType;
use alloc::vec::Vec;
use core::fmt;

/// A counter is used up. `[spec: LIMIT-5]` `[spec: LIMIT-6]` `[spec: MUT-0.3]`
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExhaustedError {
    /// No sequence is left: take a fresh incarnation.
    #[error("{replica} has used up its sequences: take a fresh incarnation")]
    Sequences {
        /// Whose.
        replica: ReplicaId,
    },
    /// No stamp is left.
    #[error("stamps are used up: one held here is {}", limits::STAMP_MAX)]
    Stamps,
}

/// An attribute cannot be written so. `[spec: MUT-3.2]`
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AttributeError {
    /// The dictionary is closed and does not list the name.
    #[error("the dictionary declares no attribute {name:?}")]
    Undeclared {
        /// The name.
        name: Name,
    },
    /// The dictionary declares another type.
    #[error("attribute {name:?} is declared as {declared}, not {given}")]
    WrongType {
        /// The name.
        name: Name,
        /// The declared type.
        declared: ValueType,
        /// The type given.
        given: ValueType,
    },
    /// The name is empty or too long.
    #[error("an attribute name has {bytes} bytes; allowed are 1 to {}", limits::NAME_BYTES_MAX)]
    NameLength {
        /// Its length.
        bytes: usize,
    },
    /// The value is too large.
    #[error("the value of {name:?} has {bytes} bytes; allowed are {}", limits::VALUE_BYTES_MAX)]
    ValueSize {
        /// The attribute.
        name: Name,
        /// Its size.
        bytes: usize,
    },
    /// Too many attributes at once.
    #[error("{count} attributes in one mutation; allowed are {}", limits::ATTRIBUTES_MAX)]
    TooMany {
        /// How many.
        count: usize,
    },
}

/// An edge cannot be made. `[spec: MUT-2.1]` and following.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NewEdgeError {
    /// An end is not in the graph.
    #[error("vertex {vertex} is not in the graph")]
    UnknownVertex {
        /// The end.
        vertex: VertexId,
    },
    /// Both ends are one vertex.
    #[error("an edge from {vertex} to itself is not allowed")]
    SelfLoop {
        /// The vertex.
        vertex: VertexId,
    },
    /// The dictionary is closed and does not list the label.
    #[error("the dictionary declares no edge label {label:?}")]
    UndeclaredLabel {
        /// The label.
        label: Name,
    },
    /// The label is empty or too long.
    #[error("an edge label has {bytes} bytes; allowed are 1 to {}", limits::NAME_BYTES_MAX)]
    LabelLength {
        /// Its length.
        bytes: usize,
    },
    /// An edge is shown under this key.
    #[error("{key} is there already, as {existing}")]
    KeyPresent {
        /// The key.
        key: EdgeKey,
        /// The edge shown.
        existing: EdgeId,
    },
    /// The source shows an edge of this functional label already: move that one.
    #[error("{label:?} is functional and {existing} holds it: move that edge instead")]
    FunctionalTaken {
        /// The label.
        label: Name,
        /// The edge shown.
        existing: EdgeKey,
    },
    /// The root cannot be a kinematic child.
    #[error("an RT edge cannot enter the root")]
    IntoRoot,
    /// The child has a kinematic parent already: move that edge.
    #[error("{child} has the kinematic parent {parent}: move that edge instead")]
    HasParent {
        /// The child.
        child: VertexId,
        /// Its parent.
        parent: VertexId,
    },
    /// The parent has no place in the kinematic tree.
    #[error("{parent} has no place in the kinematic tree: give it a parent first")]
    ParentOutsideTree {
        /// The parent.
        parent: VertexId,
    },
    /// A new vertex is linked as the kinematic parent of one in the graph. `[spec: MUT-1.1]`
    #[error(
        "a new vertex cannot be the kinematic parent of {child}: it has no place in the tree yet; link it as a \
         child, then move {child}"
    )]
    NewVertexAsParent {
        /// The vertex in the graph.
        child: VertexId,
    },
    /// The parent is a descendant of the child.
    #[error("{parent} is below {child} in the kinematic tree: this would close a cycle")]
    Cycle {
        /// The child.
        child: VertexId,
        /// The parent.
        parent: VertexId,
    },
}

/// Others would be stranded. `[spec: MUT-4.2]`
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct StrandError {
    /// The vertices that would lose their path to the root, or a kinematic parent that they need.
    pub vertices: Vec<VertexId>,
}

impl fmt::Display for StrandError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const SHOWN_MAX: usize = 5;
        f.write_str("this would strand")?;
        for (at, vertex) in self.vertices.iter().take(SHOWN_MAX).enumerate() {
            write!(f, "{} {vertex}", if at == 0 { "" } else { "," })?;
        }
        if self.vertices.len() > SHOWN_MAX {
            write!(f, " and {} more", self.vertices.len() - SHOWN_MAX)?;
        }
        f.write_str(": move or remove them first")
    }
}

impl core::error::Error for StrandError {}

/// Why [`add_vertex`](super::add_vertex) is refused. `[spec: MUT-1.1]` and following.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AddVertexError {
    /// The dictionary is closed and does not list the type.
    #[error("the dictionary declares no vertex type {vertex_type:?}")]
    UndeclaredType {
        /// The type.
        vertex_type: Name,
    },
    /// The type or name is empty or too long.
    #[error("a vertex type or name has {bytes} bytes; allowed are 1 to {}", limits::NAME_BYTES_MAX)]
    NameLength {
        /// Its length.
        bytes: usize,
    },
    /// `root` and `world` name the root.
    #[error("{name:?} names the root")]
    ReservedName {
        /// The name.
        name: Name,
    },
    /// A vertex of this name is in the graph.
    #[error("{existing} is named {name:?} already")]
    NameTaken {
        /// The name.
        name: Name,
        /// The vertex that has it.
        existing: VertexId,
    },
    /// The link cannot be made.
    #[error("the link cannot be made: {0}")]
    Link(#[from] NewEdgeError),
    /// An attribute cannot be written so.
    #[error(transparent)]
    Attribute(#[from] AttributeError),
    /// A counter is used up.
    #[error(transparent)]
    Exhausted(#[from] ExhaustedError),
}

/// Why [`add_edge`](super::add_edge) is refused. `[spec: MUT-2.1]` and following.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AddEdgeError {
    /// The edge cannot be made.
    #[error(transparent)]
    Edge(#[from] NewEdgeError),
    /// An attribute cannot be written so.
    #[error(transparent)]
    Attribute(#[from] AttributeError),
    /// A counter is used up.
    #[error(transparent)]
    Exhausted(#[from] ExhaustedError),
}

/// Why [`update_attributes`](super::update_attributes) is refused. `[spec: MUT-3.1]` and following.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum UpdateAttributesError {
    /// The vertex is not in the graph, or the edge is not shown.
    #[error("{target} is not in the graph")]
    UnknownTarget {
        /// The vertex or edge.
        target: ElementId,
    },
    /// No attribute is given.
    #[error("no attribute is given")]
    Empty,
    /// An attribute to unset is not set.
    #[error("{target} has no attribute {name:?} to unset")]
    NotSet {
        /// The vertex or edge.
        target: ElementId,
        /// The attribute.
        name: Name,
    },
    /// An attribute cannot be written so.
    #[error(transparent)]
    Attribute(#[from] AttributeError),
    /// A counter is used up.
    #[error(transparent)]
    Exhausted(#[from] ExhaustedError),
}

/// Why [`remove_edge`](super::remove_edge) is refused. `[spec: MUT-4.1]` and following.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RemoveEdgeError {
    /// No edge is shown under this key.
    #[error("no edge {key} is shown")]
    UnknownEdge {
        /// The key.
        key: EdgeKey,
    },
    /// Others would be stranded.
    #[error(transparent)]
    Strands(#[from] StrandError),
}

/// Why [`move_edge`](super::move_edge) is refused. `[spec: MUT-5.1]` and following.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MoveEdgeError {
    /// No edge is shown under this key.
    #[error("no edge {key} is shown")]
    UnknownEdge {
        /// The key.
        key: EdgeKey,
    },
    /// Old and new key are the same: update its attributes instead.
    #[error("{key} is to move onto itself: update its attributes instead")]
    SameKey {
        /// The key.
        key: EdgeKey,
    },
    /// The new edge cannot be made.
    #[error(transparent)]
    Edge(#[from] NewEdgeError),
    /// Others would be stranded.
    #[error(transparent)]
    Strands(#[from] StrandError),
    /// An attribute cannot be written so.
    #[error(transparent)]
    Attribute(#[from] AttributeError),
    /// A counter is used up.
    #[error(transparent)]
    Exhausted(#[from] ExhaustedError),
}

/// Why [`remove_vertex`](super::remove_vertex) is refused. `[spec: MUT-6.1]` and following.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RemoveVertexError {
    /// The root cannot be removed.
    #[error("the root cannot be removed")]
    Root,
    /// The vertex is not in the graph.
    #[error("vertex {vertex} is not in the graph")]
    UnknownVertex {
        /// The vertex.
        vertex: VertexId,
    },
    /// Others would be stranded.
    #[error(transparent)]
    Strands(#[from] StrandError),
}

/// Why a [`Mutation`](super::Mutation) is refused.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MutationError {
    /// From [`add_vertex`](super::add_vertex).
    #[error("add_vertex: {0}")]
    AddVertex(#[from] AddVertexError),
    /// From [`add_edge`](super::add_edge).
    #[error("add_edge: {0}")]
    AddEdge(#[from] AddEdgeError),
    /// From [`update_attributes`](super::update_attributes).
    #[error("update_attributes: {0}")]
    UpdateAttributes(#[from] UpdateAttributesError),
    /// From [`remove_edge`](super::remove_edge).
    #[error("remove_edge: {0}")]
    RemoveEdge(#[from] RemoveEdgeError),
    /// From [`move_edge`](super::move_edge).
    #[error("move_edge: {0}")]
    MoveEdge(#[from] MoveEdgeError),
    /// From [`remove_vertex`](super::remove_vertex).
    #[error("remove_vertex: {0}")]
    RemoveVertex(#[from] RemoveVertexError),
}
