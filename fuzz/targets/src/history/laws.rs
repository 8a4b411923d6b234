//! What must hold after a step, and at the end.

use super::Core;
use super::replicas::Replicas;
use crate::laws::closure_depth;
use crate::target::{Broken, equal, holds};
use dsr_core::{State, fingerprint};
use dsr_model::semantics::Breach;

/// A breach of the checker's laws, with the state in which it was found.
pub(super) fn broken(breach: &Breach, state: &State) -> Broken {
    Broken { clause: breach.clause, what: format!("{}\n{state:#?}", breach.detail) }
}

/// One replica: every law of a state; the state is the join of the deltas that it has got.
pub(super) fn of_replica<S: Core>(replicas: &Replicas<'_, S>, at: usize) -> Result<(), Broken> {
    let (core, one) = (replicas.core, &replicas.all[at]);
    core.judge(&one.state).map_err(|breach| broken(&breach, &one.state))?;
    let got = one.known.iter().map(|&delta| &replicas.sent[delta]);
    let expected = core.join_all(&core.initial(), &got.collect::<Vec<_>>());
    equal("JOIN-5", "the deltas in the order of sending, and as they came", &expected, &one.state)
}

/// Join is a join, on the states that there are. `[spec: JOIN-4]`
pub(super) fn of_joins<S: Core>(replicas: &Replicas<'_, S>) -> Result<(), Broken> {
    let states: Vec<&State> = replicas.all.iter().map(|one| &one.state).collect();
    let join = |l: &State, r: &State| replicas.core.join_states(l, r).unwrap_or_default();
    for a in &states {
        equal("JOIN-4", "a state joined with itself", &join(a, a), *a)?;
        for b in &states {
            equal("JOIN-4", "a ⊔ b and b ⊔ a", &join(a, b), &join(b, a))?;
            holds("CLOSE-3", closure_depth(a, b).is_none_or(|depth| depth <= 2), || {
                format!("closure made more than two passes: {a:#?}\n{b:#?}")
            })?;
            for c in &states {
                equal("JOIN-4", "(a ⊔ b) ⊔ c and a ⊔ (b ⊔ c)", &join(&join(a, b), c), &join(a, &join(b, c)))?;
            }
        }
    }
    Ok(())
}

/// All deltas, one state; nothing is left of gaps; nobody lacks anything. `[spec: JOIN-5]` `[spec: CTX-2]`
pub(super) fn at_rest<S: Core>(replicas: &Replicas<'_, S>) -> Result<(), Broken> {
    let first = &replicas.all[0].state;
    for one in &replicas.all {
        equal("JOIN-5", "two replicas at rest", &one.state, first)?;
        equal("SYNC-4", "their fingerprints", &fingerprint(&one.state), &fingerprint(first))?;
        equal("CTX-2", "runs beyond gaps at rest", &one.state.context().cloud_runs().count(), &0)?;
        let lacking = replicas.core.repair(first, &one.state).unwrap_or_default();
        equal("SYNC-5", "what a replica lacks at rest", &lacking, &State::new())?;
        if let Some(pair) = &one.pair {
            pair.check_thoroughly(first);
        }
    }
    Ok(())
}
