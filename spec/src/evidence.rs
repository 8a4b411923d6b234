//! All that speaks for each clause, kind by kind.

use crate::cases::{Cases, count_cases};
use crate::claim::claims;
use crate::judged::{Layer, layers_of};
use crate::proof::{LeftOut, Theorem, left_out_of, theorems_of};
use crate::witness::{WitnessKind, witness_kinds};
use crate::{Clause, ClauseId, Gap, Inputs, Source, TestModules, Trace, tags_of, trace};
use std::collections::{BTreeMap, BTreeSet};

/// What is read besides the specification and the code.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Documents {
    /// The tables of theorems.
    pub theorems: Source,
    /// What they leave out.
    pub left_out: Source,
    /// What the checker judges.
    pub judged: Source,
    /// The files of the conformance corpus.
    pub corpus: Vec<Source>,
    /// The fuzz targets.
    pub fuzz: Vec<Source>,
}

/// How strong the grounds of a clause are, best first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Grade {
    /// Theorems say all of it, of the model.
    Proved,
    /// Theorems say some of it.
    InPart,
    /// The checker judges it in every state within its bounds.
    Checked,
    /// Tests or conformance cases try it.
    Tested,
    /// Random walks, random samples or fuzzing try it.
    Sampled,
    /// Nothing does.
    Nothing,
}

impl Grade {
    /// All, best first.
    pub const ALL: [Self; 6] =
        [Self::Proved, Self::InPart, Self::Checked, Self::Tested, Self::Sampled, Self::Nothing];

    /// The grade in words.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::InPart => "proved in part",
            Self::Checked => "checked exhaustively to a bound",
            Self::Tested => "tested",
            Self::Sampled => "sampled",
            Self::Nothing => "nothing",
        }
    }
}

/// What speaks for one clause.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Grounds {
    /// The theorems about it.
    pub theorems: Vec<String>,
    /// Examples and counterexamples about it.
    pub examples: Vec<String>,
    /// What no theorem says of it.
    pub left_out: Option<String>,
    /// The layers that judge it in every state within their bounds.
    pub layers: Vec<String>,
    /// Whether random walks judge it.
    pub walked: bool,
    /// How many tests witness it.
    pub tests: usize,
    /// How many tests of random samples do.
    pub samples: usize,
    /// How many fuzz targets do.
    pub fuzzed: usize,
    /// How many conformance cases cite it.
    pub cases: usize,
}

impl Grounds {
    /// The best of them.
    pub fn grade(&self) -> Grade {
        match (self.theorems.is_empty(), &self.left_out) {
            (false, None) => Grade::Proved,
            (false, Some(_)) => Grade::InPart,
            _ if !self.layers.is_empty() => Grade::Checked,
            _ if self.tests + self.cases > 0 => Grade::Tested,
            _ if self.walked || self.samples + self.fuzzed > 0 => Grade::Sampled,
            _ => Grade::Nothing,
        }
    }
}

/// All evidence, and what is wrong with what is said of it.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Evidence {
    /// The clauses, with code and witnesses.
    pub trace: Trace,
    /// The chapters.
    pub texts: Vec<Source>,
    /// All theorems.
    pub theorems: Vec<Theorem>,
    /// What they leave out.
    pub left_out: LeftOut,
    /// The layers of the checker.
    pub layers: Vec<Layer>,
    /// The conformance cases.
    pub cases: Cases,
    /// Fuzz targets.
    pub fuzz_targets: usize,
    /// By clause; every clause has an entry.
    pub grounds: BTreeMap<ClauseId, Grounds>,
    /// What is wrong, in order.
    pub gaps: Vec<Gap>,
}

impl Evidence {
    /// The grade of a clause.
    pub fn grade(&self, id: &ClauseId) -> Grade {
        self.grounds.get(id).map_or(Grade::Nothing, Grounds::grade)
    }

    /// The clauses that bind, which need evidence.
    pub fn binding(&self) -> impl Iterator<Item = &Clause> {
        self.trace.clauses.all().iter().filter(|clause| clause.needs_witness())
    }
}

