//! Rows of Markdown tables.

use crate::{Place, Source};

/// A row of a table.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Row<'s> {
    /// Where.
    pub(crate) place: Place,
    /// The cells, trimmed.
    pub(crate) cells: Vec<&'s str>,
}

/// The rows of every table of a file under exactly these headings, whatever number of cells each has.
pub(crate) fn rows<'s>(source: &'s Source, headings: &[&str]) -> Vec<Row<'s>> {
    let mut found = Vec::new();
    let mut inside = false;
    for (at, line) in source.text.lines().enumerate() {
        let Some(cells) = cells(line) else {
            inside = false;
            continue;
        };
        if cells == headings {
            inside = true;
        } else if inside && !is_rule(&cells) {
            found.push(Row { place: Place { path: source.path.clone(), line: at + 1 }, cells });
        }
    }
    found
}

fn cells(line: &str) -> Option<Vec<&str>> {
    let body = line.trim().strip_prefix('|')?.strip_suffix('|')?;
    Some(body.split('|').map(str::trim).collect())
}

/// Whether these are the dashes below the headings.
fn is_rule(cells: &[&str]) -> bool {
    cells.iter().all(|cell| !cell.is_empty() && cell.bytes().all(|byte| byte == b'-'))
}
