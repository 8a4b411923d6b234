//! The measuring, measured: nothing here depends on time.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

mod deaf;

use deaf::Deaf;
use dsr_benches::contest::{Side, Times, median, ratio};
use dsr_benches::error::{BenchError, Result};
use dsr_benches::growth::{ASKED, Curve};
use dsr_benches::questions::{
    Question, all, attribute, element, is_meant, join, kinematic, movement, reconcile,
};
use dsr_benches::report::{json, markdown, plots, text};
use dsr_benches::run::{Extent, PARTS, Results, run};
use dsr_benches::sizes;
use serde_json::Value;
use std::marker::PhantomData;

/// Every question that takes no minutes without optimisation.
fn light() -> impl Iterator<Item = Question> {
    all().into_iter().filter(|question| !question.id.contains("100000"))
}

fn once() -> Results {
    let mut results = Results::default();
    for question in light() {
        let run = run(Extent::Once, question.id, None, |_| ()).unwrap();
        assert_eq!(run.rows.len(), 1, "{}", question.id);
        results.rows.extend(run.rows);
    }
    for part in ["growth", "sizes"] {
        let run = run(Extent::Once, part, None, |_| ()).unwrap();
        results.growth.extend(run.growth);
        results.sizes.extend(run.sizes);
    }
    results
}

/// Every side does its job, or is an error; and the three forms of the report hold all of it.
#[test]
fn law_every_question_is_answered_and_reported() {
    let results = once();
    for row in &results.rows {
        assert_eq!(row.times[0].library, "dsr", "{}", row.question.id);
        assert!(row.times.len() > 1 && row.ratio.is_some(), "{} has no peer", row.question.id);
        assert!(row.times.iter().all(|times| times.rounds_ns.len() == 1 && times.ns() > 0.0));
    }
    check_json(&results);

    let (text, page) = (text(&results), markdown(&results, "a machine").unwrap());
    for row in &results.rows {
        assert!(text.contains(row.question.id) && page.contains(&format!("| {} |", row.question.id)));
    }
    for (id, _) in ASKED {
        assert!(text.contains(id) && page.contains(id), "{id}");
    }
    let folder = std::env::temp_dir().join(format!("dsr-benches-{}", std::process::id()));
    let files = plots(&results.growth, &folder).unwrap();
    for file in &files {
        let drawn = std::fs::read_to_string(file).unwrap();
        assert!(drawn.starts_with("<svg") && drawn.contains("<polyline"), "{}", file.display());
    }
    assert_eq!(files.len(), 2);
    std::fs::remove_dir_all(folder).unwrap();
}

/// The shape that programs rely on.
fn check_json(results: &Results) {
    let value: Value = serde_json::from_str(&json(results).unwrap()).unwrap();
    let list = |key: &str| value[key].as_array().unwrap().clone();
    assert_eq!(list("rows").len(), results.rows.len());
    for row in list("rows") {
        assert!(row["id"].is_string() && row["ours_ns"].is_number(), "{row}");
        let peers = row["peers"].as_object().unwrap();
        assert!(!peers.is_empty() && peers.values().all(Value::is_number), "{row}");
        let [low, high] = [&row["spread"][0], &row["spread"][1]].map(|bound| bound.as_f64().unwrap());
        let ratio = row["ratio_to_best_peer"].as_f64().unwrap();
        assert!(low <= ratio && ratio <= high, "{row}");
    }
    assert_eq!(list("growth").len(), ASKED.len() + 4);
    assert!(list("growth").iter().all(|curve| curve["id"].is_string() && !curve["exponent"].is_boolean()));
    assert!(list("sizes").iter().all(|size| size["id"].is_string() && size["bytes"].is_u64()));
}

/// Bytes are exact, so their bounds can be tested: where they are, which is below the targets.
#[test]
fn law_deltas_are_as_small_as_stated() {
    let sizes = sizes::wire().unwrap();
    let bytes = |id: &str| sizes.iter().find(|size| size.id == id).unwrap().bytes;
    for (id, most) in [
        ("delta/remove vertex/dsr", 9),
        ("delta/remove edge/dsr", 9),
        ("delta/f64 without a clock/dsr", 26),
        ("delta/f64/dsr", 34),
        ("delta/pose, names of one letter/dsr", 62),
        ("delta/pose, published names/dsr", 58),
        ("delta/move/dsr", 22),
        ("delta/60kB/dsr", 60_030),
        ("delta/5MB/dsr", 5_000_030),
    ] {
        assert!(bytes(id) <= most, "{id}: {}", bytes(id));
    }
}

