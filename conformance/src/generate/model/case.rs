//! The two cases of a history. `[spec: CONF-20]`

use super::scene::{Group, dictionary};
use super::script::{Script, Set, members};
use super::{Rule, write};
use crate::case::{Case, Level, Origin, Provenance, Step};
use crate::generate::{Builder, CannotWrite};
use crate::protocol::{Feature, Profile};
use dsr_core::{Dictionary, MutationKind};
use std::collections::BTreeSet;

/// What is known of a history that is kept.
#[derive(Debug)]
pub(super) struct Writer<'w> {
    pub(super) group: &'w Group,
    pub(super) script: &'w Script,
    pub(super) rule: Rule,
    /// By set, whether nothing in it is disputed.
    pub(super) undisputed: Vec<bool>,
    /// The kinds of repair of all its sets.
    pub(super) repairs: BTreeSet<&'static str>,
}

impl Writer<'_> {
    /// What every sound implementation does, unless an author has decided on something disputed; and what this
    /// specification makes of all other sets.
    pub(super) fn cases(&self) -> Result<[Option<Case>; 2], CannotWrite> {
        let probe = write::exact(self.script, dictionary(), |_| true)?;
        let open = write::exact(self.script, Dictionary::open(), |_| true);
        // Who knows no dictionaries is asked wherever none matters.
        let needed = open.is_err() || open.is_ok_and(|open| open.steps != probe.steps);
        let dictionary = || if needed { dictionary() } else { Dictionary::open() };
        let is_undisputed = |set: Set| self.undisputed.get(set as usize).copied().unwrap_or(false);
        let is_common = self.script.made.iter().all(|made| is_undisputed(made.had));
        let slug = self.slug(&probe);
        let case = |family: &str, builder: Builder, why: &str, spec: Vec<String>| Case {
            id: format!("{family}/{}/{slug}", self.group.topic()),
            title: self.title(&builder),
            why: why.into(),
            spec,
            level: Level::Must,
            profile: Profile::Observe,
            requires: needed.then_some(Feature::Dictionary).into_iter().collect(),
            replicas: builder.names(),
            dictionary: needed.then(&dictionary),
            steps: builder.steps,
            provenance: self.provenance(),
            choice: None,
            since: None,
        };
        let universal = if is_common {
            let builder = write::equal(self.script, dictionary(), is_undisputed(self.script.whole()))?;
            Some(case("universal", builder, UNIVERSAL, self.universal_clauses()))
        } else {
            None
        };
        // An undisputed part is a smaller history, and one that is alike is kept.
        let is_left = |set: Set| !is_undisputed(set);
        let resolution = if (1..=self.script.whole()).any(is_left) {
            let builder = write::exact(self.script, dictionary(), is_left)?;
            Some(case("resolution", builder, RESOLUTION, self.resolution_clauses()))
        } else {
            None
        };
        Ok([universal, resolution])
    }

    fn provenance(&self) -> Provenance {
        let rule = match self.rule {
            Rule::End => "CONF-20a",
            Rule::Separates => "CONF-20b",
        };
        Provenance {
            kind: Origin::Model,
            row: None,
            bound: Some(self.group.bound_name()),
            rule: Some(rule.into()),
        }
    }

    /// The kinds, and a hash of what the authors do: the same for ever, wherever the history stands.
    fn slug(&self, probe: &Builder) -> String {
        let initials = |kind: MutationKind| -> String {
            kind.name().split('_').filter_map(|word| word.chars().next()).collect()
        };
        let kinds: Vec<String> = self.script.made.iter().map(|made| initials(made.mutation.kind())).collect();
        let is_authors = |step: &&Step| match step {
            Step::Mutate { .. } => true,
            Step::Deliver { replica, delta } => delta != "s" && self.is_author(probe, replica),
            _ => false,
        };
        let done: Vec<String> = probe.steps.iter().filter(is_authors).map(json).collect();
        format!("{}-{:08x}", kinds.join("-"), hash(&done.join("\n")))
    }

    fn is_author(&self, builder: &Builder, replica: &str) -> bool {
        self.script.made.iter().any(|made| builder.name(1 + made.author) == replica)
    }

    /// Who does what, and whose mutations each had received.
    fn title(&self, builder: &Builder) -> String {
        let told = |(at, made): (usize, &super::script::Made)| {
            let others = members(made.had).filter(|&other| self.script.made[other].author != made.author);
            let others: Vec<String> = others.map(|other| format!("m{}", other + 1)).collect();
            let after =
                if others.is_empty() { String::new() } else { format!(" after {}", others.join(" and ")) };
            format!(
                "m{} by {}: {}{after}",
                at + 1,
                builder.name(1 + made.author),
                made.mutation.kind().name()
            )
        };
        self.script.made.iter().enumerate().map(told).collect::<Vec<_>>().join("; ")
    }

    fn universal_clauses(&self) -> Vec<String> {
        let kinds: BTreeSet<MutationKind> = self.script.kinds().into_iter().collect();
        let mutations = kinds.into_iter().map(|kind| format!("MUT-{}", kind as usize + 1));
        ["JOIN-3".to_owned(), "VIEW-1".into()].into_iter().chain(mutations).collect()
    }

    fn resolution_clauses(&self) -> Vec<String> {
        let made = &self.script.made;
        let mut rows = BTreeSet::new();
        for left in 0..made.len() {
            for right in (0..left).filter(|&right| self.script.is_concurrent(left, right)) {
                rows.insert(row(made[left].mutation.kind(), made[right].mutation.kind()));
            }
        }
        let mut clauses: Vec<String> = rows.into_iter().map(|row| format!("CONFLICT-{row}")).collect();
        let rules: BTreeSet<&str> = self.repairs.iter().map(|repair| clause_of(repair)).collect();
        clauses.extend(rules.into_iter().map(String::from));
        if (1..=self.script.whole()).any(|set| !self.script.is_closed(set)) {
            clauses.push("CLOSE-4".into());
        }
        if clauses.is_empty() {
            clauses.push("VIEW-1".into());
        }
        clauses
    }
}

