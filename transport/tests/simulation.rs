//! Many runs of real sessions with all faults at once, and alarms: what is broken on purpose is found.
#![allow(clippy::panic, reason = "a test that cannot go on has failed")]

use dsr_transport::simulation::{HEAL_MAX, Options, Plan, Totals, run, run_telling, shrink};
use dsr_transport::{Flaw, MS, SECOND};
use std::ops::Range;

/// Runs seeds; a failing one is shrunk and told.
#[track_caller]
fn simulate(options: &Options, seeds: Range<u64>) -> Totals {
    let mut totals = Totals::default();
    for seed in seeds {
        let plan = Plan::draw(seed, options);
        let outcome = run(&plan);
        if let Some(failure) = &outcome.failure {
            let (small, _) = shrink(&plan);
            let (_, told) = run_telling(&small);
            panic!("seed {seed}: {failure}\nshrunk to {:?}:\n{}", small.faults, told.join("\n"));
        }
        totals.add(&outcome);
    }
    println!("{totals}");
    totals
}

/// All faults at once, few nodes; and what is rare has happened. `[spec: LINK-18]` `[spec: LINK-9]` `[spec: LINK-17]`
#[test]
fn law_all_become_equal_after_all_faults() {
    let totals = simulate(&Options::SMALL, 0..400);
    let stats = totals.stats;
    for (what, count) in [
        ("a Gone is said", stats.gone_said),
        ("something is lost since it is gone", stats.gone_heard),
        ("something is given up", stats.given_up),
        ("a buffer runs over", stats.overflows),
        ("a request is suppressed", stats.suppressed),
        ("an answer is resumed from another peer", stats.resumed),
        ("an exchange stalls", stats.stalled),
        ("an answer is refused", stats.answers_refused),
        ("a claim is objected to", stats.objections),
        ("a peer is lost", stats.lost),
        ("a mutation waits", stats.busy),
        ("something cannot be decoded", stats.undecodable),
        ("a part contradicts another", stats.contradicting),
        ("a stream is given up", stats.unanswered),
    ] {
        assert!(count > 0, "never: {what}");
    }
    assert!(totals.deliveries.iter().all(|&count| count > 0), "{:?}", totals.deliveries);
    assert!(totals.healed_after(1000) <= HEAL_MAX);
}

/// `[spec: LINK-18]`
#[test]
fn law_fifty_become_equal() {
    let options = Options { nodes_min: 50, nodes_max: 50, steps_each: 3, span: 2 * SECOND, ..Options::SMALL };
    let totals = simulate(&options, 0..2);
    assert!(totals.sessions >= 60);
}

/// Without fingerprints only what a session knows to be lacking leads to digests: it knows all that it lacks, as
/// long as nobody dies with what others lack, and nobody lies. `[spec: LINK-7]` `[spec: LINK-9]` `[spec: LINK-12]`
#[test]
fn law_what_is_lacking_is_known() {
    simulate(&KNOWN, 0..150);
}

/// Nobody dies, and fingerprints do not help.
const KNOWN: Options = Options { fingerprints: false, hostile: false, deaths: false, ..Options::SMALL };
/// Nothing is lost.
const CALM: Options = Options { faults: false, hostile: false, deaths: false, ..Options::SMALL };

/// Each flaw is found in the options where sound sessions fail nowhere, and what fails shrinks.
/// `[spec: LINK-6]` `[spec: LINK-7]` `[spec: LINK-9]` `[spec: LINK-12]` `[spec: LINK-15]`
#[test]
fn alarm_each_flaw_is_found() {
    for flaw in Flaw::ALL {
        let sound = match flaw {
            Flaw::ForgetsToWant | Flaw::GoneIsIgnored | Flaw::DropsSilently => KNOWN,
            Flaw::ContextAsDigest | Flaw::PartsReversed => Options::SMALL,
            Flaw::ClaimsWithoutWaiting => CALM,
        };
        let broken = Options { flaw: Some(flaw), ..sound.clone() };
        let found = (0..150).map(|seed| Plan::draw(seed, &broken)).find(|plan| run(plan).failure.is_some());
        let plan = found.unwrap_or_else(|| panic!("{flaw:?} is not found"));
        // The same without the flaw holds.
        assert_eq!(run(&Plan { flaw: None, ..plan.clone() }).failure, None, "{flaw:?}");
        let (small, runs) = shrink(&plan);
        let (outcome, told) = run_telling(&small);
        assert!(outcome.failure.is_some() && small.steps.len() < plan.steps.len());
        println!("{flaw:?}: seed {}, shrunk in {runs} runs\n{}\n", plan.seed, told.join("\n"));
    }
}

/// Claims where nothing is lost, under the very replica id of the holder. `[spec: LINK-15]`
#[test]
fn law_no_id_is_used_twice_where_claims_are_heard() {
    let mut objections = 0;
    for seed in 0..60 {
        let mut plan = Plan::draw(seed, &Options { flaw: Some(Flaw::ClaimsWithoutWaiting), ..CALM });
        plan.flaw = None;
        let outcome = run(&plan);
        assert_eq!(outcome.failure, None, "seed {seed}");
        objections += outcome.stats.objections;
    }
    assert!(objections > 0);
}

/// A run is its seed: the same again, event by event. `[spec: LINK-2]`
#[test]
fn law_a_run_is_its_seed() {
    for seed in [3, 4] {
        let plan = Plan::draw(seed, &Options::SMALL);
        assert_eq!(plan, Plan::draw(seed, &Options::SMALL));
        assert_eq!(run_telling(&plan), run_telling(&plan));
    }
    let calm = run(&Plan::draw(5, &CALM));
    assert!(calm.failure.is_none() && calm.healed_after <= 1500 * MS, "{calm:?}");
}
