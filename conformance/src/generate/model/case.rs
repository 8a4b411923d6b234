//! The two cases of a history. `[spec: CONF-20]`

use super::scene::{Group, dictionary};
use super::script::{Script, Set, members};
use super::sight::Seen;
use super::{Rule, write};
use crate::case::{Case, Level, Origin, Provenance, Step};
use crate::generate::{Builder, CannotWrite};
use crate::protocol::{Feature, Profile};
use dsr_core::{Dictionary, MutationKind};
use std::collections::BTreeSet;
use std::sync::Arc;

/// What is known of a history that is kept.
#[derive(Debug)]
pub(super) struct Writer<'w> {
    pub(super) group: &'w Group,
    pub(super) script: &'w Script,
    pub(super) rule: Rule,
    /// By set, whether nothing in it is disputed.
    pub(super) undisputed: Vec<bool>,
    /// By set, what is seen.
    pub(super) seen: Vec<Arc<Seen>>,
    /// Whether no history before it looks the same where causes are missing.
    pub(super) is_new_early: bool,
}

impl Writer<'_> {
    /// The cases: what every sound implementation does, unless an author has decided on something disputed; what this
    /// specification makes of sets in which something is; and what it shows where causes are missing.
    pub(super) fn cases(&self) -> Result<[Option<Case>; 3], CannotWrite> {
        let made = &self.script.made;
        let is_undisputed = |set: Set| self.undisputed.get(set as usize).copied().unwrap_or(false);
        let is_founded = made.iter().all(|made| self.script.is_closed(made.had));
        let universal = if made.iter().all(|made| is_undisputed(made.had)) {
            let shows = is_undisputed(self.script.whole());
            self.case(Part::Universal, |dictionary| write::equal(self.script, dictionary, shows), |_| false)?
        } else {
            None
        };
        // An undisputed part is a smaller history, and one that is alike is kept.
        let is_early = |set: Set| !(is_undisputed(set) || is_founded && self.script.is_closed(set));
        let is_late = |set: Set| !is_undisputed(set) && is_founded && self.script.is_closed(set);
        let exact = |is_wanted: &dyn Fn(Set) -> bool, part: Part| {
            if self.sets().any(is_wanted) {
                let write = |dictionary| write::exact(self.script, dictionary, is_wanted);
                self.case(part, write, is_wanted)
            } else {
                Ok(None)
            }
        };
        let resolution = exact(&is_late, Part::Resolution)?;
        let early = if self.is_new_early { exact(&is_early, Part::Early)? } else { None };
        Ok([universal, resolution, early])
    }

    fn sets(&self) -> impl Iterator<Item = Set> + use<> {
        1..=self.script.whole()
    }

    fn case(
        &self,
        part: Part,
        write: impl Fn(Dictionary) -> Result<Builder, CannotWrite>,
        is_read: impl Fn(Set) -> bool,
    ) -> Result<Option<Case>, CannotWrite> {
        let (with, without) = (write(dictionary())?, write(Dictionary::open()));
        // Who knows no dictionaries is asked wherever none matters.
        let needed = without.map_or(true, |without| without.steps != with.steps);
        Ok(Some(Case {
            id: format!("{}/{}/{}", part.family(), part.topic(self.group), self.slug(&with)),
            title: self.title(&with),
            why: part.why().into(),
            spec: self.clauses(part, is_read),
            level: Level::Must,
            profile: Profile::Observe,
            requires: needed.then_some(Feature::Dictionary).into_iter().collect(),
            replicas: with.names(),
            dictionary: needed.then(dictionary),
            steps: with.steps,
            provenance: self.provenance(),
            choice: None,
            since: None,
        }))
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

    /// The mutations of what everybody does; the rows of the concurrent pairs, and the rules by which there are repairs.
    fn clauses(&self, part: Part, is_read: impl Fn(Set) -> bool) -> Vec<String> {
        let made = &self.script.made;
        if matches!(part, Part::Universal) {
            let kinds: BTreeSet<MutationKind> = self.script.kinds().into_iter().collect();
            let mutations = kinds.into_iter().map(|kind| format!("MUT-{}", kind as usize + 1));
            return ["JOIN-3".to_owned(), "VIEW-1".into()].into_iter().chain(mutations).collect();
        }
        let mut clauses = Vec::new();
        if matches!(part, Part::Early) {
            clauses.push("CLOSE-4".to_owned());
        }
        let mut rows = BTreeSet::new();
        for left in 0..made.len() {
            for right in (0..left).filter(|&right| self.script.is_concurrent(left, right)) {
                rows.insert(row(made[left].mutation.kind(), made[right].mutation.kind()));
            }
        }
        clauses.extend(rows.into_iter().map(|row| format!("CONFLICT-{row}")));
        let repairs =
            self.sets().filter(|&set| is_read(set)).flat_map(|set| &self.seen[set as usize].repairs);
        let rules: BTreeSet<&str> = repairs.map(|repair| clause_of(repair)).collect();
        clauses.extend(rules.into_iter().map(String::from));
        clauses
    }
}

/// Which of its cases.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Part {
    /// What every sound implementation does.
    Universal,
    /// Sets in which something is disputed.
    Resolution,
    /// Sets in which causes are missing.
    Early,
}

impl Part {
    /// All, in the order of [`Writer::cases`].
    pub(super) const ALL: [Self; 3] = [Self::Universal, Self::Resolution, Self::Early];

    pub(super) const fn family(self) -> &'static str {
        match self {
            Self::Universal => "universal",
            Self::Resolution | Self::Early => "resolution",
        }
    }

    pub(super) fn topic(self, group: &Group) -> String {
        match self {
            Self::Universal | Self::Resolution => group.topic(),
            Self::Early => format!("{}-early", group.topic()),
        }
    }

    const fn why(self) -> &'static str {
        match self {
            Self::Universal => {
                "Whoever has received the same shows the same sound graph, whatever order it came in."
            }
            Self::Resolution => "Who decides otherwise shows another graph than everybody else.",
            Self::Early => {
                "Who holds back what has come before its causes shows less than what is known, and who does not                  must show it soundly."
            }
        }
    }
}

fn json(step: &Step) -> String {
    serde_json::to_string(step).unwrap_or_else(|error| error.to_string())
}

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
