//! Any semantics: its recorder writes the same steps again.

use super::ends::Ends;
use super::{Difference, ReplayError, Replayed};
use crate::course::Event;
use crate::semantics::Semantics;
use crate::trace::{Act, CannotHappen, Part, Recorder, Trace, TraceStep};
use serde_json::Value;
use std::collections::BTreeMap;

/// Runs a trace again by this semantics, whatever the trace calls it. `[spec: TRACE-6]`
pub fn replay_with<S: Semantics>(semantics: &S, trace: &Trace) -> Result<Replayed, ReplayError> {
    let mut replay = Replay::start(semantics, trace)?;
    while replay.step()? {}
    let judged = replay.ends.judge(&replay.recorder, &trace.finding)?;
    Ok(Replayed { steps: trace.steps.len(), judged })
}

/// A trace on its way.
#[derive(Debug)]
pub(crate) struct Replay<'s, S: Semantics> {
    semantics: &'s S,
    trace: &'s Trace,
    pub(crate) recorder: Recorder<'s, S>,
    ends: Ends<'s, S>,
    /// The numbers of messages by name.
    numbers: BTreeMap<&'s str, usize>,
    at: usize,
}

impl<'s, S: Semantics> Replay<'s, S> {
    /// Before the first step; every replica starts as it is written.
    pub(crate) fn start(semantics: &'s S, trace: &'s Trace) -> Result<Self, ReplayError> {
        trace.check_names()?;
        let mut parts = Vec::new();
        for replica in &trace.replicas {
            let state = replica.state.as_ref().map(|json| {
                let unread = || ReplayError::Setup {
                    semantics: trace.semantics.clone(),
                    why: format!("the state of {} is none of its states", replica.name),
                };
                semantics.state_from_json(json).ok_or_else(unread)
            });
            parts.push(Part { name: replica.name.clone(), index: replica.index, state: state.transpose()? });
        }
        let recorder = Recorder::starting(semantics, parts);
        for (written, starts) in trace.replicas.iter().zip(recorder.scribe().replicas()) {
            if let Some(difference) = Difference::between(written, starts) {
                return Err(ReplayError::Start { replica: written.name.clone(), difference });
            }
        }
        let sent = trace.steps.iter().flat_map(|step| step.does.sends());
        let numbers = sent.enumerate().map(|(number, sent)| (&*sent.message, number)).collect();
        let ends = Ends::new(semantics, trace.replicas.len());
        Ok(Self { semantics, trace, recorder, ends, numbers, at: 0 })
    }

    /// Runs the next step and compares it; whether there was one.
    pub(crate) fn step(&mut self) -> Result<bool, ReplayError> {
        let Some(written) = self.trace.steps.get(self.at) else { return Ok(false) };
        self.at += 1;
        let step = self.at;
        self.run(written).map_err(|why| ReplayError::Impossible { step, why })?;
        let found = self.recorder.scribe().steps().last();
        match found.and_then(|found| Difference::between(written, found)) {
            Some(difference) => Err(ReplayError::Step { step, replica: written.replica.clone(), difference }),
            None => Ok(true),
        }
    }

    fn run(&mut self, written: &TraceStep) -> Result<(), CannotHappen> {
        let replica = self.position(&written.replica);
        let event = match &written.does {
            Act::Happen { text } => {
                self.recorder.happen(replica, text.clone());
                return Ok(());
            }
            Act::Mutate { mutations, .. } => {
                Event::Mutate { replica, mutations: self.mutations(replica, mutations)? }
            }
            Act::Deliver { message, .. } => Event::Deliver { replica, message: self.number(message) },
            Act::Lose { message } => Event::Lose { replica, message: self.number(message) },
            Act::Restart { keeps } => Event::Restart { replica, keeps: *keeps },
            Act::Answer { to, .. } => Event::Answer { replica, to: self.position(to) },
        };
        let identity = self.recorder.runner().identity(replica).ok();
        let stepped = self.recorder.step(&event)?;
        self.ends.note(&event, identity, &stepped);
        Ok(())
    }

    /// Names were checked: what is unknown is nobody.
    fn position(&self, name: &str) -> usize {
        self.trace.replicas.iter().position(|replica| replica.name == name).unwrap_or(usize::MAX)
    }

    fn number(&self, message: &str) -> usize {
        self.numbers.get(message).copied().unwrap_or(usize::MAX)
    }

    /// Each mutation is read in the state that the ones before it lead to.
    fn mutations(&self, replica: usize, written: &[Value]) -> Result<Vec<S::Mutation>, CannotHappen> {
        let identity = self.recorder.runner().identity(replica)?;
        let mut state = self.recorder.states()[replica].clone();
        let mut mutations = Vec::new();
        for json in written {
            let unread = || CannotHappen::NoMutation {
                replica: self.recorder.scribe().name(replica).into(),
                mutation: json.to_string(),
            };
            let mutation = self.semantics.mutation_from_json(&state, identity, json).ok_or_else(unread)?;
            if let Some(step) = self.semantics.mutate(&state, identity, &mutation) {
                state = step.after;
            }
            mutations.push(mutation);
        }
        Ok(mutations)
    }
}
