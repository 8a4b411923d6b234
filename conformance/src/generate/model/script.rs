//! A history as what its authors do. `[spec: CHECK-3]`

use dsr_core::{Delta, Mutation, MutationKind};
use dsr_model::checked::{Act, Checked};
use dsr_model::histories::{Histories, History};
use dsr_model::semantics::Semantics;
use dsr_model::tables::{DeltaId, NONE, StateId};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A set of the mutations of a script, by bit.
pub(super) type Set = u32;

/// Mutations in an order in which they can be made.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Script {
    /// The mutations.
    pub(super) made: Vec<Made>,
}

/// A mutation and what its author had received.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Made {
    /// The author, from 0.
    pub(super) author: usize,
    /// What it does.
    pub(super) mutation: Mutation,
    /// Which of the mutations before its author had, its own included: the fewest that let it make this delta.
    pub(super) had: Set,
    /// What it broadcasts.
    pub(super) delta: Arc<Delta>,
    /// The same, in the tables of the histories.
    pub(super) id: DeltaId,
}

impl Script {
    /// All of its mutations.
    pub(super) fn whole(&self) -> Set {
        (1 << self.made.len()) - 1
    }

    /// The kinds of its mutations, in order.
    pub(super) fn kinds(&self) -> Vec<MutationKind> {
        let mut kinds: Vec<MutationKind> = self.made.iter().map(|made| made.mutation.kind()).collect();
        kinds.sort_unstable();
        kinds
    }

    /// Whether a set has with each mutation those that its author had.
    pub(super) fn is_closed(&self, set: Set) -> bool {
        members(set).all(|at| self.made[at].had & !set == 0)
    }

    /// Whether neither author had the other's mutation.
    pub(super) fn is_concurrent(&self, left: usize, right: usize) -> bool {
        self.made[left].had >> right & 1 == 0 && self.made[right].had >> left & 1 == 0
    }
}

/// The members of a set, in order.
pub(super) fn members(set: Set) -> impl Iterator<Item = usize> {
    (0..Set::BITS as usize).filter(move |at| set >> at & 1 == 1)
}

/// Writes scripts of histories.
#[derive(Debug)]
pub(super) struct Scripts {
    semantics: Arc<Checked>,
    steps: BTreeMap<(StateId, usize), Vec<(Act, Delta)>>,
}

impl Scripts {
    /// Of this semantics.
    pub(super) fn new(semantics: Arc<Checked>) -> Self {
        Self { semantics, steps: BTreeMap::new() }
    }

    /// The script of a history; `None` if it cannot be made, which would be a fault of the checker.
    pub(super) fn of(&mut self, histories: &mut Histories<Checked>, history: &History) -> Option<Script> {
        let mut made = Vec::new();
        self.go_on(histories, history, &mut made).then_some(Script { made })
    }

    /// Makes what is left, and takes back what leads nowhere.
    fn go_on(&mut self, histories: &mut Histories<Checked>, history: &History, made: &mut Vec<Made>) -> bool {
        if made.len() == history.depth() {
            return true;
        }
        for (author, deltas) in history.deltas.iter().enumerate() {
            let own = made.iter().enumerate().filter(|(_, made)| made.author == author);
            let (count, had) =
                own.fold((0, 0), |(count, had), (at, made)| (count + 1, had | made.had | 1 << at));
            let Some(&id) = deltas.get(count).filter(|&&delta| delta != NONE) else { continue };
            let mut sets: Vec<Set> = (0..1 << made.len()).filter(|set| set & had == had).collect();
            sets.sort_by_key(|set| set.count_ones());
            for had in sets {
                let before = state(histories, made, had);
                let Some(mutation) = self.mutation(histories, before, author, id) else { continue };
                let delta = histories.tables().delta(id);
                made.push(Made { author, mutation, had, delta, id });
                if self.go_on(histories, history, made) {
                    return true;
                }
                made.pop();
            }
        }
        false
    }

    /// The mutation that broadcasts this delta in a state.
    fn mutation(
        &mut self,
        histories: &Histories<Checked>,
        before: StateId,
        author: usize,
        delta: DeltaId,
    ) -> Option<Mutation> {
        let steps = self.steps.entry((before, author)).or_insert_with(|| {
            let steps = self.semantics.steps(&histories.tables().state(before), author).into_iter();
            steps.map(|(act, step)| (act, step.delta)).collect()
        });
        let delta = histories.tables().delta(delta);
        steps.iter().find(|(_, made)| *made == *delta).map(|(act, _)| act.0.clone())
    }
}

/// The state of who has received a set.
pub(super) fn state(histories: &mut Histories<Checked>, made: &[Made], set: Set) -> StateId {
    let start = histories.initial();
    members(set).fold(start, |state, at| histories.join(state, made[at].id))
}
