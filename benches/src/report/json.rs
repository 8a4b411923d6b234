//! For programs.

use crate::error::Result;
use crate::run::Results;
use crate::targets::targets;
use serde_json::{Map, Value, json};

/// `rows`, `growth` and `sizes`; beside them `checker` and `targets`.
pub fn json(results: &Results) -> Result<String> {
    let rows: Vec<Value> = results.rows.iter().filter_map(row).collect();
    let growth: Vec<Value> = results
        .growth
        .iter()
        .map(|curve| {
            let id = if curve.library == "dsr" {
                curve.id.to_owned()
            } else {
                format!("{}/{}", curve.id, curve.library)
            };
            let points: Vec<Value> =
                curve.points.iter().map(|(n, ns)| json!({ "vertices": n, "ns": ns })).collect();
            json!({ "id": id, "exponent": curve.exponent(), "points": points })
        })
        .collect();
    let sizes: Vec<Value> =
        results.sizes.iter().map(|size| json!({ "id": size.id, "bytes": size.bytes })).collect();
    let checker: Vec<Value> = results
        .paces
        .iter()
        .map(|pace| json!({ "id": pace.id, "states_per_second": pace.per_second }))
        .collect();
    let targets: Vec<Value> = targets(results)
        .iter()
        .map(|target| json!({ "target": target.text, "measured": target.measured, "met": target.is_met }))
        .collect();
    let all =
        json!({ "rows": rows, "growth": growth, "sizes": sizes, "checker": checker, "targets": targets });
    Ok(serde_json::to_string_pretty(&all)?)
}

fn row(row: &crate::run::Row) -> Option<Value> {
    let (ours, peers) = row.times.split_first()?;
    let peers: Map<String, Value> =
        peers.iter().map(|peer| (peer.library.to_owned(), json!(peer.ns()))).collect();
    Some(json!({
        "id": row.question.id,
        "ours_ns": ours.ns(),
        "peers": peers,
        "best_peer": row.ratio.as_ref().map(|ratio| ratio.peer),
        "ratio_to_best_peer": row.ratio.as_ref().map(|ratio| ratio.median),
        "spread": row.ratio.as_ref().map(|ratio| ratio.spread),
        "rounds": ours.rounds_ns.len(),
    }))
}
