//! The strict reader.

use super::{CaseFile, check};
use crate::protocol::read_strictly;

/// Why a text is no file of cases.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{file}:{line}: {what}; {remedy}")]
pub struct CaseError {
    /// The file.
    pub file: String,
    /// The line, counted from 1.
    pub line: usize,
    /// What is wrong.
    pub what: String,
    /// What to do about it.
    pub remedy: String,
}

/// Reads a file of cases. `file` is its path from the corpus, such as `universal/delivery.json`. `[spec: CONF-11]`
pub fn read(file: &str, text: &str) -> Result<CaseFile, CaseError> {
    let cases: CaseFile = read_strictly(text).map_err(|error| CaseError {
        file: file.into(),
        line: error.line().max(1),
        what: error.to_string(),
        remedy: "write what conformance/schema/case.json allows".into(),
    })?;
    match check::fault(file, &cases) {
        None => Ok(cases),
        Some(check::Fault { case, what, remedy }) => {
            Err(CaseError { file: file.into(), line: line_of(text, case), what, remedy })
        }
    }
}

/// The line on which the id of a case stands, by its number; the first line for what is no case's fault.
fn line_of(text: &str, case: Option<usize>) -> usize {
    let Some(case) = case else { return 1 };
    let ids = text.lines().zip(1..).filter(|(line, _)| line.trim_start().starts_with("\"id\":"));
    ids.map(|(_, number)| number).nth(case).unwrap_or(1)
}
