//! What may break, each as the clause of the specification that it comes closest to.

use super::graph::{Attribute, Value};
use super::local::{LEVEL, PARENT, RT};
use super::replica::{Replica, Shown};
use super::{Key, NOBODY, NodeId};
use crate::semantics::Breach;
use std::collections::BTreeSet;

/// A thing that ought not to be found.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Property {
    /// Replicas to which nothing is under way show different graphs.
    Divergence,
    /// A register is present and holds nothing: the next read fails an assertion.
    Unreadable,
    /// A shown edge ends at a node that this replica has deleted; of all replicas, or of one by position.
    Dangling(Option<usize>),
    /// A node is shown here that is deleted elsewhere.
    Revived(NodeId),
    /// Two kinematic edges end at a node, and replicas name different parents.
    TwoParents(NodeId),
    /// Several kinematic edges end at a node.
    SeveralParents(NodeId),
    /// Following `parent` never ends: a transform loops.
    ParentLoop,
    /// A node has one kinematic edge, and `parent` does not name its start, or `level` is missing.
    ParentMismatch(NodeId),
    /// A node has one kinematic edge, and its level is not one more than that of the edge's start.
    LevelMismatch(NodeId),
    /// `parent` of a node names a node that is deleted here.
    Orphan(NodeId),
    /// The last replica, which has joined, does not show a node that the first shows.
    Missing(NodeId),
    /// A value that was written, and that nobody overwrote or removed after, is shown by nobody.
    Lost(NodeId, Key, i64),
    /// An attribute is shown by one replica, by position, and by no other.
    OnlyAt(usize, NodeId, NodeId, Key),
    /// A node is present, and the index of names does not lead to it.
    NameIndex,
    /// Two replicas have each deleted a node that the other shows.
    Unreconciled,
}

impl Property {
    /// The clause that it is closest to.
    pub const fn clause(self) -> &'static str {
        match self {
            Self::Divergence | Self::OnlyAt(..) => "JOIN-5",
            Self::Unreadable => "VIEW-1",
            Self::Dangling(_) | Self::Orphan(_) => "INV-2",
            Self::Revived(_) => "STATE-3",
            Self::TwoParents(_)
            | Self::SeveralParents(_)
            | Self::ParentLoop
            | Self::ParentMismatch(_)
            | Self::LevelMismatch(_) => "INV-3",
            Self::Lost(..) => "INTENT-2",
            Self::NameIndex => "VIEW-7",
            Self::Unreconciled | Self::Missing(_) => "SYNC-5",
        }
    }

    /// In a sentence.
    pub const fn sentence(self) -> &'static str {
        match self {
            Self::Divergence => "nothing is under way, and replicas differ",
            Self::Unreadable => "a register is present and empty: the next read aborts",
            Self::Dangling(_) => "an edge ends at a deleted node",
            Self::Revived(_) => "a node is shown that is deleted elsewhere",
            Self::TwoParents(_) => "a node has two kinematic parents, and replicas answer by different ones",
            Self::SeveralParents(_) => "a node has several kinematic parents",
            Self::ParentLoop => "the parents form a circle: a transform never ends",
            Self::ParentMismatch(_) => "a kinematic edge is shown and `parent` and `level` do not say so",
            Self::LevelMismatch(_) => "a node's level does not follow from its parent's",
            Self::Orphan(_) => "a node's parent is deleted",
            Self::Missing(_) => "a replica has joined and does not show a node of the graph that it joined",
            Self::Lost(..) => "a write that everybody received is shown by nobody",
            Self::OnlyAt(..) => "an attribute is shown by one replica only",
            Self::NameIndex => "a node is present and its name leads elsewhere",
            Self::Unreconciled => "each side keeps what the other has deleted",
        }
    }

    /// Judges the replicas; those that have not joined yet are not among them.
    pub fn judge(self, replicas: &[&Replica]) -> Result<(), Breach> {
        match self.broken(replicas) {
            Some(detail) => Err(Breach::new(self.clause(), format!("{}: {detail}", self.sentence()))),
            None => Ok(()),
        }
    }

    fn broken(self, replicas: &[&Replica]) -> Option<String> {
        let mut each = replicas.iter();
        match self {
            Self::Divergence => divergence(replicas),
            Self::Unreadable => each.find_map(|at| at.copy_all().map(|what| said(at, &what))),
            Self::Dangling(Some(place)) => {
                let at = replicas.get(place)?;
                dangling(at).map(|what| said(at, &what))
            }
            Self::Dangling(None) => each.find_map(|at| dangling(at).map(|what| said(at, &what))),
            Self::Revived(node) => {
                let gone = replicas.iter().find(|at| at.deleted.contains(&node))?;
                let here = replicas.iter().find(|at| at.node(node).is_some())?;
                Some(format!("#{node} is shown at {}, deleted at {}", here.agent, gone.agent))
            }
            Self::TwoParents(child) => two_parents(child, replicas),
            Self::SeveralParents(child) => each.find_map(|at| {
                let parents = kinematic_parents(at, child);
                let names: Vec<String> = parents.iter().map(|parent| format!("#{parent}")).collect();
                (parents.len() > 1).then(|| said(at, &format!("#{child} below {}", names.join(" and "))))
            }),
            Self::ParentLoop => each.find_map(|at| parent_loop(at).map(|node| said(at, &format!("#{node}")))),
            Self::ParentMismatch(child) => {
                each.find_map(|at| mismatch(at, child).map(|what| said(at, &what)))
            }
            Self::LevelMismatch(child) => {
                each.find_map(|at| wrong_level(at, child).map(|what| said(at, &what)))
            }
            Self::Orphan(child) => each.find_map(|at| {
                let parent = parent(at, child).filter(|parent| at.deleted.contains(parent))?;
                Some(said(at, &format!("#{child} below #{parent}")))
            }),
            Self::Missing(node) => {
                let (first, last) = (replicas.first()?, replicas.last()?);
                let missing = first.node(node).is_some() && last.node(node).is_none();
                missing.then(|| said(last, &format!("#{node}")))
            }
            Self::Lost(node, key, value) => {
                let shows = |at: &&Replica| is_number(at, node, key, value);
                let all = replicas.iter().all(|at| !shows(at));
                all.then(|| format!("#{node}.{key} = {value}"))
            }
            Self::OnlyAt(place, from, to, key) => {
                let shows = |at: &Replica| edge_shows(at, from, to, key);
                let only = replicas.iter().enumerate().all(|(at, replica)| shows(replica) == (at == place));
                only.then(|| format!("{key} of #{from} -> #{to}"))
            }
            Self::NameIndex => each.find_map(|at| name_index(at).map(|what| said(at, &what))),
            Self::Unreconciled => {
                let keeps = |left: &Replica, right: &Replica| {
                    right.deleted.iter().copied().find(|&node| left.node(node).is_some())
                };
                let (left, right) = (replicas.first()?, replicas.get(1)?);
                let (mine, theirs) = (keeps(left, right)?, keeps(right, left)?);
                Some(format!("#{mine} at {}, #{theirs} at {}", left.agent, right.agent))
            }
        }
    }
}

