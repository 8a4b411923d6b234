//! `dsr scene convert`.

use super::Reading;
use crate::input::{FILE_HELP, Form};
use crate::output::{err, out_bytes};
use crate::status::Status;
use dsr_core::scene::{RootNaming, Scene};
use dsr_core::{Dictionary, encode, limits};

pub(super) const AFTER: &str = "\
What IN holds is told by its content. The form of OUT is --to, or by its name: `.state.json` is a state as \
JSON, any other `.json` a scene, `.dsr` a binary state. OUT `-` is standard output.

A scene holds what the graph shows; a state holds every record and the causal context, but not the root's own \
name and id. What a form cannot hold is listed on standard error.

Exit status: 0 written, 3 otherwise. Scenes are limited to 64 MiB, states to 1 GiB.";

#[derive(clap::Args, Debug)]
pub(crate) struct Arguments {
    #[arg(value_name = "IN", help = FILE_HELP)]
    source: String,
    /// The file to write, or `-` for standard output
    #[arg(value_name = "OUT")]
    target: String,
    /// The form to write, whatever the name of OUT
    #[arg(long, value_enum)]
    to: Option<Form>,
    #[command(flatten)]
    reading: Reading,
}

pub(super) fn run(arguments: &Arguments) -> Result<Status, Status> {
    let target = &arguments.target;
    let Some(form) = arguments.to.or_else(|| form_of_name(target)) else {
        err(format_args!("{target}: the name does not say which form to write"));
        err("  remedy: name --to scene, state or binary, or end the name in .json, .state.json or .dsr");
        return Err(Status::Usage);
    };
    let dictionary = arguments.reading.dictionary()?;
    let loaded = arguments.reading.load_or_tell(&arguments.source, &dictionary)?;
    let bytes = bytes_of(&loaded.scene, form, &dictionary, target)?;
    let limit = if form == Form::Scene { limits::SCENE_BYTES_MAX } else { limits::ENCODED_BYTES_MAX };
    if bytes.len() > limit {
        err(format_args!("{target}: not written: {} bytes are over the limit of {limit}", bytes.len()));
        err("  remedy: move large values such as images out of the graph, or write --to binary");
        return Err(Status::Usage);
    }
    let written = if target == "-" { out_bytes(&bytes) } else { std::fs::write(target, &bytes) };
    written.map_err(|error| {
        err(format_args!(
            "{target}: cannot write: {error}\n  remedy: check the path, the permissions and the space"
        ));
        Status::Usage
    })?;
    Ok(Status::Claimed)
}

fn form_of_name(name: &str) -> Option<Form> {
    let ends_in = |ending: &str| name.to_ascii_lowercase().ends_with(ending);
    match () {
        () if ends_in(".state.json") => Some(Form::State),
        () if ends_in(".json") => Some(Form::Scene),
        () if ends_in(".dsr") => Some(Form::Binary),
        () => None,
    }
}

fn bytes_of(scene: &Scene, form: Form, dictionary: &Dictionary, target: &str) -> Result<Vec<u8>, Status> {
    if form == Form::Scene {
        let written = scene.written(dictionary);
        for note in &written.notes {
            err(format_args!("{target}: note: {note}"));
        }
        return Ok(written.text.into_bytes());
    }
    if scene.root != RootNaming::default() {
        let RootNaming { name, vertex_type, external_id } = &scene.root;
        let id = external_id.map(|id| format!(", id {id}")).unwrap_or_default();
        err(format_args!(
            "{target}: note: a state does not hold the root's own name: {name:?} ({vertex_type}{id})"
        ));
    }
    if form == Form::Binary {
        return Ok(encode(&scene.state));
    }
    let text = serde_json::to_string_pretty(&scene.state);
    text.map(|text| (text + "\n").into_bytes()).map_err(|error| {
        err(format_args!("{target}: cannot be written as JSON: {error}\n  remedy: write --to binary"));
        Status::Usage
    })
}
