//! Cases from the model: of all canonical histories within a bound, those that tell something apart.
//! `[spec: CONF-20]`

mod case;
mod chains;
mod outcome;
mod scene;
mod script;
mod sight;
mod write;

pub use scene::Group;

use super::CannotWrite;
use crate::case::{CaseFile, FORMAT};
use case::{Part, Writer};
use dsr_model::histories::Histories;
use dsr_model::search::all;
use outcome::{Separated, Several};
use scene::dictionary;
use script::{Script, Scripts};
use sight::{Sights, is_sum_of_pairs, undisputed};
use std::collections::BTreeSet;
use std::sync::Arc;

/// What came of a group.
#[derive(Clone, PartialEq, Debug)]
pub struct Generated {
    /// Canonical histories, as the checker counts them.
    pub histories: usize,
    /// Of them, those of this group's kinds with different deltas.
    pub different: usize,
    /// Those that stand for others that are alike.
    pub alike: usize,
    /// Histories kept.
    pub kept: usize,
    /// The files `universal/….json`, `resolution/….json` and `resolution/…-early.json`, without those that would be empty.
    pub files: Vec<CaseFile>,
}

/// Why a history was kept.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Rule {
    /// It ends in a way that no history kept before it does.
    End,
    /// It tells two semantics apart that no history kept before it does.
    Separates,
}

/// The cases of a group.
pub fn model(group: &Group) -> Result<Generated, CannotWrite> {
    let semantics = Arc::new(group.semantics()?);
    let mut histories = Histories::new(semantics.clone(), group.bound, true);
    let nodes =
        all(&mut histories).map_err(|fault| CannotWrite::History { what: fault.breach().detail.clone() })?;
    let (mut scripts, mut sights) = (Scripts::new(semantics.clone()), Sights::default());
    let (mut known, mut shapes, mut candidates) = (BTreeSet::new(), BTreeSet::new(), Vec::new());
    let mut different = 0;
    for node in nodes.iter().filter(|node| known.insert(node.deltas)) {
        let unknown = || CannotWrite::History { what: "a history cannot be made".into() };
        let script = scripts.of(&mut histories, node).ok_or_else(unknown)?;
        if !group.has(&script.kinds()) {
            continue;
        }
        different += 1;
        if group.is_of_three() && is_sum_of_pairs(&semantics, &mut histories, &mut sights, &script) {
            continue;
        }
        let sets = 1..=script.whole();
        if shapes.insert(sights.signature(&semantics, &mut histories, &script, sets)) {
            candidates.push(script);
        }
    }
    let mut thinning = Thinning::default();
    let mut files = Part::ALL.map(|part| CaseFile {
        format: FORMAT,
        family: part.family().into(),
        topic: part.topic(group),
        cases: Vec::new(),
    });
    let (mut kept, mut early) = (0, BTreeSet::new());
    for script in &candidates {
        let end = sights.signature(&semantics, &mut histories, script, [script.whole()].into_iter());
        let Some(rule) = thinning.keep(end, script)? else { continue };
        kept += 1;
        let undisputed = undisputed(&semantics, &mut histories, &mut sights, script);
        let sets = 0..=script.whole();
        let seen = sets.map(|set| sights.of(&semantics, &mut histories, script, set)).collect();
        let of_script = sights.early(&semantics, &mut histories, script);
        let before = early.len();
        early.extend(of_script);
        let is_new_early = early.len() > before;
        let cases = Writer { group, script, rule, undisputed, seen, is_new_early }.cases()?;
        for (file, case) in files.iter_mut().zip(cases) {
            file.cases.extend(case);
        }
    }
    let files = files.into_iter().filter(|file| !file.cases.is_empty()).collect();
    Ok(Generated { histories: nodes.len(), different, alike: candidates.len(), kept, files })
}

/// What has been kept.
#[derive(Debug)]
struct Thinning {
    ends: BTreeSet<sight::Signature>,
    separated: Separated,
    several: Several,
}

impl Default for Thinning {
    fn default() -> Self {
        Self { ends: BTreeSet::new(), separated: Separated::new(), several: Several::new() }
    }
}

impl Thinning {
    /// Why a history is kept, if it is.
    fn keep(&mut self, end: sight::Signature, script: &Script) -> Result<Option<Rule>, CannotWrite> {
        let probe = write::exact(script, dictionary(), |_| true)?;
        let authors = 1 + script.made.iter().map(|made| made.author).max().unwrap_or(0);
        let separated = self.several.separated(&probe.names(), authors, &dictionary(), &probe.steps);
        let rule = if self.ends.insert(end) {
            Rule::End
        } else if separated.is_subset(&self.separated) {
            return Ok(None);
        } else {
            Rule::Separates
        };
        self.separated.extend(separated);
        Ok(Some(rule))
    }
}
