//! The small language of predicates. `[spec: SCEN-7]`

use super::atom::Atom;
use super::cursor::{Cursor, Read};
use super::error::Fault;
use super::scope::Scope;
use dsr_core::View;

/// The most questions that one scenario asks: their answers are kept in one word for each state.
const ATOMS_MAX: usize = 128;
/// The deepest nesting.
const DEPTH_MAX: usize = 16;
/// The most parts of one `all` or `any`.
const PARTS_MAX: usize = 64;

const PREDICATES: &[&str] = &[
    "all",
    "any",
    "not",
    "if",
    "then",
    "vertex",
    "edge",
    "attribute",
    "count",
    "placement",
    "repair",
    "done",
];

/// All different questions of a scenario; predicates refer to them by number.
#[derive(Clone, Debug, Default)]
pub(super) struct Atoms(Vec<Atom>);

/// The answers to all questions on one view, by bit.
pub(super) type Answers = u128;

impl Atoms {
    fn number(&mut self, cursor: &Cursor<'_>, atom: Atom) -> Read<Predicate> {
        let at = self.0.iter().position(|known| *known == atom).unwrap_or(self.0.len());
        if at == self.0.len() {
            if at == ATOMS_MAX {
                let what = "different questions in predicates";
                return cursor.fault(Fault::TooMany { what, count: at + 1, most: ATOMS_MAX });
            }
            self.0.push(atom);
        }
        Ok(Predicate::Atom(at))
    }

    /// Asks a view everything.
    pub(super) fn answers(&self, view: &View<'_>) -> Answers {
        let bits = self.0.iter().enumerate().filter(|(_, atom)| atom.holds(view));
        bits.fold(0, |answers, (at, _)| answers | 1 << at)
    }
}

/// A predicate over the answers on a view, and at an end over which replicas are done. `[spec: SCEN-7]`
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Predicate {
    All(Vec<Self>),
    Any(Vec<Self>),
    Not(Box<Self>),
    Atom(usize),
    Done(usize),
}

impl Predicate {
    /// Reads a predicate; with `end`, one that may speak of replicas that are done.
    pub(super) fn read(cursor: &Cursor<'_>, scope: &Scope, atoms: &mut Atoms, end: bool) -> Read<Self> {
        Reader { scope, atoms, end, depth: 0 }.read(cursor)
    }

    /// Whether it holds.
    pub(super) fn holds(&self, answers: Answers, done: u32) -> bool {
        match self {
            Self::All(parts) => parts.iter().all(|part| part.holds(answers, done)),
            Self::Any(parts) => parts.iter().any(|part| part.holds(answers, done)),
            Self::Not(part) => !part.holds(answers, done),
            Self::Atom(at) => answers >> at & 1 == 1,
            Self::Done(replica) => done >> replica & 1 == 1,
        }
    }
}

struct Reader<'r> {
    scope: &'r Scope,
    atoms: &'r mut Atoms,
    end: bool,
    depth: usize,
}

impl Reader<'_> {
    fn read(&mut self, cursor: &Cursor<'_>) -> Read<Predicate> {
        if self.depth == DEPTH_MAX {
            return cursor.fault(Fault::TooMany {
                what: "levels of predicates",
                count: DEPTH_MAX + 1,
                most: DEPTH_MAX,
            });
        }
        self.depth += 1;
        let predicate = self.read_one(cursor);
        self.depth -= 1;
        predicate
    }

    fn read_one(&mut self, cursor: &Cursor<'_>) -> Read<Predicate> {
        let object = cursor.object(PREDICATES)?;
        if let (Some(premise), Some(conclusion)) = (object.get("if"), object.get("then")) {
            // Beside these two no third field makes sense.
            cursor.object(&["if", "then"])?;
            let premise = Predicate::Not(Box::new(self.read(&premise)?));
            return Ok(Predicate::Any(vec![premise, self.read(&conclusion)?]));
        }
        let (kind, body) = cursor.variant(PREDICATES)?;
        let atom = match kind {
            "all" => return Ok(Predicate::All(self.parts(&body)?)),
            "any" => return Ok(Predicate::Any(self.parts(&body)?)),
            "not" => return Ok(Predicate::Not(Box::new(self.read(&body)?))),
            "if" => return cursor.fault(Fault::Needs { field: "if", needed: "`then`" }),
            "then" => return cursor.fault(Fault::Needs { field: "then", needed: "`if`" }),
            "done" if self.end => return Ok(Predicate::Done(self.scope.replica(&body)?)),
            "done" => return body.fault(Fault::DoneBeforeEnd),
            "vertex" => Atom::vertex(&body, self.scope)?,
            "edge" => Atom::edge(&body, self.scope)?,
            "attribute" => Atom::attribute(&body, self.scope)?,
            "count" => Atom::count(&body, self.scope)?,
            "placement" => Atom::placement(&body, self.scope)?,
            _ => Atom::repair(&body)?,
        };
        self.atoms.number(cursor, atom)
    }

    fn parts(&mut self, cursor: &Cursor<'_>) -> Read<Vec<Predicate>> {
        let parts = cursor.list("list of predicates", 1, PARTS_MAX)?;
        parts.iter().map(|part| self.read(part)).collect()
    }
}
