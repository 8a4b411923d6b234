//! The JSON forms: what is written is read back, one value has one text, and a text that spells no
//! well-formed state is refused.
use dsr_core::{
    Author, CausalContext, Digest, MutationKind, Record, Repair, ReplicaId, State, decode, digest, encode,
    view,
};
use dsr_testkit::{Anchors, atoms, candidates, cases, dictionary, state, states};
use proptest::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeSet;
use std::fmt::Debug;

fn text(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap()
}

/// Text and back, and through a tree of JSON values and back.
#[track_caller]
fn check_round_trip<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) {
    let text = text(value);
    assert_eq!(&serde_json::from_str::<T>(&text).unwrap(), value, "{text}");
    let tree = serde_json::to_value(value).unwrap();
    assert_eq!(tree, serde_json::from_str::<serde_json::Value>(&text).unwrap(), "one text, whatever the way");
    assert_eq!(&serde_json::from_value::<T>(tree).unwrap(), value);
}

/// `[spec: JSON-1]` `[spec: JSON-10]` `[spec: JSON-11]` `[spec: JSON-12]`
#[test]
fn law_the_example_of_the_chapter_is_what_is_written() {
    let chapter = include_str!("../../../spec/encoding.md");
    let example = chapter.split_once("```json\n").unwrap().1.split_once("```").unwrap().0;
    let spelt = state(
        "r1.1 vertex room kitchen @1
         r1.2 edge root -RT-> r1.1 @1
         r1.3 write r1.1 level=5 @1
         dead r2.4",
    );
    assert_eq!(serde_json::from_str::<State>(example).unwrap(), spelt);
    let compact: String = text(&spelt);
    assert_eq!(compact, example.split_whitespace().collect::<String>());
}

proptest! {
    #![proptest_config(cases(3000))]

    /// `[spec: JSON-1]` `[spec: JSON-3]` `[spec: JSON-12]` `[spec: JSON-13]`
    #[test]
    fn law_states_and_digests_round_trip(pair in states(2, 14, Anchors::Right)) {
        for state in &pair {
            check_round_trip(state);
            check_round_trip(&digest(state));
        }
        prop_assert_eq!(pair[0] == pair[1], text(&pair[0]) == text(&pair[1]));
    }

    /// `[spec: JSON-4]` `[spec: JSON-5]` `[spec: JSON-6]`
    #[test]
    fn law_values_round_trip(value in atoms::value()) {
        check_round_trip(&value);
    }

    /// The two encodings agree. `[spec: JSON-12]` `[spec: ENC-1]`
    #[test]
    fn differential_json_and_binary(state in states(1, 14, Anchors::Right)) {
        let by_json: State = serde_json::from_str(&text(&state[0])).unwrap();
        prop_assert_eq!(decode(&encode(&state[0])), Ok(by_json));
    }

    /// `[spec: JSON-8]` `[spec: JSON-9]` `[spec: JSON-14]`
    #[test]
    fn law_mutations_and_repairs_round_trip(state in states(1, 14, Anchors::Right), at in any::<prop::sample::Index>()) {
        let dictionary = dictionary();
        let view = view(&state[0], &dictionary);
        for repair in view.repairs() {
            check_round_trip(repair);
            let start = format!("{{\"kind\":\"{}\"", repair.kind());
            prop_assert!(text(repair).starts_with(&start), "{}", text(repair));
        }
        for kind in MutationKind::ALL {
            let candidates = candidates(&view, kind);
            if !candidates.is_empty() {
                check_round_trip(at.get(&candidates));
            }
        }
        view.edges().iter().for_each(|shown| check_round_trip(&shown.edge.key()));
        state[0].records().for_each(|(_, record)| check_round_trip(record));
    }

    /// A changed text is refused, or spells a well-formed state. `[spec: JSON-2]` `[spec: JSON-12]`
    #[test]
    fn law_changed_texts_are_refused_or_well_formed(
        state in states(1, 8, Anchors::Right),
        edits in proptest::collection::vec((any::<prop::sample::Index>(), 0x20..0x7f_u8, any::<bool>()), 1..3),
    ) {
        let mut bytes = text(&state[0]).into_bytes();
        for (at, byte, replaces) in edits {
            let at = at.index(bytes.len());
            if replaces {
                bytes[at] = byte;
            } else {
                bytes.remove(at);
            }
        }
        if let Ok(read) = serde_json::from_slice::<State>(&bytes) {
            prop_assert_eq!(dsr_core::check_well_formed(&read), Ok(()));
            prop_assert_eq!(&serde_json::from_str::<State>(&text(&read)).unwrap(), &read);
        }
    }
}

