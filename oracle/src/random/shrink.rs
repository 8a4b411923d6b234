//! The shortest history that still disagrees. `[spec: ORACLE-5]`

use super::counts::Counts;
use super::world::{Event, History, carry_out};
use crate::compare::{Disagreement, ask_now};
use crate::program::{Program, Start, Trouble};
use dsr_core::{Dictionary, Mutation, State, check_well_formed};

/// The most attempts.
const ATTEMPTS_MAX: usize = 5000;

/// A history that nothing can be left out of, and what both say.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Shrunk {
    /// The history.
    pub history: History,
    /// What both say, of the last of its facts; none if the program did not say it again.
    pub disagreement: Option<Disagreement>,
    /// How many events it had.
    pub events_before: usize,
}

/// Leaves out of a history, again and again, whatever it disagrees without.
pub fn shrink(start: &Start, history: &History) -> Result<Shrunk, Trouble> {
    let mut program = start.start()?;
    let events_before = history.events.len();
    let mut shrunk = Shrunk { history: history.clone(), disagreement: None, events_before };
    let mut attempts = 0;
    let Some(first) = disagreement(&mut program, history)? else { return Ok(shrunk) };
    shrunk.disagreement = Some(first);
    let mut smaller = true;
    while smaller && attempts < ATTEMPTS_MAX {
        smaller = false;
        // From what is left after each success it goes on in the same order, so that all is tried once a round.
        let mut at = 0;
        while let Some(candidate) = candidate(&shrunk.history, at) {
            attempts += 1;
            match disagreement(&mut program, &candidate)? {
                Some(found) if attempts < ATTEMPTS_MAX => {
                    (shrunk.history, shrunk.disagreement, smaller) = (candidate, Some(found), true);
                }
                _ => at += 1,
            }
        }
    }
    Ok(shrunk)
}

fn disagreement(program: &mut Program, history: &History) -> Result<Option<Disagreement>, Trouble> {
    ask_now(program, &carry_out(history, &mut Counts::default()))
}

/// The history with something less, the `at`-th way.
fn candidate(history: &History, mut at: usize) -> Option<History> {
    let count = history.events.len();
    // All from an event on; each event; then within events.
    if at < count {
        let mut shorter = history.clone();
        shorter.events.truncate(at);
        return Some(shorter);
    }
    at -= count;
    if at < count {
        let mut shorter = history.clone();
        shorter.events.remove(count - 1 - at);
        return Some(shorter);
    }
    at -= count;
    for (place, (_, event)) in history.events.iter().enumerate() {
        let simpler = simpler(event);
        if let Some(event) = simpler.get(at) {
            let mut changed = history.clone();
            changed.events[place].1 = event.clone();
            return Some(changed);
        }
        at -= simpler.len();
    }
    for (place, (_, dictionary)) in history.replicas.iter().enumerate() {
        if *dictionary == Dictionary::open() {
            continue;
        }
        if at == 0 {
            let mut changed = history.clone();
            changed.replicas[place].1 = Dictionary::open();
            return Some(changed);
        }
        at -= 1;
    }
    None
}

/// The event with something less.
fn simpler(event: &Event) -> Vec<Event> {
    match event {
        Event::Mutate { replica, timestamp_ns, mutations } => {
            let with =
                |mutations| Event::Mutate { replica: *replica, timestamp_ns: *timestamp_ns, mutations };
            let fewer = (0..mutations.len()).filter(|_| mutations.len() > 1).map(|out| {
                let left = mutations.iter().enumerate().filter(|(at, _)| *at != out);
                left.map(|(_, mutation)| mutation.clone()).collect()
            });
            let plainer = mutations.iter().enumerate().flat_map(|(at, mutation)| {
                plainer(mutation).into_iter().map(move |plain| {
                    let mut changed = mutations.clone();
                    changed[at] = plain;
                    changed
                })
            });
            fewer.chain(plainer).map(with).collect()
        }
        Event::Group { deltas } if deltas.len() > 2 => (0..deltas.len())
            .map(|out| {
                let left = deltas.iter().enumerate().filter(|(at, _)| *at != out);
                Event::Group { deltas: left.map(|(_, delta)| *delta).collect() }
            })
            .collect(),
        Event::Outside { state } => {
            let without = state.records().map(|(out, _)| {
                let left = state.records().filter(|(dot, _)| *dot != out);
                let left = left.map(|(dot, record)| (dot, record.clone())).collect::<Vec<_>>();
                // Neither held nor dead: as if it had never been.
                let mut context = dsr_core::CausalContext::new();
                for run in state.context().runs() {
                    let parts = if run.contains(out) {
                        [(run.first, out.sequence - 1), (out.sequence + 1, run.last)]
                    } else {
                        [(run.first, run.last), (1, 0)]
                    };
                    for (first, last) in parts.into_iter().filter(|(first, last)| first <= last) {
                        context.insert_run(dsr_core::Run { first, last, ..run });
                    }
                }
                State::assemble(left, context)
            });
            let runs =
                state.context().runs().filter(|run| !state.records().any(|(dot, _)| run.contains(dot)));
            let less_seen = runs.map(|out| {
                let mut context = dsr_core::CausalContext::new();
                state.context().runs().filter(|run| *run != out).for_each(|run| context.insert_run(run));
                let records = state.records().map(|(dot, record)| (dot, record.clone()));
                State::assemble(records, context)
            });
            let states = without.chain(less_seen).filter(|state| check_well_formed(state).is_ok());
            states.map(|state| Event::Outside { state }).collect()
        }
        _ => Vec::new(),
    }
}

/// A mutation with one attribute less, or without an external id.
fn plainer(mutation: &Mutation) -> Vec<Mutation> {
    let mut all = Vec::new();
    match mutation {
        Mutation::AddVertex { vertex, link } => {
            for name in vertex.attributes.keys() {
                let mut vertex = vertex.clone();
                vertex.attributes.remove(name);
                all.push(Mutation::AddVertex { vertex, link: link.clone() });
            }
            for name in link.attributes.keys() {
                let mut link = link.clone();
                link.attributes.remove(name);
                all.push(Mutation::AddVertex { vertex: vertex.clone(), link });
            }
            if vertex.external_id.is_some() {
                let vertex = dsr_core::NewVertex { external_id: None, ..vertex.clone() };
                all.push(Mutation::AddVertex { vertex, link: link.clone() });
            }
        }
        Mutation::AddEdge { key, attributes } => {
            for name in attributes.keys() {
                let mut attributes = attributes.clone();
                attributes.remove(name);
                all.push(Mutation::AddEdge { key: key.clone(), attributes });
            }
        }
        Mutation::MoveEdge { from, to, attributes } => {
            for name in attributes.keys() {
                let mut attributes = attributes.clone();
                attributes.remove(name);
                all.push(Mutation::MoveEdge { from: from.clone(), to: to.clone(), attributes });
            }
        }
        Mutation::UpdateAttributes { target, updates } if updates.len() > 1 => {
            for name in updates.keys() {
                let mut updates = updates.clone();
                updates.remove(name);
                all.push(Mutation::UpdateAttributes { target: *target, updates });
            }
        }
        _ => {}
    }
    all
}
