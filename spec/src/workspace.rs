//! Reads the files of the workspace.

use crate::Source;
use crate::cases::CORPUS_PATH;
use crate::evidence::Documents;
use crate::judged::JUDGED_PATH;
use crate::proof::{LEFT_OUT_PATH, THEOREMS_PATH};
use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// What the judgement reads.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Inputs {
    /// The Markdown files of the specification, except the matrix.
    pub texts: Vec<Source>,
    /// The Rust files under `src` and `tests` of each member, except those of this crate, whose tags are
    /// examples.
    pub rust: Vec<Source>,
}

/// A file or directory that cannot be read.
#[derive(Debug)]
pub struct ReadError {
    /// Which.
    pub path: PathBuf,
    /// Why.
    pub source: io::Error,
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "cannot read {}: {}", self.path.display(), self.source)
    }
}

impl std::error::Error for ReadError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.source)
    }
}

/// Reads everything under the workspace root.
pub fn read_inputs(root: &Path) -> Result<Inputs, ReadError> {
    let mut inputs = Inputs::default();
    for path in entries(&root.join("spec"))? {
        let is_matrix = path.file_name().is_some_and(|name| name == "MATRIX.md");
        if path.extension().is_some_and(|end| end == "md") && !is_matrix {
            inputs.texts.push(read(root, &path)?);
        }
    }
    let manifest = read(root, &root.join("Cargo.toml"))?;
    for member in members(&manifest.text).iter().filter(|member| *member != "spec") {
        for folder in ["src", "tests"] {
            let folder = root.join(member).join(folder);
            if folder.is_dir() {
                read_all(root, &folder, "rs", &mut inputs.rust)?;
            }
        }
    }
    Ok(inputs)
}

/// Reads what speaks for clauses besides the code: theorems, the checker's own list, the corpus, fuzz targets.
pub fn read_documents(root: &Path) -> Result<Documents, ReadError> {
    let mut documents = Documents {
        theorems: read_file(root, THEOREMS_PATH)?,
        left_out: read_file(root, LEFT_OUT_PATH)?,
        judged: read_file(root, JUDGED_PATH)?,
        ..Documents::default()
    };
    read_all(root, &root.join(CORPUS_PATH), "json", &mut documents.corpus)?;
    let fuzz = root.join(FUZZ_PATH);
    if fuzz.is_dir() {
        read_all(root, &fuzz, "rs", &mut documents.fuzz)?;
    }
    Ok(documents)
}

/// Where fuzz targets are, if there are any.
const FUZZ_PATH: &str = "fuzz/fuzz_targets";

/// Reads one file by its path from the workspace root.
pub fn read_file(root: &Path, path: &str) -> Result<Source, ReadError> {
    read(root, &root.join(path))
}

/// The quoted paths of `members = […]`.
fn members(manifest: &str) -> Vec<String> {
    let list = manifest
        .split_once("\nmembers")
        .and_then(|(_, rest)| rest.split_once('['))
        .and_then(|(_, rest)| rest.split_once(']'));
    let quoted = list.map_or("", |(list, _)| list).split('"').skip(1).step_by(2);
    quoted.map(String::from).collect()
}

fn read_all(root: &Path, folder: &Path, ending: &str, into: &mut Vec<Source>) -> Result<(), ReadError> {
    for path in entries(folder)? {
        if path.is_dir() {
            read_all(root, &path, ending, into)?;
        } else if path.extension().is_some_and(|end| end == ending) {
            into.push(read(root, &path)?);
        }
    }
    Ok(())
}

/// What a directory holds, in order.
fn entries(folder: &Path) -> Result<Vec<PathBuf>, ReadError> {
    let fail = |source| ReadError { path: folder.into(), source };
    let mut paths = fs::read_dir(folder)
        .and_then(|found| found.map(|entry| entry.map(|entry| entry.path())).collect::<io::Result<Vec<_>>>())
        .map_err(fail)?;
    paths.sort_unstable();
    Ok(paths)
}

fn read(root: &Path, path: &Path) -> Result<Source, ReadError> {
    let text = fs::read_to_string(path).map_err(|source| ReadError { path: path.into(), source })?;
    let relative = path.strip_prefix(root).unwrap_or(path);
    let parts: Vec<_> = relative.components().map(|part| part.as_os_str().to_string_lossy()).collect();
    Ok(Source { path: parts.join("/"), text })
}
