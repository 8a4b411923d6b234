//! Which runs the arguments ask for.

use super::{AgentIds, Arguments, CoreName, Layer, VariantName, Whose};
use crate::input::{self, InputError};
use dsr_core::scene::{FLAT, Scene, Strictness};
use dsr_core::{Dictionary, MutationKind};
use dsr_model::histories::Bound;
use dsr_model::job::{AlgebraRun, Job, ScenarioRun};
use dsr_model::published::suite as published_suite;
use dsr_model::published::{Stamps, Variant, Workers};
use dsr_model::scenario::{Scenario, shipped};
use dsr_model::suite::{FLAT_FOCUS, Subject};
use dsr_model::twin::{Core, OnCore};
use std::path::Path;
use std::sync::Arc;

/// Replicas touch this many vertices of a scene unless `--focus` names them.
const FOCUS_DEFAULT: usize = 2;

/// L0 asks both cores of states of at most this many records, unless one is named.
const RECORDS_OF_BOTH: usize = 4;

/// Random walks of a run unless `--walks` says otherwise.
const WALKS: u64 = 1000;
/// The same with `--deep`.
const WALKS_DEEP: u64 = 100_000;

/// Runs, the longest first, so that two cores are busy to the end.
pub(super) fn jobs(arguments: &Arguments) -> Result<Vec<Box<dyn Job>>, String> {
    match arguments.semantics {
        Whose::Published if arguments.core.is_some() => {
            return Err("--core is of the checked semantics: leave out --semantics published".into());
        }
        Whose::Published => return published(arguments),
        Whose::Checked if arguments.variant.is_some() || arguments.agent_id.is_some() => {
            return Err(
                "--variant and --agent-id are of the published semantics: add --semantics published".into()
            );
        }
        Whose::Checked => {}
    }
    if arguments.files.is_empty() {
        if !arguments.focus.is_empty() {
            return Err("--focus needs a scene: name a file, or @flat".into());
        }
        return suite(arguments);
    }
    arguments.files.iter().map(|file| of_file(arguments, file)).collect()
}

/// `[spec: CHECK-12]`
fn published(arguments: &Arguments) -> Result<Vec<Box<dyn Job>>, String> {
    if !arguments.files.is_empty() || !arguments.focus.is_empty() {
        return Err("scenes and scenarios are made of vertices, dictionaries and mutations of the checked semantics, \
                    which the published one has not: with --semantics published leave out FILE and --focus"
            .into());
    }
    if arguments.deep {
        return Err("the published semantics breaks at the least bounds: leave out --deep".into());
    }
    let of_checked = arguments.layer.iter().find_map(|layer| match layer {
        Layer::L0 => Some("L0"),
        Layer::Walks => Some("walks"),
        Layer::Scenario => Some("scenarios"),
        Layer::L1 | Layer::L2 => None,
    });
    if let Some(prefix) = of_checked {
        let reason = published_suite::NOT_APPLICABLE.iter().find(|line| line.starts_with(prefix));
        let reason = reason.copied().unwrap_or(prefix);
        return Err(format!("{reason}; with --semantics published choose from l1,l2"));
    }
    let variant = Variant {
        workers: match arguments.variant.unwrap_or(VariantName::Upstream) {
            VariantName::Upstream => Workers::Several,
            VariantName::Fork => Workers::One,
        },
        stamps: match arguments.agent_id.unwrap_or(AgentIds::Zero) {
            AgentIds::Zero => Stamps::Zero,
            AgentIds::Distinct => Stamps::Author,
        },
    };
    let wanted = |name: &str| {
        let layer = if name == "L1" { Layer::L1 } else { Layer::L2 };
        arguments.layer.is_empty() || arguments.layer.contains(&layer)
    };
    Ok(published_suite::jobs(variant, wanted))
}

