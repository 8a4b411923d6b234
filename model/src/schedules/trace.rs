//! Schedules as traces.

use super::space::Schedules;
use super::state::{Event, Message, Schedule};
use crate::checked::INCARNATION;
use crate::search::Counterexample;
use crate::semantics::Semantics;
use crate::tables::{DeltaId, StateId};
use crate::trace::{Act, TRACE_VERSION, Trace, TraceBreach, TraceStep};

/// The trace of a counterexample. What is lost does not appear in it: it never arrives.
pub(super) fn write<S: Semantics>(
    schedules: &mut Schedules<S>,
    found: &Counterexample<Schedules<S>>,
) -> Trace {
    let mut broadcasts = Vec::new();
    let mut senders = Vec::new();
    let mut steps = Vec::new();
    // An event that cannot be had without breaking a clause comes last.
    let last = found.fault.event.map(|event| (found.end, event));
    for (before, event) in found.events.iter().chain(&last) {
        if let Event::Mutate { replica, .. } = event {
            broadcasts.push((*replica, before.made(*replica)));
        }
        if let Event::Resynchronise { from, .. } = event {
            senders.push(*from);
        }
        steps.extend(step(schedules, before, event, &broadcasts, senders.last().copied()));
    }
    let everybody = schedules.bound.everybody();
    let semantics = schedules.semantics.clone();
    let json = |state: StateId| semantics.state_json(&schedules.tables.state(state));
    let states = (0..everybody).map(|replica| (name(replica), json(found.end.states[replica]))).collect();
    let breach = &found.fault.breach;
    Trace {
        format: "dsr-trace".into(),
        version: TRACE_VERSION,
        semantics: semantics.name(),
        layer: "L2".into(),
        replicas: (0..everybody).map(name).collect(),
        initial: semantics.state_json(&semantics.initial()),
        steps,
        breach: TraceBreach { clause: breach.clause.into(), detail: breach.detail.clone(), states },
    }
}

fn step<S: Semantics>(
    schedules: &mut Schedules<S>,
    before: &Schedule,
    event: &Event,
    broadcasts: &[(usize, usize)],
    answered_by: Option<usize>,
) -> Option<TraceStep> {
    let message_name = |author: usize, made: usize| {
        let at = broadcasts.iter().position(|broadcast| *broadcast == (author, made));
        format!("m{}", at.map_or(0, |at| at + 1))
    };
    let (replica, act, after) = match *event {
        Event::Mutate { replica, delta } => {
            let act =
                mutate_act(schedules, before, replica, delta, message_name(replica, before.made(replica)));
            let identity = replica + INCARNATION * usize::from(before.incarnations[replica]);
            let after = schedules.author_state(before.states[replica], identity, delta);
            (replica, act, after)
        }
        Event::Deliver { replica, message, .. } => {
            let delta = before.content(message);
            let act = match message {
                Message::Delta { author, made } => Act::Deliver { message: message_name(author, made) },
                Message::Answer(_) => {
                    let delta = schedules.semantics.delta_json(&schedules.tables.delta(delta));
                    Act::Resynchronise { from: answered_by.map(name).unwrap_or_default(), delta }
                }
            };
            (replica, act, received(schedules, before, replica, delta))
        }
        Event::Restart { replica, keeps } => {
            let after = if keeps { before.states[replica] } else { schedules.initial() };
            (replica, Act::Restart, after)
        }
        Event::Lose { .. } | Event::Resynchronise { .. } => return None,
    };
    let state = |id: StateId| schedules.tables.state(id);
    let changes = schedules.semantics.changes(&state(before.states[replica]), &state(after));
    Some(TraceStep { replica: name(replica), act, changes })
}

fn mutate_act<S: Semantics>(
    schedules: &Schedules<S>,
    before: &Schedule,
    replica: usize,
    delta: DeltaId,
    message: String,
) -> Act {
    let identity = replica + INCARNATION * usize::from(before.incarnations[replica]);
    let state = schedules.tables.state(before.states[replica]);
    let mutation = schedules.semantics.mutation_of(&state, identity, &schedules.tables.delta(delta));
    Act::Mutate {
        message,
        text: mutation.as_ref().map(ToString::to_string).unwrap_or_default(),
        mutation: mutation.map(|mutation| schedules.semantics.mutation_json(&mutation)).unwrap_or_default(),
        delta: schedules.semantics.delta_json(&schedules.tables.delta(delta)),
    }
}

fn received<S: Semantics>(
    schedules: &mut Schedules<S>,
    before: &Schedule,
    replica: usize,
    delta: DeltaId,
) -> StateId {
    schedules.tables.join(&schedules.semantics, before.states[replica], delta)
}

fn name(replica: usize) -> String {
    format!("r{}", replica + 1)
}
