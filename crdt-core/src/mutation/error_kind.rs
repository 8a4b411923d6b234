//! The names of errors, as the specification has them.

use super::error::{
    AddEdgeError, AddVertexError, AttributeError, ExhaustedError, MoveEdgeError, MutationError, NewEdgeError,
    RemoveEdgeError, RemoveVertexError, UpdateAttributesError,
};
use alloc::format;
use alloc::string::String;

impl MutationError {
    /// The name of the error, such as `NameTaken`. An error that reports another one is followed by a full stop
    /// and that one's name, such as `Link.UnknownVertex`.
    pub fn kind(&self) -> String {
        match self {
            Self::AddVertex(error) => of_add_vertex(error),
            Self::AddEdge(error) => match error {
                AddEdgeError::Edge(error) => of_new_edge(error).into(),
                AddEdgeError::Attribute(error) => of_attribute(error),
                AddEdgeError::Exhausted(error) => of_exhausted(error),
            },
            Self::UpdateAttributes(error) => match error {
                UpdateAttributesError::UnknownTarget { .. } => "UnknownTarget".into(),
                UpdateAttributesError::Empty => "Empty".into(),
                UpdateAttributesError::NotSet { .. } => "NotSet".into(),
                UpdateAttributesError::Attribute(error) => attribute_name(error).into(),
                UpdateAttributesError::Exhausted(error) => of_exhausted(error),
            },
            Self::RemoveEdge(error) => match error {
                RemoveEdgeError::UnknownEdge { .. } => "UnknownEdge".into(),
                RemoveEdgeError::Strands(_) => "Strands".into(),
            },
            Self::MoveEdge(error) => match error {
                MoveEdgeError::UnknownEdge { .. } => "UnknownEdge".into(),
                MoveEdgeError::SameKey { .. } => "SameKey".into(),
                MoveEdgeError::Edge(error) => format!("Edge.{}", of_new_edge(error)),
                MoveEdgeError::Strands(_) => "Strands".into(),
                MoveEdgeError::Attribute(error) => of_attribute(error),
                MoveEdgeError::Exhausted(error) => of_exhausted(error),
            },
            Self::RemoveVertex(error) => match error {
                RemoveVertexError::Root => "Root".into(),
                RemoveVertexError::UnknownVertex { .. } => "UnknownVertex".into(),
                RemoveVertexError::Strands(_) => "Strands".into(),
            },
        }
    }
}

fn of_add_vertex(error: &AddVertexError) -> String {
    match error {
        AddVertexError::UndeclaredType { .. } => "UndeclaredType".into(),
        AddVertexError::NameLength { .. } => "NameLength".into(),
        AddVertexError::ReservedName { .. } => "ReservedName".into(),
        AddVertexError::NameTaken { .. } => "NameTaken".into(),
        AddVertexError::Link(error) => format!("Link.{}", of_new_edge(error)),
        AddVertexError::Attribute(error) => of_attribute(error),
        AddVertexError::Exhausted(error) => of_exhausted(error),
    }
}

const fn of_new_edge(error: &NewEdgeError) -> &'static str {
    match error {
        NewEdgeError::UnknownVertex { .. } => "UnknownVertex",
        NewEdgeError::SelfLoop { .. } => "SelfLoop",
        NewEdgeError::UndeclaredLabel { .. } => "UndeclaredLabel",
        NewEdgeError::LabelLength { .. } => "LabelLength",
        NewEdgeError::KeyPresent { .. } => "KeyPresent",
        NewEdgeError::FunctionalTaken { .. } => "FunctionalTaken",
        NewEdgeError::IntoRoot => "IntoRoot",
        NewEdgeError::HasParent { .. } => "HasParent",
        NewEdgeError::ParentOutsideTree { .. } => "ParentOutsideTree",
        NewEdgeError::NewVertexAsParent { .. } => "NewVertexAsParent",
        NewEdgeError::Cycle { .. } => "Cycle",
    }
}

const fn attribute_name(error: &AttributeError) -> &'static str {
    match error {
        AttributeError::Undeclared { .. } => "Undeclared",
        AttributeError::WrongType { .. } => "WrongType",
        AttributeError::NameLength { .. } => "NameLength",
        AttributeError::ValueSize { .. } => "ValueSize",
        AttributeError::TooMany { .. } => "TooMany",
    }
}

fn of_attribute(error: &AttributeError) -> String {
    format!("Attribute.{}", attribute_name(error))
}

fn of_exhausted(error: &ExhaustedError) -> String {
    let name = match error {
        ExhaustedError::Sequences { .. } => "Sequences",
        ExhaustedError::Stamps => "Stamps",
    };
    format!("Exhausted.{name}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dot::{ReplicaId, VertexId};

    #[track_caller]
    fn check(error: impl Into<MutationError>, kind: &str) {
        assert_eq!(error.into().kind(), kind);
    }

    #[test]
    fn law_an_error_that_reports_another_names_both() {
        let unknown = || NewEdgeError::UnknownVertex { vertex: VertexId::ROOT };
        let long = || AttributeError::NameLength { bytes: 300 };
        let exhausted = || ExhaustedError::Sequences { replica: ReplicaId::SCENE };
        check(AddVertexError::Link(unknown()), "Link.UnknownVertex");
        check(AddEdgeError::Edge(unknown()), "UnknownVertex");
        check(MoveEdgeError::Edge(NewEdgeError::IntoRoot), "Edge.IntoRoot");
        check(AddVertexError::Attribute(long()), "Attribute.NameLength");
        check(UpdateAttributesError::Attribute(long()), "NameLength");
        check(UpdateAttributesError::Exhausted(exhausted()), "Exhausted.Sequences");
        check(AddEdgeError::Exhausted(ExhaustedError::Stamps), "Exhausted.Stamps");
        check(RemoveVertexError::Root, "Root");
        check(RemoveEdgeError::Strands(super::super::StrandError { vertices: alloc::vec![] }), "Strands");
    }
}
