//! How times grow with the graph: from 10² vertices up, ten times each.

use crate::contest::median;
use crate::error::Result;
use crate::libraries::{AutomergeScene, Crdts, Dsr, Loro, Yrs};
use crate::noise::Noise;
use crate::scene::{Content, Link, Plan, Scene, Tree};
use crate::stopwatch::time;
use std::hint::black_box;

/// Times by size, and the exponent that fits them.
#[derive(Clone, Debug)]
pub struct Curve {
    /// What is measured, such as `apply/spread`.
    pub id: &'static str,
    /// The library.
    pub library: &'static str,
    /// Vertices, and nanoseconds per operation.
    pub points: Vec<(usize, f64)>,
}

impl Curve {
    /// The *e* of *c·nᵉ* that fits best, by least squares of the logarithms; NaN of less than two sizes.
    #[allow(clippy::cast_precision_loss, reason = "sizes are small")]
    pub fn exponent(&self) -> f64 {
        let logs: Vec<(f64, f64)> = self.points.iter().map(|&(n, ns)| ((n as f64).ln(), ns.ln())).collect();
        let count = logs.len() as f64;
        let (x, y) = logs.iter().fold((0.0, 0.0), |(x, y), log| (x + log.0 / count, y + log.1 / count));
        let covariance: f64 = logs.iter().map(|log| (log.0 - x) * (log.1 - y)).sum();
        let variance: f64 = logs.iter().map(|log| (log.0 - x).powi(2)).sum();
        covariance / variance
    }
}

/// What is measured: its name, and what it means.
pub const ASKED: [(&str, &str); 9] = [
    ("apply/hot", "a delta of one attribute is joined; writes go to 8 vertices in turn"),
    ("apply/spread", "a delta of one attribute is joined; writes go to vertices all over the graph"),
    ("update/hot", "one number of one of 8 vertices is set; the delta is bytes"),
    ("update/spread", "one number of a vertex anywhere is set; the delta is bytes"),
    ("vertex", "a vertex is added below one anywhere; the delta is bytes"),
    ("edge", "an edge between two vertices anywhere is added; the delta is bytes"),
    ("move", "a leaf is moved; the delta is bytes"),
    ("name", "a vertex is found by its name"),
    ("snapshot", "a snapshot is taken, and dropped"),
];

const TURNS: usize = 500;
const ROUNDS: usize = 9;
const HOT: usize = 8;

/// The curves of ours, and those of the peers for deltas of one attribute, to `largest` vertices.
///
/// `peers_largest` bounds the peers: their histories grow with every turn.
pub fn curves(largest: usize, peers_largest: usize) -> Result<Vec<Curve>> {
    let mut curves: Vec<Curve> =
        ASKED.iter().map(|&(id, _)| Curve { id, library: Dsr::NAME, points: Vec::new() }).collect();
    for n in sizes(largest) {
        for (curve, ns) in curves.iter_mut().zip(ours(n)?) {
            curve.points.push((n, ns));
        }
    }
    curves.push(peer::<Yrs>(peers_largest)?);
    curves.push(peer::<Loro>(peers_largest)?);
    curves.push(peer::<AutomergeScene>(peers_largest)?);
    curves.push(peer::<Crdts>(peers_largest)?);
    Ok(curves)
}

fn sizes(largest: usize) -> impl Iterator<Item = usize> {
    std::iter::successors(Some(100), |n| Some(n * 10)).take_while(move |&n| n <= largest)
}

fn rounds(mut round: impl FnMut(usize) -> Result<f64>) -> Result<f64> {
    round(0)?;
    let times: Vec<f64> = (1..=ROUNDS).map(&mut round).collect::<Result<_>>()?;
    Ok(median(&times))
}

/// Who is written in a round: vertices all over the graph, others in each round; or few.
fn targets(n: usize, round: usize, is_hot: bool) -> Vec<usize> {
    let mut noise = Noise::new(round as u64);
    (0..TURNS).map(|turn| if is_hot { turn % HOT * (n / HOT) } else { noise.below(n) }).collect()
}

fn number(round: usize, turn: usize) -> Content {
    #[allow(clippy::cast_precision_loss, reason = "rounds and turns are few")]
    Content::Double((round * TURNS + turn) as f64 + 0.1)
}

