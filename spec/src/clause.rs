//! Clauses, as the Markdown files define them.

use crate::{ClauseId, Fault, Place, Source};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// Why a clause needs less than the others. `spec/README.md` says what each means.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Marker {
    /// Gives a word its meaning: needs neither code nor witness.
    Definition,
    /// Asked of the world: needs neither code nor witness.
    Assumption,
    /// Explains: needs neither code nor witness.
    Informative,
    /// Follows from the clauses that it cites: needs a witness and no code.
    Derived,
}

impl Marker {
    /// All four.
    pub const ALL: [Self; 4] = [Self::Definition, Self::Assumption, Self::Informative, Self::Derived];

    /// The word in the text.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Definition => "definition",
            Self::Assumption => "assumption",
            Self::Informative => "informative",
            Self::Derived => "derived",
        }
    }

    fn of(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|marker| marker.word() == word)
    }
}

impl fmt::Display for Marker {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

/// One clause.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Clause {
    /// Its id.
    pub id: ClauseId,
    /// Its marker, if any.
    pub marker: Option<Marker>,
    /// Where it is defined.
    pub place: Place,
    /// The words in its text that look like ids of other clauses.
    pub cites: BTreeSet<ClauseId>,
}

impl Clause {
    /// Whether some code must cite it.
    pub fn needs_code(&self) -> bool {
        self.marker.is_none()
    }

    /// Whether some test or property must cite it.
    pub fn needs_witness(&self) -> bool {
        matches!(self.marker, None | Some(Marker::Derived))
    }
}

/// All clauses, in the order of files and lines.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Clauses {
    all: Vec<Clause>,
    index: BTreeMap<ClauseId, usize>,
}

impl Clauses {
    /// All of them, in order.
    pub fn all(&self) -> &[Clause] {
        &self.all
    }

    /// The clause of an id.
    pub fn get(&self, id: &ClauseId) -> Option<&Clause> {
        self.index.get(id).map(|&at| &self.all[at])
    }

    fn has_chapter(&self, chapter: &str) -> bool {
        self.all.iter().any(|clause| clause.id.chapter() == chapter)
    }

    fn add(&mut self, clause: Clause, faults: &mut Vec<Fault>) {
        if let Some(first) = self.get(&clause.id) {
            faults.push(Fault::Duplicate { id: clause.id, first: first.place.clone(), second: clause.place });
        } else {
            self.index.insert(clause.id.clone(), self.all.len());
            self.all.push(clause);
        }
    }
}

/// The clauses that the files define, and what is wrong with their definitions and cross-references.
pub fn collect_clauses(sources: &[Source]) -> (Clauses, Vec<Fault>) {
    let mut clauses = Clauses::default();
    let mut faults = Vec::new();
    for source in sources {
        for clause in clauses_of(source, &mut faults) {
            clauses.add(clause, &mut faults);
        }
    }
    for clause in clauses.all() {
        let known = |id: &&ClauseId| clauses.get(id).is_some();
        // `UTF-8` looks like an id and is none: only words of chapters count.
        let unknown = clause.cites.iter().filter(|id| !known(id) && clauses.has_chapter(id.chapter()));
        faults
            .extend(unknown.map(|id| Fault::UnknownCitation { id: id.clone(), place: clause.place.clone() }));
        if clause.marker == Some(Marker::Derived) && !clause.cites.iter().any(|id| known(&id)) {
            faults.push(Fault::DerivedFromNothing { id: clause.id.clone(), place: clause.place.clone() });
        }
    }
    (clauses, faults)
}

fn clauses_of(source: &Source, faults: &mut Vec<Fault>) -> Vec<Clause> {
    let mut clauses: Vec<Clause> = Vec::new();
    let mut open = false;
    let mut fenced = false;
    for (at, line) in source.text.lines().enumerate() {
        let place = Place { path: source.path.clone(), line: at + 1 };
        if line.starts_with("```") {
            fenced = !fenced;
        }
        if fenced {
            continue;
        }
        if line.starts_with('#') {
            open = false;
        }
        match head_of(line) {
            Head::None => {}
            Head::Malformed(text) => {
                faults.push(Fault::MalformedClause { text, place });
                open = false;
            }
            Head::Clause(id, marker) => {
                clauses.push(Clause { id, marker, place, cites: BTreeSet::new() });
                open = true;
            }
        }
        if let Some(clause) = clauses.last_mut().filter(|_| open) {
            clause.cites.extend(ids_in(line).filter(|id| *id != clause.id));
        }
    }
    clauses
}

/// The id of the clause that a line begins.
pub(crate) fn head(line: &str) -> Option<ClauseId> {
    match head_of(line) {
        Head::Clause(id, _) => Some(id),
        Head::None | Head::Malformed(_) => None,
    }
}

enum Head {
    None,
    Malformed(String),
    Clause(ClauseId, Option<Marker>),
}

/// Reads `**JOIN-3.**` or `**NET-1 (assumption).**` at the start of a line. Other bold text is no clause,
/// unless it starts like one.
fn head_of(line: &str) -> Head {
    let Some((bold, _)) = line.strip_prefix("**").and_then(|rest| rest.split_once("**")) else {
        return Head::None;
    };
    let chapter = bold.split('-').next().unwrap_or_default();
    let like_one =
        bold.contains('-') && !chapter.is_empty() && chapter.bytes().all(|byte| byte.is_ascii_uppercase());
    if !like_one {
        return Head::None;
    }
    let malformed = || Head::Malformed(bold.into());
    let Some(body) = bold.strip_suffix('.') else { return malformed() };
    let (id, marker) = match body.split_once(" (") {
        Some((id, word)) => match word.strip_suffix(')').and_then(Marker::of) {
            Some(marker) => (id, Some(marker)),
            None => return malformed(),
        },
        None => (body, None),
    };
    id.parse().map_or_else(|_| malformed(), |id| Head::Clause(id, marker))
}

fn ids_in(line: &str) -> impl Iterator<Item = ClauseId> + '_ {
    line.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-' || c == '.'))
        .filter_map(|word| word.trim_end_matches('.').parse().ok())
}
