//! What the script reads.
//!
//! A trace has more than is drawn: deltas, mutations, setups. A page leaves those out, tells replicas by their
//! position, writes graphs that several replicas start with once, and of a change only what is after it.

use crate::{Content, Origin, PageError, Shown};
use dsr_model::graph::{Change, Element, Graph};
use dsr_model::trace::{Act, Finding, Sent, TraceStep};
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// The data of a page.
#[derive(Serialize)]
pub(crate) struct Data<'c> {
    title: &'c str,
    #[serde(skip_serializing_if = "Option::is_none")]
    report: Option<Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gallery: Option<&'c Value>,
    traces: Vec<Drawn<'c>>,
}

/// What is drawn of a trace.
#[derive(Serialize)]
struct Drawn<'c> {
    title: &'c str,
    #[serde(skip_serializing_if = "Option::is_none")]
    run: Option<&'c str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    row: Option<&'c str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    side: Option<&'static str>,
    semantics: &'c str,
    layer: &'c str,
    bound: &'c str,
    replicas: Vec<&'c str>,
    /// Different graphs at the start.
    graphs: Vec<&'c Graph>,
    /// Which of them each replica starts with.
    starts: Vec<usize>,
    steps: Vec<Step<'c>>,
    finding: &'c Finding,
}

#[derive(Serialize)]
struct Step<'c> {
    who: usize,
    does: Value,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    changes: Vec<(&'c str, Option<&'c Element>)>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    remarks: Vec<(&'c str, bool)>,
    state: &'c str,
}

impl<'c> Data<'c> {
    /// The data of sound traces; others are refused.
    pub(crate) fn of(content: &'c Content) -> Result<Self, PageError> {
        Ok(Self {
            title: &content.title,
            report: content.report.as_ref().map(with_properties_once),
            gallery: content.gallery.as_ref(),
            traces: content.traces.iter().map(drawn).collect::<Result<_, _>>()?,
        })
    }
}

fn drawn(shown: &Shown) -> Result<Drawn<'_>, PageError> {
    let trace = &shown.trace;
    trace.check().map_err(|why| PageError::Unsound { title: trace.title.clone(), why })?;
    let mut graphs: Vec<&Graph> = Vec::new();
    let starts = trace.replicas.iter().map(|replica| {
        let known = graphs.iter().position(|graph| **graph == replica.starts);
        known.unwrap_or_else(|| {
            graphs.push(&replica.starts);
            graphs.len() - 1
        })
    });
    let starts = starts.collect();
    let (run, row, side) = match &shown.origin {
        Origin::Alone => (None, None, None),
        Origin::Run(run) => (Some(&**run), None, None),
        Origin::Row { row, side } => (None, Some(&**row), Some(side.word())),
    };
    let replicas: Vec<&str> = trace.replicas.iter().map(|replica| &*replica.name).collect();
    let steps = trace.steps.iter().map(|step| drawn_step(step, &replicas)).collect();
    Ok(Drawn {
        title: &trace.title,
        run,
        row,
        side,
        semantics: &trace.semantics,
        layer: &trace.layer,
        bound: &trace.bound,
        graphs,
        starts,
        steps,
        replicas,
        finding: &trace.finding,
    })
}

fn drawn_step<'c>(step: &'c TraceStep, replicas: &[&str]) -> Step<'c> {
    let mut changes = Vec::new();
    let mut remarks = Vec::new();
    for change in &step.changes {
        match change {
            Change::Element { element, after, .. } => changes.push((&**element, after.as_ref())),
            Change::Remark { remark, holds } => remarks.push((&**remark, *holds)),
        }
    }
    let who = replicas.iter().position(|name| *name == step.replica).unwrap_or_default();
    Step { who, does: drawn_act(&step.does), changes, remarks, state: &step.state }
}

/// An act in the form of the trace format, without mutations and deltas.
fn drawn_act(act: &Act) -> Value {
    let sends = |sends: &[Sent]| -> Vec<Value> {
        sends.iter().map(|sent| json!({ "message": sent.message, "text": sent.text })).collect()
    };
    match act {
        Act::Mutate { text, sends: sent, .. } => json!({ "mutate": { "text": text, "sends": sends(sent) } }),
        Act::Answer { to, sends: sent } => json!({ "answer": { "to": to, "sends": sends(sent) } }),
        Act::Deliver { message, again } => json!({ "deliver": { "message": message, "again": again } }),
        Act::Lose { message } => json!({ "lose": { "message": message } }),
        Act::Restart { keeps } => json!({ "restart": { "keeps": keeps } }),
        Act::Happen { text } => json!({ "happen": { "text": text } }),
    }
}

/// A report in which runs tell their properties by position in one list: most runs have the same.
fn with_properties_once(report: &Value) -> Value {
    let mut report = report.clone();
    let mut known: BTreeMap<String, usize> = BTreeMap::new();
    let mut properties = Vec::new();
    let runs = report.get_mut("runs").and_then(Value::as_array_mut);
    for of_run in runs.into_iter().flatten().filter_map(|run| run.get_mut("properties")) {
        for property in of_run.as_array_mut().into_iter().flatten() {
            let at = *known.entry(property.to_string()).or_insert_with(|| {
                properties.push(property.clone());
                properties.len() - 1
            });
            *property = at.into();
        }
    }
    if let Some(report) = report.as_object_mut() {
        report.insert("properties".into(), properties.into());
    }
    report
}
