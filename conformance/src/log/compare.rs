//! What changed between two runs. `[spec: CONF-17]`

use super::{CaseLine, Log};
use crate::report::Verdict;
use std::collections::{BTreeMap, BTreeSet};

/// A case that came out otherwise.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Change {
    /// The case.
    pub id: String,
    /// Before; `None` if it was not there.
    pub before: Option<Verdict>,
    /// After; `None` if it is not there.
    pub after: Option<Verdict>,
    /// Why, after.
    pub detail: String,
}

/// What changed.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Comparison {
    /// What differs between the headers, in words.
    pub headers: Vec<String>,
    /// Every case whose verdict changed, by id.
    pub changes: Vec<Change>,
    /// How many have the verdict that they had.
    pub same: usize,
}

impl Change {
    /// Whether it is worse than before: a pass that is none any more, or something left out that is bad now.
    pub fn is_worse(&self) -> bool {
        match (self.before, self.after) {
            (None, Some(after)) => after.is_bad(),
            (before, after) => rank(after) > rank(before),
        }
    }

    /// Whether it is better than before.
    pub fn is_better(&self) -> bool {
        rank(self.after) < rank(self.before)
    }
}

/// 0 for a pass, 1 for what is left out, 2 for what is bad.
fn rank(verdict: Option<Verdict>) -> u8 {
    match verdict {
        Some(Verdict::Pass) => 0,
        Some(verdict) if verdict.is_bad() => 2,
        Some(_) | None => 1,
    }
}

impl Comparison {
    /// Whether something is worse.
    pub fn is_worse(&self) -> bool {
        self.changes.iter().any(Change::is_worse)
    }
}

/// Compares two logs, case by case; neither their order nor how long something took counts.
pub fn compare(before: &Log, after: &Log) -> Comparison {
    let by_id = |log: &'_ Log| -> BTreeMap<String, CaseLine> {
        log.cases.iter().map(|case| (case.id.clone(), case.clone())).collect()
    };
    let (old, new) = (by_id(before), by_id(after));
    let ids: BTreeSet<&String> = old.keys().chain(new.keys()).collect();
    let mut comparison = Comparison { headers: headers(before, after), ..Comparison::default() };
    for id in ids {
        let verdicts = (old.get(id).map(|case| case.verdict), new.get(id).map(|case| case.verdict));
        if verdicts.0 == verdicts.1 {
            comparison.same += 1;
        } else {
            let detail = new.get(id).map(|case| case.detail.clone()).unwrap_or_default();
            comparison.changes.push(Change { id: id.clone(), before: verdicts.0, after: verdicts.1, detail });
        }
    }
    comparison
}

fn headers(before: &Log, after: &Log) -> Vec<String> {
    let (old, new) = (&before.header, &after.header);
    let named = |log: &super::Header| {
        let known = log.implementation.as_ref();
        known.map_or("it never said".to_owned(), |known| format!("{} {}", known.name, known.version))
    };
    let pairs = [
        ("implementation", named(old), named(new)),
        ("protocol", old.protocol.to_string(), new.protocol.to_string()),
        ("corpus", old.corpus.clone(), new.corpus.clone()),
        ("spec", old.spec.clone(), new.spec.clone()),
        ("filter", old.only.clone(), new.only.clone()),
    ];
    let differing = pairs.into_iter().filter(|(_, old, new)| old != new);
    differing.map(|(what, old, new)| format!("{what}: {old} → {new}")).collect()
}
