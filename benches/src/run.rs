//! Everything that is measured in one run.

use crate::checker::{self, Pace};
use crate::contest::{Patience, Ratio, Times, hold, ratio};
use crate::error::{BenchError, Result};
use crate::growth::{self, Curve};
use crate::libraries::Dsr;
use crate::questions::{self, Question, is_meant};
use crate::scene::Scene;
use crate::sizes::{self, Size};

/// How much is measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Extent {
    /// Every question once: tests of the measuring itself.
    Once,
    /// In under three minutes; growth to 10⁵ vertices.
    Quick,
    /// In five minutes or so of the processor; growth to 10⁶ vertices.
    Full,
}

impl Extent {
    fn patience(self, question: &Question) -> Patience {
        match (self, question.heavy) {
            (Self::Once, _) => Patience { seconds: 0.0, rounds_min: 1, rounds_max: 1 },
            (Self::Quick, false) => Patience { seconds: 0.7, rounds_min: 7, rounds_max: 60 },
            (Self::Quick, true) => Patience { seconds: 1.0, rounds_min: 3, rounds_max: 40 },
            (Self::Full, false) => Patience { seconds: 3.0, rounds_min: 15, rounds_max: 200 },
            (Self::Full, true) => Patience { seconds: 5.0, rounds_min: 7, rounds_max: 100 },
        }
    }

    /// The largest graphs of growth curves: ours, and the peers'.
    fn largest(self) -> (usize, usize) {
        match self {
            Self::Once => (1000, 100),
            Self::Quick => (100_000, 10_000),
            Self::Full => (1_000_000, 100_000),
        }
    }
}

/// A question with what it gave.
#[derive(Clone, Debug)]
pub struct Row {
    /// The question.
    pub question: Question,
    /// What the sides needed; ours is the first.
    pub times: Vec<Times>,
    /// Ours against the best peer.
    pub ratio: Option<Ratio>,
}

/// What a run has measured.
#[derive(Clone, Debug, Default)]
pub struct Results {
    /// Questions.
    pub rows: Vec<Row>,
    /// Growth with the graph.
    pub growth: Vec<Curve>,
    /// Bytes.
    pub sizes: Vec<Size>,
    /// The checker's speed.
    pub paces: Vec<Pace>,
}

/// The parts that are no questions, by the names that patterns mean.
pub const PARTS: [(&str, &str); 4] = [
    ("growth", "how times grow from 10² vertices up"),
    ("sizes", "bytes of every delta on the wire"),
    ("memory", "bytes per vertex in memory"),
    ("checker", "states per second in the checker"),
];

/// Measures what a pattern means, beside all peers or some; tells what it does next.
pub fn run(
    extent: Extent,
    pattern: &str,
    peers: Option<&[String]>,
    mut tell: impl FnMut(&str),
) -> Result<Results> {
    let mut results = Results::default();
    let mut is_any = false;
    let is_wanted = |library: &str| {
        library == Dsr::NAME || peers.is_none_or(|peers| peers.iter().any(|peer| peer == library))
    };
    for question in questions::all().into_iter().filter(|question| is_meant(pattern, question.id)) {
        tell(question.id);
        is_any = true;
        let turns = if extent == Extent::Once { question.turns.min(10) } else { question.turns };
        let question = Question { turns, ..question };
        let mut sides = (question.sides)(&question, &is_wanted)?;
        let times = hold(&mut sides, extent.patience(&question))?;
        results.rows.push(Row { question, ratio: ratio(&times), times });
    }
    for (part, _) in PARTS.into_iter().filter(|(part, _)| is_meant(pattern, part)) {
        tell(part);
        is_any = true;
        match part {
            "growth" => {
                let (largest, peers_largest) = extent.largest();
                results.growth = growth::curves(largest, peers_largest)?;
            }
            "sizes" => results.sizes.extend(sizes::wire()?),
            "memory" => results.sizes.extend(sizes::memory()?),
            _ => results.paces = checker::paces()?,
        }
    }
    if is_any { Ok(results) } else { Err(BenchError::NoQuestion { pattern: pattern.into() }) }
}
