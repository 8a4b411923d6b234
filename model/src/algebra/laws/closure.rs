//! The laws of closure, on all assignments, closed or not.

use super::super::Algebra;
use super::super::conditions::{self, Condition};
use super::super::report::Tally;
use super::super::space::{Id, Space};

/// The closure of each assignment by the semantics; `None` if it has none.
fn closures<S: Algebra>(space: &mut Space<'_, S>) -> Option<Vec<Id>> {
    let all: Vec<Id> = space.all().collect();
    all.into_iter()
        .map(|x| {
            let closed = space.semantics.close(space.state(x))?;
            Some(space.intern(closed))
        })
        .collect()
}

/// `[property: CLOSE-1]`
pub(super) fn oracle<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    let Some(closures) = closures(space) else { return };
    for (x, &closed) in space.all().zip(&closures) {
        let expected = conditions::closure(&space.family.records, &space.oracle[x as usize]);
        let holds = space.conditions(closed).is_some_and(|found| found == expected);
        tally.instance(holds, |clause| {
            space.example(clause, &[("X", x), ("close(X)", closed)], "not the closure")
        });
    }
}

/// `[property: CLOSE-2]`
pub(super) fn inflationary<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    let Some(closures) = closures(space) else { return };
    for (x, &closed) in space.all().zip(&closures) {
        let after = space.conditions(closed);
        let holds = after.is_some_and(|after| conditions::is_below(&space.oracle[x as usize], &after));
        tally.instance(holds, |clause| {
            space.example(clause, &[("X", x), ("close(X)", closed)], "a dot moved back")
        });
    }
}

/// `[property: CLOSE-2]`
pub(super) fn idempotence<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    let Some(closures) = closures(space) else { return };
    for (x, &once) in space.all().zip(&closures) {
        let Some(twice) = space.semantics.close(space.state(once)) else { return };
        let twice = space.intern(twice);
        tally.instance(twice == once, |clause| {
            space.example(clause, &[("X", x), ("closed once", once), ("closed twice", twice)], "they differ")
        });
    }
}

/// `[property: CLOSE-2]`
pub(super) fn monotone<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    let Some(closures) = closures(space) else { return };
    for (x, y) in space.all_pairs() {
        if !conditions::is_below(&space.oracle[x as usize], &space.oracle[y as usize]) {
            continue;
        }
        let (cx, cy) = (closures[x as usize], closures[y as usize]);
        let (Some(lower), Some(upper)) = (space.conditions(cx), space.conditions(cy)) else { continue };
        tally.instance(conditions::is_below(&lower, &upper), |clause| {
            space.example(clause, &[("X", x), ("Y", y), ("close(X)", cx), ("close(Y)", cy)], "not below")
        });
    }
}

/// `[property: CLOSE-2]`
pub(super) fn before_merge<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    let Some(closures) = closures(space) else { return };
    for (x, y) in space.all_pairs() {
        let closed_union = |left: Id| {
            let merged = space.semantics.merge(space.state(left), space.state(y))?;
            space.semantics.close(&merged)
        };
        let (Some(late), Some(early)) = (closed_union(x), closed_union(closures[x as usize])) else { return };
        let holds = late == early;
        tally.instance(holds, |clause| {
            let detail = format!("{} and {}", space.describe(&early), space.describe(&late));
            space.example(clause, &[("X", x), ("Y", y)], &detail)
        });
    }
}

/// `[property: CLOSE-3]`
pub(super) fn fixed_point<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    let Some(closures) = closures(space) else { return };
    for (x, &closed) in space.all().zip(&closures) {
        let Some(body) = space.semantics.body(space.state(closed)) else { return };
        let mut anchors = body.records().flat_map(|(_, record)| record.anchors());
        let holds = !anchors.any(|anchor| body.is_dead(anchor));
        tally.instance(holds, |clause| {
            space.example(clause, &[("X", x), ("close(X)", closed)], "something is anchored to the dead")
        });
    }
}

/// `[property: CLOSE-4]`
pub(super) fn pending<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    let Some(closures) = closures(space) else { return };
    for (x, &closed) in space.all().zip(&closures) {
        let before = &space.oracle[x as usize];
        let condition_of = |dot| {
            let at = space.family.records.iter().position(|(known, _)| *known == dot);
            at.map(|at| before[at])
        };
        for (at, (dot, record)) in space.family.records.iter().enumerate() {
            let mut anchors = record.anchors().filter_map(condition_of).peekable();
            let waits = anchors.peek().is_some() && anchors.all(|anchor| anchor == Condition::Unseen);
            if before[at] == Condition::Held && waits {
                let stays = space.semantics.body(space.state(closed)).is_some_and(|body| body.holds(*dot));
                tally.instance(stays, |clause| {
                    space.example(clause, &[("X", x), ("close(X)", closed)], "what was pending is gone")
                });
            }
        }
    }
}
