//! Writes to registers, for those who ask why. Dots are those of one register: `0.3` of one attribute has nothing
//! to do with `0.3` of another. `[spec: TRACE-7]`

use super::NodeId;
use super::context::Dot;
use super::graph::{Attribute, AttributeRegisters, Edge, Node};
use super::message::Message;
use super::register::Register;
use super::replica::Replica;
use crate::why::{Claim, Fate, Standing, Target};
use std::collections::BTreeMap;

/// What is known of the register that a target is.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
struct Held {
    /// By dot, the value in words.
    values: BTreeMap<String, String>,
    /// Whether a dot counts as seen.
    seen: Option<super::Context>,
}

fn dot_text(dot: Dot) -> String {
    format!("{}.{}", dot.id, dot.n)
}

fn node_id(id: NodeId) -> String {
    format!("#{id}")
}

fn held<T>(register: &Register<T>, text: impl Fn(&T) -> String) -> Held {
    let values = register.values().iter().map(|(&dot, value)| (dot_text(dot), text(value)));
    Held { values: values.collect(), seen: Some(register.context().clone()) }
}

fn of_attributes(registers: &AttributeRegisters, name: &str) -> Option<Held> {
    registers.get(name).map(|register| of_attribute(register, name))
}

fn of_attribute(register: &Register<Attribute>, name: &str) -> Held {
    held(register, |attribute| format!("{name} = {}, of agent {}", attribute.value, attribute.agent))
}

fn of_edge(register: &Register<Edge>, key: &str, target: &Target) -> Option<Held> {
    match target {
        Target::Edge { id, .. } if id == key => {
            Some(held(register, |edge| format!("edge {key}, of agent {}", edge.agent)))
        }
        Target::Attribute { of, name } if of == key => of_attributes(&register.value()?.attributes, name),
        _ => None,
    }
}

fn of_node(register: &Register<Node>, id: NodeId, target: &Target) -> Option<Held> {
    match target {
        Target::Vertex { id: wanted } if *wanted == node_id(id) => {
            return Some(held(register, |node| {
                format!("node #{id} {} ({}), of agent {}", node.name, node.kind, node.agent)
            }));
        }
        Target::Attribute { of, name } if *of == node_id(id) => {
            return of_attributes(&register.value()?.attributes, name);
        }
        _ => {}
    }
    register
        .value()?
        .edges
        .iter()
        .find_map(|(&(to, kind), edge)| of_edge(edge, &edge_key(id, kind, to), target))
}

fn edge_key(from: NodeId, kind: &str, to: NodeId) -> String {
    format!("#{from} -{kind}-> #{to}")
}

fn claims(held: Option<Held>) -> Vec<Claim> {
    let values = held.into_iter().flat_map(|held| held.values);
    values.map(|(dot, text)| Claim { dot, text }).collect()
}

impl Message {
    fn held(&self, target: &Target) -> Option<Held> {
        match self {
            Self::Node { id, delta, .. } => of_node(delta, *id, target),
            Self::Edge { from, to, kind, delta, .. } => of_edge(delta, &edge_key(*from, kind, *to), target),
            Self::Graph { nodes, .. } => nodes.iter().find_map(|(&id, node)| of_node(node, id, target)),
            Self::NodeAttributes { parts, .. } => {
                let Target::Attribute { of, name } = target else { return None };
                let mut parts = parts.iter().filter(|part| node_id(part.node) == *of && part.key == name);
                parts.next().map(|part| of_attribute(&part.delta, name))
            }
            Self::EdgeAttributes { parts, .. } => {
                let Target::Attribute { of, name } = target else { return None };
                let is_it = |key: String| key == *of;
                let mut parts = parts
                    .iter()
                    .filter(|part| is_it(edge_key(part.from, part.kind, part.to)) && part.key == name);
                parts.next().map(|part| of_attribute(&part.delta, name))
            }
        }
    }

    /// What it says about a target.
    pub fn claims(&self, target: &Target) -> Vec<Claim> {
        claims(self.held(target))
    }

