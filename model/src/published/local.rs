//! What a replica does for its own agent, and broadcasts.

use super::graph::{Attribute, AttributeRegisters, Edge, Node, NodeName, Value};
use super::message::{EdgePart, Message, NodePart};
use super::operation::Operation;
use super::register::{Payload, Register};
use super::replica::{NodeCopy, Replica};
use super::{AgentId, Crash, Key, Kind, NodeId, Time};
use std::collections::{BTreeMap, BTreeSet};

/// What a call broadcasts, in order; `None` when it is refused (it returns false, or throws).
type Sent = Result<Option<Vec<Message>>, Crash>;

/// The deltas of attributes that were written, and of those that were removed.
type Assigned = (Vec<(Key, Register<Attribute>)>, Vec<(Key, Register<Attribute>)>);

/// The type of kinematic edges.
pub(super) const RT: Kind = "RT";
/// The attribute that names a node's kinematic parent.
pub(super) const PARENT: Key = "parent";
/// The attribute that counts kinematic edges down from the root.
pub(super) const LEVEL: Key = "level";

impl Replica {
    /// Makes a call at a time on the agent's own clock, in nanoseconds.
    pub fn call(&mut self, operation: &Operation, now: Time) -> Sent {
        match *operation {
            Operation::InsertNode { id, kind, name, attributes } => {
                Ok(self.insert_node(id, kind, name, attributes, now))
            }
            Operation::Set { node, key, value } => {
                let Some(mut copy) = self.copy_of(node)? else { return Ok(None) };
                copy.attributes.insert(key, self.number(value));
                self.update_node(&copy, now)
            }
            Operation::Remove { node, key } => {
                let Some(mut copy) = self.copy_of(node)? else { return Ok(None) };
                if copy.attributes.remove(key).is_none() {
                    return Ok(None);
                }
                self.update_node(&copy, now)
            }
            Operation::Get { node } => {
                self.copy = self.copy_of(node)?;
                Ok(self.copy.is_some().then(Vec::new))
            }
            Operation::PutBack { key, value } => {
                let Some(mut copy) = self.copy.take() else { return Ok(None) };
                copy.attributes.insert(key, self.number(value));
                self.update_node(&copy, now)
            }
            Operation::DeleteNode { node } => self.delete_node(node, now),
            Operation::AssignEdge { from, to, kind, attributes } => {
                let attributes = self.numbers(attributes);
                self.assign_edge((from, to, kind), &attributes, now)
            }
            Operation::DeleteEdge { from, to, kind } => self.delete_edge((from, to, kind), now),
            Operation::Place { from, to, pose } => self.place(from, to, pose, now),
        }
    }

    fn number(&self, value: i64) -> Attribute {
        Attribute { value: Value::Number(value), agent: self.stamp() }
    }

    fn numbers(&self, attributes: &[(Key, i64)]) -> BTreeMap<Key, Attribute> {
        attributes.iter().map(|&(key, value)| (key, self.number(value))).collect()
    }

    fn insert_node(
        &mut self,
        id: NodeId,
        kind: Kind,
        name: &'static str,
        attributes: &[(Key, i64)],
        time: Time,
    ) -> Option<Vec<Message>> {
        if self.deleted.contains(&id) || self.nodes.contains_key(&id) {
            return None;
        }
        let given = NodeName::Given(name);
        let taken = name.is_empty() || self.ids.contains_key(&given);
        let name = if taken { NodeName::Made(kind, id) } else { given };
        let attributes = written(&self.numbers(attributes));
        let node = Node { id, kind, name, agent: self.stamp(), attributes, edges: BTreeMap::new() };
        let delta = self.nodes.entry(id).or_default().write(node).map(Node::wire);
        self.index_node(id);
        Some(vec![Message::Node { sender: self.agent, time, id, delta }])
    }

    /// Makes a node's attributes those of a copy. Removals say that they are from whoever made the node.
    fn update_node(&mut self, copy: &NodeCopy, time: Time) -> Sent {
        let named = self.names.get(&copy.id).is_none_or(|name| *name == copy.name);
        let mine = self.ids.get(&copy.name).is_none_or(|id| *id == copy.id);
        if self.deleted.contains(&copy.id) || !named || !mine {
            return Ok(None);
        }
        let ignored = self.ignored.clone();
        let Some(node) = self.edit(copy.id)? else { return Ok(None) };
        let (writes, removals) = assign(&mut node.attributes, &copy.attributes, &ignored);
        let author = node.agent;
        let part = |sender: AgentId| move |(key, delta)| NodePart { sender, node: copy.id, key, delta };
        let parts = writes.into_iter().map(part(self.agent));
        let parts = parts.chain(removals.into_iter().map(part(author))).collect();
        Ok(Some(vec![Message::NodeAttributes { time, parts }]))
    }

