//! The same schedule on the checked semantics: `dsr-core` in place of the published one.
//!
//! Each call becomes a mutation, made by the same replica at the same point; its delta arrives wherever and
//! whenever a message of the published call does. After each event every view is judged. At the end all
//! states must be equal; where messages were lost or missed, after everybody has resynchronised. What a row
//! says of a single write or node must not come true either.

use super::Row;
use super::record::new_copies;
use super::run::bound;
use crate::checked::alphabet::Alphabet;
use crate::checked::{Act, Checked, replica_id};
use crate::course::Event;
use crate::published::{Envelope, Happening, Network, NodeId, Operation, Property, Setup};
use crate::search::Space;
use crate::trace::{CannotHappen, Finding, FindingKind, Part, Recorder, Trace};
use dsr_core::invariant::check_view;
use dsr_core::{
    AttributeMap, Author, Dictionary, EdgeKey, ElementId, Mutation, NewVertex, RT, State, Value, VertexId,
    VertexLink, View, view,
};
use std::collections::BTreeMap;

/// What the checked semantics does with a schedule.
#[derive(Clone, PartialEq, Debug)]
pub struct Twin {
    /// The clause that does not hold, if any, and why.
    pub broken: Option<String>,
    /// Deliveries that changed a state.
    pub deliveries: usize,
    /// Calls that it refuses: nothing is broadcast for them.
    pub refused: usize,
    /// Whether all were equal only after resynchronising, because messages never arrived.
    pub resynchronised: bool,
    /// What happens.
    pub trace: Trace,
}

impl Twin {
    /// In a word, or a sentence.
    pub fn verdict(&self) -> String {
        self.broken.clone().unwrap_or_else(|| "holds".into())
    }
}

/// What the first replica of a row has done before it begins, all but a joiner having heard of it, as mutations.
pub fn mutations_before(row: &Row) -> Vec<Mutation> {
    Cast::new(&row.setup).set_up(&row.setup).1
}

/// Runs a schedule of a row on the checked semantics; `None` if it is none of the row's.
pub fn run_checked(row: &Row, schedule: &[Happening]) -> Option<Twin> {
    let setup = &row.setup;
    let mut cast = Cast::new(setup);
    let (initial, _) = cast.set_up(setup);
    let dictionary = Dictionary::open();
    let alphabet = Alphabet::of(&[], Vec::new());
    let semantics = Checked { dictionary, initial: State::new(), alphabet };
    let parts = setup.agents.iter().zip(initial).enumerate().map(|(at, (&agent, state))| Part {
        name: setup.name(at),
        index: usize::try_from(agent.saturating_sub(1)).unwrap_or(0),
        state: Some(state),
    });
    let mut replay = Replay {
        recorder: Recorder::starting(&semantics, parts.collect()),
        cast,
        sent: Vec::new(),
        deliveries: 0,
        refused: 0,
    };
    let mut network = Network::new(setup.clone());
    let mut at = network.start();
    for happening in schedule {
        let before = network.letters(at);
        at = network.step(at, happening)?;
        let sent = new_copies(&before, network.letters(at));
        replay.happen(setup, happening, sent).ok()?;
        if let Some(broken) = replay.judge() {
            return Some(replay.end(row, Some(broken), false));
        }
    }
    for copy in network.letters(at) {
        replay.happen(setup, &Happening::Deliver(copy, false), Vec::new()).ok()?;
    }
    let powers = &setup.powers;
    let missed = powers.losses_max > 0 || powers.joiner.is_some() || powers.restarts.is_some();
    let resynchronised = missed && replay.differ();
    if resynchronised {
        replay.resynchronise().ok()?;
    }
    let broken = replay.judge().or_else(|| replay.differ().then(|| "JOIN-5: the replicas differ".into()));
    let broken = broken.or_else(|| replay.judge_property(setup.property));
    Some(replay.end(row, broken, resynchronised))
}