/// Gathers what speaks for each clause.
pub fn evidence(inputs: &Inputs, documents: &Documents) -> Evidence {
    let trace = trace(&inputs.texts, &inputs.rust);
    let mut gaps = Vec::new();
    let theorems = theorems_of(&documents.theorems, &trace.clauses, &mut gaps);
    let left_out = left_out_of(&documents.left_out, &trace.clauses, &mut gaps);
    let layers = layers_of(&documents.judged, &trace.clauses, &mut gaps);
    let cases = count_cases(&documents.corpus, &trace.clauses, &mut gaps);
    let mut grounds: BTreeMap<ClauseId, Grounds> =
        trace.clauses.all().iter().map(|clause| (clause.id.clone(), Grounds::default())).collect();
    for theorem in &theorems {
        for id in &theorem.clauses {
            let Some(of_clause) = grounds.get_mut(id) else { continue };
            let names = if theorem.is_example { &mut of_clause.examples } else { &mut of_clause.theorems };
            names.push(theorem.name.clone());
        }
    }
    for (id, (part, _)) in &left_out.parts {
        grounds.get_mut(id).into_iter().for_each(|grounds| grounds.left_out = Some(part.clone()));
    }
    add_layers(&layers, &mut grounds);
    add_witnesses(&trace, &inputs.rust, &mut grounds);
    for (id, count) in &cases.citing {
        grounds.get_mut(id).into_iter().for_each(|grounds| grounds.cases = *count);
    }
    add_fuzz(&documents.fuzz, &mut grounds);
    let fuzz_targets = documents.fuzz.len();
    let texts = inputs.texts.clone();
    let mut evidence =
        Evidence { trace, texts, theorems, left_out, layers, cases, fuzz_targets, grounds, gaps };
    evidence.gaps.extend(judge(&evidence));
    evidence.gaps.sort_unstable();
    evidence
}

fn add_layers(layers: &[Layer], grounds: &mut BTreeMap<ClauseId, Grounds>) {
    for layer in layers {
        let judged: BTreeSet<&ClauseId> = layer.judges.iter().map(|(id, _)| id).collect();
        for id in judged {
            let Some(of_clause) = grounds.get_mut(id) else { continue };
            if layer.is_exhaustive() {
                let name = layer.kind();
                if !of_clause.layers.iter().any(|known| known == name) {
                    of_clause.layers.push(name.into());
                }
            } else {
                of_clause.walked = true;
            }
        }
    }
}

fn add_witnesses(trace: &Trace, rust: &[Source], grounds: &mut BTreeMap<ClauseId, Grounds>) {
    let modules = TestModules::of(rust);
    let kinds: BTreeMap<&str, _> =
        rust.iter().map(|source| (&*source.path, witness_kinds(source, &modules))).collect();
    for (id, witnesses) in &trace.witnesses {
        let Some(of_clause) = grounds.get_mut(id) else { continue };
        for (path, function) in witnesses {
            match kinds.get(&**path).and_then(|kinds| kinds.get(function)) {
                Some(WitnessKind::Test) => of_clause.tests += 1,
                Some(WitnessKind::Sample) => of_clause.samples += 1,
                Some(WitnessKind::Judge) | None => {}
            }
        }
    }
}

fn add_fuzz(targets: &[Source], grounds: &mut BTreeMap<ClauseId, Grounds>) {
    let modules = TestModules::default();
    for target in targets {
        let tags = tags_of(target, &modules, &mut Vec::new());
        let cited: BTreeSet<ClauseId> = tags.into_iter().map(|tag| tag.id).collect();
        for id in cited {
            grounds.get_mut(&id).into_iter().for_each(|grounds| grounds.fuzzed += 1);
        }
    }
}

/// What is said of the evidence and is not so.
fn judge(evidence: &Evidence) -> Vec<Gap> {
    let mut gaps = Vec::new();
    let is_proved =
        |id: &ClauseId| evidence.grounds.get(id).is_some_and(|grounds| !grounds.theorems.is_empty());
    for (id, (_, place)) in &evidence.left_out.parts {
        if !is_proved(id) {
            gaps.push(Gap::NoPart { id: id.clone(), place: place.clone() });
        }
    }
    for (_, ids, place) in &evidence.left_out.reasons {
        if ids.iter().all(is_proved) {
            gaps.push(Gap::StaleReason { place: place.clone() });
        }
    }
    let reasoned: BTreeSet<&ClauseId> =
        evidence.left_out.reasons.iter().flat_map(|(_, ids, _)| ids).collect();
    for clause in evidence.binding() {
        let (id, place) = (clause.id.clone(), clause.place.clone());
        if evidence.grade(&id) == Grade::Nothing {
            gaps.push(Gap::NoEvidence { id: id.clone(), place: place.clone() });
        }
        if !is_proved(&id) && !reasoned.contains(&id) {
            gaps.push(Gap::NoReason { id, place });
        }
    }
    for claim in claims(evidence).iter().filter(|claim| claim.clauses.is_empty()) {
        let clause = evidence.trace.clauses.get(&claim.id);
        gaps.extend(
            clause.map(|clause| Gap::EmptyClaim { id: claim.id.clone(), place: clause.place.clone() }),
        );
    }
    gaps
}
