//! What the theorems of the Coq development say, by the tables of its README, and what they leave out.

use crate::list::{NoList, listed};
use crate::table::{Row, rows};
use crate::{ClauseId, Clauses, Gap, Place, Source};
use std::collections::BTreeMap;

/// Where the tables of theorems are, from the workspace root.
pub const THEOREMS_PATH: &str = "spec/coq/README.md";
/// Where it is said what they leave out.
pub const LEFT_OUT_PATH: &str = "spec/coq/coverage.md";

/// In place of clauses: the theorem is a tool of the proofs.
const TOOL: &str = "tool";

/// A theorem, as a table has it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Theorem {
    /// File and name, such as `Join.join_assoc`.
    pub name: String,
    /// The clauses that it is about; none for a tool.
    pub clauses: Vec<ClauseId>,
    /// Whether it is an example or a counterexample, which proves no clause.
    pub is_example: bool,
}

/// The theorems of every table `clause | theorem | says | code`.
pub fn theorems_of(source: &Source, clauses: &Clauses, gaps: &mut Vec<Gap>) -> Vec<Theorem> {
    let mut theorems = Vec::new();
    for row in rows(source, &["clause", "theorem", "says", "code"]) {
        let [cited, name, says, _] = row.cells[..] else {
            gaps.push(Gap::MalformedRow { place: row.place, cells: row.cells.len(), expected: 4 });
            continue;
        };
        let Some(name) = theorem_name(name) else {
            gaps.push(Gap::NoTheorem { text: name.into(), place: row.place });
            continue;
        };
        let Some(clauses) = cited_by(cited, &row, clauses, gaps) else { continue };
        if clauses.is_empty() && cited != TOOL {
            gaps.push(Gap::NothingCited { theorem: name.into(), place: row.place });
            continue;
        }
        let is_example = ["Example", "Counterexample"].iter().any(|word| says.starts_with(word));
        theorems.push(Theorem { name: name.into(), clauses, is_example });
    }
    if theorems.is_empty() {
        gaps.push(Gap::Empty { path: source.path.clone(), what: "theorems" });
    }
    theorems
}

/// `File.name` between backticks.
fn theorem_name(cell: &str) -> Option<&str> {
    let name = cell.strip_prefix('`')?.strip_suffix('`')?;
    let (file, theorem) = name.split_once('.')?;
    let is_word =
        |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
    (is_word(file) && is_word(theorem)).then_some(name)
}

/// The clauses of a cell, all known; `None` if the cell is no list of such.
fn cited_by(cell: &str, row: &Row<'_>, known: &Clauses, gaps: &mut Vec<Gap>) -> Option<Vec<ClauseId>> {
    let cell = if cell == TOOL { "" } else { cell };
    match listed(cell) {
        Ok(ids) => known_only(ids, &row.place, known, gaps),
        Err(NoList(text)) => {
            gaps.push(Gap::NoList { text, place: row.place.clone() });
            None
        }
    }
}

fn known_only(
    ids: Vec<ClauseId>,
    place: &Place,
    known: &Clauses,
    gaps: &mut Vec<Gap>,
) -> Option<Vec<ClauseId>> {
    let unknown = ids.iter().find(|id| known.get(id).is_none());
    if let Some(id) = unknown {
        gaps.push(Gap::UnknownClause { id: id.clone(), place: place.clone() });
        return None;
    }
    Some(ids)
}

/// What the theorems leave out, by hand.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct LeftOut {
    /// Of a clause that theorems are about: what none of them says.
    pub parts: BTreeMap<ClauseId, (String, Place)>,
    /// Why clauses have no theorem, with the clauses, in the order of the table.
    pub reasons: Vec<(String, Vec<ClauseId>, Place)>,
}

/// Reads the tables `clause | what no theorem says` and `clauses | why there is no proof`. In the second a
/// chapter's word, such as `ENC`, stands for all its clauses.
pub fn left_out_of(source: &Source, clauses: &Clauses, gaps: &mut Vec<Gap>) -> LeftOut {
    let mut left_out = LeftOut::default();
    let two = |row: &Row<'_>, gaps: &mut Vec<Gap>| match row.cells[..] {
        [first, second] if !second.is_empty() => Some((first.to_owned(), second.to_owned())),
        _ => {
            let (place, cells) =
                (row.place.clone(), row.cells.iter().filter(|cell| !cell.is_empty()).count());
            gaps.push(Gap::MalformedRow { place, cells, expected: 2 });
            None
        }
    };
    for row in rows(source, &["clause", "what no theorem says"]) {
        let Some((cited, part)) = two(&row, gaps) else { continue };
        for id in cited_by(&cited, &row, clauses, gaps).unwrap_or_default() {
            left_out.parts.insert(id, (part.clone(), row.place.clone()));
        }
    }
    for row in rows(source, &["clauses", "why there is no proof"]) {
        let Some((cited, why)) = two(&row, gaps) else { continue };
        let mut ids = Vec::new();
        for part in cited.split(", ") {
            let of_chapter = clauses.all().iter().filter(|clause| clause.id.chapter() == part);
            let chapter: Vec<ClauseId> = of_chapter.map(|clause| clause.id.clone()).collect();
            if chapter.is_empty() {
                ids.extend(cited_by(part, &row, clauses, gaps).unwrap_or_default());
            } else {
                ids.extend(chapter);
            }
        }
        left_out.reasons.push((why, ids, row.place));
    }
    left_out
}