/// A library that does nothing is nowhere the fastest.
#[test]
fn law_who_does_not_do_the_job_is_told() {
    type Make = fn(&Question, PhantomData<Deaf>) -> Result<Side>;
    let makes: [(&str, Make); 20] = [
        ("update/f64", attribute::update),
        ("update/f64/unencoded", attribute::unencoded),
        ("apply/f64", attribute::apply),
        ("vertex/add", element::add_vertex),
        ("vertex/add/apply", element::apply_vertex),
        ("vertex/remove", element::remove_vertex),
        ("vertex/remove/apply", element::apply_removed_vertex),
        ("edge/add", element::add_edge),
        ("edge/add/apply", element::apply_edge),
        ("edge/remove", element::remove_edge),
        ("edge/remove/apply", element::apply_removed_edge),
        ("move", movement::update),
        ("move/unencoded", movement::unencoded),
        ("move/apply", movement::apply),
        ("kinematic/deep", kinematic::deep),
        ("kinematic/wide", kinematic::wide),
        ("join/1000", join::small),
        ("late-join/1000", join::late_small),
        ("reconcile/1000", reconcile::reconcile),
        ("missing/1000", reconcile::missing),
    ];
    for (id, make) in makes {
        let question = all().into_iter().find(|question| question.id == id).unwrap();
        let answer = make(&question, PhantomData).and_then(|mut side| (side.round)());
        assert!(matches!(answer, Err(BenchError::NotTheJob { library: "deaf", .. })), "{id}: {answer:?}");
    }
}

#[test]
fn law_names_are_unique_and_patterns_mean_them() {
    let mut names: Vec<&str> = all().iter().map(|question| question.id).collect();
    names.extend(PARTS.map(|(part, _)| part));
    let mut sorted = names.clone();
    sorted.sort_unstable();
    sorted.dedup();
    assert_eq!(names.len(), sorted.len());
    for (pattern, id, means) in [
        ("*", "apply/f64", true),
        ("apply/*", "apply/f64", true),
        ("*f64", "apply/f64", true),
        ("a*/*4", "apply/f64", true),
        ("apply/f64", "apply/f64", true),
        ("apply", "apply/f64", false),
        ("*/f6", "apply/f64", false),
        ("move*", "remove", false),
    ] {
        assert_eq!(is_meant(pattern, id), means, "{pattern} {id}");
    }
    let nothing = run(Extent::Once, "no such question", None, |_| ());
    assert!(matches!(nothing, Err(BenchError::NoQuestion { .. })));
}

#[test]
fn oracle_exponents_medians_and_ratios_are_those_of_known_numbers() {
    let points =
        [100, 1000, 10_000].map(|n: usize| (n, 7.0 * f64::from(u32::try_from(n).unwrap()).powf(0.5)));
    let curve = Curve { id: "known", library: "dsr", points: points.into() };
    assert!((curve.exponent() - 0.5).abs() < 1e-9, "{}", curve.exponent());

    assert!((median(&[3.0, 1.0, 2.0]) - 2.0).abs() < 1e-9);
    assert!((median(&[4.0, 1.0, 2.0, 3.0]) - 2.5).abs() < 1e-9);

    let times = |library, rounds: &[f64]| Times { library, rounds_ns: rounds.into() };
    let found = ratio(&[
        times("dsr", &[1.0, 2.0, 1.0]),
        times("slow", &[9.0, 9.0, 9.0]),
        times("fast", &[4.0, 4.0, 5.0]),
    ])
    .unwrap();
    assert_eq!((found.peer, found.median, found.spread), ("fast", 4.0, [2.0, 5.0]));
}

/// The recorded page speaks of the questions that there are.
#[test]
fn law_the_recorded_run_has_every_question() {
    let page = include_str!("../../docs/performance.md");
    let run: Value = serde_json::from_str(include_str!("../../docs/performance/run.json")).unwrap();
    let rows = run["rows"].as_array().unwrap();
    for question in all() {
        assert!(page.contains(&format!("| {} | {} |", question.id, question.asks)), "{}", question.id);
        assert!(rows.iter().any(|row| row["id"] == question.id), "{}", question.id);
    }
    for part in ["growth", "sizes", "checker"] {
        assert!(!run[part].as_array().unwrap().is_empty(), "{part}");
    }
}