fn suite(arguments: &Arguments) -> Result<Vec<Box<dyn Job>>, String> {
    let wanted = |layer: Layer| arguments.layer.is_empty() || arguments.layer.contains(&layer);
    let dictionary = Dictionary::aal();
    let scene = Scene::read(FLAT, &dictionary, Strictness::Strict).map_err(|error| error.to_string())?.scene;
    let subject = Subject { state: &scene.state, dictionary: &dictionary, names: &FLAT_FOCUS };
    let mut jobs: Vec<Box<dyn Job>> = Vec::new();
    // Both cores where that costs little, unless one is named.
    let chosen = arguments.core.map(CoreName::core);
    let core = chosen.unwrap_or(Core::Reference);
    if wanted(Layer::L2) {
        jobs.extend(subject.schedules(chosen.unwrap_or(Core::Both)).map_err(|error| error.to_string())?);
    }
    if wanted(Layer::L1) {
        let histories = if arguments.deep { subject.deep_histories() } else { subject.default_histories() };
        for run in histories.map_err(|error| error.to_string())? {
            jobs.push(run.on(core));
        }
        if chosen.is_none() {
            for run in subject.compared_histories().map_err(|error| error.to_string())? {
                jobs.push(run.on(Core::Both));
            }
        }
    }
    // Never by default: a sample is bounded, and would make the whole suite so.
    if arguments.layer.contains(&Layer::Walks) {
        let (walks, deep) = (if arguments.deep { WALKS_DEEP } else { WALKS }, arguments.deep);
        let runs = subject.walks(arguments.seed, arguments.walks.unwrap_or(walks), deep);
        for run in runs.map_err(|error| error.to_string())? {
            jobs.push(run.on(core));
        }
    }
    if wanted(Layer::L0) {
        let semantics =
            subject.histories(FOCUS_DEFAULT, Bound { replicas: 2, mutations: 1 }, &MutationKind::ALL);
        let semantics = semantics.map_err(|error| error.to_string())?.semantics;
        let records = if arguments.deep { vec![5] } else { vec![4, 3] };
        for records in records {
            let small = records <= RECORDS_OF_BOTH;
            let core = chosen.unwrap_or(if small { Core::Both } else { Core::Reference });
            jobs.push(AlgebraRun { semantics: Arc::clone(&semantics), records }.on(core));
        }
    }
    if wanted(Layer::Scenario) {
        for (file, text) in shipped() {
            let scenario = Scenario::read(text, file).map_err(|error| error.to_string())?;
            jobs.push(Box::new(ScenarioRun { scenario }));
        }
    }
    Ok(jobs)
}

/// A scenario has replicas; everything else is a scene.
fn of_file(arguments: &Arguments, file: &str) -> Result<Box<dyn Job>, String> {
    let is_embedded = file.starts_with('@');
    if !is_embedded && is_scenario(file) {
        let scenario = Scenario::open(Path::new(file)).map_err(|error| error.to_string())?;
        return Ok(Box::new(ScenarioRun { scenario }));
    }
    let explain = |error: InputError| format!("{file}: {error}: {}", error.remedy());
    let dictionary = input::dictionary(&arguments.dictionary)
        .map_err(|error| format!("--dictionary {}: {error}: {}", arguments.dictionary, error.remedy()))?;
    let scene = match input::load(file, &dictionary, Strictness::Strict) {
        Ok(loaded) => loaded.scene,
        Err(InputError::Refused(refused)) => {
            let faults = refused.faults.iter().map(|fault| format!("{file}: {fault}"));
            let lines: Vec<String> =
                faults.chain([format!("{file}: refused; see `dsr scene check {file}`")]).collect();
            return Err(lines.join("\n"));
        }
        Err(error) => return Err(explain(error)),
    };
    let graph = dsr_core::view(&scene.state, &dictionary);
    let first =
        graph.vertices().iter().filter_map(|&vertex| graph.vertex(vertex)).map(|vertex| &*vertex.name);
    let names: Vec<&str> = if arguments.focus.is_empty() {
        first.take(FOCUS_DEFAULT).collect()
    } else {
        arguments.focus.iter().map(String::as_str).collect()
    };
    let subject = Subject { state: &scene.state, dictionary: &dictionary, names: &names };
    let bound = Bound { replicas: arguments.replicas.into(), mutations: arguments.mutations.into() };
    let mut kinds: Vec<MutationKind> = arguments.alphabet.iter().flat_map(|kinds| kinds.0.clone()).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let mut run =
        subject.histories(names.len(), bound, &kinds).map_err(|error| format!("{file}: {error}"))?;
    run.name = format!("{file} [{}]: {}", names.join(", "), run.name);
    Ok(run.on(arguments.core.map_or(Core::Reference, CoreName::core)))
}

fn is_scenario(file: &str) -> bool {
    let Ok(text) = std::fs::read_to_string(file) else { return false };
    match serde_json::from_str::<serde_json::Value>(&text) {
        Ok(json) => json.get("replicas").is_some() || json.get("format").is_some(),
        // Whoever reads it will say where it is broken.
        Err(_) => text.contains("\"replicas\""),
    }
}
