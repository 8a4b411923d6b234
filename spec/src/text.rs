//! The chapters, and the text of each clause in them.

use crate::clause::head;
use crate::{ClauseId, Source};

macro_rules! chapters {
    ($($name:literal),* $(,)?) => {
        /// Each chapter: its path from the workspace root, and its text.
        pub const CHAPTERS: &[(&str, &str)] =
            &[$((concat!("spec/", $name, ".md"), include_str!(concat!("../", $name, ".md")))),*];
    };
}

chapters! {
    "README", "checker", "claims", "closure", "conflicts", "conformance", "context", "dictionary", "encoding",
    "identity", "intent", "invariants", "join", "limits", "mutations", "network", "oracle", "replica", "scenario", "scene",
    "stamps", "state", "sync", "trace", "transport", "values", "view", "wellformed",
}

/// The chapters as sources.
pub fn chapters() -> Vec<Source> {
    CHAPTERS.iter().map(|(path, text)| Source::new(path, text)).collect()
}

/// The text of a clause, as its chapter has it, and the chapter's path; `None` if there is no such clause.
pub fn clause_text(id: &ClauseId) -> Option<(&'static str, String)> {
    CHAPTERS.iter().find_map(|(path, text)| Some((*path, text_in(text, id)?)))
}

/// From the head of the clause to the next head or heading.
pub(crate) fn text_in(text: &str, id: &ClauseId) -> Option<String> {
    let mut fenced = false;
    let mut found: Option<Vec<&str>> = None;
    for line in text.lines() {
        if line.starts_with("```") {
            fenced = !fenced;
        }
        let begins = if fenced { None } else { head(line) };
        match &mut found {
            None if begins.as_ref() == Some(id) => found = Some(vec![line]),
            None => {}
            Some(_) if begins.is_some() || (!fenced && line.starts_with('#')) => break,
            Some(lines) => lines.push(line),
        }
    }
    found.map(|lines| lines.join("\n").trim_end().to_owned())
}

#[cfg(test)]
mod tests {
    use super::{CHAPTERS, chapters, clause_text};
    use crate::collect_clauses;
    use std::collections::BTreeSet;

    #[test]
    fn law_every_clause_has_its_text() {
        let (clauses, _) = collect_clauses(&chapters());
        assert!(clauses.all().len() > 100);
        for clause in clauses.all() {
            let (path, text) = clause_text(&clause.id).unwrap();
            assert_eq!(path, clause.place.path);
            assert!(text.starts_with(&format!("**{}", clause.id)), "{text}");
            assert!(text.len() > 20, "{text}");
        }
        assert_eq!(clause_text(&"NONE-1".parse().unwrap()), None);
    }

    #[test]
    fn law_every_chapter_is_taken_in() {
        let folder = std::fs::read_dir(env!("CARGO_MANIFEST_DIR")).unwrap();
        let names = folder.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let found: BTreeSet<String> = names
            .filter(|name| name.strip_suffix(".md").is_some_and(|name| name != "MATRIX"))
            .map(|name| format!("spec/{name}"))
            .collect();
        let listed: BTreeSet<String> = CHAPTERS.iter().map(|(path, _)| (*path).into()).collect();
        assert_eq!(found, listed);
    }
}
