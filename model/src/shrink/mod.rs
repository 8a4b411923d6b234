//! Shrinking: a course that fails, reduced until no single reduction still fails. `[spec: CHECK-14]`
//!
//! ```text
//! course that fails ─► drop, merge, simplify ─► carried out anew ─► does it still fail? ─► keep it
//! ```
//!
//! This is delta debugging: large parts of the course are left out first, then ever smaller ones, until every
//! reduction that there is, taken alone, leads to a course that no longer fails. What a reduction leaves behind
//! is carried out anew: messages and replicas are renumbered, mutations [name what they named
//! before](crate::semantics::Semantics::readdressed) by its new id, and what can no longer happen goes as well.
//! So a course that is tried is always one that can happen, and whoever decides whether it fails need not mind.
//!
//! Not promised: that there is no shorter course that fails; only that none is one reduction away.
//!
//! | room | what |
//! |---|---|
//! | `plan` | a course with something left out, and how it is carried out |
//! | `reductions` | the kinds of reduction, and every single one of a course |

mod plan;
mod reductions;

pub use reductions::Reduction;

use crate::course::{Course, Moment, Outcome, run};
use crate::semantics::Semantics;
use plan::{Plan, Recorded};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The most courses that are tried, unless another limit is asked for.
pub const TRIES_MAX: usize = 20_000;

/// Which reductions are made, and how many tries they may cost.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Shrinker {
    /// The kinds, in the order in which they are tried.
    pub kinds: Vec<Reduction>,
    /// The most courses tried. Reaching it leaves a course that fails, but may not be minimal.
    pub tries_max: usize,
}

impl Default for Shrinker {
    fn default() -> Self {
        Self { kinds: Reduction::ALL.into(), tries_max: TRIES_MAX }
    }
}

/// A course that still fails, and what it took.
#[derive(Debug)]
pub struct Shrunk<S: Semantics> {
    /// The semantics, on an initial state that may be smaller.
    pub semantics: Arc<S>,
    /// The course.
    pub course: Course<S::Mutation>,
    /// How many events the course had before.
    pub events_before: usize,
    /// How many courses were tried.
    pub tries: usize,
    /// How many reductions of each kind were made.
    pub made: BTreeMap<Reduction, usize>,
    /// Whether every single reduction was tried on the course and none still fails.
    pub is_minimal: bool,
}

/// Shrinks by every kind of reduction: see [`Shrinker::shrink`].
pub fn shrink<S: Semantics>(
    semantics: &Arc<S>,
    course: &Course<S::Mutation>,
    fails: impl Fn(&S, &Course<S::Mutation>) -> bool,
) -> Shrunk<S> {
    Shrinker::default().shrink(semantics, course, fails)
}

/// Whether a course breaks the clause that another one broke: the usual answer to what *fails the same* means.
/// An initial state that breaks a clause by itself is not the failure of a course that breaks it later.
/// `[spec: CHECK-14]`
pub fn breaks_as<S: Semantics>(outcome: &Outcome) -> impl Fn(&S, &Course<S::Mutation>) -> bool + use<S> {
    let wanted = match outcome {
        Outcome::Broken(broken) => Some((broken.breach.clause, broken.at == Moment::Start)),
        Outcome::Held | Outcome::Invalid { .. } => None,
    };
    move |semantics, course| match run(semantics, course, true) {
        Outcome::Broken(broken) => wanted == Some((broken.breach.clause, broken.at == Moment::Start)),
        Outcome::Held | Outcome::Invalid { .. } => false,
    }
}

/// Every course that one reduction leads to, each with the semantics that it is of: what a minimal course is
/// minimal among. `[spec: CHECK-14]`
pub fn neighbours<S: Semantics>(
    semantics: &Arc<S>,
    course: &Course<S::Mutation>,
    kind: Reduction,
) -> Vec<(Arc<S>, Course<S::Mutation>)> {
    let recorded = Recorded::of(&**semantics, course);
    let plans = kind.plans(semantics, course, &recorded).into_iter();
    let carried_out = plans.map(|(semantics, plan)| {
        let course = plan.carry_out(&*semantics, &recorded);
        (semantics, course)
    });
    carried_out.collect()
}

