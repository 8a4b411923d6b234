//! The laws of merge and join.

use super::super::Algebra;
use super::super::conditions::{self, Condition};
use super::super::report::Tally;
use super::super::space::Space;

/// `[property: JOIN-1]`
pub(super) fn merge_oracle<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    for (x, y) in space.all_pairs() {
        let Some(merged) = space.semantics.merge(space.state(x), space.state(y)) else { return };
        let merged = space.intern(merged);
        let expected = conditions::merged(&space.oracle[x as usize], &space.oracle[y as usize]);
        let holds = space.conditions(merged).is_some_and(|found| found == expected);
        tally.instance(holds, |clause| {
            space.example(clause, &[("X", x), ("Y", y), ("merge", merged)], "not the maximum")
        });
    }
}

/// `[property: JOIN-3]`
pub(super) fn join_oracle<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    if !space.has_bodies() {
        return;
    }
    for (x, y) in space.pairs() {
        let Some(joined) = space.join(x, y) else { return };
        let merged = conditions::merged(&space.oracle[x as usize], &space.oracle[y as usize]);
        let expected = conditions::closure(&space.family.records, &merged);
        let holds = space.conditions(joined).is_some_and(|found| found == expected);
        tally.instance(holds, |clause| {
            space.example(clause, &[("X", x), ("Y", y), ("join", joined)], "not the closure of the maximum")
        });
    }
}

/// `[property: JOIN-3]`
pub(super) fn idempotence<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    for x in space.closed.clone() {
        let Some(joined) = space.join(x, x) else { return };
        tally.instance(joined == x, |clause| space.example(clause, &[("X", x), ("X ⊔ X", joined)], "not X"));
    }
}

/// `[property: JOIN-3]`
pub(super) fn commutativity<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    for (x, y) in space.pairs() {
        let (Some(xy), Some(yx)) = (space.join(x, y), space.join(y, x)) else { return };
        tally.instance(xy == yx, |clause| {
            space.example(clause, &[("X", x), ("Y", y), ("X ⊔ Y", xy), ("Y ⊔ X", yx)], "they differ")
        });
    }
}

/// The first assignment has seen nothing. `[property: JOIN-3]`
pub(super) fn neutral<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    for x in space.closed.clone() {
        for (left, right) in [(0, x), (x, 0)] {
            let Some(joined) = space.join(left, right) else { return };
            tally.instance(joined == x, |clause| {
                space.example(
                    clause,
                    &[("left", left), ("right", right), ("join", joined)],
                    "not the other one",
                )
            });
        }
    }
}

/// `[property: JOIN-3]` `[property: WF-1]` `[property: WF-2]`
pub(super) fn well_formed<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    for (x, y) in space.pairs() {
        let Some(joined) = space.join(x, y) else { return };
        let Some(body) = space.semantics.body(space.state(joined)) else { return };
        let fault = dsr_core::check_well_formed(body);
        tally.instance(fault.is_ok(), |clause| {
            let detail = fault.err().map(|fault| fault.to_string()).unwrap_or_default();
            space.example(clause, &[("X", x), ("Y", y), ("X ⊔ Y", joined)], &detail)
        });
    }
}

/// `[property: JOIN-3]`
pub(super) fn associativity<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    for (x, y) in space.pairs() {
        let Some(xy) = space.join(x, y) else { return };
        for at in 0..space.closed.len() {
            let z = space.closed[at];
            let (Some(left), Some(yz)) = (space.join(xy, z), space.join(y, z)) else { return };
            let Some(right) = space.join(x, yz) else { return };
            tally.instance(left == right, |clause| {
                let states = [("X", x), ("Y", y), ("Z", z), ("(X ⊔ Y) ⊔ Z", left), ("X ⊔ (Y ⊔ Z)", right)];
                space.example(clause, &states, "they differ")
            });
        }
    }
}

/// `[property: JOIN-4]`
pub(super) fn order<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    if !space.has_bodies() {
        return;
    }
    for (x, y) in space.pairs() {
        let Some(joined) = space.join(x, y) else { return };
        let below = conditions::is_below(&space.oracle[x as usize], &space.oracle[y as usize]);
        tally.instance((joined == y) == below, |clause| {
            space.example(clause, &[("X", x), ("Y", y), ("X ⊔ Y", joined)], "the orders differ")
        });
    }
}

/// `[property: JOIN-4]`
pub(super) fn upper_bound<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    for (x, y) in space.pairs() {
        let Some(joined) = space.join(x, y) else { return };
        for part in [x, y] {
            let Some(again) = space.join(part, joined) else { return };
            tally.instance(again == joined, |clause| {
                space.example(clause, &[("X", x), ("Y", y), ("X ⊔ Y", joined)], "not above both")
            });
        }
    }
}

/// `[property: JOIN-4]`
pub(super) fn monotone<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    for (x, y) in space.pairs() {
        let Some(xy) = space.join(x, y) else { return };
        if xy != y {
            continue;
        }
        for at in 0..space.closed.len() {
            let z = space.closed[at];
            let (Some(xz), Some(yz)) = (space.join(x, z), space.join(y, z)) else { return };
            let Some(both) = space.join(xz, yz) else { return };
            tally.instance(both == yz, |clause| {
                space.example(
                    clause,
                    &[("X", x), ("Y", y), ("Z", z), ("X ⊔ Z", xz), ("Y ⊔ Z", yz)],
                    "not below",
                )
            });
        }
    }
}

/// Whether no dot is further back in the second. `[property: STATE-3]`
pub(super) fn moves_forwards(before: &[Condition], after: &[Condition]) -> bool {
    before.iter().zip(after).all(|(before, after)| before <= after)
}
