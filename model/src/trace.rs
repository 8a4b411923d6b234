//! Traces: a run as people and programs read it, step by step, up to the clause that breaks.
//! `[spec: TRACE-1]`

mod read;

pub use read::TraceError;

use crate::histories::{Choice, FoundFault, Histories};
use crate::search::Counterexample;
use crate::semantics::{Breach, Semantics};
use crate::tables::{DeltaId, StateId};
use crate::verdict::RunTrace;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The version of the trace format.
pub const TRACE_VERSION: u32 = 1;

/// A run of replicas, step by step. Format version [`TRACE_VERSION`]. `[spec: TRACE-1]`
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trace {
    /// Always `dsr-trace`.
    pub format: String,
    /// The format's version.
    pub version: u32,
    /// Whose semantics.
    pub semantics: String,
    /// The layer that found it.
    pub layer: String,
    /// The replicas' names; observers only receive.
    pub replicas: Vec<String>,
    /// What every replica starts from.
    pub initial: Value,
    /// What happens, in order.
    pub steps: Vec<TraceStep>,
    /// The clause that does not hold after the last step.
    pub breach: TraceBreach,
}

/// One step of one replica.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TraceStep {
    /// Who.
    pub replica: String,
    /// What.
    pub act: Act,
    /// What changed in the replica's view, a line each.
    pub changes: Vec<String>,
}

/// What a replica does.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Act {
    /// Mutates and broadcasts.
    Mutate {
        /// The message that carries the delta.
        message: String,
        /// The mutation, for people.
        text: String,
        /// The mutation.
        mutation: Value,
        /// The delta.
        delta: Value,
    },
    /// Receives a message.
    Deliver {
        /// Which.
        message: String,
    },
    /// Stops and starts again under a fresh incarnation.
    Restart,
    /// Asks a peer for what it is missing, by digest.
    Resynchronise {
        /// Whom.
        from: String,
        /// What it got.
        delta: Value,
    },
}

/// The clause that does not hold.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TraceBreach {
    /// Its id.
    pub clause: String,
    /// What is wrong, with the values.
    pub detail: String,
    /// The states that show it, by replica.
    pub states: Vec<(String, Value)>,
}

/// Writes traces of L1 counterexamples.
pub(crate) struct TraceWriter<'h, S: Semantics> {
    semantics: &'h S,
    histories: &'h mut Histories<S>,
    steps: Vec<TraceStep>,
    /// Broadcast so far, by message number.
    messages: Vec<DeltaId>,
    states: Vec<StateId>,
}

impl<'h, S: Semantics> TraceWriter<'h, S> {
    /// The trace of a counterexample.
    pub(crate) fn write(
        semantics: &'h S,
        histories: &'h mut Histories<S>,
        found: &Counterexample<Histories<S>>,
    ) -> Trace {
        let replicas = histories.bound().replicas;
        let states = vec![histories.initial(); replicas];
        let mut writer = Self { semantics, histories, steps: Vec::new(), messages: Vec::new(), states };
        for (_, choice) in &found.events {
            writer.replay(choice);
        }
        let mut names: Vec<String> = (0..replicas).map(replica_name).collect();
        let breach = match &found.fault {
            FoundFault::Step(fault) => {
                writer.receive_until(fault.replica, fault.before);
                let states = writer.mutate_fault(fault);
                trace_breach(&fault.breach, states)
            }
            FoundFault::Delivered(fault) => {
                let mut orders = vec![(observer_name(0), fault.delivered.clone())];
                orders.extend(fault.other_order.clone().map(|order| (observer_name(1), order)));
                names.extend(orders.iter().map(|(name, _)| name.clone()));
                let states = orders.into_iter().map(|(name, order)| writer.observe(name, &order)).collect();
                trace_breach(&fault.breach, states)
            }
        };
        Trace {
            format: "dsr-trace".into(),
            version: TRACE_VERSION,
            semantics: semantics.name(),
            layer: "L1".into(),
            replicas: names,
            initial: semantics.state_json(&semantics.initial()),
            steps: writer.steps,
            breach,
        }
    }

    fn replay(&mut self, choice: &Choice) {
        self.receive_until(choice.replica, choice.before);
        let before = self.histories.tables().state(choice.before);
        let delta = self.histories.tables().delta(choice.delta);
        let mutation = self.semantics.mutation_of(&before, choice.replica, &delta);
        let after = self.histories.author_state(choice.before, choice.replica, choice.delta);
        self.push_mutation(choice.replica, mutation.as_ref(), choice.delta, choice.before, after);
    }