/// Which vertices stand for nodes, and who holds copies.
struct Cast {
    dictionary: Dictionary,
    vertices: BTreeMap<NodeId, VertexId>,
    /// By replica, the node that its user keeps a copy of.
    copies: BTreeMap<usize, NodeId>,
    first: usize,
}

/// The checked replicas, beside the published ones.
struct Replay<'s> {
    recorder: Recorder<'s, Checked>,
    cast: Cast,
    /// The numbers of the messages that stand for published ones.
    sent: Vec<(Envelope, usize)>,
    deliveries: usize,
    refused: usize,
}

impl Replay<'_> {
    fn happen(
        &mut self,
        setup: &Setup,
        happening: &Happening,
        sent: Vec<Envelope>,
    ) -> Result<(), CannotHappen> {
        match happening {
            Happening::Call(replica, call) => {
                let calls = setup.plays.get(*replica).map(|play| &play.calls);
                let Some((_, operation)) = calls.and_then(|calls| calls.get(*call)) else { return Ok(()) };
                if let Some(number) = self.call(*replica, operation)? {
                    self.sent.extend(sent.into_iter().map(|copy| (copy, number)));
                }
                Ok(())
            }
            Happening::Encode => {
                let joiner = setup.powers.joiner.as_ref();
                let (replica, to) = joiner.map_or((0, 0), |joiner| (joiner.server, joiner.replica));
                let number = self.recorder.runner().messages().len();
                self.sent.extend(sent.into_iter().map(|copy| (copy, number)));
                self.recorder.record(&Event::Answer { replica, to })
            }
            Happening::Deliver(copy, _) => {
                let known = self.sent.iter().find(|(sent, _)| sent == copy);
                let Some(&(_, message)) = known else { return Ok(()) };
                let before = self.recorder.states()[copy.to].clone();
                // One message of ours may stand for several: it arrives with the first of them.
                if self.recorder.runner().messages()[message]
                    .deltas
                    .iter()
                    .all(|delta| before.joined(delta) == before)
                {
                    return Ok(());
                }
                self.deliveries += 1;
                self.recorder.record(&Event::Deliver { replica: copy.to, message })
            }
            Happening::Lose(copy) => {
                let known = self.sent.iter().find(|(sent, _)| sent == copy);
                let Some(&(_, message)) = known else { return Ok(()) };
                self.recorder.record(&Event::Lose { replica: copy.to, message })
            }
            Happening::Restart(replica) => {
                self.recorder.record(&Event::Restart { replica: *replica, keeps: false })
            }
            Happening::Refuse => {
                let joiner = setup.powers.joiner.as_ref();
                let (replica, to) = joiner.map_or((0, 0), |joiner| (joiner.server, joiner.replica));
                let message = self.recorder.runner().messages().len();
                self.recorder.record(&Event::Answer { replica, to })?;
                self.recorder.record(&Event::Deliver { replica: to, message })
            }
            Happening::Find(_) | Happening::Tell => Ok(()),
        }
    }

    /// Makes a call; the number of its message, or `None` if it broadcasts nothing.
    fn call(&mut self, replica: usize, operation: &Operation) -> Result<Option<usize>, CannotHappen> {
        if let Operation::Get { node } = operation {
            self.cast.copies.insert(replica, *node);
            self.recorder.happen(replica, operation.to_string());
            return Ok(None);
        }
        let author = Author::new(replica_id(self.recorder.runner().identity(replica)?));
        let state = self.recorder.states()[replica].clone();
        let seen = view(&state, &self.cast.dictionary);
        let mutation = self.cast.mutation(&seen, replica, operation);
        let Some(mutation) = mutation.filter(|mutation| mutation.delta(&seen, author).is_ok()) else {
            self.refused += 1;
            self.recorder.happen(replica, format!("is refused: {operation}"));
            return Ok(None);
        };
        self.cast.note(&state, author, operation);
        let number = self.recorder.runner().messages().len();
        self.recorder.record(&Event::Mutate { replica, mutations: vec![Act(mutation)] })?;
        Ok(Some(number))
    }

    fn differ(&self) -> bool {
        let states = self.recorder.states();
        states.iter().any(|state| *state != states[0])
    }

    /// The first view that breaks an invariant.
    fn judge(&self) -> Option<String> {
        self.recorder.states().iter().enumerate().find_map(|(at, state)| {
            let broken = check_view(&view(state, &self.cast.dictionary)).err()?;
            Some(format!("{broken:?} at {}", self.recorder.scribe().name(at)))
        })
    }

    /// What a row says of one node, where the invariants do not cover it: a write that nobody superseded is
    /// live everywhere, hidden by a greater one at most; what was removed is not shown.
    fn judge_property(&self, property: Property) -> Option<String> {
        let vertex = |node: NodeId| self.cast.vertices.get(&node).copied();
        self.recorder.states().iter().find_map(|state| {
            let seen = view(state, &self.cast.dictionary);
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

    /// The first replica asks everybody, then everybody asks the first.
    fn resynchronise(&mut self) -> Result<(), CannotHappen> {
        let others = 1..self.recorder.states().len();
        let asks = others.clone().map(|other| (other, 0));
        for (replica, to) in asks.chain(others.map(|other| (0, other))) {
            let message = self.recorder.runner().messages().len();
            self.recorder.record(&Event::Answer { replica, to })?;
            self.recorder.record(&Event::Deliver { replica: to, message })?;
        }
        Ok(())
    }

    fn end(self, row: &Row, broken: Option<String>, resynchronised: bool) -> Twin {
        let names = self.recorder.scribe().names(0..self.recorder.states().len());
        let kind = if broken.is_some() { FindingKind::Broken } else { FindingKind::Holds };
        let finding = Finding {
            kind,
            clause: row.setup.property.clause().into(),
            what: "the replicas end equal, and every view keeps the invariants".into(),
            detail: broken
                .clone()
                .unwrap_or_else(|| "all replicas are equal, and every view is sound".into()),
            replicas: names,
        };
        let title = format!("{}. {}: the same schedule", row.row, row.title);
        let trace = self.recorder.finish(title, "gallery", bound(&row.setup), finding);
        Twin { broken, deliveries: self.deliveries, refused: self.refused, resynchronised, trace }
    }
}

impl Cast {
    fn new(setup: &Setup) -> Self {
        let first =
            setup.agents.first().map_or(0, |&agent| usize::try_from(agent.saturating_sub(1)).unwrap_or(0));
        Self { dictionary: Dictionary::open(), vertices: BTreeMap::new(), copies: BTreeMap::new(), first }
    }

    /// What each replica starts with: the first has made its calls, and all but a joiner have heard of them. With
    /// the mutations that these are.
    fn set_up(&mut self, setup: &Setup) -> (Vec<State>, Vec<Mutation>) {
        let (mut made, mut mutations) = (State::new(), Vec::new());
        for operation in &setup.before {
            let author = Author::new(replica_id(self.first));
            let before = made.clone();
            let seen = view(&before, &self.dictionary);
            let Some(mutation) = self.mutation(&seen, 0, operation) else { continue };
            let Ok(delta) = mutation.delta(&seen, author) else { continue };
            self.note(&before, author, operation);
            made.join(&delta);
            mutations.push(mutation);
        }
        let joiner = setup.powers.joiner.as_ref().map(|joiner| joiner.replica);
        let state = |at| if Some(at) == joiner { State::new() } else { made.clone() };
        ((0..setup.replicas()).map(state).collect(), mutations)
    }

    /// Remembers which vertex a call makes.
    fn note(&mut self, state: &State, author: Author, operation: &Operation) {
        if let (Operation::InsertNode { id, .. }, Some(dot)) = (operation, state.next_dot(author.replica)) {
            self.vertices.insert(*id, VertexId(dot));
        }
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
