//! What the layers of the suite judge, kept in `data/judged.json` for readers that do not run it, and held to the code.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use dsr_core::Dictionary;
use dsr_core::scene::{FLAT, Scene, Strictness};
use dsr_model::job::Job;
use dsr_model::suite::{FLAT_FOCUS, Subject};
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// The jobs of `dsr check`, and walks.
fn jobs() -> Vec<Box<dyn Job>> {
    let dictionary = Dictionary::aal();
    let scene = Scene::read(FLAT, &dictionary, Strictness::Strict).unwrap().scene;
    let subject = Subject { state: &scene.state, dictionary: &dictionary, names: &FLAT_FOCUS };
    let mut jobs = subject.suite(false, None, |_| true).unwrap();
    jobs.extend(subject.walks(1, 1, false).unwrap().into_iter().map(|run| -> Box<dyn Job> { Box::new(run) }));
    jobs
}

/// A layer's runs in order, and each clause that it judges with what it says of it.
type Layer = (Vec<String>, Vec<(&'static str, &'static str)>);

/// What is behind a layer's name where only some of its runs ask both cores.
const BOTH: &str = " (both cores)";

/// Each layer; all runs of one must judge the same. Runs that ask both cores beside runs that do not are a layer of their own.
fn layers() -> BTreeMap<String, Layer> {
    let mut layers: BTreeMap<String, Layer> = BTreeMap::new();
    for job in jobs() {
        let clauses: Vec<_> = job.clauses().iter().map(|clause| (clause.id, clause.what)).collect();
        let mut name = job.layer().to_owned();
        if job.name().ends_with("both cores")
            && layers.get(&name).is_some_and(|(_, judged)| *judged != clauses)
        {
            name += BOTH;
        }
        let (runs, judged) = layers.entry(name).or_insert_with(|| (Vec::new(), clauses.clone()));
        assert_eq!(*judged, clauses, "{} judges something else than the runs before it", job.name());
        // A walk's seed is no bound.
        runs.push(job.name().split(", seed").next().unwrap().to_owned());
    }
    layers
}

/// One line for each run and each clause.
fn written() -> String {
    let mut text = String::from("{\n  \"layers\": [\n");
    let layers = layers();
    let last = layers.len() - 1;
    for (at, (layer, (runs, clauses))) in layers.into_iter().enumerate() {
        let lines = |items: Vec<serde_json::Value>| {
            items.iter().map(|item| format!("        {item}")).collect::<Vec<_>>().join(",\n")
        };
        let runs = lines(runs.into_iter().map(|run| json!(run)).collect());
        let clauses = lines(
            clauses.into_iter().map(|(clause, what)| json!({ "clause": clause, "says": what })).collect(),
        );
        let comma = if at == last { "" } else { "," };
        let _ = write!(
            text,
            "    {{\n      \"layer\": {},\n      \"runs\": [\n{runs}\n      ],\n      \"judges\": [\n{clauses}\n      ]\n    \
             }}{comma}\n",
            json!(layer)
        );
    }
    text + "  ]\n}\n"
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).into()
}

/// Set `DSR_WRITE=1` to write the file anew. `[spec: CHECK-2]` `[spec: CHECK-13]`
#[test]
fn law_the_list_of_what_is_judged_is_current() {
    let file = folder().join("data/judged.json");
    if std::env::var_os("DSR_WRITE").is_some() {
        std::fs::write(&file, written()).unwrap();
    }
    let found = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(found == written(), "model/data/judged.json is out of date: run this test with DSR_WRITE=1");
    serde_json::from_str::<serde_json::Value>(&found).unwrap();
}

/// What the judges' own files name: `Breach::new("…"`, what is handed to a comparison, and the clauses of the core's violations.
fn named(folders: &[&str]) -> BTreeSet<String> {
    let mut files: Vec<PathBuf> = Vec::new();
    for name in folders {
        let inside = std::fs::read_dir(folder().join("src").join(name)).unwrap();
        files.extend(inside.map(|entry| entry.unwrap().path()).filter(|path| path.is_file()));
    }
    let mut clauses = BTreeSet::new();
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let literal = |opening: &str| -> Vec<String> {
            let starts = text.split(opening).skip(1);
            starts.filter_map(|rest| rest.split('"').nth(1)).map(Into::into).collect()
        };
        clauses.extend(literal("Breach::new("));
        clauses.extend(literal("compare::shown("));
        if file.ends_with("checked/mod.rs") {
            clauses.extend(literal("Violation::").into_iter().filter(|word| word.contains('-')));
        }
    }
    // Where the call has a variable, the next literal is another one.
    let of_clause = |byte: u8| byte.is_ascii_uppercase() || byte.is_ascii_digit() || b"-.".contains(&byte);
    clauses.retain(|word| word.contains('-') && word.bytes().all(of_clause));
    clauses
}

/// Every clause that a judge can name is listed, and nothing is listed that no judge names: but for what the
/// comparison of engines says, which is about the search itself (CHECK-9).
#[test]
fn law_what_is_listed_is_what_judges_name() {
    let listed: BTreeSet<String> = layers()
        .into_iter()
        .filter(|(layer, _)| ["L1", "L2", "L3", "scenario"].contains(&layer.trim_end_matches(BOTH)))
        .flat_map(|(_, (_, clauses))| clauses)
        .map(|(clause, _)| clause.to_owned())
        .collect();
    let mut named = named(&["checked", "course", "histories", "scenario", "schedules", "search", "twin"]);
    assert!(named.remove("CHECK-9"));
    assert_eq!(listed, named);
}
