//! Mutations where earlier ones have other dots. `[spec: CHECK-14]`

use dsr_core::{Delta, Dot, EdgeId, EdgeKey, ElementId, Mutation, Name, Record, State, VertexId, VertexLink};

/// The mutation with each dot that an earlier one made replaced by what that one makes now; `None` if it names
/// a dot of nobody. Of a dot made twice the later maker counts.
pub(super) fn mutation(mutation: &Mutation, initial: &State, made: &[(Delta, Delta)]) -> Option<Mutation> {
    let now = |dot: Dot| {
        if VertexId(dot).is_root() || initial.holds(dot) {
            return Some(dot);
        }
        made.iter().rev().find(|(old, _)| old.holds(dot)).and_then(|(old, new)| counterpart(old, new, dot))
    };
    let vertex = |id: VertexId| now(id.0).map(VertexId);
    let key = |key: &EdgeKey| {
        Some(EdgeKey { from: vertex(key.from)?, to: vertex(key.to)?, label: key.label.clone() })
    };
    Some(match mutation {
        Mutation::AddVertex { vertex: new, link } => Mutation::AddVertex {
            vertex: new.clone(),
            link: VertexLink { other: vertex(link.other)?, ..link.clone() },
        },
        Mutation::AddEdge { key: new, attributes } => {
            Mutation::AddEdge { key: key(new)?, attributes: attributes.clone() }
        }
        Mutation::UpdateAttributes { target, updates } => {
            let target = match *target {
                ElementId::Vertex(id) => ElementId::Vertex(vertex(id)?),
                ElementId::Edge(id) => ElementId::Edge(EdgeId(now(id.0)?)),
            };
            Mutation::UpdateAttributes { target, updates: updates.clone() }
        }
        Mutation::RemoveEdge { key: old } => Mutation::RemoveEdge { key: key(old)? },
        Mutation::MoveEdge { from, to, attributes } => {
            Mutation::MoveEdge { from: key(from)?, to: key(to)?, attributes: attributes.clone() }
        }
        Mutation::RemoveVertex { vertex: old } => Mutation::RemoveVertex { vertex: vertex(*old)? },
    })
}

/// What a record is, whatever its dot: a mutation makes at most one vertex and one edge, and of each attribute
/// one write on either.
#[derive(PartialEq, Eq)]
enum Role {
    Vertex,
    Edge,
    Write(Option<Box<Role>>, Name),
}

fn role(delta: &Delta, dot: Dot) -> Option<Role> {
    Some(match delta.get(dot)? {
        Record::Vertex(_) => Role::Vertex,
        Record::Edge(_) => Role::Edge,
        Record::Write(write) => Role::Write(role(delta, write.target).map(Box::new), write.name.clone()),
    })
}

/// The dot in `new` that has the place of `dot` in `old`.
fn counterpart(old: &Delta, new: &Delta, dot: Dot) -> Option<Dot> {
    let wanted = role(old, dot)?;
    new.records().map(|(dot, _)| dot).find(|&dot| role(new, dot).as_ref() == Some(&wanted))
}
