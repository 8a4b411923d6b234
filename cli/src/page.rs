//! Pages that show results, written to files.

use dsr_explorer::{Content, PageError};
use std::path::{Path, PathBuf};

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Refusal {
    #[error(transparent)]
    Page(#[from] PageError),
    #[error("{}: cannot write: {source}\n  remedy: check the path, the permissions and the space", path.display())]
    Write { path: PathBuf, source: std::io::Error },
}

/// Writes the page of some content.
pub(crate) fn write(path: &Path, content: &Content) -> Result<(), Refusal> {
    let page = dsr_explorer::page(content)?;
    std::fs::write(path, page).map_err(|source| Refusal::Write { path: path.into(), source })
}
