//! Sessions broken on purpose: the alarms of the simulation.

/// What is broken.
#[cfg_attr(not(feature = "simulation"), allow(unreachable_pub, reason = "then nobody sees it"))]
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Flaw {
    /// Never asks for what is missing.
    ForgetsToWant,
    /// Sends a digest without what lives: a context alone. `[spec: SYNC-2]`
    ContextAsDigest,
    /// Takes no digest when what it lacks is gone.
    GoneIsIgnored,
    /// Takes no digest when a buffer had no room.
    DropsSilently,
    /// Puts the parts of a message together in the wrong order.
    PartsReversed,
    /// Uses its agent id at once, and hears no objection.
    ClaimsWithoutWaiting,
}

#[cfg(feature = "simulation")]
impl Flaw {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::ForgetsToWant,
        Self::ContextAsDigest,
        Self::GoneIsIgnored,
        Self::DropsSilently,
        Self::PartsReversed,
        Self::ClaimsWithoutWaiting,
    ];
}
