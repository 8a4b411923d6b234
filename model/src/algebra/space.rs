//! One family with its joins, each computed once by the semantics under test.

use super::conditions::{self, Conditions};
use super::report::Example;
use super::{Algebra, Family};
use crate::tables::NONE;
use rustc_hash::FxHashMap;

/// A state's number: below the number of assignments it is the assignment's; beyond it is something that
/// no assignment means, which only a broken semantics makes.
pub(super) type Id = u32;

/// One family, enumerated.
pub(super) struct Space<'s, S: Algebra> {
    pub(super) semantics: &'s S,
    pub(super) family: Family<S::State>,
    /// What each assignment means to the oracle.
    pub(super) oracle: Vec<Conditions>,
    /// The closed states.
    pub(super) closed: Vec<Id>,
    values: Vec<S::State>,
    ids: FxHashMap<S::State, Id>,
    /// Joins of assignments, row by row.
    joins: Vec<Id>,
    /// Joins of anything else.
    beyond: FxHashMap<(Id, Id), Id>,
}

impl<'s, S: Algebra> Space<'s, S> {
    pub(super) fn new(semantics: &'s S, family: Family<S::State>) -> Self {
        let values = family.all.clone();
        let ids = values.iter().enumerate().map(|(at, state)| (state.clone(), id(at))).collect();
        let joins = vec![NONE; values.len() * values.len()];
        let oracle = conditions::assignments(family.records.len());
        let closed = family.closed.iter().map(|&at| id(at)).collect();
        Self { semantics, family, oracle, closed, values, ids, joins, beyond: FxHashMap::default() }
    }

    /// Every assignment, closed or not.
    pub(super) fn all(&self) -> impl Iterator<Item = Id> + use<S> {
        0..id(self.family.all.len())
    }

    /// Every ordered pair of closed states.
    pub(super) fn pairs(&self) -> Vec<(Id, Id)> {
        self.closed.iter().flat_map(|&left| self.closed.iter().map(move |&right| (left, right))).collect()
    }

    /// Every ordered pair of assignments.
    pub(super) fn all_pairs(&self) -> impl Iterator<Item = (Id, Id)> + use<S> {
        let count = id(self.family.all.len());
        (0..count).flat_map(move |left| (0..count).map(move |right| (left, right)))
    }

    pub(super) fn state(&self, at: Id) -> &S::State {
        &self.values[at as usize]
    }

    pub(super) fn intern(&mut self, state: S::State) -> Id {
        if let Some(&known) = self.ids.get(&state) {
            return known;
        }
        let new = id(self.values.len());
        self.values.push(state.clone());
        self.ids.insert(state, new);
        new
    }

    /// The join by the semantics; `None` if it has none.
    pub(super) fn join(&mut self, left: Id, right: Id) -> Option<Id> {
        let count = self.family.all.len();
        let (l, r) = (left as usize, right as usize);
        let dense = l < count && r < count;
        let known =
            if dense { self.joins[l * count + r] } else { *self.beyond.get(&(left, right)).unwrap_or(&NONE) };
        if known != NONE {
            return Some(known);
        }
        let joined = self.semantics.join_states(self.state(left), self.state(right))?;
        let joined = self.intern(joined);
        if dense {
            self.joins[l * count + r] = joined;
        } else {
            self.beyond.insert((left, right), joined);
        }
        Some(joined)
    }

    /// What the oracle makes of a state: `None` if it is no state over these records.
    pub(super) fn conditions(&self, at: Id) -> Option<Conditions> {
        if let Some(conditions) = self.oracle.get(at as usize) {
            return Some(conditions.clone());
        }
        conditions::conditions_of(&self.family.records, self.semantics.body(self.state(at))?)
    }

    /// Whether states have bodies that the oracle can be compared with.
    pub(super) fn has_bodies(&self) -> bool {
        self.values.first().is_some_and(|state| self.semantics.body(state).is_some())
    }

    /// The state for people.
    pub(super) fn describe(&self, state: &S::State) -> String {
        let body = self.semantics.body(state);
        let conditions = body.and_then(|body| conditions::conditions_of(&self.family.records, body));
        conditions.map_or_else(
            || format!("{state:?}"),
            |conditions| conditions::describe(&self.family.records, &conditions),
        )
    }

    /// An example of some states.
    pub(super) fn example(
        &self,
        clause: &'static str,
        states: &[(&'static str, Id)],
        detail: &str,
    ) -> Example {
        let describe = |&(name, at): &(&'static str, Id)| (name, self.describe(self.state(at)));
        Example {
            family: self.family.name,
            clause,
            states: states.iter().map(describe).collect(),
            json: states.iter().map(|&(_, at)| self.semantics.state_json(self.state(at))).collect(),
            detail: detail.into(),
        }
    }
}

fn id(at: usize) -> Id {
    Id::try_from(at).unwrap_or(NONE)
}
