//! Writes down what replicas do and show. `[spec: TRACE-1]` `[spec: TRACE-2]`

use super::{Act, FORMAT, Finding, Sent, TRACE_VERSION, Trace, TraceReplica, TraceStep, hash};
use crate::graph::Graph;
use serde_json::Value;

/// What a trace says of itself.
#[derive(Clone, Debug)]
pub struct Heading {
    /// In words.
    pub title: String,
    /// Whose semantics.
    pub semantics: String,
    /// What it takes to run it again.
    pub setup: Value,
    /// The layer.
    pub layer: String,
    /// The bound, in words.
    pub bound: String,
}

/// Writes a trace, step by step.
#[derive(Clone, Debug)]
pub struct Scribe {
    replicas: Vec<TraceReplica>,
    graphs: Vec<Graph>,
    steps: Vec<TraceStep>,
    sent: usize,
}

impl Scribe {
    /// Before the first step.
    pub fn new(replicas: Vec<TraceReplica>) -> Self {
        let graphs = replicas.iter().map(|replica| replica.starts.clone()).collect();
        Self { replicas, graphs, steps: Vec::new(), sent: 0 }
    }

    /// The name of a replica by position.
    pub fn name(&self, replica: usize) -> &str {
        self.replicas.get(replica).map_or("", |replica| &replica.name)
    }

    /// The names of these replicas.
    pub fn names(&self, replicas: impl IntoIterator<Item = usize>) -> Vec<String> {
        replicas.into_iter().map(|replica| self.name(replica).to_owned()).collect()
    }

    /// Who takes part, with what they start with.
    pub fn replicas(&self) -> &[TraceReplica] {
        &self.replicas
    }

    /// The next message.
    pub fn send(&mut self, text: String, delta: Value) -> Sent {
        let message = message_name(self.sent);
        self.sent += 1;
        Sent { message, text, delta }
    }

    /// The step of a replica, by position, that leads to a state and shows a graph; not written down yet.
    pub fn step(&self, replica: usize, does: Act, shows: &Graph, state: &Value) -> TraceStep {
        TraceStep {
            replica: self.name(replica).to_owned(),
            does,
            changes: self.graphs.get(replica).map(|before| before.changes(shows)).unwrap_or_default(),
            state: hash(state),
        }
    }

    /// Writes down a step of a replica, by position.
    pub fn note(&mut self, replica: usize, does: Act, shows: Graph, state: &Value) {
        self.steps.push(self.step(replica, does, &shows, state));
        if let Some(known) = self.graphs.get_mut(replica) {
            *known = shows;
        }
    }

    /// Leaves out a replica to whom nothing has happened.
    pub fn drop_idle(&mut self, name: &str) {
        let is_idle = self.steps.iter().all(|step| step.replica != name);
        if let Some(at) = self.replicas.iter().position(|replica| replica.name == name && is_idle) {
            self.replicas.remove(at);
            self.graphs.remove(at);
        }
    }

    /// The steps so far.
    pub fn steps(&self) -> &[TraceStep] {
        &self.steps
    }

    /// The trace.
    pub fn finish(self, heading: Heading, finding: Finding) -> Trace {
        let Heading { title, semantics, setup, layer, bound } = heading;
        Trace {
            format: FORMAT.into(),
            version: TRACE_VERSION,
            title,
            semantics,
            setup,
            layer,
            bound,
            replicas: self.replicas,
            steps: self.steps,
            finding,
        }
    }
}

/// The name of a message by number.
pub fn message_name(message: usize) -> String {
    format!("m{}", message + 1)
}
