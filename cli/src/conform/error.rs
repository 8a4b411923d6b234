//! Why nothing can be run or shown.

use dsr_conformance::case::CaseError;
use dsr_conformance::expect::ExpectError;
use dsr_conformance::log::LogError;
use std::path::PathBuf;

/// Exit status 3.
#[derive(Debug, thiserror::Error)]
pub(super) enum ConformError {
    #[error("{0}")]
    Corpus(#[from] CaseError),
    #[error("{0}")]
    Expect(#[from] ExpectError),
    #[error("{0}")]
    Log(#[from] LogError),
    #[error("no case matches {only:?}{}\n  remedy: see `dsr conform list`", alike(.similar))]
    NoCase { only: String, similar: Vec<String> },
    #[error("this program does not find itself: {0}\n  remedy: run `dsr conform run -- dsr conform adapter`")]
    Myself(std::io::Error),
    #[error("it cannot be written as JSON: {0}\n  remedy: use --format text")]
    Json(#[from] serde_json::Error),
    #[error("{}: {why}\n  remedy: check the path and its permissions", path.display())]
    File { path: PathBuf, why: std::io::Error },
    #[error("the adapter stopped: {0}\n  remedy: send one request a line, as spec/conformance.md says")]
    Serve(#[from] dsr_conformance::serve::ServeError),
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
    Usage(Vec<String>),
}

fn alike(similar: &[String]) -> String {
    if similar.is_empty() {
        return String::new();
    }
    let quoted: Vec<String> = similar.iter().map(|id| format!("{id:?}")).collect();
    format!("\n  did you mean {}?", quoted.join(" or "))
}

pub(super) fn read(path: &std::path::Path) -> Result<Vec<u8>, ConformError> {
    std::fs::read(path).map_err(|why| ConformError::File { path: path.into(), why })
}

pub(super) fn read_text(path: &std::path::Path) -> Result<String, ConformError> {
    std::fs::read_to_string(path).map_err(|why| ConformError::File { path: path.into(), why })
}

pub(super) fn write(path: &std::path::Path, text: &str) -> Result<(), ConformError> {
    std::fs::write(path, text).map_err(|why| ConformError::File { path: path.into(), why })
}
