//! Expectations that fit a run.

use super::{Expectations, Expected};
use crate::corpus::matches;
use crate::report::{Report, Verdict};

/// What a run came to, as expectations. Entries that still hold for every case of the run that they match stay as they are,
/// and so do those about cases that were not run; new ones have an empty reason, which a person must write. `ids` are those
/// of the whole corpus. `[spec: CONF-14]`
pub fn update(old: Option<&Expectations>, report: &Report, ids: &[String]) -> Expectations {
    let results = &report.results;
    let stays = |entry: &&Expected| {
        let mut about = results.iter().filter(|result| matches(&entry.case, &result.id)).peekable();
        if about.peek().is_none() {
            return ids.iter().any(|id| matches(&entry.case, id));
        }
        about.all(|result| result.verdict == entry.verdict)
    };
    let known = old.map(|old| old.expected.as_slice()).unwrap_or_default();
    let mut expected: Vec<Expected> = known.iter().filter(stays).cloned().collect();
    for result in results {
        let is_expected =
            |entry: &Expected| entry.verdict == result.verdict && matches(&entry.case, &result.id);
        if matches!(result.verdict, Verdict::Pass | Verdict::Unsupported) || expected.iter().any(is_expected)
        {
            continue;
        }
        // A pattern that does not hold for all of its cases any more leaves its reason to those for which it does.
        let before = known.iter().find(|entry| is_expected(entry));
        let reason = before.map(|entry| entry.reason.clone()).unwrap_or_default();
        let issue = before.and_then(|entry| entry.issue.clone());
        expected.push(Expected { case: result.id.clone(), verdict: result.verdict, reason, issue });
    }
    expected.sort_by(|one, other| (&one.case, one.verdict).cmp(&(&other.case, other.verdict)));
    let named = report.implementation.as_ref().map(|implementation| implementation.name.clone());
    let before = || old.map(|old| old.implementation.clone()).unwrap_or_default();
    Expectations { implementation: named.unwrap_or_else(before), expected }
}
