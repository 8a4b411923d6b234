//! The cases from the model are what the checker's histories give. Run with `DSR_WRITE=1` to write them anew.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use dsr_conformance::case::write;
use dsr_conformance::generate::{Generated, Group, model};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::thread;

/// All groups, on two threads.
fn generated() -> Vec<(Group, Generated)> {
    let ahead = Mutex::new(Group::all().into_iter().enumerate());
    let done = Mutex::new(BTreeMap::new());
    thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                loop {
                    let Some((number, group)) = ahead.lock().unwrap().next() else { return };
                    let generated = model(&group).unwrap();
                    done.lock().unwrap().insert(number, (group, generated));
                }
            });
        }
    });
    done.into_inner().unwrap().into_values().collect()
}

fn folder(family: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus/v1").join(family)
}

/// `[spec: CONF-20]`
#[test]
fn conform_the_models_cases_are_those_of_its_histories() {
    let groups = generated();
    let mut expected = BTreeMap::new();
    let mut ids = BTreeSet::new();
    for (group, generated) in &groups {
        let Generated { histories, different, alike, kept, files } = generated;
        let cases: usize = files.iter().map(|file| file.cases.len()).sum();
        println!(
            "{:<40} {histories:>6} histories, {different:>6} different, {alike:>4} unlike, {kept:>3} kept: {cases} cases",
            group.topic()
        );
        for file in files {
            for case in &file.cases {
                assert!(ids.insert(case.id.clone()), "{} is there twice", case.id);
            }
            expected.insert(folder(&file.family).join(format!("{}.json", file.topic)), write(file).unwrap());
        }
    }
    if std::env::var_os("DSR_WRITE").is_some() {
        for (path, text) in &expected {
            std::fs::write(path, text).unwrap();
        }
    }
    let mut found = BTreeSet::new();
    for family in ["universal", "resolution"] {
        let paths = std::fs::read_dir(folder(family)).unwrap().map(|file| file.unwrap().path());
        found.extend(paths.filter(|path| path.file_name().unwrap().to_string_lossy().starts_with("model-")));
    }
    assert!(found.iter().eq(expected.keys()), "files of the model: {found:#?}, {:#?}", expected.keys());
    for (path, text) in &expected {
        let written = std::fs::read_to_string(path).unwrap();
        assert!(written == *text, "{} is out of date: run this test with DSR_WRITE=1", path.display());
    }
}
