//! One value that replicas overwrite.

use super::context::{Context, Dot};
use super::{AgentId, Crash};
use std::collections::{BTreeMap, BTreeSet};

/// The id in every dot. A register's own id is never set in the published implementation, so the dots of
/// different agents collide.
pub const REGISTER_ID: u32 = 0;

/// What a register holds.
pub trait Payload: Clone {
    /// The agent that the value says it is from; ties between equal dots go to the lower one.
    fn agent(&self) -> AgentId;

    /// Whether two values count as equal.
    fn same_value(&self, other: &Self) -> bool;
}

/// A register: values by dot, and the dots seen. A delta is a register too.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Register<T> {
    values: BTreeMap<Dot, T>,
    context: Context,
}

impl<T> Default for Register<T> {
    fn default() -> Self {
        Self { values: BTreeMap::new(), context: Context::default() }
    }
}

impl<T> Register<T> {
    /// Values by dot.
    pub const fn values(&self) -> &BTreeMap<Dot, T> {
        &self.values
    }

    /// The dots seen.
    pub const fn context(&self) -> &Context {
        &self.context
    }

    /// Whether it holds nothing.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The value of the smallest dot, if any.
    pub fn value(&self) -> Option<&T> {
        self.values.values().next()
    }

    /// The value of the smallest dot; reading an empty register fails an assertion.
    pub fn read(&self) -> Result<&T, Crash> {
        self.value().ok_or(Crash::EmptyRegister)
    }

    /// The value of the smallest dot, to be edited in place: without a new dot.
    pub fn edit(&mut self) -> Result<&mut T, Crash> {
        self.values.values_mut().next().ok_or(Crash::EmptyRegister)
    }

    /// Removes the value; the delta says which dots are gone.
    #[must_use]
    pub fn reset(&mut self) -> Self {
        let context = Context::of(self.values.keys().copied());
        self.values.clear();
        Self { values: BTreeMap::new(), context }
    }

    /// The same register with other values.
    pub fn map<U>(&self, value: impl Fn(&T) -> U) -> Register<U> {
        let values = self.values.iter().map(|(&dot, held)| (dot, value(held))).collect();
        Register { values, context: self.context.clone() }
    }

    /// As it travels inside a node or an edge: of its context only the counter of its dot is left.
    pub fn nested<U>(&self, value: impl Fn(&T) -> U) -> Register<U> {
        let mut context = Context::default();
        for dot in self.values.keys() {
            context.join(&Context::counted(dot.id, dot.n));
        }
        Register { context, ..self.map(value) }
    }
}

impl<T: Payload> Register<T> {
    /// Replaces the value; the delta says which dots are gone and brings the new one.
    #[must_use]
    pub fn write(&mut self, value: T) -> Self {
        let mut delta = self.reset();
        let dot = self.context.make_dot(REGISTER_ID);
        self.values.insert(dot, value.clone());
        let added = Self { values: BTreeMap::from([(dot, value)]), context: Context::of([dot]) };
        delta.join_kernel(&added);
        delta
    }

    /// Takes a delta in; more than one value afterwards fails an assertion.
    pub fn join(&mut self, theirs: &Self) -> Result<(), Crash> {
        self.join_kernel(theirs);
        if self.values.len() > 1 { Err(Crash::SeveralValues) } else { Ok(()) }
    }

    /// The walk over both sides in the order of dots. What was decided for a smaller dot is seen by the next;
    /// the contexts are joined last.
    fn join_kernel(&mut self, theirs: &Self) {
        let dots: BTreeSet<Dot> = self.values.keys().chain(theirs.values.keys()).copied().collect();
        for dot in dots {
            match (self.values.get(&dot), theirs.values.get(&dot)) {
                (Some(_), None) => {
                    if theirs.context.known(dot) {
                        self.values.remove(&dot);
                    }
                }
                (None, Some(their)) => {
                    if !self.context.known(dot) || self.values.is_empty() {
                        self.values.insert(dot, their.clone());
                    }
                }
                (Some(mine), Some(their)) => {
                    if mine.agent() > their.agent() && !mine.same_value(their) {
                        self.values.insert(dot, their.clone());
                    }
                }
                (None, None) => {}
            }
        }
        self.context.join(&theirs.context);
    }

    /// Whether both hold equal values under equal dots; what they have seen is not compared.
    pub fn same_values(&self, other: &Self) -> bool {
        self.values.len() == other.values.len()
            && self
                .values
                .iter()
                .zip(&other.values)
                .all(|(mine, theirs)| mine.0 == theirs.0 && mine.1.same_value(theirs.1))
    }
}
