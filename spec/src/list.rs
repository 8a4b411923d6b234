//! Lists of clause ids, in the cells of tables and in sentences.

use crate::ClauseId;

/// A part of a list that is neither an id nor a range of ids.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct NoList(pub(crate) String);

/// The ids of a list such as `JOIN-3, WF-4 – WF-6`, ranges written out. An empty text lists none.
pub(crate) fn listed(text: &str) -> Result<Vec<ClauseId>, NoList> {
    let mut ids = Vec::new();
    for part in text.split(',').map(str::trim).filter(|part| !part.is_empty()) {
        let fail = || NoList(part.into());
        match part.split_once(" – ") {
            Some((first, last)) => {
                let (first, last) = (id(first).ok_or_else(fail)?, id(last).ok_or_else(fail)?);
                ids.extend(first.to(&last).ok_or_else(fail)?);
            }
            None => ids.push(id(part).ok_or_else(fail)?),
        }
    }
    Ok(ids)
}

/// The ids that a sentence names, in order, with what lies between in `INV-1 to INV-6`.
pub(crate) fn named(text: &str) -> Vec<ClauseId> {
    let mut ids: Vec<ClauseId> = Vec::new();
    let mut before = ["", ""];
    for word in text.split_whitespace() {
        let word = word.trim_matches(|c: char| !c.is_ascii_alphanumeric());
        if let Some(found) = id(word) {
            let first = id(before[0]).filter(|_| before[1] == "to");
            match first.and_then(|first| first.to(&found)) {
                Some(range) => ids.extend(range.into_iter().skip(1)),
                None => ids.push(found),
            }
        }
        before = [before[1], word];
    }
    ids
}

/// A list as [`listed`] reads it: three or more ids that follow each other become a range.
pub(crate) fn collapsed<'i>(ids: impl IntoIterator<Item = &'i ClauseId>) -> String {
    let mut runs: Vec<Vec<&ClauseId>> = Vec::new();
    for id in ids {
        let follows = |run: &&mut Vec<&ClauseId>| {
            run.last().and_then(|last| last.to(id)).is_some_and(|range| range.len() == 2)
        };
        match runs.last_mut().filter(follows) {
            Some(run) => run.push(id),
            None => runs.push(vec![id]),
        }
    }
    let text = |run: &Vec<&ClauseId>| match run.as_slice() {
        [first, _, .., last] => format!("{first} – {last}"),
        few => few.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "),
    };
    runs.iter().map(text).collect::<Vec<_>>().join(", ")
}

fn id(text: &str) -> Option<ClauseId> {
    text.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::{NoList, collapsed, listed, named};

    fn texts(ids: &[crate::ClauseId]) -> Vec<String> {
        ids.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn law_lists_are_read_as_they_are_written() {
        let text = "JOIN-3, WF-4 – WF-6, MUT-1.1 – MUT-1.3, CLAIM-L1";
        let ids = listed(text).unwrap();
        assert_eq!(ids.len(), 8);
        assert_eq!(collapsed(&ids), text);
        assert_eq!(collapsed(&listed("WF-1, WF-2").unwrap()), "WF-1, WF-2");
        assert_eq!(listed(""), Ok(vec![]));
    }

    #[test]
    fn oracle_what_is_no_list_is_refused_with_its_part() {
        for (text, part) in [
            ("JOIN-3, join-4", "join-4"),
            ("WF-6 – WF-4", "WF-6 – WF-4"),
            ("WF-1 – JOIN-4", "WF-1 – JOIN-4"),
            ("JOIN-3 JOIN-4", "JOIN-3 JOIN-4"),
        ] {
            assert_eq!(listed(text), Err(NoList(part.into())));
        }
    }

    #[test]
    fn oracle_sentences_name_ids_and_ranges() {
        let text = "Kept: VIEW-1, INV-1 to INV-3, under NET-1; UTF-8 is a word, and (MUT-0.1).";
        assert_eq!(texts(&named(text)), ["VIEW-1", "INV-1", "INV-2", "INV-3", "NET-1", "UTF-8", "MUT-0.1"]);
    }
}
