//! Rounds in which all sides take their turns, and what comes out of them.

use crate::error::Result;
use crate::scene::Scene;
use crate::stopwatch::now_ns;

/// One library before one question.
pub struct Side {
    /// The library.
    pub library: &'static str,
    /// A round; nanoseconds per operation in it.
    pub round: Box<dyn FnMut() -> Result<f64>>,
}

impl std::fmt::Debug for Side {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Side").field("library", &self.library).finish_non_exhaustive()
    }
}

impl Side {
    /// A side with its round.
    pub fn of<S: Scene>(round: impl FnMut() -> Result<f64> + 'static) -> Self {
        Self { library: S::NAME, round: Box::new(round) }
    }
}

/// How long to measure.
#[derive(Clone, Copy, Debug)]
pub struct Patience {
    /// Processor time for the rounds of one question, in seconds.
    pub seconds: f64,
    /// The fewest rounds, whatever they take.
    pub rounds_min: usize,
    /// The most rounds.
    pub rounds_max: usize,
}

/// What a library has needed.
#[derive(Clone, Debug)]
pub struct Times {
    /// The library.
    pub library: &'static str,
    /// Nanoseconds per operation of each round.
    pub rounds_ns: Vec<f64>,
}

impl Times {
    /// The median of the rounds.
    pub fn ns(&self) -> f64 {
        median(&self.rounds_ns)
    }
}

/// The median; NaN of nothing.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    match sorted.len() {
        0 => f64::NAN,
        odd if odd % 2 == 1 => sorted[middle],
        _ => f64::midpoint(sorted[middle - 1], sorted[middle]),
    }
}

/// How many times as fast as the best peer ours is.
#[derive(Clone, Debug)]
pub struct Ratio {
    /// The peer with the least median.
    pub peer: &'static str,
    /// The median over the rounds of their time by ours: above 1 ours is faster.
    pub median: f64,
    /// The least and the greatest round.
    pub spread: [f64; 2],
}

/// All rounds of one question. The first side is ours.
pub fn hold(sides: &mut [Side], patience: Patience) -> Result<Vec<Times>> {
    let mut times: Vec<Times> =
        sides.iter().map(|side| Times { library: side.library, rounds_ns: Vec::new() }).collect();
    // Warm up: caches, allocators, branch predictors, and the sides' own lazy parts.
    for side in sides.iter_mut() {
        (side.round)()?;
    }
    let start = now_ns();
    for round in 0..patience.rounds_max {
        if round >= patience.rounds_min && now_ns() - start > patience.seconds * 1e9 {
            break;
        }
        for (side, times) in sides.iter_mut().zip(&mut times) {
            times.rounds_ns.push((side.round)()?);
        }
    }
    Ok(times)
}

/// Ours, the first, against the best of the others, if there is one.
pub fn ratio(times: &[Times]) -> Option<Ratio> {
    let (ours, peers) = times.split_first()?;
    let best = peers.iter().min_by(|l, r| l.ns().total_cmp(&r.ns()))?;
    against(ours, best)
}

/// Ours against one peer, round by round.
pub fn against(ours: &Times, peer: &Times) -> Option<Ratio> {
    let ratios: Vec<f64> =
        peer.rounds_ns.iter().zip(&ours.rounds_ns).map(|(theirs, ours)| theirs / ours).collect();
    let least = ratios.iter().copied().min_by(f64::total_cmp)?;
    let greatest = ratios.iter().copied().max_by(f64::total_cmp)?;
    Some(Ratio { peer: peer.library, median: median(&ratios), spread: [least, greatest] })
}