fn json(step: &Step) -> String {
    serde_json::to_string(step).unwrap_or_else(|error| error.to_string())
}

const UNIVERSAL: &str =
    "Whoever has received the same shows the same sound graph, whatever order it came in.";
const RESOLUTION: &str =
    "What is shown follows from what has been received, also where causes are still missing.";

/// The row of two kinds in the chapter on conflicts.
const fn row(left: MutationKind, right: MutationKind) -> usize {
    let (left, right) = (left as usize, right as usize);
    let (low, high) = if left < right { (left, right) } else { (right, left) };
    // Rows before that of `low` have six, five, … entries.
    let kinds = MutationKind::ALL.len();
    low * kinds - low * (low + 1) / 2 + high + 1
}

/// The clause by which a repair is made.
fn clause_of(repair: &str) -> &'static str {
    match repair {
        "same-key" => "VIEW-2",
        "rt-parent" | "cycle-broken" => "VIEW-3",
        "detached" => "VIEW-4",
        "reattached" => "VIEW-5",
        "functional" => "VIEW-6",
        "name-clash" => "VIEW-7",
        _ => "VIEW-9",
    }
}

/// FNV-1a, folded to 32 bits.
fn hash(text: &str) -> u32 {
    let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325, mix);
    #[expect(clippy::cast_possible_truncation, reason = "both halves are folded into one")]
    let folded = (hash ^ hash >> 32) as u32;
    folded
}

#[cfg(test)]
mod tests {
    use super::row;
    use dsr_core::MutationKind;

    #[test]
    fn law_rows_number_the_pairs_in_order() {
        let kinds = MutationKind::ALL;
        let mut number = 0;
        for (at, &left) in kinds.iter().enumerate() {
            for &right in &kinds[at..] {
                number += 1;
                assert_eq!((row(left, right), row(right, left)), (number, number));
            }
        }
        assert_eq!(number, 21);
    }
}