    /// Deletes a node and, by the index of edges, the edges that end at it.
    ///
    /// What is held back for the node stays held back: only what arrives is described to drop it.
    fn delete_node(&mut self, id: NodeId, now: Time) -> Sent {
        let Some(register) = self.nodes.get_mut(&id) else { return Ok(None) };
        let delta = register.reset();
        self.remove_node(id);
        let mut sent = vec![Message::Node { sender: self.agent, time: now, id, delta }];
        let incoming: Vec<(NodeId, BTreeSet<Kind>)> = self
            .edges
            .iter()
            .filter(|&(&(_, to), _)| to == id)
            .map(|(&(from, _), kinds)| (from, kinds.clone()))
            .collect();
        let mut time = now;
        for (from, kinds) in incoming {
            self.unindex_edge(from, id);
            for kind in kinds {
                time += 1;
                sent.extend(self.drop_edge((from, id, kind), time)?);
            }
        }
        Ok(Some(sent))
    }

    /// Resets an edge's register and forgets it, its context included.
    fn drop_edge(
        &mut self,
        (from, to, kind): (NodeId, NodeId, Kind),
        time: Time,
    ) -> Result<Option<Message>, Crash> {
        let sender = self.agent;
        let Some(node) = self.edit(from)? else { return Ok(None) };
        let removed = node.edges.remove(&(to, kind));
        Ok(removed.map(|mut edge| Message::Edge { sender, time, from, to, kind, delta: edge.reset() }))
    }

    fn assign_edge(
        &mut self,
        (from, to, kind): (NodeId, NodeId, Kind),
        attributes: &BTreeMap<Key, Attribute>,
        time: Time,
    ) -> Sent {
        if !self.nodes.contains_key(&to) {
            return Ok(None);
        }
        let (sender, agent, ignored) = (self.agent, self.stamp(), self.ignored.clone());
        let Some(node) = self.edit(from)? else { return Ok(None) };
        if let Some(register) = node.edges.get_mut(&(to, kind)) {
            let (writes, removals) = assign(&mut register.edit()?.attributes, attributes, &ignored);
            let part = |(key, delta)| EdgePart { sender, from, to, kind, key, delta };
            let parts = writes.into_iter().chain(removals).map(part).collect();
            return Ok(Some(vec![Message::EdgeAttributes { time, parts }]));
        }
        let edge = Edge { from, to, kind, agent, attributes: written(attributes) };
        let delta = node.edges.entry((to, kind)).or_default().write(edge).map(Edge::wire);
        self.index_edge((from, to, kind));
        Ok(Some(vec![Message::Edge { sender, time, from, to, kind, delta }]))
    }

    fn delete_edge(&mut self, (from, to, kind): (NodeId, NodeId, Kind), time: Time) -> Sent {
        let Some(message) = self.drop_edge((from, to, kind), time)? else { return Ok(None) };
        self.unindex_edge(from, to);
        Ok(Some(vec![message]))
    }

    /// Inserts or updates a kinematic edge and, if they change, `parent` and `level` of the child. All of
    /// these say that they are from agent 0. An older kinematic edge to the child stays.
    fn place(&mut self, from: NodeId, to: NodeId, pose: i64, now: Time) -> Sent {
        let Some(Attribute { value: Value::Number(level), .. }) = self.attribute(from, LEVEL) else {
            return Ok(None);
        };
        let nobodys = |value| Attribute { value, agent: 0 };
        let pose = BTreeMap::from([("rt", nobodys(Value::Number(pose)))]);
        let Some(mut sent) = self.assign_edge((from, to, RT), &pose, now)? else { return Ok(None) };
        let sender = self.agent;
        let Some(child) = self.edit(to)? else { return Ok(None) };
        let mut parts = Vec::new();
        for (key, value) in [(PARENT, Value::Node(from)), (LEVEL, Value::Number(level + 1))] {
            let register = child.attributes.entry(key).or_default();
            if register.value().is_none_or(|held| held.value != value) {
                parts.push(NodePart { sender, node: to, key, delta: register.write(nobodys(value)) });
            }
        }
        if !parts.is_empty() {
            sent.push(Message::NodeAttributes { time: now + 1, parts });
        }
        Ok(Some(sent))
    }
}

/// Fresh registers, each written once: such a register and its delta are alike.
fn written(attributes: &BTreeMap<Key, Attribute>) -> AttributeRegisters {
    attributes.iter().map(|(&key, &attribute)| (key, Register::default().write(attribute))).collect()
}

/// Makes registers hold exactly what is wanted. A removed register is forgotten, its context included; an
/// ignored one is forgotten whatever is wanted.
fn assign(
    registers: &mut AttributeRegisters,
    wanted: &BTreeMap<Key, Attribute>,
    ignored: &BTreeSet<Key>,
) -> Assigned {
    let (mut writes, mut removals) = (Vec::new(), Vec::new());
    for (&key, attribute) in wanted {
        let register = registers.entry(key).or_default();
        if register.value().is_none_or(|held| !held.same_value(attribute)) {
            writes.push((key, register.write(*attribute)));
        }
    }
    let gone: Vec<Key> = registers.keys().copied().filter(|key| !wanted.contains_key(key)).collect();
    for key in gone {
        if let Some(mut register) = registers.remove(key).filter(|_| !ignored.contains(key)) {
            removals.push((key, register.reset()));
        }
    }
    registers.retain(|key, _| !ignored.contains(key));
    (writes, removals)
}