impl Replica {
    /// The first node of which no copy can be had.
    fn copy_all(&self) -> Option<String> {
        self.nodes.keys().find(|&&id| self.copy_of(id).is_err()).map(|id| format!("#{id}"))
    }
}

fn said(at: &Replica, what: &str) -> String {
    if at.agent == NOBODY { what.into() } else { format!("{what} at agent {}", at.agent) }
}

fn divergence(replicas: &[&Replica]) -> Option<String> {
    let shown: Vec<Shown> = replicas.iter().map(|at| at.shown()).collect();
    let first = shown.first()?;
    let other = shown.iter().position(|other| other != first)?;
    let (left, right) = only(&lines(first), &lines(&shown[other]));
    Some(format!(
        "only agent {} shows {left}; only agent {} shows {right}",
        replicas[0].agent, replicas[other].agent
    ))
}

/// What only one and only the other says, each in a line.
pub(super) fn only(left: &BTreeSet<String>, right: &BTreeSet<String>) -> (String, String) {
    let only = |mine: &BTreeSet<String>, theirs: &BTreeSet<String>| {
        let only: Vec<&str> = mine.difference(theirs).map(String::as_str).collect();
        if only.is_empty() { "nothing".to_owned() } else { only.join(", ") }
    };
    (only(left, right), only(right, left))
}

