//! Which of the published implementations, and how its users fill it in.

/// How many threads apply what arrives.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Workers {
    /// Five (upstream): what one writer sends on the node or the edge topic may be applied out of order.
    Several,
    /// One (the fork), which also drops more of what it holds back.
    One,
}

/// Which agent new nodes, edges and attributes say they are from.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Stamps {
    /// Agent 0, as the published constructors do.
    Zero,
    /// Their author, as a careful user does. Poses, `parent` and `level` say 0 all the same.
    Author,
}

/// A variant of the published semantics.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Variant {
    /// Upstream or the fork.
    pub workers: Workers,
    /// Who new things say they are from.
    pub stamps: Stamps,
}

impl Variant {
    /// Upstream, with its constructors as they are.
    pub const UPSTREAM: Self = Self { workers: Workers::Several, stamps: Stamps::Zero };
    /// Upstream, with careful users.
    pub const STAMPED: Self = Self { workers: Workers::Several, stamps: Stamps::Author };
    /// The fork, with its constructors as they are.
    pub const FORK: Self = Self { workers: Workers::One, stamps: Stamps::Zero };
}
