//! What is broken after the last step of a course.

use super::ReplayError;
use crate::course::{Event, Stepped, judge_mutations};
use crate::semantics::{Breach, Delivery, Semantics};
use crate::trace::{Finding, FindingKind, Recorder};
use std::collections::BTreeSet;

/// The same deltas in another order.
pub const ANOTHER_ORDER: &str = "the same deltas in another order lead to another state";
/// That the same deltas in another order lead elsewhere, and how.
pub fn another_order(how: &str) -> String {
    if how.is_empty() { ANOTHER_ORDER.into() } else { format!("{ANOTHER_ORDER}: {how}") }
}

/// That everything is delivered and the first replica and another, by position, differ, and how.
pub fn all_delivered(other: usize, how: &str) -> String {
    if how.is_empty() {
        return ALL_DELIVERED.into();
    }
    format!("everything is delivered to everybody, and r1 and r{} differ: {how}", other + 1)
}

/// The same delta twice.
pub const TWICE: &str = "a delta delivered twice is not the same as once";
/// A resynchronisation that does not do what it is for.
pub const NOT_THE_JOIN: &str = "resynchronisation does not lead to the join of both";
/// Nothing is under way.
pub const ALL_DELIVERED: &str = "everything is delivered to everybody, and they differ";
/// All have resynchronised.
pub const ALL_RESYNCHRONISED: &str = "all have resynchronised, and they differ";

/// Watches a course, so as to judge its end.
#[derive(Debug)]
pub struct Ends<'s, S: Semantics> {
    semantics: &'s S,
    /// By replica, what it received or sent.
    received: Vec<BTreeSet<usize>>,
    /// What an answer was made from, by message.
    answers: Vec<(usize, S::State)>,
    shown: Vec<Shown>,
}

/// Something broken, and who shows it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Shown {
    /// What is broken.
    pub breach: Breach,
    /// By whom, in order.
    pub by: Vec<usize>,
}

impl<'s, S: Semantics> Ends<'s, S> {
    /// Before the first event.
    pub fn new(semantics: &'s S, replicas: usize) -> Self {
        let received = vec![BTreeSet::new(); replicas];
        Self { semantics, received, answers: Vec::new(), shown: Vec::new() }
    }

    /// An event has happened; `identity` is the index by which its replica mutated.
    pub fn note(&mut self, event: &Event<S::Mutation>, identity: Option<usize>, stepped: &Stepped<S>) {
        let Stepped { replica, before, after, sent, .. } = stepped;
        let mut broken: Vec<Breach> = Vec::new();
        match event {
            Event::Mutate { mutations, .. } => {
                self.received[*replica].extend(sent);
                let judged = identity.map(|by| judge_mutations(self.semantics, by, mutations, stepped));
                broken.extend(judged.and_then(Result::err));
                broken.extend(self.semantics.judge_delivery(before, after).err());
            }
            Event::Deliver { message, .. } => {
                broken.extend(self.semantics.judge_delivery(before, after).err());
                let is_again = !self.received[*replica].insert(*message);
                if is_again && before != after && self.semantics.delivery() == Delivery::Any {
                    broken.push(Breach::new("JOIN-3", TWICE));
                }
                let made_from = self.answers.iter().find(|(answer, _)| answer == message);
                let joined = made_from.and_then(|(_, ours)| self.semantics.join_states(before, ours));
                if joined.is_some_and(|joined| joined != *after) {
                    broken.push(Breach::new("SYNC-3", NOT_THE_JOIN));
                }
            }
            Event::Answer { .. } => self.answers.extend(sent.map(|message| (message, before.clone()))),
            Event::Restart { keeps: false, .. } => self.received[*replica].clear(),
            Event::Restart { .. } | Event::Lose { .. } => {}
        }
        self.shown = broken.into_iter().map(|breach| Shown { breach, by: vec![*replica] }).collect();
    }

