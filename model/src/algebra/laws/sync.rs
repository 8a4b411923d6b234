//! The laws of resynchronisation.

use super::super::Algebra;
use super::super::conditions::{self, Conditions};
use super::super::report::Tally;
use super::super::space::{Id, Space};

/// State `a` after it has received what `b` answers to its digest.
fn repaired<S: Algebra>(space: &mut Space<'_, S>, a: Id, b: Id) -> Option<Id> {
    let delta = space.semantics.repair(space.state(b), space.state(a))?;
    let after = space.semantics.join(space.state(a), &delta);
    Some(space.intern(after))
}

/// `[property: SYNC-3]`
pub(super) fn brings_to_join<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    for (a, b) in space.pairs() {
        let (Some(after), Some(joined)) = (repaired(space, a, b), space.join(a, b)) else { return };
        tally.instance(after == joined, |clause| {
            space.example(clause, &[("A", a), ("B", b), ("A ⊔ Δ", after), ("A ⊔ B", joined)], "they differ")
        });
    }
}

/// What the delta for `a` from `b` says, by the oracle's measure.
fn delta_conditions<S: Algebra>(space: &Space<'_, S>, a: Id, b: Id) -> Option<Conditions> {
    let delta = space.semantics.repair(space.state(b), space.state(a))?;
    conditions::conditions_of(&space.family.records, space.semantics.delta_body(&delta)?)
}

/// `[property: SYNC-3]`
pub(super) fn says_what_lacks<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    if !space.has_bodies() || space.semantics.repair(space.state(0), space.state(0)).is_none() {
        return;
    }
    for (a, b) in space.pairs() {
        let expected = conditions::least_delta(&space.oracle[b as usize], &space.oracle[a as usize]);
        let closed = conditions::closure(&space.family.records, &expected) == expected;
        let holds = delta_conditions(space, a, b).is_some_and(|found| found == expected) && closed;
        tally.instance(holds, |clause| {
            let expected = conditions::describe(&space.family.records, &expected);
            space.example(clause, &[("A", a), ("B", b)], &format!("expected was: {expected}"))
        });
    }
}

/// Of all states that merge with A to what B merges to, Δ is the least. `[property: SYNC-3]`
pub(super) fn least<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    for (a, b) in space.pairs() {
        let Some(delta) = delta_conditions(space, a, b) else { continue };
        let of_a = &space.oracle[a as usize];
        let goal = conditions::merged(of_a, &space.oracle[b as usize]);
        for other in space.all() {
            let candidate = &space.oracle[other as usize];
            let reaches = of_a.iter().zip(candidate).map(|(of_a, other)| of_a.max(other)).eq(&goal);
            if reaches {
                tally.instance(conditions::is_below(&delta, candidate), |clause| {
                    space.example(clause, &[("A", a), ("B", b), ("lesser", other)], "it does as well")
                });
            }
        }
    }
}

/// `[property: SYNC-4]`
pub(super) fn fingerprints<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    let fingerprints: Option<Vec<_>> =
        space.all().map(|x| space.semantics.body(space.state(x)).map(dsr_core::fingerprint)).collect();
    let Some(fingerprints) = fingerprints else { return };
    for (x, y) in space.all_pairs() {
        let equal = fingerprints[x as usize] == fingerprints[y as usize];
        tally.instance(equal == (x == y), |clause| {
            space.example(clause, &[("X", x), ("Y", y)], "one fingerprint")
        });
    }
}

/// `[property: SYNC-5]`
pub(super) fn both_ways<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    for (a, b) in space.pairs() {
        let (Some(of_a), Some(of_b)) = (repaired(space, a, b), repaired(space, b, a)) else { return };
        tally.instance(of_a == of_b, |clause| {
            space.example(clause, &[("A", a), ("B", b), ("A after", of_a), ("B after", of_b)], "they differ")
        });
    }
}

/// A witness that contexts alone do not tell states apart. `[property: SYNC-2]`
pub(super) fn context_is_no_digest<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    for (x, y) in space.pairs() {
        let (Some(left), Some(right)) =
            (space.semantics.body(space.state(x)), space.semantics.body(space.state(y)))
        else {
            return;
        };
        let witness = left.context() == right.context() && x != y;
        tally.instance(witness, |clause| {
            space.example(clause, &[("X", x), ("Y", y)], "one context, two states")
        });
    }
}
