//! Broken programs are found; programs that cannot be asked are no agreement.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on says where")]

mod common;

use common::core;
use dsr_core::{Dictionary, State};
use dsr_model::progress::{Limits, Progress};
use dsr_oracle::compare::{Compared, Fact, ask_each};
use dsr_oracle::fact::{Question, read};
use dsr_oracle::flawed::Flaw;
use dsr_oracle::histories::{Extent, RunFound, run as search, runs};
use dsr_oracle::program::{Start, Trouble};
use dsr_oracle::random::{Counts, carry_out, draw, run as random};
use dsr_oracle::verdict::Verdict;
use std::sync::Arc;
use std::sync::atomic::Ordering::Relaxed;
use std::time::Duration;

fn first_run(flaw: &str) -> Result<RunFound, Trouble> {
    let run = runs(Extent::Small).unwrap().remove(0);
    search(&run, &core(flaw), 2, &Arc::new(Progress::new(Limits::default())))
}

/// `[spec: ORACLE-4]` `[spec: ORACLE-5]` `[spec: ORACLE-7]`
#[test]
fn oracle_the_sound_core_agrees_with_itself_in_every_history() {
    let found = first_run("sound").unwrap();
    assert_eq!(found.verdict(), Verdict::Agree);
    assert!(found.histories > 1000 && found.asked() > 10_000, "{found:?}");
    let kinds = found.facts.values().filter(|&&count| count > 0).count();
    assert_eq!(kinds, 5, "all kinds but bytes from outside: {:?}", found.facts);
}

/// `[spec: ORACLE-5]` `[spec: ORACLE-7]`
#[test]
fn canary_a_search_finds_each_broken_answer_and_shows_the_shortest_history() {
    for (flaw, steps_max) in
        [("join", 4), ("delta", 1), ("refusal", 2), ("view", 4), ("digest", 1), ("answer", 4)]
    {
        let found = first_run(flaw).unwrap();
        assert_eq!(found.verdict(), Verdict::Disagree, "{flaw}");
        let trace = found.counterexample.unwrap().trace.unwrap();
        assert!(trace.contains("[ORACLE-5] the program says otherwise"), "{flaw}: {trace}");
        let is_step = |line: &&str| line.trim_start().starts_with(|first: char| first.is_ascii_digit());
        assert!(trace.lines().filter(is_step).count() <= steps_max, "{flaw}: {trace}");
    }
}

/// `[spec: ORACLE-5]` `[spec: ORACLE-7]`
#[test]
fn canary_random_histories_find_each_broken_answer_and_are_shrunk() {
    let flaws = [
        ("join", 6),
        ("delta", 4),
        ("refusal", 4),
        ("view", 8),
        ("digest", 4),
        ("answer", 8),
        ("accepts", 8),
    ];
    for (flaw, events_max) in flaws {
        let found = random(&core(flaw), 2, 5, 0..20_000, &|_| {}).unwrap();
        assert!(found.compared.disagreeing.load(Relaxed) > 0, "{flaw}");
        let shrunk = found.shrunk.unwrap();
        let events = shrunk.history.events.len();
        assert!(events <= events_max && events <= shrunk.events_before, "{flaw}: {:?}", shrunk.history);
        let disagreement = shrunk.disagreement.unwrap();
        assert_ne!(disagreement.fact.ours, disagreement.theirs);
    }
}

/// `[spec: ORACLE-6]`
#[test]
fn canary_a_program_that_cannot_be_asked_is_no_agreement() {
    let trouble = |flaw: &str| random(&core(flaw), 1, 1, 0..100, &|_| {}).unwrap_err();
    assert!(matches!(trouble("crash"), Trouble::Ended { ref how, .. } if how.contains('7')));
    assert!(matches!(trouble("short"), Trouble::Ended { .. }));
    assert!(matches!(trouble("garbage"), Trouble::Garbage { .. }));
    assert!(
        matches!(trouble("twice"), Trouble::Garbage { .. } | Trouble::Unasked { .. }),
        "{}",
        trouble("twice")
    );
    let impatient = Start { patience: Duration::from_millis(300), ..core("hang") };
    let late = random(&impatient, 1, 1, 0..100, &|_| {}).unwrap_err();
    assert!(matches!(late, Trouble::Late { .. }), "{late}");
    for flaw in ["crash", "short", "garbage"] {
        assert!(first_run(flaw).is_err(), "{flaw}");
    }
    let nowhere = random(&Start::new("./nowhere/dsr-oracle"), 1, 1, 0..10, &|_| {}).unwrap_err();
    assert!(nowhere.to_string().contains("spec/coq/check"), "{nowhere}");
    // A program that knows no facts ends at once.
    let deaf = random(&Start::new("/bin/true"), 1, 1, 0..10, &|_| {}).unwrap_err();
    assert!(matches!(deaf, Trouble::Ended { .. }), "{deaf}");
}

/// A program may be asked far ahead of its answers, whatever pipes hold. `[spec: ORACLE-1]`
#[test]
fn regress_nobody_waits_for_a_full_pipe() {
    let state = State::new();
    let question = Question::View(state);
    let fact = Fact::of(0, &question, &Dictionary::open());
    let wide = Fact { line: format!("accepts {}", "00".repeat(200_000)), ours: "no".into(), about: 0 };
    let compared = Compared::default();
    let mut batches = vec![vec![fact; 50_000], vec![wide; 40]];
    ask_each(&core("sound"), &compared, &mut || batches.pop());
    assert_eq!((compared.trouble(), compared.tally.total()), (None, 50_040));
    assert_eq!(compared.disagreeing.load(Relaxed), 0);
}

/// `[spec: ORACLE-2]`
#[test]
fn law_a_question_is_read_as_it_is_written() {
    let mut asked = 0;
    for number in 0..200 {
        for fact in carry_out(&draw(3, number), &mut Counts::default()) {
            if fact.line.starts_with("dictionary ") {
                continue;
            }
            let question = read(&fact.line).unwrap();
            assert_eq!(question.line(), fact.line);
            asked += 1;
        }
    }
    assert!(asked > 1000);
    for unclear in
        ["", "view", "view 0G", "view 0", "join 020000", "delta r1 020000 {}", "answer 020000", "knows 00"]
    {
        assert!(read(unclear).is_err(), "{unclear}");
    }
    assert!(Flaw::of("sound").is_some() && Flaw::of("nothing").is_none());
}
