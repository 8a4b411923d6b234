//! Why a mutation is refused: the names of the specification, with handles in the place of ids.

use dsr_core::limits;

/// An attribute cannot be written so (MUT-3.2).
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum AttributeRefusal {
    /// The dictionary is closed and does not list it.
    #[error("the dictionary declares no attribute {0:?}")]
    Undeclared(String),
    /// The dictionary declares another type.
    #[error("the attribute {0:?} is declared with another type")]
    WrongType(String),
    /// The name is empty or too long.
    #[error("an attribute name has {0} bytes; allowed are 1 to {max}", max = limits::NAME_BYTES_MAX)]
    NameLength(usize),
    /// The value is too large.
    #[error("the value of {name:?} has {bytes} bytes; allowed are {max}", max = limits::VALUE_BYTES_MAX)]
    ValueSize {
        /// The attribute.
        name: String,
        /// Its size.
        bytes: usize,
    },
    /// Too many at once.
    #[error("{0} attributes in one mutation; allowed are {max}", max = limits::ATTRIBUTES_MAX)]
    TooMany(usize),
}

/// An edge cannot be made (MUT-2.1 and following).
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum EdgeRefusal {
    /// An end is not in the graph.
    #[error("the vertex {0:?} is not in the graph")]
    UnknownVertex(String),
    /// Both ends are one vertex.
    #[error("an edge from {0:?} to itself is not allowed")]
    SelfLoop(String),
    /// The dictionary is closed and does not list the label.
    #[error("the dictionary declares no edge label {0:?}")]
    UndeclaredLabel(String),
    /// The label is empty or too long.
    #[error("an edge label has {0} bytes; allowed are 1 to {max}", max = limits::NAME_BYTES_MAX)]
    LabelLength(usize),
    /// An edge is shown under the key.
    #[error("this edge is there already: update its attributes instead")]
    KeyPresent,
    /// The source shows an edge of this functional label.
    #[error("{0:?} is functional, and its source has such an edge: move that one")]
    FunctionalTaken(String),
    /// The root cannot be a kinematic child.
    #[error("an RT edge cannot enter the root")]
    IntoRoot,
    /// The child has a kinematic parent.
    #[error("{child:?} has the kinematic parent {parent:?}: move that edge instead")]
    HasParent {
        /// The child.
        child: String,
        /// Its parent.
        parent: String,
    },
    /// The parent has no place in the tree.
    #[error("{0:?} has no place in the kinematic tree: give it a parent first")]
    ParentOutsideTree(String),
    /// A new vertex as a kinematic parent.
    #[error("a new vertex cannot be the kinematic parent of {0:?}: link it as a child")]
    NewVertexAsParent(String),
    /// The parent is below the child.
    #[error("{parent:?} is below {child:?} in the kinematic tree")]
    Cycle {
        /// The child.
        child: String,
        /// The parent.
        parent: String,
    },
}

/// Why a mutation is refused.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Refusal {
    /// The dictionary is closed and does not list the vertex type.
    #[error("the dictionary declares no vertex type {0:?}")]
    UndeclaredType(String),
    /// A vertex type or name is empty or too long.
    #[error("a vertex type or name has {0} bytes; allowed are 1 to {max}", max = limits::NAME_BYTES_MAX)]
    NameLength(usize),
    /// The name is the root's.
    #[error("{0:?} names the root")]
    ReservedName(String),
    /// A vertex in the graph has the name.
    #[error("{existing:?} is named {name:?} already")]
    NameTaken {
        /// The name.
        name: String,
        /// Who has it.
        existing: String,
    },
    /// The link of a new vertex cannot be made.
    #[error("the link cannot be made: {0}")]
    Link(EdgeRefusal),
    /// A moved edge cannot be made.
    #[error("the edge cannot be moved there: {0}")]
    Edge(EdgeRefusal),
    /// A new edge cannot be made.
    #[error(transparent)]
    NewEdge(EdgeRefusal),
    /// An attribute of a new element cannot be written.
    #[error(transparent)]
    Attribute(AttributeRefusal),
    /// An attribute cannot be updated.
    #[error(transparent)]
    Update(AttributeRefusal),
    /// What is to be updated is not in the graph.
    #[error("what is to be updated is not in the graph")]
    UnknownTarget,
    /// Nothing is given.
    #[error("no attribute is given")]
    Empty,
    /// An attribute to unset is not set.
    #[error("there is no attribute {0:?} to unset")]
    NotSet(String),
    /// No such edge is shown.
    #[error("no such edge is shown")]
    UnknownEdge,
    /// Old and new key are one.
    #[error("the edge is to move onto itself: update its attributes instead")]
    SameKey,
    /// The root cannot be removed.
    #[error("the root cannot be removed")]
    Root,
    /// The vertex to remove is not in the graph.
    #[error("the vertex {0:?} is not in the graph")]
    UnknownVertex(String),
    /// Others would be stranded.
    #[error("this would strand {0:?}: move or remove them first")]
    Strands(Vec<String>),
}

impl AttributeRefusal {
    const fn kind(&self) -> &'static str {
        match self {
            Self::Undeclared(_) => "Undeclared",
            Self::WrongType(_) => "WrongType",
            Self::NameLength(_) => "NameLength",
            Self::ValueSize { .. } => "ValueSize",
            Self::TooMany(_) => "TooMany",
        }
    }
}

impl EdgeRefusal {
    const fn kind(&self) -> &'static str {
        match self {
            Self::UnknownVertex(_) => "UnknownVertex",
            Self::SelfLoop(_) => "SelfLoop",
            Self::UndeclaredLabel(_) => "UndeclaredLabel",
            Self::LabelLength(_) => "LabelLength",
            Self::KeyPresent => "KeyPresent",
            Self::FunctionalTaken(_) => "FunctionalTaken",
            Self::IntoRoot => "IntoRoot",
            Self::HasParent { .. } => "HasParent",
            Self::ParentOutsideTree(_) => "ParentOutsideTree",
            Self::NewVertexAsParent(_) => "NewVertexAsParent",
            Self::Cycle { .. } => "Cycle",
        }
    }
}

impl Refusal {
    /// The error's name. `[spec: CONF-8]`
    pub fn kind(&self) -> String {
        match self {
            Self::UndeclaredType(_) => "UndeclaredType",
            Self::NameLength(_) => "NameLength",
            Self::ReservedName(_) => "ReservedName",
            Self::NameTaken { .. } => "NameTaken",
            Self::Link(refusal) => return format!("Link.{}", refusal.kind()),
            Self::Edge(refusal) => return format!("Edge.{}", refusal.kind()),
            Self::NewEdge(refusal) => refusal.kind(),
            Self::Attribute(refusal) => return format!("Attribute.{}", refusal.kind()),
            Self::Update(refusal) => refusal.kind(),
            Self::UnknownTarget => "UnknownTarget",
            Self::Empty => "Empty",
            Self::NotSet(_) => "NotSet",
            Self::UnknownEdge => "UnknownEdge",
            Self::SameKey => "SameKey",
            Self::Root => "Root",
            Self::UnknownVertex(_) => "UnknownVertex",
            Self::Strands(_) => "Strands",
        }
        .into()
    }
}
