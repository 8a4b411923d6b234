//! Histories as traces. `[spec: TRACE-4]`

use super::{Choice, FoundFault, Histories};
use crate::course::Event;
use crate::search::Counterexample;
use crate::semantics::{Breach, Clause, Semantics};
use crate::tables::{DeltaId, StateId};
use crate::trace::{CannotHappen, Finding, Recorder, Trace};

/// Makes the events of a counterexample out of the choices of the search.
struct Writer<'h, S: Semantics> {
    semantics: &'h S,
    histories: &'h mut Histories<S>,
    recorder: Recorder<'h, S>,
    /// Broadcast so far.
    messages: Vec<DeltaId>,
    states: Vec<StateId>,
}

/// The trace of a counterexample: before each mutation the fewest deliveries that lead to the state in which
/// it was made, and in the end, if need be, observers.
pub(super) fn write<'h, S: Semantics>(
    semantics: &'h S,
    histories: &'h mut Histories<S>,
    clauses: &[Clause],
    found: &Counterexample<Histories<S>>,
) -> Result<Trace, CannotHappen> {
    let bound = histories.bound();
    let orders = match &found.fault {
        FoundFault::Step(_) => Vec::new(),
        FoundFault::Delivered(fault) => {
            let others = fault.other_order.iter().chain(&fault.answered);
            [&fault.delivered].into_iter().chain(others).cloned().collect()
        }
    };
    let observers = (1..=orders.len()).map(|at| format!("observer {at}"));
    let names = (1..=bound.replicas).map(|at| format!("r{at}")).chain(observers);
    let states = vec![histories.initial(); bound.replicas + orders.len()];
    let recorder = Recorder::new(semantics, names);
    let mut writer = Writer { semantics, histories, recorder, messages: Vec::new(), states };
    for (_, choice) in &found.events {
        writer.choose(choice)?;
    }
    let at = match &found.fault {
        FoundFault::Step(fault) => {
            writer.receive_until(fault.replica, fault.before)?;
            writer.mutate(fault.replica, &fault.mutation)?;
            vec![fault.replica]
        }
        FoundFault::Delivered(fault) => {
            let first = bound.replicas;
            for (observer, order) in (first..).zip(&orders) {
                writer.observe(observer, order)?;
            }
            if fault.answered.is_some() {
                writer.answer(first, first + 1)?;
            }
            // Of a resynchronisation, who was answered shows it.
            let shows = if fault.answered.is_some() { first + 1 } else { first };
            (shows..first + orders.len()).collect()
        }
    };
    let shown_by = writer.recorder.scribe().names(at);
    let breach: &Breach = found.fault.breach();
    let finding = Finding::broken(clauses, breach, shown_by);
    let title = format!("{} is broken: {}", finding.clause, finding.what);
    Ok(writer.recorder.finish(
        title,
        "L1",
        format!("{} replicas × {} mutations", bound.replicas, bound.mutations),
        finding,
    ))
}

impl<S: Semantics> Writer<'_, S> {
    fn choose(&mut self, choice: &Choice) -> Result<(), CannotHappen> {
        let Choice { replica, before, delta, .. } = *choice;
        self.receive_until(replica, before)?;
        let tables = self.histories.tables();
        let (state, content) = (tables.state(before), tables.delta(delta));
        let mutation = self.semantics.mutation_of(&state, replica, &content);
        let unknown = || CannotHappen::NoMutation {
            replica: format!("r{}", replica + 1),
            mutation: format!("{content:?}"),
        };
        self.mutate(replica, &mutation.ok_or_else(unknown)?)?;
        self.messages.push(delta);
        self.states[replica] = self.histories.author_state(before, replica, delta);
        Ok(())
    }

    fn mutate(&mut self, replica: usize, mutation: &S::Mutation) -> Result<(), CannotHappen> {
        self.recorder.record(&Event::Mutate { replica, mutations: vec![mutation.clone()] })
    }

    /// Delivers the fewest messages that bring a replica to the state in which it mutated.
    fn receive_until(&mut self, replica: usize, target: StateId) -> Result<(), CannotHappen> {
        let mut sets: Vec<usize> = (0..1 << self.messages.len()).collect();
        sets.sort_by_key(|set| set.count_ones());
        for set in sets {
            let order = (0..self.messages.len()).filter(|message| set >> message & 1 == 1);
            let join = |state, message| self.histories.join(state, self.messages[message]);
            if order.clone().fold(self.states[replica], join) == target {
                return order.into_iter().try_for_each(|message| self.deliver(replica, message));
            }
        }
        Ok(())
    }

    fn deliver(&mut self, replica: usize, message: usize) -> Result<(), CannotHappen> {
        self.states[replica] = self.histories.join(self.states[replica], self.messages[message]);
        self.recorder.record(&Event::Deliver { replica, message })
    }

    /// A replica answers another's digest.
    fn answer(&mut self, replica: usize, to: usize) -> Result<(), CannotHappen> {
        let message = self.recorder.runner().messages().len();
        self.recorder.record(&Event::Answer { replica, to })?;
        self.recorder.record(&Event::Deliver { replica: to, message })
    }

    /// A replica that only receives, in the given order.
    fn observe(&mut self, observer: usize, order: &[DeltaId]) -> Result<(), CannotHappen> {
        for delta in order {
            if let Some(message) = self.messages.iter().position(|known| known == delta) {
                self.deliver(observer, message)?;
            }
        }
        Ok(())
    }
}