    fn push_mutation(
        &mut self,
        replica: usize,
        mutation: Option<&S::Mutation>,
        delta: DeltaId,
        before: StateId,
        after: StateId,
    ) {
        self.messages.push(delta);
        let tables = self.histories.tables();
        let act = Act::Mutate {
            message: format!("m{}", self.messages.len()),
            text: mutation.map(ToString::to_string).unwrap_or_default(),
            mutation: mutation.map(|mutation| self.semantics.mutation_json(mutation)).unwrap_or_default(),
            delta: self.semantics.delta_json(&tables.delta(delta)),
        };
        let changes = self.semantics.changes(&tables.state(before), &tables.state(after));
        self.steps.push(TraceStep { replica: replica_name(replica), act, changes });
        self.states[replica] = after;
    }

    fn mutate_fault(&mut self, fault: &crate::tables::StepFault<S>) -> Vec<(String, Value)> {
        let delta = self.histories.intern_delta(fault.step.delta.clone());
        let after = self.histories.intern(fault.step.after.clone());
        self.push_mutation(fault.replica, Some(&fault.mutation), delta, fault.before, after);
        vec![(replica_name(fault.replica), self.semantics.state_json(&fault.step.after))]
    }

    /// Delivers the fewest messages that bring a replica to the state in which it mutated.
    fn receive_until(&mut self, replica: usize, target: StateId) {
        let start = self.states[replica];
        let mut orders: Vec<usize> = (0..1 << self.messages.len()).collect();
        orders.sort_by_key(|mask| mask.count_ones());
        for mask in orders {
            let order: Vec<usize> =
                (0..self.messages.len()).filter(|message| mask >> message & 1 == 1).collect();
            let end = order
                .iter()
                .fold(start, |state, &message| self.histories.join(state, self.messages[message]));
            if end == target {
                for message in order {
                    self.deliver(replica_name(replica), replica, message);
                }
                return;
            }
        }
    }

    fn deliver(&mut self, name: String, replica: usize, message: usize) {
        let before = self.states[replica];
        let after = self.histories.join(before, self.messages[message]);
        let tables = self.histories.tables();
        let changes = self.semantics.changes(&tables.state(before), &tables.state(after));
        self.steps.push(TraceStep {
            replica: name,
            act: Act::Deliver { message: format!("m{}", message + 1) },
            changes,
        });
        self.states[replica] = after;
    }

    /// A replica that only receives, in the given order.
    fn observe(&mut self, name: String, order: &[DeltaId]) -> (String, Value) {
        let observer = self.states.len();
        self.states.push(self.histories.initial());
        for delta in order {
            if let Some(message) = self.messages.iter().position(|known| known == delta) {
                self.deliver(name.clone(), observer, message);
            }
        }
        let state = self.histories.tables().state(self.states[observer]);
        (name, self.semantics.state_json(&state))
    }
}

fn trace_breach(breach: &Breach, states: Vec<(String, Value)>) -> TraceBreach {
    TraceBreach { clause: breach.clause.into(), detail: breach.detail.clone(), states }
}

fn replica_name(replica: usize) -> String {
    format!("r{}", replica + 1)
}

fn observer_name(observer: usize) -> String {
    format!("observer {}", observer + 1)
}

impl From<Trace> for RunTrace {
    fn from(trace: Trace) -> Self {
        let json = serde_json::to_value(&trace).unwrap_or_default();
        let TraceBreach { clause, detail, .. } = trace.breach.clone();
        Self { clause, detail, steps: trace.steps.len(), text: trace.to_string(), json }
    }
}

/// Prints a trace for people: a line per step, what changed below it, the broken clause last.
impl std::fmt::Display for Trace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (at, step) in self.steps.iter().enumerate() {
            write!(f, "{:>3}  {:<10} ", at + 1, step.replica)?;
            match &step.act {
                Act::Mutate { message, text, .. } => writeln!(f, "{text}  → {message}")?,
                Act::Deliver { message } => writeln!(f, "receives {message}")?,
                Act::Restart => writeln!(f, "restarts under a fresh incarnation")?,
                Act::Resynchronise { from, .. } => writeln!(f, "resynchronises with {from}")?,
            }
            for change in &step.changes {
                writeln!(f, "                {change}")?;
            }
        }
        write!(f, "  ✗  [{}] {}", self.breach.clause, self.breach.detail)
    }
}
