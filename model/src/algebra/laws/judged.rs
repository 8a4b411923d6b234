//! Laws that the semantics' own judges check, and renaming.

use super::super::Algebra;
use super::super::report::Tally;
use super::super::space::{Id, Space};
use super::join::moves_forwards;

/// Replicas 0 and 1 change names; the families know no others.
const SWAP: [usize; 2] = [1, 0];

/// `[property: STATE-3]`
pub(super) fn removal_is_final<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    if !space.has_bodies() {
        return;
    }
    for (x, y) in space.pairs() {
        let Some(joined) = space.join(x, y) else { return };
        let after = space.conditions(joined);
        let holds = after.is_some_and(|after| moves_forwards(&space.oracle[x as usize], &after));
        tally.instance(holds, |clause| {
            space.example(clause, &[("X", x), ("Y", y), ("X ⊔ Y", joined)], "a dot of X moved back")
        });
    }
}

/// `[property: STATE-3]`
pub(super) fn deliveries<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    for (x, y) in space.pairs() {
        let Some(joined) = space.join(x, y) else { return };
        let verdict = space.semantics.judge_delivery(space.state(x), space.state(joined));
        tally.instance(verdict.is_ok(), |_| {
            let (clause, detail) =
                verdict.err().map_or(("", String::new()), |breach| (breach.clause, breach.detail));
            space.example(clause, &[("before", x), ("delivered", y), ("after", joined)], &detail)
        });
    }
}

/// `[property: CHECK-5]`
pub(super) fn renaming<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    let renamed: Vec<S::State> =
        space.all().map(|x| space.semantics.rename_state(space.state(x), &SWAP)).collect();
    for (x, y) in space.pairs() {
        let (left, right) = (&renamed[x as usize], &renamed[y as usize]);
        let (Some(joined), Some(after)) = (space.join(x, y), space.semantics.join_states(left, right)) else {
            return;
        };
        let holds = space.semantics.rename_state(space.state(joined), &SWAP) == after;
        tally.instance(holds, |clause| {
            let detail = format!("joined after renaming: {}", space.describe(&after));
            space.example(clause, &[("X", x), ("Y", y), ("X ⊔ Y", joined)], &detail)
        });
    }
}

/// Judges every closed state and its image with the replicas' names changed. `[property: VIEW-1]`
pub(super) fn states<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    let closed: Vec<Id> = space.closed.clone();
    for x in closed {
        let image = space.semantics.rename_state(space.state(x), &SWAP);
        for state in [space.state(x), &image] {
            let verdict = space.semantics.judge(state);
            tally.instance(verdict.is_ok(), |own| {
                let (clause, detail) =
                    verdict.err().map_or((own, String::new()), |breach| (breach.clause, breach.detail));
                space.example(clause, &[("X", x)], &format!("{}: {detail}", space.describe(state)))
            });
        }
    }
}
