//! The form of the corpus.

use dsr_conformance::case::{read, write as canonical};
use dsr_conformance::corpus::{self, faults, known_ids, listed_ids, similar};

/// `[spec: CONF-15]`
#[test]
fn law_the_corpus_is_in_order() {
    let found = faults(corpus::FILES, corpus::IDS, corpus::MANIFEST);
    assert!(found.is_empty(), "run `dsr conform validate --fix conformance/corpus`: {found:#?}");
}

/// `[spec: CONF-15]`
#[test]
fn law_the_canonical_form_is_one_and_means_the_same() {
    for (path, text) in corpus::FILES {
        let file = read(path, text).unwrap();
        let due = canonical(&file).unwrap();
        assert_eq!(read(path, &due).unwrap(), file);
        assert_eq!(canonical(&read(path, &due).unwrap()).unwrap(), due);
    }
}

/// What is done to files, ids and manifest.
type Change<'c> = dyn Fn(&mut Vec<(String, String)>, &mut String, &mut String) + 'c;

/// `[spec: CONF-15]`
#[test]
fn canary_each_disorder_is_told() {
    let tells = |change: &Change<'_>, piece: &str| {
        let mut files: Vec<(String, String)> =
            corpus::FILES.iter().map(|(path, text)| ((*path).into(), (*text).into())).collect();
        let (mut ids, mut listed) = (corpus::IDS.to_owned(), corpus::MANIFEST.to_owned());
        change(&mut files, &mut ids, &mut listed);
        let files: Vec<_> = files.iter().map(|(path, text)| (path.as_str(), text.as_str())).collect();
        let found = faults(&files, &ids, &listed);
        assert!(found.iter().any(|fault| fault.to_string().contains(piece)), "{piece}: {found:?}");
    };
    let first = corpus::IDS.lines().next().unwrap();
    tells(&|files, _, _| files[0].1 = files[0].1.replacen("  ", "   ", 1), "not in canonical form");
    tells(
        &|files, _, _| files[0].1 = files[0].1.replacen("\"spec\": [\"", "\"spec\": [\"NO-9\", \"", 1),
        "no clause",
    );
    tells(&|files, _, _| files[0].1.truncate(100), "EOF");
    tells(&|files, _, _| drop(files.remove(0)), "is gone");
    tells(&|_, ids, _| *ids = ids.replacen(&format!("{first}\n"), "", 1), "is not in ids.txt");
    tells(&|_, ids, _| *ids = ids.replacen(first, &format!("{first} retired"), 1), "another case's");
    tells(&|_, ids, _| *ids = format!("{ids}{first}\n"), "ids.txt:");
    tells(&|_, _, listed| *listed = listed.replacen("\"cases\": ", "\"cases\": 1", 1), "MANIFEST.json");
    tells(
        &|files, _, _| files[0].1 = files[0].1.replacen("\"why\": \"", "\"why\": \"Now. ", 1),
        "MANIFEST.json",
    );
    tells(
        &|files, _, _| {
            let (path, text) = files[0].clone();
            files.push((path, text));
        },
        "is in",
    );
}

/// `[spec: CONF-15]`
#[test]
fn law_ids_are_read_as_they_are_written() {
    let known = known_ids("a/b/c\na/b/d retired\n").unwrap();
    assert_eq!((known.used.len(), known.retired.len()), (1, 1));
    assert_eq!(listed_ids(&known), "a/b/c\na/b/d retired\n");
    assert_eq!(known_ids("a/b/c\na/b/c retired\n"), Err(2));
    assert_eq!(known_ids("a/b\n"), Err(1));
}

#[test]
fn law_the_first_look_names_cases_and_suggestions_are_near() {
    let cases = corpus::cases().unwrap();
    let ids: Vec<&str> = cases.iter().map(|case| case.id.as_str()).collect();
    let smoke = corpus::smoke().unwrap();
    assert!((4..=7).contains(&smoke.len()));
    assert!(smoke.iter().all(|id| ids.contains(&id.as_str())), "{smoke:?}");
    assert_eq!(similar("universal/delivery/twise", ids.iter().copied())[0], "universal/delivery/twice");
    assert_eq!(similar("twise", ids.iter().copied())[0], "universal/delivery/twice");
    assert!(similar("xxxxxxxxxxxxxxxxxxxxxxxxxxx", ids).is_empty());
}
