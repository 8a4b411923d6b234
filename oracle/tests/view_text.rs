//! Views as text, and histories beside the extracted program.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on says where")]

mod common;

use common::extracted;
use dsr_core::{Dictionary, ValueType, view};
use dsr_model::progress::{Limits, Progress};
use dsr_oracle::fact::view_text;
use dsr_oracle::histories::{Extent, run, runs};
use dsr_oracle::program::FACTS;
use dsr_oracle::verdict::Verdict;
use std::sync::Arc;

#[track_caller]
fn check(state: &str, expected: &str) {
    let mut dictionary = Dictionary::open().with_functional("in");
    dictionary.attributes.insert("level".into(), ValueType::Int);
    assert_eq!(view_text(&view(&dsr_testkit::state(state), &dictionary)), expected);
}

/// `[spec: ORACLE-3]`
#[test]
fn law_a_view_has_one_text() {
    check("", r#"{"vertices":[["root","root",false,null]],"edges":[],"writes":[],"repairs":[]}"#);
    // Two parents; a name twice; a write that waits.
    check(
        "r1.1 vertex room kitchen @1
         r1.2 edge root -RT-> r1.1 @1
         r1.3 vertex robot kitchen @2
         r1.4 edge r1.1 -RT-> r1.3 @2
         r2.1 edge root -RT-> r1.3 @2
         r2.2 write r3.1 level=5 @3
         r2.3 write r1.1 level=5 @3
         r2.4 write r1.1 level=6 @3
         dead r3.2",
        concat!(
            r#"{"vertices":[["root","root",false,null],["r1.1",["root","r1.2"],false,"r1.1"],["#,
            r#""r1.3",["root","r2.1"],false,"r1.1"]],"edges":["r1.2","r2.1"],"writes":[["r2.4","r2.3"]],"#,
            r#""repairs":[["name-clash","r1.1","r1.3"],["rt-parent","r1.4","r2.1"]]}"#
        ),
    );
    // A cycle without a path to the root, with a vertex beside it; one that nothing holds.
    check(
        "r1.1 vertex a a @1
         r1.2 vertex b b @1
         r1.3 edge r1.1 -RT-> r1.2 @2
         r2.3 edge r1.2 -RT-> r1.1 @2
         r1.4 vertex c c @1
         r1.5 edge r1.4 -in-> r1.1 @1
         r1.6 vertex d d @1",
        concat!(
            r#"{"vertices":[["root","root",false,null],["r1.1",["r1.2","r2.3"],true,"r1.1"],["#,
            r#""r1.2","detached",true,"r1.2"],["r1.4","outside",true,"r1.4"],["r1.6","outside",true,"r1.6"]],"#,
            r#""edges":["r1.5","r2.3"],"writes":[],"repairs":[["cycle-broken","r1.3"],["detached","r1.2"],["reattached","r1.6"]]}"#
        ),
    );
}

/// `[spec: ORACLE-4]` `[spec: ORACLE-5]`
#[test]
fn oracle_every_small_history_agrees_with_the_extracted_program() {
    let Some(program) = extracted() else { return };
    let facts = program.with(FACTS);
    for each in runs(Extent::Small).unwrap() {
        let found = run(&each, &facts, 2, &Arc::new(Progress::new(Limits::default()))).unwrap();
        assert_eq!(found.verdict(), Verdict::Agree, "{}: {:?}", found.name, found.counterexample);
    }
}
