//! Files, standard input and the embedded scenes; what they hold; and why they cannot be read.

use dsr_core::scene::{FLAT, Fault, FaultKind, Scene, SceneError, Strictness, TINY};
use dsr_core::{DecodeError, Dictionary, State, decode, limits};
use std::io::Read;
use std::path::Path;

/// What a file name may be.
pub(crate) const FILE_HELP: &str =
    "A file, `-` for standard input, `@flat` or `@tiny` for a scene that ships with dsr";

/// A graph from outside, and what was dropped to get it.
#[derive(Debug)]
pub(crate) struct Loaded {
    pub(crate) scene: Scene,
    pub(crate) dropped: Vec<Fault>,
}

/// In which form a graph is kept.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub(crate) enum Form {
    /// The JSON graph file of the published system
    Scene,
    /// A state with its causal context, as JSON
    State,
    /// A state with its causal context, canonical bytes
    Binary,
}

/// Why there is no graph.
#[derive(Debug, thiserror::Error)]
pub(crate) enum InputError {
    #[error("cannot read: {0}")]
    Io(#[from] std::io::Error),
    #[error("more than {max} bytes, the most that a {form} may have")]
    TooLarge { max: usize, form: &'static str },
    #[error("{name:?} is no embedded scene")]
    NoSuchScene { name: String },
    #[error("line {line}, column {column}: not UTF-8 text")]
    NotText { line: usize, column: usize },
    #[error("{} fault(s)", .0.faults.len())]
    Refused(SceneError),
    #[error("not a state: {0}")]
    State(serde_json::Error),
    #[error("not a binary state: {0}")]
    Binary(DecodeError),
    #[error("not a dictionary: {0}")]
    Dictionary(serde_json::Error),
}

impl InputError {
    pub(crate) fn remedy(&self) -> &'static str {
        match self {
            Self::Io(_) => "check the path and the permissions",
            Self::TooLarge { .. } => "split the graph, or move large values such as images out of it",
            Self::NoSuchScene { .. } => "use @flat or @tiny, or ./@… for a file of that name",
            Self::NotText { .. } => "save the file as UTF-8, or check that it is the right file",
            Self::Refused(_) => "correct each fault, or read with --lenient to drop what is broken",
            Self::State(_) => "write the state again with `dsr scene convert`",
            Self::Binary(_) => "copy the file again as binary, or write it anew with `dsr scene convert`",
            Self::Dictionary(_) => {
                "see crdt-core/data/published.dictionary.json for the form, or name `published` or `aal`"
            }
        }
    }

    /// Whether nothing could be judged, rather than something judged and refused.
    pub(crate) fn is_unreadable(&self) -> bool {
        let Self::Refused(error) = self else { return true };
        error.faults.iter().any(|fault| match fault.kind {
            FaultKind::TooLarge { .. } | FaultKind::Empty | FaultKind::Syntax(_) | FaultKind::ArrayForm => {
                true
            }
            FaultKind::WrongForm { .. } | FaultKind::MissingKey { .. } => fault.place.symbol.is_none(),
            _ => false,
        })
    }
}

/// The bytes of a file, at most `max`.
fn bytes_of(file: &str, max: usize, form: &'static str) -> Result<Vec<u8>, InputError> {
    match file.strip_prefix('@') {
        Some("flat") => return Ok(FLAT.into()),
        Some("tiny") => return Ok(TINY.into()),
        Some(_) => return Err(InputError::NoSuchScene { name: file.to_owned() }),
        None => {}
    }
    let mut bytes = Vec::new();
    let limit = max as u64 + 1;
    if file == "-" {
        std::io::stdin().lock().take(limit).read_to_end(&mut bytes)?;
    } else {
        std::fs::File::open(Path::new(file))?.take(limit).read_to_end(&mut bytes)?;
    }
    if bytes.len() > max { Err(InputError::TooLarge { max, form }) } else { Ok(bytes) }
}

fn text_of(bytes: Vec<u8>) -> Result<String, InputError> {
    String::from_utf8(bytes).map_err(|error| {
        let sound = error.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(error.as_bytes().get(..sound).unwrap_or_default()).into_owned();
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
        InputError::NotText { line, column }
    })
}

/// The text of a file of at most `max` bytes.
pub(crate) fn text(file: &str, max: usize, form: &'static str) -> Result<String, InputError> {
    text_of(bytes_of(file, max, form)?)
}

/// What bytes hold: a binary state or digest of any version starts with a byte that no text starts with, and a
/// JSON state with a key that no scene has. What is no state is refused by name, when it is read. `[spec: ENC-2]`
fn form_of(bytes: &[u8]) -> Form {
    let starts_no_text = |&byte: &u8| byte < b' ' && !byte.is_ascii_whitespace();
    if bytes.first().is_some_and(starts_no_text) {
        return Form::Binary;
    }
    let inside = bytes.trim_ascii_start().strip_prefix(b"{").unwrap_or_default().trim_ascii_start();
    let is_state = [&b"\"context\""[..], b"\"store\""].iter().any(|key| inside.starts_with(key));
    if is_state { Form::State } else { Form::Scene }
}

/// The graph in a file of any form; what it holds is told by its content.
pub(crate) fn load(
    file: &str,
    dictionary: &Dictionary,
    strictness: Strictness,
) -> Result<Loaded, InputError> {
    let bytes = bytes_of(file, limits::ENCODED_BYTES_MAX, "state")?;
    let of_state = |state| Loaded { scene: Scene::of(state), dropped: Vec::new() };
    match form_of(&bytes) {
        Form::Binary => decode(&bytes).map(of_state).map_err(InputError::Binary),
        Form::State => serde_json::from_slice::<State>(&bytes).map(of_state).map_err(InputError::State),
        Form::Scene if bytes.len() > limits::SCENE_BYTES_MAX => {
            Err(InputError::TooLarge { max: limits::SCENE_BYTES_MAX, form: "scene" })
        }
        Form::Scene => {
            let text = text_of(bytes)?;
            let imported = Scene::read(&text, dictionary, strictness).map_err(InputError::Refused)?;
            Ok(Loaded { scene: imported.scene, dropped: imported.dropped })
        }
    }
}

/// The dictionary of a name or file.
pub(crate) fn dictionary(name: &str) -> Result<Dictionary, InputError> {
    const DICTIONARY_BYTES_MAX: usize = 16 << 20;
    match name {
        "open" => Ok(Dictionary::open()),
        "published" => Ok(Dictionary::published()),
        "aal" => Ok(Dictionary::aal()),
        file => {
            let text = text(file, DICTIONARY_BYTES_MAX, "dictionary")?;
            serde_json::from_str(&text).map_err(InputError::Dictionary)
        }
    }
}
