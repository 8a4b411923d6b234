//! The second engine on schedules: a plain breadth-first search that keeps whole states. Its counts must
//! agree with stateright's, and its counterexamples are shortest. `[spec: CHECK-9]`

use super::space::{ScheduleFault, Schedules};
use super::state::{Event, Schedule};
use crate::semantics::Semantics;
use rustc_hash::FxHashSet;

/// Everything reached.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Reached {
    /// Different schedules, the initial one first.
    pub schedules: Vec<Schedule>,
    /// Successors generated, repeated ones included.
    pub generated: u64,
}

/// Every schedule within the bound.
pub fn explore<S: Semantics>(schedules: &mut Schedules<S>) -> Result<Reached, ScheduleFault> {
    let start = schedules.start();
    let mut seen = FxHashSet::from_iter([start]);
    let mut reached = Reached { schedules: vec![start], generated: 0 };
    let mut successors = Vec::new();
    let mut at = 0;
    while let Some(&schedule) = reached.schedules.get(at) {
        successors.clear();
        schedules.successors(&schedule, &mut successors)?;
        reached.generated += successors.len() as u64;
        reached.schedules.extend(successors.iter().map(|&(_, next)| next).filter(|next| seen.insert(*next)));
        at += 1;
    }
    Ok(reached)
}

/// A shortest way to a fault.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Counterexample {
    /// What happens, each with the moment before it.
    pub events: Vec<(Schedule, Event)>,
    /// The moment at which the clause breaks, unless an event broke it.
    pub end: Schedule,
    /// What breaks.
    pub fault: ScheduleFault,
}

/// The first fault in breadth-first order, or `None` among the first `states_max` schedules.
pub fn find_fault<S: Semantics>(schedules: &mut Schedules<S>, states_max: usize) -> Option<Counterexample> {
    let start = schedules.start();
    let mut seen = FxHashSet::from_iter([start]);
    let mut nodes: Vec<(Schedule, Option<(usize, Event)>)> = vec![(start, None)];
    let mut successors = Vec::new();
    let mut at = 0;
    while at < nodes.len().min(states_max) {
        let schedule = nodes[at].0;
        successors.clear();
        let judged = schedules.judge(&schedule).map_err(|breach| ScheduleFault { breach, event: None });
        if let Err(fault) = judged.and_then(|()| schedules.successors(&schedule, &mut successors)) {
            let mut events = path(&nodes, at);
            events.extend(fault.event.map(|event| (schedule, event)));
            return Some(Counterexample { events, end: schedule, fault });
        }
        for &(event, next) in &successors {
            if seen.insert(next) {
                nodes.push((next, Some((at, event))));
            }
        }
        at += 1;
    }
    None
}

fn path(nodes: &[(Schedule, Option<(usize, Event)>)], mut at: usize) -> Vec<(Schedule, Event)> {
    let mut events = Vec::new();
    while let Some((before, event)) = nodes[at].1 {
        events.push((nodes[before].0, event));
        at = before;
    }
    events.reverse();
    events
}
