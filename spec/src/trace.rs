//! The judgement: which clauses are kept by which code and witnessed by what.

use crate::{Clause, ClauseId, Clauses, Fault, Source, TagKind, TestModules, collect_clauses, tags_of};
use std::collections::{BTreeMap, BTreeSet};

/// Clauses, code, witnesses and faults.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Trace {
    /// The clauses.
    pub clauses: Clauses,
    /// The files that cite each clause as code.
    pub code: BTreeMap<ClauseId, BTreeSet<String>>,
    /// The file and function of each witness.
    pub witnesses: BTreeMap<ClauseId, BTreeSet<(String, String)>>,
    /// What is wrong, in order.
    pub faults: Vec<Fault>,
}

impl Trace {
    /// The clauses that need no witness, with their markers: printed, so that they stay few.
    pub fn exemptions(&self) -> impl Iterator<Item = &Clause> {
        self.clauses.all().iter().filter(|clause| !clause.needs_witness())
    }
}

/// Ties the Markdown files of the specification to the Rust files of the workspace.
pub fn trace(texts: &[Source], rust: &[Source]) -> Trace {
    let (clauses, mut faults) = collect_clauses(texts);
    let modules = TestModules::of(rust);
    let mut trace = Trace { clauses, ..Trace::default() };
    for source in rust {
        for tag in tags_of(source, &modules, &mut faults) {
            if trace.clauses.get(&tag.id).is_none() {
                faults.push(Fault::Stale { id: tag.id, place: tag.place });
                continue;
            }
            match tag.kind {
                TagKind::Code => {
                    trace.code.entry(tag.id).or_default().insert(tag.place.path);
                }
                TagKind::Witness => {
                    let witness = (tag.place.path, tag.function.unwrap_or_default());
                    trace.witnesses.entry(tag.id).or_default().insert(witness);
                }
            }
        }
    }
    for clause in trace.clauses.all() {
        let (id, place) = (clause.id.clone(), clause.place.clone());
        if clause.needs_code() && !trace.code.contains_key(&clause.id) {
            faults.push(Fault::NoCode { id: id.clone(), place: place.clone() });
        }
        if clause.needs_witness() && !trace.witnesses.contains_key(&clause.id) {
            faults.push(Fault::NoWitness { id, place });
        }
    }
    faults.sort_unstable();
    trace.faults = faults;
    trace
}
