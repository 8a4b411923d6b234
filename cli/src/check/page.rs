//! The result as a page.

use super::about::About;
use crate::page::{self, Refusal};
use dsr_explorer::{Content, Origin, Shown};
use dsr_model::trace::Trace;
use dsr_model::verdict::{RunReport, RunTrace, Verdict};
use serde_json::{Value, json};
use std::path::Path;

/// Writes a page with the runs and their counterexamples.
pub(super) fn write(
    path: &Path,
    runs: &[RunReport],
    verdict: Verdict,
    seconds: f64,
    about: &About,
) -> Result<(), Refusal> {
    page::write(path, &content(runs, verdict, seconds, about))
}

fn content(runs: &[RunReport], verdict: Verdict, seconds: f64, about: &About) -> Content {
    let mut traces = Vec::new();
    let mut texts = Vec::new();
    for run in runs {
        for example in run.traces.iter().chain(&run.witnesses) {
            match drawn(example) {
                Some(trace) => traces.push(Shown { trace, origin: Origin::Run(run.name.clone()) }),
                None => texts.push(text(run, example)),
            }
        }
    }
    let report = json!({
        "verdict": verdict,
        "seconds": seconds,
        "runs": runs,
        "assumed": about.assumed,
        "not_checked": about.not_checked,
        "not_applicable": about.not_applicable,
        "examples": texts,
    });
    Content { title: "What the check found".into(), report: Some(report), gallery: None, traces }
}

/// A counterexample as a trace, if it is one: those of the algebra are states, not runs.
fn drawn(example: &RunTrace) -> Option<Trace> {
    serde_json::from_value(example.json.clone()).ok()
}

fn text(run: &RunReport, example: &RunTrace) -> Value {
    json!({ "layer": run.layer, "run": run.name, "clause": example.clause, "text": example.text })
}
