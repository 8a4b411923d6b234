//! What happens when: drawn from a seed, as data, so that it can be shrunk.

use super::dice::Dice;
use crate::config::{MS, SECOND};
use crate::flaw::Flaw;
use crate::memory::Faults;
use std::fmt;

/// One thing that happens.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Step {
    /// A session mutates; `choice` says how.
    Mutate {
        /// Which.
        node: usize,
        /// Any number.
        choice: u64,
    },
    /// A session writes an image of so many bytes.
    Image {
        /// Which.
        node: usize,
        /// Its bytes.
        bytes: usize,
    },
    /// A session mutates many times at once, or writes many images.
    Burst {
        /// Which.
        node: usize,
        /// Any number.
        choice: u64,
        /// How often.
        count: usize,
    },
    /// The network is cut in two: the nodes whose bit is set, and the others.
    Partition {
        /// Bits of nodes.
        side: u64,
    },
    /// The network is whole again.
    Heal,
    /// A session is killed; it forgets everything.
    Crash {
        /// Which.
        node: usize,
    },
    /// A session that is not there starts, with nothing, as its next incarnation.
    Start {
        /// Which.
        node: usize,
    },
    /// A session leaves.
    Leave {
        /// Which.
        node: usize,
    },
    /// A clock jumps, forward or back.
    Jump {
        /// Whose.
        node: usize,
        /// By so many milliseconds.
        ms: i64,
    },
    /// A session reads nothing for a while.
    Slow {
        /// Which.
        node: usize,
        /// So many milliseconds.
        ms: u64,
    },
    /// A stranger sends something to the group.
    Hostile {
        /// Any number.
        choice: u64,
    },
    /// A session that is not there starts under the agent id of one that is.
    Impostor {
        /// Which starts.
        node: usize,
        /// Whose id it claims.
        of: usize,
    },
}

/// What is drawn from.
#[derive(Clone, Debug)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "each is one kind of trouble, and any of them may be left out"
)]
pub struct Options {
    /// Fewest nodes.
    pub nodes_min: usize,
    /// Most nodes, at most 64.
    pub nodes_max: usize,
    /// For so long things happen.
    pub span: u64,
    /// So many steps for each node.
    pub steps_each: usize,
    /// Whether the network loses, repeats, reorders, damages, is cut, readers are slow, and clocks jump.
    pub faults: bool,
    /// Whether strangers send what is spelt well and lies.
    pub hostile: bool,
    /// Whether sessions crash, leave, start under ids of others.
    pub deaths: bool,
    /// Whether differing fingerprints lead to digests: without them only what a session knows to be lacking does.
    pub fingerprints: bool,
    /// What is broken in every session.
    pub flaw: Option<Flaw>,
}

impl Options {
    /// All faults, few nodes.
    pub const SMALL: Self = Self {
        nodes_min: 3,
        nodes_max: 7,
        span: 4 * SECOND,
        steps_each: 12,
        faults: true,
        hostile: true,
        deaths: true,
        fingerprints: true,
        flaw: None,
    };

    /// All faults, from 3 to 50 nodes.
    pub const WIDE: Self = Self { nodes_max: 50, steps_each: 8, ..Self::SMALL };
}

/// A run to be carried out.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Plan {
    /// For what is random in sessions and network.
    pub seed: u64,
    /// So many nodes.
    pub nodes: usize,
    /// What the network does until the end of the span.
    pub faults: Faults,
    /// What happens, in order of time.
    pub steps: Vec<(u64, Step)>,
    /// When the network heals, for good.
    pub heal_at: u64,
    /// See [`Options::fingerprints`].
    pub fingerprints: bool,
    /// What is broken in every session.
    pub flaw: Option<Flaw>,
    /// Small buffers, so that they run over.
    pub tight: bool,
}

impl Plan {
    /// Draws a run.
    pub fn draw(seed: u64, options: &Options) -> Self {
        let mut dice = Dice::new(seed);
        let width = (options.nodes_max - options.nodes_min + 1) as u64;
        // Few nodes more often than many.
        let more = dice.below(width).min(dice.below(width));
        let nodes = options.nodes_min + usize::try_from(more).unwrap_or(0);
        let faults = if options.faults { dice.faults() } else { Faults::NONE };
        let tight = dice.below(2) == 0;
        let start = 300 * MS;
        let mut steps = Vec::new();
        for node in 0..nodes {
            // Most start at once, some late.
            let late = dice.below(4) == 0;
            let at = if late { dice.below(options.span) } else { dice.below(100 * MS) };
            steps.push((at, Step::Start { node }));
        }
        for _ in 0..nodes * options.steps_each {
            let at = start + dice.below(options.span);
            let step = dice.step(nodes, options);
            steps.push((at, step));
        }
        if options.flaw == Some(Flaw::ClaimsWithoutWaiting) || options.deaths && dice.below(3) == 0 {
            steps.push((
                start + dice.below(options.span),
                Step::Impostor { node: nodes, of: dice.node(nodes) },
            ));
        }
        steps.sort_by_key(|step| step.0);
        let heal_at = start + options.span + 200 * MS;
        Self {
            seed,
            nodes,
            faults,
            steps,
            heal_at,
            fingerprints: options.fingerprints,
            flaw: options.flaw,
            tight,
        }
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mutate { node, choice } => write!(f, "n{node} mutates ({choice:x})"),
            Self::Image { node, bytes } => write!(f, "n{node} writes an image of {bytes} bytes"),
            Self::Burst { node, choice, count } => write!(f, "n{node} mutates {count} times ({choice:x})"),
            Self::Partition { side } => write!(f, "the network is cut: {side:b}"),
            Self::Heal => write!(f, "the network is whole"),
            Self::Crash { node } => write!(f, "n{node} is killed"),
            Self::Start { node } => write!(f, "n{node} starts with nothing"),
            Self::Leave { node } => write!(f, "n{node} leaves"),
            Self::Jump { node, ms } => write!(f, "the clock of n{node} jumps by {ms} ms"),
            Self::Slow { node, ms } => write!(f, "n{node} reads nothing for {ms} ms"),
            Self::Hostile { choice } => write!(f, "a stranger sends something ({choice:x})"),
            Self::Impostor { node, of } => write!(f, "n{node} starts under the agent id of n{of}"),
        }
    }
}
