//! What a result takes for granted, and what it does not say.

use super::Whose;
use dsr_model::published::suite::NOT_APPLICABLE;

/// What is printed below every result.
#[derive(Debug)]
pub(super) struct About {
    /// What every run takes for granted.
    pub(super) assumed: &'static [&'static str],
    /// What no run shows.
    pub(super) not_checked: &'static [&'static str],
    /// What of the suite does not apply to this semantics, and why.
    pub(super) not_applicable: &'static [&'static str],
}

/// See `spec/network.md`.
const CHECKED: About = About {
    assumed: &[
        "replicas start from the same graph and use the same dictionary",
        "authors follow the specification: no dot is used twice, nobody forges deltas",
        "deltas arrive whole; they may be lost, repeated and reordered without limit",
        "L1 fuses deliveries into mutations; that deltas commute is checked in every delivered subset, not assumed",
        "L1 judges sets of deltas once that differ in nothing that counts; that is tried on a sample of them (CHECK-11)",
    ],
    not_checked: &[
        "anything beyond the bounds above: more replicas, mutations, or elements in focus",
        "values: one value stands for all, since the semantics compares ranks and never looks into values",
        "duplicate delivery and resynchronisation in L1 beyond sets of two deltas (L0 and L2 judge them in general)",
        "liveness: that deltas do arrive is the transport's task",
        "the proof of the unbounded case: see the claims table in README.md for what is proved and what is not",
    ],
    not_applicable: &[],
};

/// See CHECK-12 in `spec/checker.md`.
const PUBLISHED: About = About {
    assumed: &[
        "replicas start from the same graph, which an agent loaded that has left; nobody joins",
        "what one call sends arrives in one piece and in its order, once; nothing is lost",
        "L1 delivers in any order; L2 keeps the order of each sender, as the published transport does on a topic",
        "clocks are right: a call is later than all that its author has seen",
        "users are careful: no second parent, no circle, no node deleted that carries others, no stale copies",
    ],
    not_checked: &[
        "anything beyond the bounds above; a run stops at its first violation, so each clause is run alone as well",
        "messages of one call that are split, lost or overtaken, clocks that are wrong, ignored attributes: see `dsr gallery`",
        "whether the model is right: it follows a description of the published code and was never compared with it running",
    ],
    not_applicable: &NOT_APPLICABLE,
};

/// What is to be said of a semantics.
pub(super) const fn of(whose: Whose) -> &'static About {
    match whose {
        Whose::Checked => &CHECKED,
        Whose::Published => &PUBLISHED,
    }
}
