//! The corpus finds every core that the checker has broken on purpose.

use dsr_conformance::case::Case;
use dsr_conformance::corpus;
use dsr_conformance::score::{Extent, score};

/// Whoever looks at graphs alone finds each, as does who looks deeper. `[spec: CONF-19]`
#[test]
fn canary_each_broken_core_fails_a_case() {
    let cases = corpus::cases().unwrap();
    all_are_found(&cases);
    all_are_found(&cases.into_iter().filter(|case| case.profile.is_default()).collect::<Vec<_>>());
}

fn all_are_found(cases: &[Case]) {
    let scores = score(cases, Extent::UntilFound);
    for core in &scores.cores {
        let shortest = core.shortest.as_deref().unwrap_or("missed");
        println!("{:<26} {:<8} {shortest}", core.flaw, core.clause);
    }
    println!("{} of {} found", scores.found, scores.cores.len());
    assert_eq!(scores.control, Vec::<String>::new());
    assert_eq!(scores.cores.len(), 31);
    assert!(scores.is_full(), "{scores:#?}");
}