impl Shrinker {
    /// Reduces a course of `semantics` as long as `fails` says that it still fails. A course that does not fail
    /// itself comes back as it is, and is not minimal.
    pub fn shrink<S: Semantics>(
        &self,
        semantics: &Arc<S>,
        course: &Course<S::Mutation>,
        fails: impl Fn(&S, &Course<S::Mutation>) -> bool,
    ) -> Shrunk<S> {
        let mut shrunk = Shrunk {
            semantics: semantics.clone(),
            course: course.clone(),
            events_before: course.events.len(),
            tries: 1,
            made: BTreeMap::new(),
            is_minimal: false,
        };
        if !fails(semantics, course) {
            return shrunk;
        }
        let mut search =
            Search { recorded: Recorded::of(&**semantics, course), tries_max: self.tries_max, fails };
        // Each kind is tried anew after every kind that came to something: what was in the way may be gone.
        let mut at = 0;
        while let Some(&kind) = self.kinds.get(at) {
            let made: usize = shrunk.made.values().sum();
            search.reduce(&mut shrunk, kind);
            at = if made == shrunk.made.values().sum::<usize>() { at + 1 } else { 0 };
        }
        shrunk.is_minimal = shrunk.tries < self.tries_max;
        shrunk
    }
}

/// A shrinker at work.
struct Search<S: Semantics, F> {
    recorded: Recorded<S>,
    tries_max: usize,
    fails: F,
}

impl<S: Semantics, F: Fn(&S, &Course<S::Mutation>) -> bool> Search<S, F> {
    /// Makes reductions of one kind until none of them alone leads to a course that fails.
    fn reduce(&mut self, shrunk: &mut Shrunk<S>, kind: Reduction) {
        if kind == Reduction::Event {
            self.drop_stretches(shrunk);
        }
        // After a reduction the search goes on from where it is: what was tried before seldom helps now, and
        // the next round will tell.
        let mut at = 0;
        loop {
            let plans = kind.plans(&shrunk.semantics, &shrunk.course, &self.recorded);
            let Some(found) = (at..plans.len()).find(|&at| self.attempt(shrunk, kind, &plans[at])) else {
                return;
            };
            at = found;
        }
    }

    /// Leaves out stretches of events, half the course first, then ever shorter ones.
    fn drop_stretches(&mut self, shrunk: &mut Shrunk<S>) {
        let mut length = shrunk.course.events.len() / 2;
        while length > 1 {
            let mut end = shrunk.course.events.len();
            while end > 0 {
                let start = end.saturating_sub(length);
                let mut plan = Plan::of(&shrunk.course, &self.recorded);
                plan.items.drain(start..end);
                self.attempt(shrunk, Reduction::Event, &(shrunk.semantics.clone(), plan));
                end = start.min(shrunk.course.events.len());
            }
            length /= 2;
        }
    }

    /// Tries one reduction, and keeps what it leads to if that still fails.
    fn attempt(
        &mut self,
        shrunk: &mut Shrunk<S>,
        kind: Reduction,
        (semantics, plan): &(Arc<S>, Plan<S::Mutation>),
    ) -> bool {
        if shrunk.tries >= self.tries_max {
            return false;
        }
        shrunk.tries += 1;
        let course = plan.carry_out(&**semantics, &self.recorded);
        if !(self.fails)(semantics, &course) {
            return false;
        }
        self.recorded = Recorded::of(&**semantics, &course);
        (shrunk.course, shrunk.semantics) = (course, semantics.clone());
        *shrunk.made.entry(kind).or_default() += 1;
        true
    }
}
