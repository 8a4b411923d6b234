//! The laws, a room for each chapter of the specification.

mod closure;
mod context;
mod join;
mod judged;
mod sync;

use super::Algebra;
use super::report::{Law, Quantifier, Tally};
use super::space::Space;

/// Checks one law on one family.
pub(super) type Check<S> = fn(&mut Space<'_, S>, &mut Tally);

const fn all(clause: &'static str, says: &'static str) -> Law {
    Law { clause, says, quantifier: Quantifier::All }
}

const fn some(clause: &'static str, says: &'static str) -> Law {
    Law { clause, says, quantifier: Quantifier::Some }
}

/// Every law: first those that a semantics owes itself, then what an oracle expects of it.
pub(super) fn laws<S: Algebra>() -> Vec<(Law, Check<S>)> {
    vec![
        (all("JOIN-3", "idempotence: X ⊔ X = X"), join::idempotence),
        (all("JOIN-3", "commutativity: X ⊔ Y = Y ⊔ X"), join::commutativity),
        (all("JOIN-3", "the empty state is neutral"), join::neutral),
        (all("JOIN-3", "associativity: (X ⊔ Y) ⊔ Z = X ⊔ (Y ⊔ Z)"), join::associativity),
        (all("STATE-3", "no join moves a dot backwards"), judged::removal_is_final),
        (all("STATE-3", "each delivery is accepted by the judge of deliveries"), judged::deliveries),
        (all("CLOSE-2", "closing twice is closing once"), closure::idempotence),
        (all("CLOSE-3", "closure stops only where nothing is anchored to the dead"), closure::fixed_point),
        (all("CLOSE-4", "what waits for an anchor nobody has seen stays"), closure::pending),
        (all("CLOSE-2", "closure only moves dots forwards"), closure::inflationary),
        (all("CLOSE-2", "closure is monotone"), closure::monotone),
        (all("CLOSE-2", "close(close(X) ∪ Y) = close(X ∪ Y)"), closure::before_merge),
        (all("JOIN-4", "X ⊑ X ⊔ Y, and Y too"), join::upper_bound),
        (all("JOIN-4", "monotone: X ⊑ Y implies X ⊔ Z ⊑ Y ⊔ Z"), join::monotone),
        (
            all("JOIN-3", "the join of closed states is closed, and all that it holds was seen"),
            join::well_formed,
        ),
        (all("SYNC-3", "A ⊔ Δ = A ⊔ B for the delta Δ for A from B"), sync::brings_to_join),
        (all("SYNC-5", "after both have resynchronised they are equal"), sync::both_ways),
        (all("JOIN-4", "X ⊔ Y = Y exactly if each dot of X is at most as far as in Y"), join::order),
        (all("JOIN-1", "merge is the pointwise maximum of unseen < held < dead"), join::merge_oracle),
        (all("JOIN-3", "join is the closure of the merge"), join::join_oracle),
        (all("CLOSE-1", "closure drops what has a dead anchor, and nothing else"), closure::oracle),
        (all("CTX-1", "a merged context holds the dots that either had seen, and no others"), context::union),
        (all("CTX-2", "its form is compact, so equal sets have equal forms"), context::compact),
        (all("CTX-3", "inclusion of contexts is inclusion of sets"), context::inclusion),
        (all("CTX-4", "it is rebuilt from its runs"), context::runs),
        (all("SYNC-3", "Δ says what A lacks of B, and nothing else"), sync::says_what_lacks),
        (all("SYNC-3", "no lesser state does for merge what Δ does"), sync::least),
        (all("SYNC-4", "fingerprints are equal exactly if states are"), sync::fingerprints),
        (some("SYNC-2", "equal contexts do not mean equal states"), sync::context_is_no_digest),
        (all("CHECK-5", "renaming replicas commutes with join"), judged::renaming),
        (
            all("VIEW-1", "every state, reachable or not, has a view that keeps the invariants"),
            judged::states,
        ),
    ]
}
