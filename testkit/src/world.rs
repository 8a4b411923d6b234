//! Replicas, the deltas that they have sent, and who has got which.

use crate::history::Step;
use dsr_core::{
    Author, Delta, Dictionary, Mutation, MutationError, ReplicaId, State, delta_for, digest, view,
};
use std::collections::BTreeSet;

/// Replicas `r1`, `r2`, … over a network that may deliver any sent delta, at any time, any number of times.
#[derive(Clone, Debug)]
pub struct World {
    /// What all replicas know.
    pub dictionary: Dictionary,
    /// Each replica's state.
    pub states: Vec<State>,
    /// Every delta sent, in the order of sending.
    pub sent: Vec<Delta>,
    /// Per replica: which of the deltas it has got, its own included, directly or by resynchronisation.
    pub known: Vec<BTreeSet<usize>>,
    /// How often each replica has restarted.
    pub incarnations: Vec<u32>,
}

impl World {
    /// Replicas that know nothing.
    pub fn new(replicas: usize, dictionary: Dictionary) -> Self {
        Self {
            dictionary,
            states: vec![State::new(); replicas],
            sent: Vec::new(),
            known: vec![BTreeSet::new(); replicas],
            incarnations: vec![0; replicas],
        }
    }

    /// The author of a replica, by its number from 0; its clock shows the greatest stamp that it holds.
    pub fn author(&self, replica: usize) -> Author {
        author(replica, self.incarnations[replica], &self.states[replica])
    }

    /// Lets a replica mutate, and sends the delta to nobody yet.
    pub fn mutate(&mut self, replica: usize, mutation: &Mutation) -> Result<&Delta, MutationError> {
        let delta = mutation.delta(&view(&self.states[replica], &self.dictionary), self.author(replica))?;
        self.states[replica].join(&delta);
        self.known[replica].insert(self.sent.len());
        self.sent.push(delta);
        Ok(&self.sent[self.sent.len() - 1])
    }

    /// Delivers one of the deltas sent, perhaps again.
    pub fn deliver(&mut self, delta: usize, to: usize) {
        self.states[to].join(&self.sent[delta]);
        self.known[to].insert(delta);
    }

    /// Lets one replica answer another's digest.
    pub fn resynchronise(&mut self, from: usize, to: usize) {
        let delta = delta_for(&self.states[from], &digest(&self.states[to]));
        self.states[to].join(&delta);
        let known = self.known[from].clone();
        self.known[to].extend(known);
    }

    /// Delivers some of the deltas sent as one.
    pub fn deliver_together(&mut self, deltas: &[usize], to: usize) {
        let all = deltas.iter().fold(Delta::new(), |all, &delta| all.joined(&self.sent[delta]));
        self.states[to].join(&all);
        self.known[to].extend(deltas);
    }

    /// Lets a replica go on as its next incarnation, with its state or with nothing. `[spec: CRASH-2]`
    pub fn restart(&mut self, replica: usize, keeps: bool) {
        self.incarnations[replica] += 1;
        if !keeps {
            self.states[replica] = State::new();
            self.known[replica].clear();
        }
    }

    /// Takes one step of a history; what is not possible now does nothing.
    pub fn step(&mut self, step: &Step) {
        let count = self.states.len();
        match *step {
            Step::Mutate { replica, kind, choice } => {
                let replica = replica % count;
                let here = view(&self.states[replica], &self.dictionary);
                if let Some(mutation) = crate::pick(&here, self.author(replica), kind, choice) {
                    // Enabled, so it cannot be refused.
                    let _ = self.mutate(replica, &mutation);
                }
            }
            Step::Deliver { delta, to } => {
                if !self.sent.is_empty() {
                    self.deliver(delta % self.sent.len(), to % count);
                }
            }
            Step::Attempt { replica, kind, choice } => {
                let replica = replica % count;
                let here = view(&self.states[replica], &self.dictionary);
                if let Some(mutation) = crate::attempt(&here, kind, choice) {
                    let _ = self.mutate(replica, &mutation);
                }
            }
            Step::Try { replica, ref mutation } => {
                let _ = self.mutate(replica % count, mutation);
            }
            Step::Resynchronise { from, to } => self.resynchronise(from % count, to % count),
            Step::Group { ref deltas, to } => {
                if !self.sent.is_empty() {
                    let deltas: Vec<usize> = deltas.iter().map(|delta| delta % self.sent.len()).collect();
                    self.deliver_together(&deltas, to % count);
                }
            }
            Step::Restart { replica, keeps } => self.restart(replica % count, keeps),
        }
    }

    /// Delivers everything to everybody.
    pub fn settle(&mut self) {
        for to in 0..self.states.len() {
            for delta in 0..self.sent.len() {
                self.deliver(delta, to);
            }
        }
    }

    /// The join of the deltas that a replica has got, in the order of sending: what its state must be.
    /// `[spec: JOIN-5]`
    pub fn expected(&self, replica: usize) -> State {
        self.known[replica].iter().fold(State::new(), |state, &delta| state.joined(&self.sent[delta]))
    }
}

/// The author of a replica, by its number and its restarts, both from 0, with its state for a clock.
pub fn author(replica: usize, incarnation: u32, state: &State) -> Author {
    let agent = u32::try_from(replica + 1).unwrap_or(u32::MAX);
    Author { replica: ReplicaId { agent, incarnation }, timestamp_ns: state.greatest_stamp() }
}
