//! What each vertex is called in a file: ids, names and types that re-read to the same graph.
//! `[spec: SCENE-15]`

use super::{RootNaming, Scene};
use crate::dot::VertexId;
use crate::limits;
use crate::record::Name;
use crate::view::View;
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::vec::Vec;
use core::fmt;

/// Where a written file differs from the graph, because the format cannot hold it as it is.
/// `[spec: SCENE-15]`
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum Note {
    /// Two live vertices have one external id: the older keeps it.
    Renumbered {
        /// The younger vertex.
        vertex: VertexId,
        /// The id that it had.
        from: u64,
        /// The id in the file.
        to: u64,
    },
    /// Two live vertices have one name, or one that only the root may have.
    Renamed {
        /// The vertex.
        vertex: VertexId,
        /// Its name.
        from: Name,
        /// Its name in the file.
        to: Name,
    },
    /// A vertex other than the root has a type that only the root may have.
    Retyped {
        /// The vertex.
        vertex: VertexId,
        /// Its type.
        from: Name,
        /// Its type in the file.
        to: Name,
    },
    /// Only a repair holds the vertex: the file has no such link, and is refused when it is read strictly.
    Stranded {
        /// The vertex.
        vertex: VertexId,
    },
    /// Records that the view does not show are not in the file: losing claims, and what is pending.
    Hidden {
        /// How many.
        records: usize,
    },
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Renumbered { vertex, from, to } => {
                write!(f, "vertex {vertex} has id {to} in the file: an older vertex has its id {from}")
            }
            Self::Renamed { vertex, from, to } => {
                write!(f, "vertex {vertex} is named {to:?} in the file: {from:?} is taken")
            }
            Self::Retyped { vertex, from, to } => {
                write!(f, "vertex {vertex} is of type {to:?} in the file: {from:?} is the root's")
            }
            Self::Stranded { vertex } => {
                write!(f, "vertex {vertex} is held by a repair alone: the file will be refused for it")
            }
            Self::Hidden { records } => {
                write!(f, "{records} record(s) that the graph does not show are not in the file")
            }
        }
    }
}

/// A vertex as the file has it.
#[derive(Debug)]
pub(super) struct Named {
    pub(super) vertex: VertexId,
    pub(super) name: Name,
    pub(super) vertex_type: Name,
}

/// Every live vertex by the id that it has in the file.
pub(super) fn named(scene: &Scene, view: &View<'_>, notes: &mut Vec<Note>) -> BTreeMap<u64, Named> {
    let ids = ids(&scene.root, view, notes);
    let mut taken = BTreeSet::from([scene.root.name.clone()]);
    let mut named = BTreeMap::new();
    for (&vertex, id) in view.vertices().iter().zip(ids) {
        let entry = match view.vertex(vertex) {
            None => {
                Named { vertex, name: scene.root.name.clone(), vertex_type: scene.root.vertex_type.clone() }
            }
            Some(record) => {
                // The vertex that a name finds keeps it, whatever its dot.
                let found = view.vertex_by_name(&record.name) == Some(vertex);
                let name = if found && taken.insert(record.name.clone()) {
                    record.name.clone()
                } else {
                    let to = fresh(&record.name, id, |name| {
                        view.vertex_by_name(name).is_none() && taken.insert(name.clone())
                    });
                    notes.push(Note::Renamed { vertex, from: record.name.clone(), to: to.clone() });
                    to
                };
                Named { vertex, name, vertex_type: plain_type(vertex, &record.vertex_type, id, notes) }
            }
        };
        named.insert(id, entry);
    }
    named
}

/// Beside the view's vertices: external ids where they are unique, else the smallest unused number from 1.
fn ids(root: &RootNaming, view: &View<'_>, notes: &mut Vec<Note>) -> Vec<u64> {
    let stated = |vertex: VertexId| match view.vertex(vertex) {
        Some(record) => record.external_id,
        None => root.external_id,
    };
    let mut taken = BTreeSet::new();
    let kept: Vec<Option<u64>> =
        view.vertices().iter().map(|&vertex| stated(vertex).filter(|&id| taken.insert(id))).collect();
    let mut next = 0;
    let mut unused = || {
        loop {
            next += 1;
            if !taken.contains(&next) {
                return next;
            }
        }
    };
    let mut ids = Vec::with_capacity(kept.len());
    for (&vertex, kept) in view.vertices().iter().zip(kept) {
        let id = kept.unwrap_or_else(&mut unused);
        if let Some(from) = stated(vertex).filter(|&stated| stated != id) {
            notes.push(Note::Renumbered { vertex, from, to: id });
        }
        ids.push(id);
    }
    ids
}

fn plain_type(vertex: VertexId, vertex_type: &Name, id: u64, notes: &mut Vec<Note>) -> Name {
    if !crate::is_root_name(vertex_type) {
        return vertex_type.clone();
    }
    let to = fresh(vertex_type, id, |_| true);
    notes.push(Note::Retyped { vertex, from: vertex_type.clone(), to: to.clone() });
    to
}

/// `<name>~<id>`, cut to the limit and lengthened by further `~` until `accept` takes it.
fn fresh(name: &str, id: u64, mut accept: impl FnMut(&Name) -> bool) -> Name {
    let mut suffix = format!("~{id}");
    loop {
        let mut end = name.len().min(limits::NAME_BYTES_MAX.saturating_sub(suffix.len()));
        while !name.is_char_boundary(end) {
            end -= 1;
        }
        let candidate: Name = format!("{}{suffix}", name.get(..end).unwrap_or_default()).into();
        if accept(&candidate) {
            return candidate;
        }
        suffix.insert(0, '~');
    }
}
