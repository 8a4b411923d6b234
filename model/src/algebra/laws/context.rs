//! The laws of the causal context, on the contexts of merged states.

use super::super::Algebra;
use super::super::conditions::{self, Condition};
use super::super::report::Tally;
use super::super::space::{Id, Space};
use dsr_core::CausalContext;

/// The context of each merge of two assignments, by the semantics.
fn merged_contexts<S: Algebra>(space: &Space<'_, S>, mut look: impl FnMut(Id, Id, &CausalContext)) {
    for (x, y) in space.all_pairs() {
        let Some(merged) = space.semantics.merge(space.state(x), space.state(y)) else { return };
        let Some(body) = space.semantics.body(&merged) else { return };
        look(x, y, body.context());
    }
}

/// `[property: CTX-1]` `[property: CTX-3]`
pub(super) fn union<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    merged_contexts(space, |x, y, context| {
        let expected = conditions::merged(&space.oracle[x as usize], &space.oracle[y as usize]);
        let dots = space.family.records.iter().map(|(dot, _)| *dot);
        let seen = expected.iter().filter(|condition| **condition != Condition::Unseen).count();
        let holds = dots
            .zip(&expected)
            .all(|(dot, condition)| context.contains(dot) == (*condition != Condition::Unseen))
            && context.runs().map(|run| run.dots().count()).sum::<usize>() == seen;
        tally.instance(holds, |clause| space.example(clause, &[("X", x), ("Y", y)], &format!("{context:?}")));
    });
}

/// `[property: CTX-2]`
pub(super) fn compact<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    merged_contexts(space, |x, y, context| {
        let holds = context.vector().all(|(_, sequence)| sequence > 0)
            && context.cloud_runs().all(|run| run.first >= context.prefix(run.replica) + 2)
            && context.runs().flat_map(dsr_core::Run::dots).collect::<CausalContext>() == *context;
        tally.instance(holds, |clause| space.example(clause, &[("X", x), ("Y", y)], &format!("{context:?}")));
    });
}

/// `[property: CTX-3]`
pub(super) fn inclusion<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    for (x, y) in space.all_pairs() {
        let (Some(left), Some(right)) =
            (space.semantics.body(space.state(x)), space.semantics.body(space.state(y)))
        else {
            return;
        };
        let seen = |at: Id| space.oracle[at as usize].iter().map(|condition| *condition != Condition::Unseen);
        let expected = seen(x).zip(seen(y)).all(|(in_x, in_y)| in_x || !in_y);
        let holds = left.context().includes(right.context()) == expected;
        tally.instance(holds, |clause| {
            space.example(clause, &[("X", x), ("Y", y)], "includes() and the sets differ")
        });
    }
}

/// `[property: CTX-4]`
pub(super) fn runs<S: Algebra>(space: &mut Space<'_, S>, tally: &mut Tally) {
    merged_contexts(space, |x, y, context| {
        let mut rebuilt = CausalContext::new();
        context.runs().for_each(|run| rebuilt.insert_run(run));
        let ascending = context
            .runs()
            .zip(context.runs().skip(1))
            .all(|(run, next)| (run.replica, run.last + 1) < (next.replica, next.first));
        tally.instance(rebuilt == *context && ascending, |clause| {
            space.example(clause, &[("X", x), ("Y", y)], &format!("{context:?}"))
        });
    });
}