fn apply<S: Scene>(author: &mut S, reader: &mut S, n: usize, is_hot: bool) -> Result<f64> {
    rounds(|round| {
        let targets = targets(n, round, is_hot);
        let set = |turn: usize| author.set(targets[turn], &number(round, turn));
        let messages: Vec<Vec<u8>> = (0..TURNS).map(set).collect::<Result<_>>()?;
        time(TURNS, |turn| reader.apply(&messages[turn]))
    })
}

fn update<S: Scene>(author: &mut S, n: usize, is_hot: bool) -> Result<f64> {
    rounds(|round| {
        let targets = targets(n, round, is_hot);
        time(TURNS, |turn| {
            black_box(author.set(targets[turn], &number(round, turn))?);
            Ok(())
        })
    })
}

fn pair<S: Scene>(plan: &Plan) -> Result<(S, S)> {
    let mut author = S::empty(1)?;
    author.populate(plan)?;
    let mut reader = S::load(2, &author.save()?)?;
    reader.find(plan)?;
    Ok((author, reader))
}

fn peer<S: Scene>(largest: usize) -> Result<Curve> {
    let mut points = Vec::new();
    for n in sizes(largest) {
        let (mut author, mut reader) = pair::<S>(&Plan::tree("vertex-", n, 10))?;
        points.push((n, apply(&mut author, &mut reader, n, false)?));
    }
    Ok(Curve { id: "apply/spread", library: S::NAME, points })
}

/// An edge anywhere; those of one round are different, however small the graph.
fn link(plan: &Plan, at: usize) -> Link {
    /// A prime that is no factor of a size.
    const STRIDE: usize = 7919;
    let n = plan.names.len();
    let from = at * STRIDE % n;
    Link::new(plan, from, (from + n / 2 + at / n % (n / 2)) % n)
}

/// In the order of [`ASKED`].
fn ours(n: usize) -> Result<[f64; ASKED.len()]> {
    let plan = Plan::tree("vertex-", n, 10);
    let (mut author, mut reader) = pair::<Dsr>(&plan)?;
    let apply_hot = apply(&mut author, &mut reader, n, true)?;
    let apply_spread = apply(&mut author, &mut reader, n, false)?;
    drop(reader);
    let (update_hot, update_spread) = (update(&mut author, n, true)?, update(&mut author, n, false)?);
    let edge = rounds(|round| {
        let links: Vec<Link> = (0..TURNS).map(|turn| link(&plan, round * TURNS + turn)).collect();
        let ns = time(TURNS, |turn| {
            black_box(author.add_edge(&links[turn])?);
            Ok(())
        })?;
        for link in &links {
            author.remove_edge(link)?;
        }
        Ok(ns)
    })?;
    let movement = rounds(|round| {
        // Leaves below the first vertices, there and back.
        time(TURNS, |turn| {
            let vertex = n - 1 - turn / 2 % (n / 4);
            let parent = if turn % 2 == 0 { 1 + round % 2 } else { plan.parents[vertex].unwrap_or(0) };
            if parent != plan.parents[vertex].unwrap_or(0) || turn % 2 == 1 {
                black_box(author.move_below(vertex, parent)?);
            }
            Ok(())
        })
    })?;
    let name = rounds(|round| {
        let targets = targets(n, round, false);
        let replica = author.replica();
        time(TURNS, |turn| {
            black_box(replica.vertex_by_name(&plan.names[targets[turn]]));
            Ok(())
        })
    })?;
    let snapshot = rounds(|_| {
        let replica = author.replica();
        time(TURNS, |_| {
            drop(black_box(replica.snapshot()));
            Ok(())
        })
    })?;
    let names: Vec<String> = (0..(ROUNDS + 1) * TURNS).map(|at| format!("new-{at}")).collect();
    let vertex = rounds(|round| {
        let targets = targets(n, round, false);
        time(TURNS, |turn| {
            black_box(author.add_vertex(&names[round * TURNS + turn], targets[turn])?);
            Ok(())
        })
    })?;
    Ok([apply_hot, apply_spread, update_hot, update_spread, vertex, edge, movement, name, snapshot])
}
