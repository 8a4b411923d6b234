//! The conformance corpus, step by step.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on says where")]

mod common;

use common::{adapter, core, extracted};
use dsr_conformance::{corpus as cases, protocol::Profile};
use dsr_oracle::corpus::run;
use dsr_oracle::program::Trouble;

/// Cases of every family, few of the model's.
fn some() -> Vec<dsr_conformance::case::Case> {
    let all = cases::cases().unwrap().into_iter();
    all.filter(|case| !case.id.contains("/model-") || case.id.ends_with('7')).collect()
}

/// `[spec: ORACLE-4]`
#[test]
fn oracle_the_core_agrees_with_itself_step_by_step() {
    let cases = some();
    assert!(Profile::ALL.iter().all(|profile| cases.iter().any(|case| case.profile == *profile)));
    let found = run(&adapter("sound"), 2, &cases, &|| {}).unwrap();
    assert!(found.agrees(), "{:?}", found.differences);
    assert_eq!(found.cases, cases.len());
    assert!(found.steps > 1000 && found.replies > found.steps && found.expectations > 500, "{found:?}");
}

/// `[spec: ORACLE-6]`
#[test]
fn canary_what_is_no_adapter_is_no_agreement() {
    let trouble = run(&core("sound"), 1, &some()[..3], &|| {}).unwrap_err();
    assert!(matches!(trouble, Trouble::Garbage { .. } | Trouble::Ended { .. }), "{trouble}");
}

/// `[spec: ORACLE-1]` `[spec: ORACLE-4]`
#[test]
fn oracle_the_extracted_program_passes_and_agrees_step_by_step() {
    let Some(program) = extracted() else { return };
    let found = run(&program, 2, &cases::cases().unwrap(), &|| {}).unwrap();
    assert!(found.agrees(), "{:?}", found.differences);
}
