//! Flaws of the checker's own: shapes of sets that tell too little. `[spec: CHECK-11]`
//!
//! The core is sound here. What is wrong is what the search concludes from it, and would pass over in silence.

use super::Flaw;
use crate::semantics::{Competition, Judged};

/// No two deltas are taken to compete.
#[derive(Debug)]
pub(super) struct RanksUntold;

impl Flaw for RanksUntold {
    fn competition(&self, _: Competition) -> Competition {
        Competition::Never
    }
}

/// Registers are taken to decide for themselves, always.
#[derive(Debug)]
pub(super) struct EntanglementUntold;

impl Flaw for EntanglementUntold {
    fn judged(&self, judged: Judged) -> Judged {
        Judged { entangled: false, ..judged }
    }
}

/// No rank is taken to decide anything.
#[derive(Debug)]
pub(super) struct OrderUntold;

impl Flaw for OrderUntold {
    fn judged(&self, judged: Judged) -> Judged {
        Judged { entangled: false, order_sensitive: false, ..judged }
    }
}