    /// Whether it says that a claim is gone: its dot is seen, and not brought.
    pub fn ends(&self, target: &Target, claim: &Claim) -> bool {
        let of = match target {
            Target::Vertex { id } | Target::Edge { id, .. } => id,
            Target::Attribute { of, .. } => of,
        };
        let is_removal = match self {
            Self::Node { id, delta, .. } => delta.is_empty() && node_id(*id) == *of,
            Self::Edge { from, to, kind, delta, .. } => delta.is_empty() && edge_key(*from, kind, *to) == *of,
            _ => false,
        };
        let told = self.held(target);
        is_removal || told.is_some_and(|held| !held.values.contains_key(&claim.dot) && held.knows(claim))
    }
}

impl Held {
    fn knows(&self, claim: &Claim) -> bool {
        let parsed = claim.dot.split_once('.').and_then(|(id, n)| Some((id.parse().ok()?, n.parse().ok()?)));
        let Some((id, n)) = parsed else { return false };
        self.seen.as_ref().is_some_and(|seen| seen.known(Dot { id, n }))
    }
}

impl Replica {
    fn held_of(&self, target: &Target) -> Option<Held> {
        self.nodes.iter().find_map(|(&id, node)| of_node(node, id, target))
    }

    /// What waits in its buffers.
    fn waiting(&self, target: &Target) -> Vec<Held> {
        let buffers = &self.buffers;
        let attribute = |of: String, key: &str, register: &Register<Attribute>| match target {
            Target::Attribute { of: wanted, name } if *wanted == of && name == key => {
                Some(of_attribute(register, key))
            }
            _ => None,
        };
        let nodes = buffers.node_attributes.iter();
        let nodes = nodes.filter_map(|((id, key), held)| attribute(node_id(*id), key, &held.delta));
        let edges = buffers.edge_attributes.iter().filter_map(|(&(from, to, kind, key), held)| {
            attribute(edge_key(from, kind, to), key, &held.delta)
        });
        let starts = buffers.edges_from.iter();
        let starts = starts
            .filter_map(|(&(from, to, kind), held)| of_edge(&held.delta, &edge_key(from, kind, to), target));
        let ends = buffers.edges_to.iter().flat_map(|(&to, all)| {
            all.iter().filter_map(move |(from, kind, held)| {
                of_edge(&held.delta, &edge_key(*from, kind, to), target)
            })
        });
        nodes.chain(edges).chain(starts).chain(ends).collect()
    }

    /// What it holds of a target.
    pub fn claims_held(&self, target: &Target) -> Vec<Claim> {
        claims(self.held_of(target))
    }

    /// How a claim stands here.
    pub fn standing(&self, target: &Target, claim: &Claim) -> Standing {
        let stands = |fate, why: String| Standing { fate, why, clause: "" };
        let says = |held: &Held| held.values.get(&claim.dot) == Some(&claim.text);
        let here = self.held_of(target).unwrap_or_default();
        if says(&here) {
            return stands(Fate::Shown, "it is what the register holds".into());
        }
        if let Some(other) = here.values.get(&claim.dot) {
            let why = format!(
                "{other} has the same dot here: of two, the lower agent's stays, else what was there"
            );
            return stands(Fate::Beaten, why);
        }
        if self.waiting(target).iter().any(says) {
            return stands(Fate::Waits, "what it belongs to has not come here".into());
        }
        if here.knows(claim) {
            let why = match here.values.iter().next() {
                Some((dot, held)) => format!("its dot counts as seen, and {held} [{dot}] is held"),
                None => "its dot counts as seen, and nothing is held".into(),
            };
            return stands(Fate::Gone, why);
        }
        let id = match target {
            Target::Vertex { id } => id,
            Target::Edge { from, .. } => from,
            Target::Attribute { of, .. } => of,
        };
        if self.deleted.iter().any(|node| node_id(*node) == *id) {
            return stands(Fate::Gone, format!("{id} is deleted here"));
        }
        stands(Fate::Unseen, "it is not held here, and its dot does not count as seen".into())
    }
}
