//! Schedules as traces. `[spec: TRACE-4]`

use super::space::Schedules;
use super::state::{Event, Message, Schedule};
use crate::course;
use crate::search::Counterexample;
use crate::semantics::{Clause, Semantics};
use crate::trace::{CannotHappen, Finding, Recorder, Trace};

/// The trace of a counterexample. Where everything is delivered, or all resynchronise, and still they differ,
/// that is part of it.
pub(super) fn write<S: Semantics>(
    schedules: &mut Schedules<S>,
    clauses: &[Clause],
    found: &Counterexample<Schedules<S>>,
) -> Result<Trace, CannotHappen> {
    let semantics = schedules.semantics.clone();
    let bound = schedules.bound;
    let recorder = Recorder::new(&*semantics, (1..=bound.everybody()).map(|at| format!("r{at}")));
    let mut writer = Writer { schedules, recorder, broadcasts: Vec::new(), answers: Vec::new() };
    // An event that cannot be had without breaking a clause comes last.
    let last = found.fault.event.map(|event| (found.end, event));
    for (before, event) in found.events.iter().chain(&last) {
        let event = writer.event(before, event)?;
        writer.recorder.record(&event)?;
    }
    let at: Vec<usize> = if let Some(event) = &found.fault.event {
        vec![event.replica()]
    } else {
        writer.recorder.come_to_rest()?
    };
    let shown_by = writer.recorder.scribe().names(at);
    let finding = Finding::broken(clauses, &found.fault.breach, shown_by);
    let title = format!("{} is broken: {}", finding.clause, finding.what);
    Ok(writer.recorder.finish(title, "L2", bound.to_string(), finding))
}

struct Writer<'h, S: Semantics> {
    schedules: &'h Schedules<S>,
    recorder: Recorder<'h, S>,
    /// The number of each broadcast, by author and count.
    broadcasts: Vec<(usize, usize, usize)>,
    /// The answers under way: to whom, and their numbers.
    answers: Vec<(usize, usize)>,
}

impl<S: Semantics> Writer<'_, S> {
    fn event(
        &mut self,
        before: &Schedule,
        event: &Event,
    ) -> Result<course::Event<S::Mutation>, CannotHappen> {
        let next = self.recorder.runner().messages().len();
        Ok(match *event {
            Event::Mutate { replica, delta } => {
                self.broadcasts.push((replica, before.made(replica), next));
                let identity = before.identity(replica);
                let tables = self.schedules.tables();
                let (state, delta) = (tables.state(before.states[replica]), tables.delta(delta));
                let mutation = self.schedules.semantics.mutation_of(&state, identity, &delta);
                let unknown = || CannotHappen::NoMutation {
                    replica: format!("r{}", replica + 1),
                    mutation: format!("{delta:?}"),
                };
                course::Event::Mutate { replica, mutations: vec![mutation.ok_or_else(unknown)?] }
            }
            Event::Deliver { replica, message, again } => {
                let number = self.number(before, message, !again);
                course::Event::Deliver { replica, message: number }
            }
            Event::Lose { replica, message } => {
                course::Event::Lose { replica, message: self.number(before, message, true) }
            }
            Event::Restart { replica, keeps } => course::Event::Restart { replica, keeps },
            Event::Resynchronise { replica, from } => {
                self.answers.push((replica, next));
                course::Event::Answer { replica: from, to: replica }
            }
        })
    }

    /// The number of a message; an answer that will not arrive again is forgotten.
    fn number(&mut self, before: &Schedule, message: Message, is_last: bool) -> usize {
        match message {
            Message::Delta { author, made } => {
                let known = self.broadcasts.iter().find(|(who, count, _)| (*who, *count) == (author, made));
                known.map_or(usize::MAX, |(_, _, number)| *number)
            }
            Message::Answer(at) => {
                let (to, delta) = before.answers[at];
                let delta = self.schedules.tables().delta(delta);
                let is_it = |&(receiver, number): &(usize, usize)| {
                    receiver == usize::from(to)
                        && self
                            .recorder
                            .runner()
                            .messages()
                            .get(number)
                            .is_some_and(|sent| sent.deltas[..] == [(*delta).clone()])
                };
                let Some(at) = self.answers.iter().position(is_it) else { return usize::MAX };
                if is_last { self.answers.remove(at).1 } else { self.answers[at].1 }
            }
        }
    }
}
