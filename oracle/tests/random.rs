//! Random histories.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on says where")]

mod common;

use common::{core, extracted};
use dsr_oracle::program::FACTS;
use dsr_oracle::random::{Counts, carry_out, draw, run, tell};
use std::sync::atomic::Ordering::Relaxed;

/// All that has to occur occurs, so that an agreement says something. `[spec: ORACLE-5]`
#[test]
fn law_nothing_is_vacuous_in_ten_thousand_histories() {
    let mut counts = Counts::default();
    for number in 0..10_000 {
        carry_out(&draw(1, number), &mut counts);
    }
    assert_eq!(counts.never(), Vec::<&str>::new());
}

/// `[spec: ORACLE-4]`
#[test]
fn law_a_number_decides_a_history() {
    for number in [0, 1, 4711, u64::MAX] {
        assert_eq!(draw(7, number), draw(7, number));
        assert!(!tell(&draw(7, number)).is_empty());
    }
    assert_ne!(draw(7, 1), draw(7, 2));
    assert_ne!(draw(7, 1).events, draw(8, 1).events);
    // On however many programs.
    let facts = |jobs| run(&core("sound"), jobs, 7, 0..300, &|_| {}).unwrap();
    let (one, three) = (facts(1), facts(3));
    assert_eq!(one.counts, three.counts);
    assert_eq!(one.compared.tally.total(), three.compared.tally.total());
    assert_eq!(one.compared.disagreeing.load(Relaxed) + three.compared.disagreeing.load(Relaxed), 0);
}

/// `[spec: ORACLE-4]` `[spec: ORACLE-5]`
#[test]
fn oracle_random_histories_agree_with_the_extracted_program() {
    let Some(program) = extracted() else { return };
    let found = run(&program.with(FACTS), 2, 1, 0..10_000, &|_| {}).unwrap();
    let shown = found.shrunk.map(|shrunk| format!("{}\n{:?}", tell(&shrunk.history), shrunk.disagreement));
    assert_eq!(shown, None, "{}", shown.as_deref().unwrap_or_default());
    assert!(found.compared.tally.total() > 100_000);
}
