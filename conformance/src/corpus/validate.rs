//! Whether a corpus is in order. `[spec: CONF-15]`

use super::{known_ids, manifest};
use crate::case::{CaseFile, read, write};
use dsr_spec::{Clauses, chapters, collect_clauses};
use std::collections::BTreeMap;

/// Something that is not in order.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{place}: {what}; {remedy}")]
pub struct CorpusFault {
    /// Which file, and line if one is known.
    pub place: String,
    /// What is wrong.
    pub what: String,
    /// What to do about it.
    pub remedy: String,
}

fn fault(place: impl Into<String>, what: impl Into<String>, remedy: &str) -> CorpusFault {
    CorpusFault { place: place.into(), what: what.into(), remedy: remedy.into() }
}

/// What is wrong with one file by itself: its form, its clauses, its formatting.
pub fn faults_of_file(path: &str, text: &str) -> (Option<CaseFile>, Vec<CorpusFault>) {
    faults_with(path, text, &collect_clauses(&chapters()).0)
}

fn faults_with(path: &str, text: &str, clauses: &Clauses) -> (Option<CaseFile>, Vec<CorpusFault>) {
    let file = match read(path, text) {
        Ok(file) => file,
        Err(error) => {
            return (None, vec![fault(format!("{path}:{}", error.line), error.what, &error.remedy)]);
        }
    };
    let mut faults = Vec::new();
    for case in &file.cases {
        if case.title.trim().is_empty() || case.why.trim().is_empty() {
            faults.push(fault(path, format!("{:?} lacks its title or its reason", case.id), "write both"));
        }
        for clause in &case.spec {
            if clause.parse().ok().and_then(|id| clauses.get(&id)).is_none() {
                let what = format!("{:?} cites {clause}, which is no clause", case.id);
                faults.push(fault(path, what, "cite one that spec/ has"));
            }
        }
    }
    match write(&file) {
        Ok(due) if due == text => {}
        Ok(due) => {
            let same = due.lines().zip(text.lines()).take_while(|(due, found)| due == found).count();
            faults.push(fault(
                format!("{path}:{}", same + 1),
                "not in canonical form",
                "run `dsr conform validate --fix`",
            ));
        }
        Err(error) => faults.push(fault(path, error.to_string(), "write what can be written as JSON")),
    }
    (Some(file), faults)
}

/// What is wrong with a whole corpus: its files in order of path, the list of ids, the manifest.
pub fn faults(files: &[(&str, &str)], ids: &str, listed: &str) -> Vec<CorpusFault> {
    let (clauses, _) = collect_clauses(&chapters());
    let mut faults = Vec::new();
    let mut read = Vec::new();
    let mut places: BTreeMap<String, &str> = BTreeMap::new();
    let known = known_ids(ids).unwrap_or_else(|line| {
        let remedy = "write each id once, a line each, and ` retired` behind those whose cases are gone";
        faults.push(fault(format!("ids.txt:{line}"), "no id, or one that stands before", remedy));
        super::Known::default()
    });
    for (path, text) in files {
        let (file, found) = faults_with(path, text, &clauses);
        faults.extend(found);
        let Some(file) = file else { continue };
        for case in &file.cases {
            if let Some(first) = places.insert(case.id.clone(), path) {
                faults.push(fault(
                    *path,
                    format!("{:?} is in {first}, too", case.id),
                    "give one of them another id",
                ));
            }
            if known.retired.contains(&case.id) {
                let what = format!("the id {:?} was another case's", case.id);
                faults.push(fault(*path, what, "ids are never used again: give it another"));
            } else if !known.used.contains(&case.id) {
                let what = format!("{:?} is not in ids.txt", case.id);
                faults.push(fault(*path, what, "run `dsr conform validate --fix`"));
            }
        }
        read.push((*path, *text, file));
    }
    for id in known.used.iter().filter(|id| !places.contains_key(*id)) {
        let remedy = "bring it back, or write ` retired` behind its id";
        faults.push(fault("ids.txt", format!("the case {id:?} is gone"), remedy));
    }
    let read: Vec<_> = read.iter().map(|(path, text, file)| (*path, *text, file)).collect();
    if manifest(&read).ok().as_deref() != Some(listed) {
        faults.push(fault(
            "MANIFEST.json",
            "does not say what the files are",
            "run `dsr conform validate --fix`",
        ));
    }
    faults
}
