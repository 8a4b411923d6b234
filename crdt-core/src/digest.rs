//! Digests and repair: how two replicas become equal whatever was lost. `[spec: SYNC-1]`
//!
//! A context alone is no digest: let `e2` replace `e1` and `e3` replace `e2`. Who gets `e1` and `e3` but
//! not `e2`'s delta has seen all three dots and still holds `e1`. So a digest names the live dots too.
//! `[spec: SYNC-2]`

use crate::context::{CausalContext, Run, runs_of};
use crate::dot::Dot;
use crate::state::{Delta, State};
use alloc::vec::Vec;
use core::fmt;
use core::hash::Hasher;
use siphasher::sip128::{Hasher128, SipHasher24};

/// What a replica has seen and what of it lives: enough for another to compute what is missing here.
/// `[spec: SYNC-1]`
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Digest {
    /// Every dot seen.
    pub context: CausalContext,
    /// The dots held, as ascending, maximal runs.
    pub live: Vec<Run>,
}

/// 128 bits over a digest: equal for equal states; different states collide with a chance of about
/// 2⁻¹²⁸ a pair. No protection against an adversary. `[spec: SYNC-4]`
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Fingerprint(pub u128);

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

/// The digest of a state. O(records + runs). `[spec: SYNC-1]`
pub fn digest(state: &State) -> Digest {
    Digest { context: state.context().clone(), live: runs_of(state.records().map(|(dot, _)| dot)).collect() }
}

/// The fingerprint of a state: of the runs of its digest. Peers that compare equal need send nothing
/// else. `[spec: SYNC-4]`
pub fn fingerprint(state: &State) -> Fingerprint {
    digest(state).fingerprint()
}

impl Digest {
    /// See [`fingerprint`].
    pub fn fingerprint(&self) -> Fingerprint {
        // Fixed keys: every replica must compute the same.
        let mut hasher = SipHasher24::new_with_keys(0, 0);
        for part in [self.context.runs().collect(), self.live.clone()] {
            // As bytes: how a hasher writes numbers may depend on the machine.
            hasher.write(&(part.len() as u64).to_le_bytes());
            for run in part {
                hasher.write(&run.replica.agent.to_le_bytes());
                hasher.write(&run.replica.incarnation.to_le_bytes());
                hasher.write(&run.first.to_le_bytes());
                hasher.write(&run.last.to_le_bytes());
            }
        }
        Fingerprint(hasher.finish128().as_u128())
    }

    /// Whether the digest's owner holds a record under `dot`.
    pub fn lives(&self, dot: Dot) -> bool {
        let key = (dot.replica, dot.sequence);
        let after = self.live.partition_point(|run| (run.replica, run.first) <= key);
        self.live[..after].last().is_some_and(|run| run.replica == dot.replica && dot.sequence <= run.last)
    }
}

/// The delta that brings the owner of `theirs` up to `state`: of all states with the same effect in
/// [`State::merge`] the least. `[spec: SYNC-3]`
///
/// It holds the records that they have not seen, and its context is what they have not seen together
/// with what they hold and this state has seen die. Then `A ⊔ Δ = A ⊔ state`, whatever either missed.
/// A join could do with less: it would find by closure some of the deaths that are named here.
///
/// O((records + runs) · log n), however many dots they have missed. Records are shared, not copied.
pub fn delta_for(state: &State, theirs: &Digest) -> Delta {
    let mut delta = Delta::new();
    for missed in state.context().unseen_runs_by(&theirs.context) {
        delta.take_run(state, missed);
    }
    for dead in theirs.live.iter().flat_map(|&live| state.dead_within(live)) {
        delta.observe(dead);
    }
    delta
}