    /// Whether what is found is so: `Ok(Err(why))` if that cannot be judged from a course.
    pub fn judge(
        &self,
        recorder: &Recorder<'_, S>,
        finding: &Finding,
    ) -> Result<Result<(), &'static str>, ReplayError> {
        let shown = self.broken(recorder);
        let told = || {
            let names = |by: &[usize]| recorder.scribe().names(by.iter().copied()).join(", ");
            let lines = shown
                .iter()
                .map(|Shown { breach, by }| format!("[{}] {} ({})", breach.clause, breach.detail, names(by)));
            lines.collect::<Vec<_>>().join("; ")
        };
        let differs = |found: String| Err(ReplayError::Finding { expected: finding.to_string(), found });
        match finding.kind {
            FindingKind::Seen | FindingKind::Fails => {
                Ok(Err("properties of a scenario are judged by its exploration"))
            }
            FindingKind::Broken if finding.clause == "CHECK-11" => {
                Ok(Err("CHECK-11 is a clause of the search, not of the replicas"))
            }
            FindingKind::Broken => {
                let same = |shown: &Shown| {
                    shown.breach.clause == finding.clause
                        && shown.breach.detail == finding.detail
                        && recorder.scribe().names(shown.by.iter().copied()) == finding.replicas
                };
                match &shown[..] {
                    [] => differs("nothing is broken".into()),
                    shown if shown.iter().any(same) => Ok(Ok(())),
                    _ => differs(format!("it is {}", told())),
                }
            }
            FindingKind::Holds if !shown.is_empty() => differs(format!("it is {}", told())),
            FindingKind::Holds if differ(recorder) => differs("the replicas differ".into()),
            FindingKind::Holds => Ok(Ok(())),
        }
    }

    /// All that is broken now.
    pub fn broken(&self, recorder: &Recorder<'_, S>) -> Vec<Shown> {
        let states = recorder.states();
        let everybody = || (0..states.len()).collect::<Vec<usize>>();
        let mut shown = self.shown.clone();
        shown.extend(states.iter().enumerate().filter_map(|(replica, state)| {
            Some(Shown { breach: self.semantics.judge(state).err()?, by: vec![replica] })
        }));
        let is_answer = |message: &usize| self.answers.iter().any(|(answer, _)| answer == message);
        let sent: BTreeSet<usize> =
            (0..recorder.runner().messages().len()).filter(|message| !is_answer(message)).collect();
        let has_all = |&replica: &usize| sent.is_subset(&self.received[replica]);
        for left in 0..states.len() {
            let alike = (left + 1..states.len()).filter(|&right| self.received[left] == self.received[right]);
            shown.extend(alike.filter_map(|right| {
                let how = self.semantics.differ(&states[left], &states[right])?;
                Some(Shown { breach: Breach::new("JOIN-3", another_order(&how)), by: vec![left, right] })
            }));
        }
        if everybody().iter().all(has_all) {
            let mut others = 1..states.len();
            let odd =
                others.find_map(|other| Some((other, self.semantics.differ(&states[0], &states[other])?)));
            shown.extend(odd.map(|(other, how)| Shown {
                breach: Breach::new("JOIN-5", all_delivered(other, &how)),
                by: everybody(),
            }));
        }
        if differ(recorder) && self.all_resynchronised(states.len()) {
            shown.push(Shown { breach: Breach::new("SYNC-5", ALL_RESYNCHRONISED), by: everybody() });
        }
        shown
    }

    /// Everybody but the first has received an answer, and the first has received one from each of them.
    fn all_resynchronised(&self, replicas: usize) -> bool {
        let received = |replica: usize| {
            self.answers.iter().filter(|(answer, _)| self.received[replica].contains(answer)).count()
        };
        replicas > 1 && received(0) + 1 >= replicas && (1..replicas).all(|replica| received(replica) > 0)
    }
}

fn differ<S: Semantics>(recorder: &Recorder<'_, S>) -> bool {
    let states = recorder.states();
    states.iter().any(|state| *state != states[0])
}
