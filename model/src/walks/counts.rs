//! What walks did and saw. `[spec: CHECK-13]`

use crate::semantics::Witnesses;

/// What happened in some walks.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Counts {
    /// Walks.
    pub walks: u64,
    /// Events.
    pub events: u64,
    /// Mutations by their kind.
    pub mutations: Vec<u64>,
    /// Messages that carry several mutations.
    pub groups: u64,
    /// First arrivals of a message.
    pub deliveries: u64,
    /// Of them, those before an earlier message of the same sender.
    pub reorderings: u64,
    /// Arrivals after the first.
    pub duplicates: u64,
    /// Messages that will not arrive at somebody.
    pub losses: u64,
    /// Restarts.
    pub restarts: u64,
    /// Answers to digests.
    pub answers: u64,
    /// Replica states judged.
    pub judged: u64,
    /// What the states bore witness of.
    pub witnesses: Witnesses,
}

impl Counts {
    /// Adds what was counted elsewhere.
    pub fn add(&mut self, other: &Self) {
        if self.mutations.len() < other.mutations.len() {
            self.mutations.resize(other.mutations.len(), 0);
        }
        self.mutations.iter_mut().zip(&other.mutations).for_each(|(count, more)| *count += more);
        let numbers = |counts: &Self| {
            [
                counts.walks,
                counts.events,
                counts.groups,
                counts.deliveries,
                counts.reorderings,
                counts.duplicates,
                counts.losses,
                counts.restarts,
                counts.answers,
                counts.judged,
            ]
        };
        let more = numbers(other);
        let own = [
            &mut self.walks,
            &mut self.events,
            &mut self.groups,
            &mut self.deliveries,
            &mut self.reorderings,
            &mut self.duplicates,
            &mut self.losses,
            &mut self.restarts,
            &mut self.answers,
            &mut self.judged,
        ];
        own.into_iter().zip(more).for_each(|(count, more)| *count += more);
        self.witnesses.insert(other.witnesses);
    }
}
