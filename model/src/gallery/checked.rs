//! The same schedule on the checked semantics: `dsr-core` in place of the published one.
//!
//! Each call becomes a mutation, made by the same replica at the same point; its delta arrives wherever and
//! whenever a message of the published call does. After each event every view is judged. At the end all
//! states must be equal; where messages were lost or missed, after everybody has resynchronised. What a row
//! says of a single write or node must not come true either.

use crate::published::{Envelope, Happening, Moment, Network, NodeId, Operation, Property, Setup};
use crate::search::Space;
use dsr_core::invariant::check_view;
use dsr_core::{
    AttributeMap, Author, Delta, Dictionary, EdgeKey, ElementId, Mutation, NewVertex, RT, ReplicaId, State,
    Value, VertexId, VertexLink, View, delta_for, digest, view,
};
use std::collections::BTreeMap;

/// What the checked semantics does with a schedule.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Checked {
    /// The clause that does not hold, if any, and why.
    pub broken: Option<String>,
    /// Deliveries that changed a state.
    pub deliveries: usize,
    /// Calls that it refuses: nothing is broadcast for them.
    pub refused: usize,
    /// Whether all were equal only after resynchronising, because messages never arrived.
    pub resynchronised: bool,
}

impl Checked {
    /// In a word, or a sentence.
    pub fn verdict(&self) -> String {
        self.broken.clone().unwrap_or_else(|| "holds".into())
    }
}

/// Runs a trace of a setup on the checked semantics; `None` if the trace is not one of the setup.
pub fn run_checked(setup: &Setup, trace: &[Happening]) -> Option<Checked> {
    let mut network = Network::new(setup.clone());
    let mut at = network.start();
    let mut replay = Replay::new(setup);
    for happening in trace {
        let before = network.letters(at);
        at = network.step(at, happening)?;
        let sent = new_copies(&before, network.letters(at));
        replay.happen(setup, happening, sent);
        if let Some(broken) = replay.judge() {
            return Some(Checked { broken: Some(broken), ..replay.outcome });
        }
    }
    Some(replay.end(setup, &network, at))
}

fn new_copies(before: &[Envelope], after: Vec<Envelope>) -> Vec<Envelope> {
    after.into_iter().filter(|copy| !before.contains(copy)).collect()
}

/// The checked replicas, beside the published ones.
struct Replay {
    dictionary: Dictionary,
    replicas: Vec<ReplicaId>,
    initial: Vec<State>,
    states: Vec<State>,
    /// The vertices that stand for nodes.
    vertices: BTreeMap<NodeId, VertexId>,
    /// The attribute that the copy kept by a user was asked for.
    copies: BTreeMap<usize, NodeId>,
    /// The deltas behind messages.
    deltas: Vec<(Envelope, Delta)>,
    outcome: Checked,
}

impl Replay {
    fn new(setup: &Setup) -> Self {
        let replica = |&agent: &u32| ReplicaId { agent, incarnation: 0 };
        let replicas: Vec<ReplicaId> = setup.agents.iter().map(replica).collect();
        let states = vec![State::new(); replicas.len()];
        let mut replay = Self {
            dictionary: Dictionary::open(),
            replicas,
            initial: Vec::new(),
            states,
            vertices: BTreeMap::new(),
            copies: BTreeMap::new(),
            deltas: Vec::new(),
            outcome: Checked { broken: None, deliveries: 0, refused: 0, resynchronised: false },
        };
        let joiner = setup.powers.joiner.as_ref().map(|joiner| joiner.replica);
        for operation in &setup.before {
            let Some(delta) = replay.call(0, operation) else { continue };
            let others = replay.states.iter_mut().enumerate().filter(|(at, _)| Some(*at) != joiner);
            others.for_each(|(_, state)| state.join(&delta));
        }
        replay.initial.clone_from(&replay.states);
        replay
    }

    fn happen(&mut self, setup: &Setup, happening: &Happening, sent: Vec<Envelope>) {
        match happening {
            Happening::Call(replica, call) => {
                let calls = setup.plays.get(*replica).map(|play| &play.calls);
                let Some((_, operation)) = calls.and_then(|calls| calls.get(*call)) else { return };
                if let Some(delta) = self.call(*replica, operation) {
                    self.deltas.extend(sent.into_iter().map(|copy| (copy, delta.clone())));
                }
            }
            Happening::Encode => {
                let server = setup.powers.joiner.as_ref().map_or(0, |joiner| joiner.server);
                let whole = self.states[server].clone();
                self.deltas.extend(sent.into_iter().map(|copy| (copy, whole.clone())));
            }
            Happening::Deliver(copy, _) => {
                let delta = self.deltas.iter().find(|(sent, _)| sent == copy);
                if let Some((_, delta)) = delta {
                    let after = self.states[copy.to].joined(delta);
                    self.outcome.deliveries += usize::from(after != self.states[copy.to]);
                    self.states[copy.to] = after;
                }
            }
            Happening::Restart(replica) => {
                self.states[*replica] = self.initial[*replica].clone();
                self.replicas[*replica].incarnation += 1;
            }
            Happening::Lose(_) | Happening::Find(_) | Happening::Tell => {}
        }
    }

    /// Makes a call; `None` if it broadcasts nothing.
    fn call(&mut self, replica: usize, operation: &Operation) -> Option<Delta> {
        if let Operation::Get { node } = operation {
            self.copies.insert(replica, *node);
            return None;
        }
        let state = &self.states[replica];
        let seen = view(state, &self.dictionary);
        let author = Author::new(self.replicas[replica]);
        let next = state.next_dot(author.replica);
        let mutation = self.mutation(&seen, replica, operation);
        let Some(delta) = mutation.and_then(|mutation| mutation.delta(&seen, author).ok()) else {
            self.outcome.refused += 1;
            return None;
        };
        if let (Operation::InsertNode { id, .. }, Some(dot)) = (operation, next) {
            self.vertices.insert(*id, VertexId(dot));
        }
        self.states[replica].join(&delta);
        Some(delta)
    }