/// Every kind of repair has a form. `[spec: JSON-14]`
#[test]
fn law_every_repair_has_a_form() {
    let texts = [
        r#"{"kind":"same-key","hidden":"r1.2","shown":"r2.1"}"#,
        r#"{"kind":"functional","hidden":"r1.2","shown":"r2.1"}"#,
        r#"{"kind":"rt-parent","hidden":"r1.2","shown":"r2.1"}"#,
        r#"{"kind":"cycle-broken","hidden":"r1.2"}"#,
        r#"{"kind":"detached","vertex":"r1.1"}"#,
        r#"{"kind":"reattached","vertex":"r1.1"}"#,
        r#"{"kind":"name-clash","name":"a","shown":"r1.1","hidden":"r2.1"}"#,
        r#"{"kind":"undeclared","write":"r1.3"}"#,
    ];
    let repairs: BTreeSet<Repair> = texts
        .iter()
        .map(|written| {
            let repair: Repair = serde_json::from_str(written).unwrap();
            assert_eq!(&text(&repair), written);
            repair
        })
        .collect();
    assert_eq!(repairs.len(), texts.len());
    assert!(serde_json::from_str::<Repair>(r#"{"kind":"detached","vertex":"r1.1","why":1}"#).is_err());
}

#[track_caller]
fn check_refused<T: DeserializeOwned + Debug>(written: &str, expected: &str) {
    let error = serde_json::from_str::<T>(written).unwrap_err().to_string();
    assert!(error.contains(expected), "{written}: {error}");
}

/// `[spec: JSON-2]` `[spec: JSON-12]`
#[test]
fn regress_states_that_are_not_well_formed() {
    let vertex = r#"{"vertex": {"type": "room", "name": "k", "stamp": 1}}"#;
    check_refused::<State>(&format!(r#"{{"context": {{}}, "store": {{"r1.1": {vertex}}}}}"#), "[WF-1] r1.1");
    check_refused::<State>(
        r#"{"context": {"r1": "1-2"}, "store": {"r1.2": {"write": {"target": "r1.1", "name": "a", "value": {"type": "int", "value": 1}, "stamp": 1}}}}"#,
        "[WF-2] r1.2 is anchored to r1.1, which is dead",
    );
    check_refused::<State>(
        &format!(r#"{{"context": {{"r1": "1"}}, "store": {{"r1.1": {vertex}, "r1.1": {vertex}}}}}"#),
        "twice",
    );
    check_refused::<State>(r#"{"context": {}}"#, "missing field `store`");
    check_refused::<State>(r#"{"context": {}, "store": {}, "clock": {}}"#, "unknown field `clock`");
    check_refused::<Record>(
        r#"{"vertex": {"type": "room", "name": "k", "stamp": 1, "id": 2}}"#,
        "unknown field `id`",
    );
    check_refused::<Record>(
        r#"{"edge": {"from": "r1.1", "label": "in", "to": "world", "stamp": 1}}"#,
        "or `root`",
    );
}

/// `[spec: JSON-11]`
#[test]
fn regress_runs_in_another_spelling() {
    for runs in
        ["", "0", "2-1", "1-1", "1,2", "1-3,4", "3,1", "1-3,2", "01", "1-", "-1", "1 ,3", "+1", "1--2"]
    {
        check_refused::<CausalContext>(&format!(r#"{{"r1": "{runs}"}}"#), "maximal runs");
    }
    check_refused::<CausalContext>(r#"{"r1": "1", "r1": "2"}"#, "twice");
    check_refused::<CausalContext>(r#"{"r1": "1-9007199254740992"}"#, "[LIMIT-6]");
    let all = r#"{"r1":"1-9007199254740991","r2+1":"3-9007199254740991"}"#;
    let context: CausalContext = serde_json::from_str(all).unwrap();
    assert_eq!(context.cloud_runs().count(), 1);
    assert_eq!(text(&context), all);
}

/// `[spec: JSON-11]` `[spec: LIMIT-7]`
#[test]
fn regress_more_runs_beyond_gaps_than_allowed() {
    let spelled = |count: u64| {
        let runs: Vec<String> = (1..=count).map(|at| (at * 2).to_string()).collect();
        format!(r#"{{"r1": "{}"}}"#, runs.join(","))
    };
    let context: CausalContext = serde_json::from_str(&spelled(1 << 20)).unwrap();
    assert_eq!(context.cloud_runs().count(), 1 << 20);
    check_refused::<CausalContext>(&spelled((1 << 20) + 1), "[LIMIT-7]");
}

/// `[spec: JSON-13]`
#[test]
fn regress_digest_of_no_state() {
    check_refused::<Digest>(r#"{"context": {"r1": "1-2"}, "live": {"r1": "2-3"}}"#, "[ENC-11] not every dot");
    check_refused::<Digest>(
        r#"{"context": {"r1": "1-90000000"}, "live": {"r1": "1-90000000"}}"#,
        "[ENC-11] over",
    );
}

/// `[spec: JSON-3]` `[spec: JSON-8]`
#[test]
fn law_authors_have_one_text() {
    let author = Author { replica: ReplicaId { agent: 3, incarnation: 1 }, timestamp_ns: u64::MAX };
    check_round_trip(&author);
    assert_eq!(text(&author), r#"{"replica":"r3+1","timestamp_ns":"18446744073709551615"}"#);
    assert_eq!(
        serde_json::from_str::<Author>(r#"{"replica":"r3"}"#).unwrap(),
        Author::new(ReplicaId::agent(3))
    );
}

/// Every 32-bit float survives as its shortest decimal read through 64 bits: all exponents with mantissas
/// around the ends, and a coarse walk through the rest. `[spec: JSON-5]`
#[test]
fn law_floats_survive_the_way_through_decimals() {
    let ends = (0..=u32::from(u8::MAX)).flat_map(|exponent| {
        (0..64_u32).chain((1 << 23) - 64..1 << 23).map(move |mantissa| exponent << 23 | mantissa)
    });
    for bits in ends.chain((0..u32::MAX >> 1).step_by(20_011)) {
        let item = f32::from_bits(bits);
        let value = dsr_core::Value::Float(item).with_canonical_nans();
        let read: dsr_core::Value = serde_json::from_str(&text(&value)).unwrap();
        assert_eq!(read, value, "{bits:#x}");
    }
}
