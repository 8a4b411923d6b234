//! Schedules of the published semantics as traces. `[spec: TRACE-1]`

use super::Row;
use super::run::bound;
use crate::published::{Envelope, Happening, Message, Moment, Network, Replica, Setup};
use crate::search::Space;
use crate::semantics::Breach;
use crate::trace::{Act, Finding, FindingKind, Heading, Scribe, Sent, Trace, TraceReplica, TraceStep};
use serde_json::json;
use std::sync::Arc;

/// The semantics' name in traces.
pub const SEMANTICS: &str = "published";

/// Whether a trace is of a row of the gallery.
pub fn is_published(trace: &Trace) -> bool {
    trace.semantics == SEMANTICS && trace.setup.get("row").is_some()
}

/// Runs a row's setup and has it written down.
#[derive(Debug)]
pub struct PublishedRun {
    setup: Setup,
    network: Network,
    at: Moment,
    scribe: Scribe,
    /// The names of messages, by sender.
    names: Vec<(usize, Arc<Message>, String)>,
}

impl PublishedRun {
    /// Before anything has happened.
    pub fn new(setup: &Setup) -> Self {
        let network = Network::new(setup.clone());
        let at = network.start();
        let replicas = network.at(at).into_iter().enumerate().map(|(index, replica)| TraceReplica {
            name: setup.name(index),
            index,
            starts: replica.picture(),
            state: None,
        });
        let scribe = Scribe::new(replicas.collect());
        Self { setup: setup.clone(), network, at, scribe, names: Vec::new() }
    }

    /// What can happen next, each with its step.
    pub fn successors(&mut self) -> Vec<(Happening, TraceStep)> {
        let mut successors = Vec::new();
        // What breaks the property is judged at the end, not on the way.
        let _ = self.network.successors(&self.at, &mut successors);
        let happenings: Vec<Happening> =
            successors.iter().map(|(event, _)| self.network.happening(event)).collect();
        let mut steps = Vec::new();
        for happening in happenings {
            let mut fork = Fork { names: self.names.clone(), scribe: self.scribe.clone() };
            if let Some(step) = fork.take(&self.setup, &mut self.network, self.at, &happening) {
                steps.push((happening, step.1));
            }
        }
        steps
    }

    /// Makes something happen; whether it could.
    pub fn happen(&mut self, happening: &Happening) -> bool {
        let mut fork = Fork { names: std::mem::take(&mut self.names), scribe: self.scribe.clone() };
        let taken = fork.take(&self.setup, &mut self.network, self.at, happening);
        self.names = fork.names;
        let Some((at, _)) = taken else { return false };
        (self.at, self.scribe) = (at, fork.scribe);
        true
    }

    /// A replica by position.
    pub fn replica(&self, replica: usize) -> Arc<Replica> {
        self.network.at(self.at).swap_remove(replica)
    }

    /// What was sent so far, in the order of its names.
    pub fn messages(&self) -> impl Iterator<Item = &Message> {
        self.names.iter().map(|(_, message, _)| &**message)
    }

    /// What was written down so far.
    pub const fn scribe(&self) -> &Scribe {
        &self.scribe
    }

    /// What is broken now.
    pub fn judge(&mut self) -> Result<(), Breach> {
        self.network.judge(&self.at)
    }

    /// The trace of what happened, to this breach.
    pub fn finish(self, row: &Row, breach: &Breach) -> Trace {
        let finding = Finding {
            kind: FindingKind::Broken,
            clause: breach.clause.into(),
            what: self.setup.property.sentence().into(),
            detail: breach.detail.clone(),
            replicas: self.scribe.names(0..self.setup.replicas()),
        };
        let heading = Heading {
            title: format!("{}. {}", row.row, row.title),
            semantics: SEMANTICS.into(),
            setup: json!({ "row": row.row }),
            layer: "gallery".into(),
            bound: bound(&self.setup),
        };
        self.scribe.finish(heading, finding)
    }
}

impl Setup {
    /// What a replica is called in traces.
    pub fn name(&self, replica: usize) -> String {
        let Some(agent) = self.agents.get(replica) else { return format!("replica {}", replica + 1) };
        let is_taken = self.agents[..replica].contains(agent);
        if is_taken { format!("another agent {agent}") } else { format!("agent {agent}") }
    }
}

/// What a step adds, before it is taken for good.
struct Fork {
    names: Vec<(usize, Arc<Message>, String)>,
    scribe: Scribe,
}

impl Fork {
    fn take(
        &mut self,
        setup: &Setup,
        network: &mut Network,
        at: Moment,
        happening: &Happening,
    ) -> Option<(Moment, TraceStep)> {
        let before = network.letters(at);
        let after = network.step(at, happening)?;
        let sent = new_copies(&before, network.letters(after));
        let sends = self.name(&sent);
        let joiner = setup.powers.joiner.as_ref();
        let joins = joiner.map_or(0, |joiner| joiner.replica);
        let (replica, does) = match happening {
            Happening::Call(replica, call) => {
                let (_, operation) = setup.plays.get(*replica)?.calls.get(*call)?;
                let (text, mutations) = (operation.to_string(), vec![operation.json()]);
                (*replica, Act::Mutate { text, mutations, sends })
            }
            Happening::Deliver(copy, again) => {
                (copy.to, Act::Deliver { message: self.known(copy)?, again: *again })
            }
            Happening::Lose(copy) => (copy.to, Act::Lose { message: self.known(copy)? }),
            Happening::Encode => (joiner?.server, Act::Answer { to: setup.name(joins), sends }),
            Happening::Find(other) => (joins, Act::Happen { text: format!("finds {}", setup.name(*other)) }),
            Happening::Refuse => {
                (joins, Act::Happen { text: "asks again, and is refused as a duplicate of itself".into() })
            }
            Happening::Tell => (joins, Act::Happen { text: "is told that it has joined".into() }),
            Happening::Restart(replica) => (*replica, Act::Restart { keeps: false }),
        };
        let holder = network.at(after).into_iter().nth(replica)?;
        self.scribe.note(replica, does, holder.picture(), &holder.json());
        let step = self.scribe.steps().last()?.clone();
        Some((after, step))
    }

    /// Names what is new: copies for several receivers are one message.
    fn name(&mut self, sent: &[Envelope]) -> Vec<Sent> {
        let mut sends: Vec<Sent> = Vec::new();
        let mut new: Vec<(usize, Arc<Message>)> = Vec::new();
        for copy in sent {
            if !new.iter().any(|(from, message)| (*from, message) == (copy.from, &copy.message)) {
                new.push((copy.from, copy.message.clone()));
            }
        }
        new.sort_by_key(|(from, message)| (*from, message.topic()));
        for (from, message) in new {
            let sent = self.scribe.send(message.to_string(), message.json());
            self.names.push((from, message, sent.message.clone()));
            sends.push(sent);
        }
        sends
    }

    /// The name of a copy: the latest if the same was sent before.
    fn known(&self, copy: &Envelope) -> Option<String> {
        let mut latest = self.names.iter().rev();
        let known = latest.find(|(from, message, _)| (*from, message) == (copy.from, &copy.message));
        known.map(|(_, _, name)| name.clone())
    }
}

/// Copies that were not under way before.
pub(super) fn new_copies(before: &[Envelope], after: Vec<Envelope>) -> Vec<Envelope> {
    after.into_iter().filter(|copy| !before.contains(copy)).collect()
}