    fn mutation(&self, seen: &View<'_>, replica: usize, operation: &Operation) -> Option<Mutation> {
        let vertex = |node: NodeId| self.vertices.get(&node).copied();
        let key = |from, kind, to| Some(EdgeKey::new(vertex(from)?, kind, vertex(to)?));
        let update = |node, name: &str, value: Option<i64>| {
            let target = ElementId::Vertex(vertex(node)?);
            let updates = [(name.into(), value.map(number))].into();
            Some(Mutation::UpdateAttributes { target, updates })
        };
        match *operation {
            Operation::InsertNode { kind, name, attributes, .. } => {
                let vertex = NewVertex { attributes: numbers(attributes), ..NewVertex::new(kind, name) };
                Some(Mutation::AddVertex { vertex, link: VertexLink::child_of(VertexId::ROOT) })
            }
            Operation::Set { node, key, value } => update(node, key, Some(value)),
            Operation::Remove { node, key } => update(node, key, None),
            Operation::Get { .. } => None,
            Operation::PutBack { key, value } => update(*self.copies.get(&replica)?, key, Some(value)),
            Operation::DeleteNode { node } => Some(Mutation::RemoveVertex { vertex: vertex(node)? }),
            Operation::AssignEdge { from, to, kind, attributes } => {
                Some(assign(seen, key(from, kind, to)?, numbers(attributes)))
            }
            Operation::DeleteEdge { from, to, kind } => {
                Some(Mutation::RemoveEdge { key: key(from, kind, to)? })
            }
            Operation::Place { from, to, pose } => {
                let child = vertex(to)?;
                let old =
                    seen.edges().iter().find(|shown| shown.edge.to == child && *shown.edge.label == *RT)?;
                let old = EdgeKey::new(old.edge.from, RT, child);
                let attributes = numbers(&[("rt", pose)]);
                Some(Mutation::MoveEdge { from: old, to: key(from, RT, to)?, attributes })
            }
        }
    }

    /// The first view that breaks an invariant.
    fn judge(&self) -> Option<String> {
        self.states.iter().zip(&self.replicas).find_map(|(state, replica)| {
            let broken = check_view(&view(state, &self.dictionary)).err()?;
            Some(format!("{broken:?} at agent {}", replica.agent))
        })
    }

    /// What a row says of one node, where the invariants do not cover it: a write that nobody superseded is
    /// live everywhere, hidden by a greater one at most; what was removed is not shown.
    fn judge_property(&self, property: Property) -> Option<String> {
        let vertex = |node: NodeId| self.vertices.get(&node).copied();
        self.states.iter().find_map(|state| {
            let seen = view(state, &self.dictionary);
            match property {
                Property::Lost(node, key, value) => {
                    let writes = seen.attribute_writes(vertex(node)?, key);
                    let is_live = writes.iter().any(|(_, write)| write.value == number(value));
                    (!is_live).then(|| format!("INTENT-2: {key} = {value} is lost"))
                }
                Property::Revived(node) => {
                    seen.has_vertex(vertex(node)?).then(|| format!("STATE-3: #{node} is shown"))
                }
                _ => None,
            }
        })
    }

    /// Judges the end: equal at once if everything has arrived, else after resynchronisation.
    fn end(mut self, setup: &Setup, network: &Network, at: Moment) -> Checked {
        for copy in network.letters(at) {
            let rest = Happening::Deliver(copy, false);
            self.happen(setup, &rest, Vec::new());
        }
        let powers = &setup.powers;
        let missed = powers.losses_max > 0 || powers.joiner.is_some() || powers.restarts.is_some();
        if missed && self.states.iter().any(|state| *state != self.states[0]) {
            self.resynchronise();
            self.outcome.resynchronised = true;
        }
        let differ = self.states.iter().any(|state| *state != self.states[0]);
        let broken = self.judge().or_else(|| differ.then(|| "JOIN-5: the replicas differ".into()));
        let broken = broken.or_else(|| self.judge_property(setup.property));
        Checked { broken, ..self.outcome }
    }

    /// The first replica asks everybody, then everybody asks the first.
    fn resynchronise(&mut self) {
        for other in 1..self.states.len() {
            let delta = delta_for(&self.states[other], &digest(&self.states[0]));
            self.states[0].join(&delta);
        }
        for other in 1..self.states.len() {
            let delta = delta_for(&self.states[0], &digest(&self.states[other]));
            self.states[other].join(&delta);
        }
    }
}

/// Adds an edge, or gives it exactly these attributes if it is shown.
fn assign(seen: &View<'_>, key: EdgeKey, attributes: AttributeMap) -> Mutation {
    let Some(shown) = seen.edge_by_key(&key) else { return Mutation::AddEdge { key, attributes } };
    let old = seen.attributes_of(shown.id).map(|(_, write)| (write.name.clone(), None));
    let mut updates: BTreeMap<_, _> = old.collect();
    updates.extend(attributes.into_iter().map(|(name, value)| (name, Some(value))));
    Mutation::UpdateAttributes { target: ElementId::Edge(shown.id), updates }
}

fn number(value: i64) -> Value {
    Value::Int(i32::try_from(value).unwrap_or(i32::MAX))
}

fn numbers(attributes: &[(&str, i64)]) -> AttributeMap {
    attributes.iter().map(|&(name, value)| (name.into(), number(value))).collect()
}
