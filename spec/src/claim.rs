//! The claims, and what may be said of each.

use crate::evidence::{Evidence, Grade};
use crate::list::{collapsed, named};
use crate::text::text_in;
use crate::{ClauseId, Marker};
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// A claim of the chapter on claims.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Claim {
    /// Its id, such as `CLAIM-L1`.
    pub id: ClauseId,
    /// What it says, before it names clauses.
    pub sentence: String,
    /// The clauses that say it exactly.
    pub clauses: Vec<ClauseId>,
    /// The assumptions that it names.
    pub assumed: Vec<ClauseId>,
}

impl Claim {
    /// Its short name, such as `L1`.
    pub fn name(&self) -> String {
        self.id.to_string().trim_start_matches("CLAIM-").into()
    }

    /// The clauses of a grade.
    pub fn of_grade<'c>(
        &'c self,
        evidence: &'c Evidence,
        grade: Grade,
    ) -> impl Iterator<Item = &'c ClauseId> {
        self.clauses.iter().filter(move |id| evidence.grade(id) == grade)
    }

    /// The grade of the weakest clause.
    pub fn grade(&self, evidence: &Evidence) -> Grade {
        self.clauses.iter().map(|id| evidence.grade(id)).max().unwrap_or(Grade::Nothing)
    }

    /// What may be said of it: the word of its weakest clause, and which clauses have more.
    pub fn status(&self, evidence: &Evidence) -> String {
        let weakest = self.grade(evidence);
        if weakest == Grade::Proved {
            return "**proved** of the model".into();
        }
        let list = |grade: Grade| collapsed(self.of_grade(evidence, grade));
        let mut status =
            format!("**{}** as a whole (no more is known of {})", weakest.words(), list(weakest));
        for grade in Grade::ALL.into_iter().rev().filter(|grade| *grade < weakest) {
            if self.of_grade(evidence, grade).next().is_some() {
                let _ = write!(status, "; {}: {}", grade.words(), list(grade));
            }
        }
        status
    }

    /// The layers of the checker that judge some of its clauses, in their order.
    pub fn layers(&self, evidence: &Evidence) -> Vec<String> {
        let of_clauses = self.clauses.iter().filter_map(|id| evidence.grounds.get(id));
        let judging: BTreeSet<&String> = of_clauses.flat_map(|grounds| &grounds.layers).collect();
        let all = evidence.layers.iter().map(|layer| &layer.name);
        all.filter(|name| judging.contains(name)).cloned().collect()
    }

    /// The commands that show it.
    pub fn commands(&self, evidence: &Evidence) -> String {
        let mut commands: Vec<String> = Vec::new();
        let proves = |id: &ClauseId| [Grade::Proved, Grade::InPart].contains(&evidence.grade(id));
        if self.clauses.iter().any(proves) {
            commands.push("`spec/coq/check`".into());
        }
        let mut layers: Vec<&str> = Vec::new();
        for layer in self.layers(evidence) {
            let argument = match &*layer {
                "L0" => "l0",
                "L1" => "l1",
                "scenario" => "scenario",
                _ => "l2",
            };
            if !layers.contains(&argument) {
                layers.push(argument);
            }
        }
        if !layers.is_empty() {
            commands.push(format!("`dsr check --layer {}`", layers.join(",")));
        }
        commands.push("`cargo test -p dsr-core`".into());
        commands.join(", ")
    }
}

/// All claims, in their order.
pub fn claims(evidence: &Evidence) -> Vec<Claim> {
    let all = evidence.trace.clauses.all().iter().filter(|clause| clause.id.chapter() == "CLAIM");
    all.filter_map(|clause| {
        let source = evidence.texts.iter().find(|source| source.path == clause.place.path)?;
        let text = text_in(&source.text, &clause.id)?;
        // What the chapter says after its last claim is none of it.
        let (_, text) = text.split("\n\n").next()?.split_once(".**")?;
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let ids = named(&text);
        let sentence = ids.first().and_then(|first| text.split(&first.to_string()).next()).unwrap_or(&text);
        let sentence = sentence.trim().trim_end_matches(':').to_owned();
        let is_assumed = |id: &ClauseId| {
            evidence.trace.clauses.get(id).is_some_and(|clause| clause.marker == Some(Marker::Assumption))
        };
        let (assumed, clauses) = ids.into_iter().partition(is_assumed);
        Some(Claim { id: clause.id.clone(), sentence, clauses, assumed })
    })
    .collect()
}
