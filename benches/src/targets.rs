//! What ours is to reach, and what it has reached.

use crate::checker::fast_by_reference;
use crate::contest::{Times, against};
use crate::run::{Results, Row};

/// A target with its measurement.
#[derive(Clone, Debug)]
pub struct Target {
    /// What is to be reached.
    pub text: &'static str,
    /// What is measured, in words.
    pub measured: String,
    /// Whether it is reached.
    pub is_met: bool,
}

/// Libraries that encode the delta of a mutation themselves.
const ENCODE: [&str; 3] = ["yrs", "loro", "automerge"];

/// The targets that the results tell of.
pub fn targets(results: &Results) -> Vec<Target> {
    let faster = |text, id, least, peers: &[&str]| {
        let (peer, median, [low, high]) = best(row(results, id)?, peers)?;
        let measured = format!("{median:.2} × {peer} ({low:.2} to {high:.2})");
        Some(Target { text, measured, is_met: median >= least })
    };
    let bytes = |text, id: &str, most| {
        let size = results.sizes.iter().find(|size| size.id == id)?;
        Some(Target { text, measured: format!("{} bytes", size.bytes), is_met: size.bytes <= most })
    };
    let exponent = |text, id, most| {
        let curve = results.growth.iter().find(|curve| curve.id == id && curve.library == "dsr")?;
        let (exponent, last) = (curve.exponent(), curve.points.last()?.0);
        let measured = format!("{exponent:.3} up to {last} vertices");
        Some(Target { text, measured, is_met: exponent <= most })
    };
    let huge = || {
        let ns = |id| Some(row(results, id)?.times.first()?.ns());
        let ratio = ns("update/5MB/unencoded")? / ns("update/f64/unencoded")?;
        let measured = format!("{ratio:.2} × the small one");
        Some(Target { text: "5 MB attribute within 2 × of a small one", measured, is_met: ratio <= 2.0 })
    };
    let checker = || {
        let ratio = fast_by_reference(&results.paces)?;
        let measured = format!("{ratio:.2} × the reference");
        Some(Target {
            text: "checker on the fast replica 2 × the reference", measured, is_met: ratio >= 2.0
        })
    };
    [
        faster("small update with bytes 5 × the fastest peer that encodes", "update/f64", 5.0, &ENCODE),
        faster("small apply of bytes 5 × the fastest peer that encodes", "apply/f64", 5.0, &ENCODE),
        bytes("delta of one f64 at most 40 bytes", "delta/f64/dsr", 40),
        faster("move with bytes faster than loro's", "move", 1.0, &["loro"]),
        faster("apply of a move faster than loro's", "move/apply", 1.0, &["loro"]),
        huge(),
        exponent("apply of a one-attribute delta grows with exponent ≤ 0.1", "apply/hot", 0.1),
        exponent("the same with writes all over the graph", "apply/spread", 0.1),
        faster(
            "join of the states of 2 × 100,000 vertices 5 × the fastest peer",
            "join/100000/states",
            5.0,
            &[],
        ),
        faster("the same with indexes, view and changes", "join/100000", 5.0, &[]),
        bytes("delta of a pose at most 80 bytes", "delta/pose, published names/dsr", 80),
        bytes("delta of a removed vertex at most 24 bytes", "delta/remove vertex/dsr", 24),
        bytes("delta of a removed edge at most 24 bytes", "delta/remove edge/dsr", 24),
        bytes("at most 400 bytes in memory per vertex with one edge", "memory/vertex/dsr", 400),
        checker(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn row<'r>(results: &'r Results, id: &str) -> Option<&'r Row> {
    results.rows.iter().find(|row| row.question.id == id)
}

/// Ours against the best of some peers, or of all if none is named.
fn best(row: &Row, peers: &[&str]) -> Option<(&'static str, f64, [f64; 2])> {
    let (ours, others) = row.times.split_first()?;
    let meant = |times: &&Times| peers.is_empty() || peers.contains(&times.library);
    let best = others.iter().filter(meant).min_by(|l, r| l.ns().total_cmp(&r.ns()))?;
    let ratio = against(ours, best)?;
    Some((ratio.peer, ratio.median, ratio.spread))
}