/// A graph as a set of facts.
pub(super) fn lines(shown: &Shown) -> BTreeSet<String> {
    let mut lines = BTreeSet::new();
    for (id, node) in shown {
        let Some(node) = node else {
            lines.insert(format!("#{id} empty"));
            continue;
        };
        lines.insert(format!("#{id} {} {}", node.kind, node.name));
        lines.extend(node.attributes.iter().map(|(key, held)| format!("#{id}.{key} = {}", held_text(*held))));
        for ((to, kind), edge) in &node.edges {
            let name = format!("#{id} -{kind}-> #{to}");
            let Some(edge) = edge else { continue };
            let (from, end, says) = edge.says;
            lines.insert(name.clone());
            if (from, end, says) != (*id, *to, kind) {
                lines.insert(format!("{name} saying #{from} -{says}-> #{end}"));
            }
            let attributes = edge.attributes.iter();
            lines.extend(attributes.map(|(key, held)| format!("{name}.{key} = {}", held_text(*held))));
        }
    }
    lines
}

fn held_text(held: Option<Attribute>) -> String {
    held.map_or_else(|| "empty".into(), |held| held.value.to_string())
}

fn edges_of(at: &Replica) -> impl Iterator<Item = (NodeId, NodeId, &'static str)> + '_ {
    let nodes = at.nodes.values().filter_map(|register| register.value());
    nodes.flat_map(|node| node.edges.keys().map(|&(to, kind)| (node.id, to, kind)))
}

fn dangling(at: &Replica) -> Option<String> {
    let gone = |to: &NodeId| at.deleted.contains(to) && !at.nodes.contains_key(to);
    edges_of(at).find(|(_, to, _)| gone(to)).map(|(from, to, kind)| format!("#{from} -{kind}-> #{to}"))
}

fn kinematic_parents(at: &Replica, child: NodeId) -> Vec<NodeId> {
    edges_of(at).filter(|&(_, to, kind)| (to, kind) == (child, RT)).map(|(from, _, _)| from).collect()
}

fn parent(at: &Replica, child: NodeId) -> Option<NodeId> {
    match at.attribute(child, PARENT)?.value {
        Value::Node(node) => Some(node),
        Value::Number(_) => None,
    }
}

fn two_parents(child: NodeId, replicas: &[&Replica]) -> Option<String> {
    if replicas.iter().any(|at| kinematic_parents(at, child).len() < 2) {
        return None;
    }
    let first = parent(replicas.first()?, child)?;
    let other = replicas.iter().filter_map(|at| parent(at, child)).find(|other| *other != first)?;
    Some(format!("#{child} below #{first} and #{other}"))
}

/// The walk that a transform makes: from a node to its parent as long as the edge between them is shown.
fn parent_loop(at: &Replica) -> Option<NodeId> {
    let step = |child| parent(at, child).filter(|parent| kinematic_parents(at, child).contains(parent));
    at.nodes.keys().copied().find(|&start| {
        let mut node = start;
        let walk = (0..=at.nodes.len()).take_while(|_| match step(node) {
            Some(next) => {
                node = next;
                true
            }
            None => false,
        });
        walk.count() > at.nodes.len()
    })
}

fn mismatch(at: &Replica, child: NodeId) -> Option<String> {
    let [from] = kinematic_parents(at, child)[..] else { return None };
    at.node(child)?;
    let says = parent(at, child);
    let level = at.attribute(child, LEVEL);
    (says != Some(from) || level.is_none()).then(|| format!("#{from} -RT-> #{child}, parent {says:?}"))
}

fn level(at: &Replica, node: NodeId) -> Option<i64> {
    match at.attribute(node, LEVEL)?.value {
        Value::Number(level) => Some(level),
        Value::Node(_) => None,
    }
}

fn wrong_level(at: &Replica, child: NodeId) -> Option<String> {
    let [from] = kinematic_parents(at, child)[..] else { return None };
    let (above, below) = (level(at, from)?, level(at, child)?);
    (below != above + 1).then(|| format!("#{child} at level {below}, its parent #{from} at level {above}"))
}

fn is_number(at: &Replica, node: NodeId, key: Key, value: i64) -> bool {
    at.attribute(node, key).is_some_and(|held| held.value == Value::Number(value))
}

fn edge_shows(at: &Replica, from: NodeId, to: NodeId, key: Key) -> bool {
    let edges = at.node(from).into_iter().flat_map(|node| &node.edges);
    edges.filter(|((end, _), _)| *end == to).any(|(_, edge)| {
        edge.value().is_some_and(|edge| edge.attributes.get(key).is_some_and(|held| !held.is_empty()))
    })
}

fn name_index(at: &Replica) -> Option<String> {
    let nodes = at.nodes.values().filter_map(|register| register.value());
    let mut wrong = nodes.filter(|node| at.ids.get(&node.name) != Some(&node.id));
    wrong.next().map(|node| format!("#{} named {}", node.id, node.name))
}
