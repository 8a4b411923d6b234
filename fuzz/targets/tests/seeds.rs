//! What the fuzzer has found is replayed, and reaches everything rare.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

use dsr_fuzz_targets::noise::Noise;
use dsr_fuzz_targets::seeds::{self, Best};
use dsr_fuzz_targets::{Marks, TARGETS, Target, target, watch};
use std::collections::BTreeSet;
use std::fs;

/// Inputs that once broke something, and do so no more; they need not reach a mark.
const CRASH: &str = "crash-";

/// Each seed keeps every law, and reaches the mark that it is named after.
#[test]
fn regress_every_seed() {
    for target in &TARGETS {
        for (name, input) in seeds::files(&seeds::folder().join(target.name)).unwrap() {
            let marks =
                (target.run)(&input).unwrap_or_else(|broken| panic!("{}/{name}: {broken}", target.name));
            assert!(name.starts_with(CRASH) || marks.has(&name), "{}/{name} reaches {marks:?}", target.name);
            assert!(input.len() <= 16 << 10, "{}/{name} is large: {} bytes", target.name, input.len());
        }
    }
}

/// The seeds reach every mark in the list, and no other: a new one belongs into the list, with a seed.
#[test]
fn law_seeds_reach_every_mark() {
    let mut count = 0;
    for target in &TARGETS {
        let mut reached = BTreeSet::new();
        for (_, input) in seeds::files(&seeds::folder().join(target.name)).unwrap() {
            let marks = (target.run)(&input).unwrap();
            reached.extend(marks.iter().map(str::to_owned));
        }
        let listed: BTreeSet<String> = target.marks.iter().map(|mark| (*mark).to_owned()).collect();
        assert_eq!(reached, listed, "{}", target.name);
        assert_eq!(listed.len(), target.marks.len(), "{}: a mark is listed twice", target.name);
        count += listed.len();
    }
    println!("{count} marks");
}

/// The inputs to begin with, and some made of them, keep every law: a fuzzer of a few seconds.
#[test]
fn law_changed_inputs_keep_the_laws() {
    for target in &TARGETS {
        let mut best = Best::default();
        let pool = (target.first)();
        assert!(!pool.is_empty(), "{}", target.name);
        let rounds = if target.name == "trace" { 100 } else { 1500 };
        for input in &pool {
            best.try_input(target, input).unwrap();
        }
        seeds::search(target, &mut best, &pool, rounds, &mut Noise::new(7)).unwrap();
        let few = target.marks.iter().filter(|mark| best.0.contains_key(**mark)).count();
        assert!(2 * few > target.marks.len(), "{}: {few} of {} marks", target.name, target.marks.len());
    }
}

/// What is minimised still reaches its mark, and is not longer.
#[test]
fn law_minimised_inputs_reach_their_mark() {
    let history = target("history").unwrap();
    let input = Noise::new(11).bytes(400);
    let marks = (history.run)(&input).unwrap();
    for mark in marks.iter().step_by(5) {
        let small = seeds::minimised(history, mark, &input);
        assert!(small.len() < input.len() && (history.run)(&small).unwrap().has(mark), "{mark}");
    }
    assert!(marks.iter().count() > 10, "{marks:?}");
}

/// libFuzzer learns of a broken law.
#[test]
#[should_panic(expected = "[JOIN-4] no join")]
fn law_a_broken_law_panics() {
    let broken = |_: &[u8]| Err(dsr_fuzz_targets::Broken { clause: "JOIN-4", what: "no join".into() });
    watch(&Target { run: broken, ..TARGETS[0] }, &[]);
}

/// There is a binary for each target, and nothing is run that is none.
#[test]
fn law_each_target_has_its_binary() {
    let folder = seeds::folder().join("../fuzz_targets");
    let files: BTreeSet<String> = seeds::files(&folder).unwrap().into_iter().map(|(name, _)| name).collect();
    let expected: BTreeSet<String> = TARGETS.iter().map(|target| format!("{}.rs", target.name)).collect();
    assert_eq!(files, expected);
    let manifest = fs::read_to_string(folder.join("../Cargo.toml")).unwrap();
    for target in &TARGETS {
        assert!(manifest.contains(&format!("name = \"{}\"", target.name)), "{}", target.name);
        let text = fs::read_to_string(folder.join(format!("{}.rs", target.name))).unwrap();
        assert!(text.contains(&format!("watch(\"{}\"", target.name)), "{}", target.name);
    }
}

/// No marks without an input that has reached them.
#[test]
fn law_marks_begin_empty() {
    assert!(Marks::default().is_empty());
    assert_eq!(
        (target("decode_state").unwrap().run)(&[]).unwrap().iter().collect::<Vec<_>>(),
        ["refused-End"]
    );
}
