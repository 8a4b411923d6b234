//! The corpus finds every core that the checker has broken on purpose.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use dsr_conformance::corpus;
use dsr_conformance::score::{Extent, score};

/// `[spec: CONF-19]`
#[test]
fn canary_each_broken_core_fails_a_case() {
    let scores = score(&corpus::cases().unwrap(), Extent::UntilFound);
    for core in &scores.cores {
        let shortest = core.shortest.as_deref().unwrap_or("missed");
        println!("{:<26} {:<8} {shortest}", core.flaw, core.clause);
    }
    println!("{} of {} found", scores.found, scores.cores.len());
    assert_eq!(scores.cores.len(), 31);
    assert!(scores.is_full(), "{scores:#?}");
}
