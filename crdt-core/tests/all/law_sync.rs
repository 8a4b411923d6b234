//! Digests and the least delta: whatever two replicas have missed, one exchange makes them equal.
use dsr_core::{
    CausalContext, Digest, Dot, Record, ReplicaId, Run, State, Value, Vertex, VertexId, Write, check_digest,
    check_well_formed, decode, delta_for, digest, encode, fingerprint, limits,
};
use dsr_testkit::{Anchors, Universe, cases, state, states};
use proptest::prelude::*;

/// All that SYNC-3 says of the delta for `a` from `b`.
#[track_caller]
fn check(a: &State, b: &State) {
    let delta = delta_for(b, &digest(a));
    assert_eq!(a.joined(&delta), a.joined(b), "{a:?}\n{b:?}\n{delta:?}");
    assert_eq!(check_well_formed(&delta), Ok(()));
    assert!(delta.is_below(b));
    let merged = |other: &State| {
        let mut merged = a.clone();
        merged.merge(other);
        merged
    };
    assert_eq!(merged(&delta), merged(b));
    // Least: without any one of its dots it would not do.
    for dot in delta.context().runs().flat_map(dsr_core::Run::dots) {
        let others = |other: &Dot| *other != dot;
        let context: CausalContext =
            delta.context().runs().flat_map(dsr_core::Run::dots).filter(others).collect();
        let records =
            delta.records().filter(|(other, _)| *other != dot).map(|(other, record)| (other, record.clone()));
        let less = State::assemble(records, context);
        assert_ne!(merged(&less), merged(b), "{dot} is not needed");
    }
}

/// Every pair of states over a small universe. `[spec: SYNC-3]`
#[test]
fn law_the_delta_is_enough_and_least_on_small_universes() {
    let mut pairs = 0;
    for text in [
        "r1.1 vertex t a @1\nr1.2 edge root -RT-> r1.1 @1\nr1.3 write r1.2 level=1 @1\nr2.1 write r1.1 level=2 @2",
        "r1.1 edge root -in-> r3.1 @1\nr1.2 edge root -in-> r3.1 @2\nr1.4 edge root -in-> r3.1 @3\nr2.2 write r1.2 level=1 @4",
    ] {
        let states = Universe::of(&state(text)).all_states();
        for a in &states {
            for b in &states {
                check(a, b);
                pairs += 1;
            }
        }
    }
    println!("{pairs} pairs");
    assert!(pairs > 5000, "{pairs}");
}

proptest! {
    #![proptest_config(cases(6000))]

    /// `[spec: SYNC-3]`
    #[test]
    fn law_the_delta_is_enough_and_least(pair in states(2, 20, Anchors::Right)) {
        check(&pair[0], &pair[1]);
    }

    /// `[spec: SYNC-5]` `[spec: SYNC-4]`
    #[test]
    fn law_one_exchange_makes_equal(pair in states(2, 20, Anchors::Right)) {
        let [a, b] = [&pair[0], &pair[1]];
        let new_a = a.joined(&delta_for(b, &digest(a)));
        let new_b = b.joined(&delta_for(a, &digest(b)));
        prop_assert_eq!(&new_a, &new_b);
        prop_assert_eq!(fingerprint(&new_a), fingerprint(&new_b));
        prop_assert_eq!(delta_for(&new_a, &digest(&new_b)), State::new());
        prop_assert!(encode(&delta_for(a, &digest(a))).len() <= 5);
    }

    /// Over one universe, equal digests are equal states, and equal fingerprints are equal digests.
    /// `[spec: SYNC-1]` `[spec: SYNC-4]`
    #[test]
    fn law_digests_tell_states_apart(pair in states(2, 12, Anchors::Right)) {
        let digests = [digest(&pair[0]), digest(&pair[1])];
        prop_assert_eq!(digests[0] == digests[1], pair[0] == pair[1]);
        prop_assert_eq!(fingerprint(&pair[0]) == fingerprint(&pair[1]), pair[0] == pair[1]);
        for (digest, state) in digests.iter().zip(&pair) {
            prop_assert_eq!(check_digest(digest), Ok(()));
            prop_assert_eq!(digest.fingerprint(), fingerprint(state));
            for dot in state.context().runs().flat_map(dsr_core::Run::dots) {
                prop_assert_eq!(digest.lives(dot), state.holds(dot));
            }
        }
    }

    /// By chains of exchanges all become equal. `[spec: SYNC-5]`
    #[test]
    fn law_chains_of_exchanges_make_all_equal(mut replicas in states(4, 16, Anchors::Right)) {
        let all = replicas.iter().fold(State::new(), |all, state| all.joined(state));
        for (from, to) in [(0, 1), (1, 2), (2, 3), (3, 2), (2, 1), (1, 0)] {
            let delta = delta_for(&replicas[from], &digest(&replicas[to]));
            replicas[to].join(&delta);
        }
        prop_assert!(replicas.iter().all(|state| *state == all));
    }
}

/// Equal contexts, different states: a context alone is no digest. `[spec: SYNC-2]`
#[test]
fn regress_context_alone_finds_nothing_to_send() {
    let author = state("dead r1.3 r1.4\nr1.5 edge root -near-> r2.1 @3");
    let other = state("r1.3 edge root -near-> r2.1 @1\ndead r1.4\nr1.5 edge root -near-> r2.1 @3");
    assert_eq!(author.context(), other.context());
    assert_ne!(author, other);
    assert_ne!(fingerprint(&author), fingerprint(&other));
    let delta = delta_for(&author, &digest(&other));
    assert_eq!(delta, state("dead r1.3"));
    assert_eq!(other.joined(&delta), author);
}

/// A context of very many dots costs nothing where both sides know them. `[spec: SYNC-3]` `[spec: LIMIT-6]`
#[test]
fn regress_long_histories_are_not_walked() {
    let replica = dsr_core::ReplicaId::agent(1);
    let mut context = CausalContext::new();
    context.insert_prefix(replica, dsr_core::limits::SEQUENCE_MAX);
    let long = State::assemble([], context);
    let twice = long.joined(&long);
    assert_eq!(twice, long);
    assert_eq!(delta_for(&long, &digest(&twice)), State::new());
}

fn vertex(name: &str) -> Record {
    Record::Vertex(Vertex { vertex_type: "room".into(), name: name.into(), external_id: None, stamp: 1 })
}

/// Over a million missed dots, nearly all of them dead, are a few runs: the delta fits what a decoder takes,
/// and brings the other up to date. `[spec: SYNC-3]` `[spec: LIMIT-7]`
#[test]
fn regress_a_delta_of_a_million_missed_dots() {
    let r1 = |sequence| Dot::new(ReplicaId::agent(1), sequence);
    let run = |first, last| Run { replica: ReplicaId::agent(1), first, last };
    let records = [(r1(2), vertex("a")), (r1(700_000), vertex("b")), (r1(1_048_600), vertex("c"))];
    let b = State::assemble(records, [run(1, 1_048_600)].into_iter().collect());
    let a = State::assemble([(r1(1), vertex("z"))], [r1(1)].into_iter().collect());
    let delta = delta_for(&b, &digest(&a));
    assert_eq!(delta.context().runs().collect::<Vec<_>>(), [run(1, 1_048_600)], "with the death of r1.1");
    assert_eq!(decode(&encode(&delta)).as_ref(), Ok(&delta));
    assert_eq!(a.joined(&delta), a.joined(&b));
    // The same where a gap stays open.
    let late = State::assemble([(r1(9), vertex("c"))], [run(3, 1_048_600)].into_iter().collect());
    let delta = delta_for(&late, &digest(&State::new()));
    assert_eq!(decode(&encode(&delta)).as_ref(), Ok(&late));
    assert_eq!(delta, late);
}

/// Who has seen nothing asks one that has seen as much as sequences allow, and the other way round.
/// `[spec: SYNC-3]` `[spec: LIMIT-6]`
#[test]
fn regress_histories_of_all_sequences_are_not_walked() {
    let all = Run { replica: ReplicaId::agent(1), first: 1, last: limits::SEQUENCE_MAX };
    let dot = Dot::new(all.replica, 1 << 40);
    let long = State::assemble([(dot, vertex("a"))], [all].into_iter().collect());
    let nothing = State::new();
    assert_eq!(delta_for(&long, &digest(&nothing)), long);
    assert_eq!(nothing.joined(&long), long);
    assert_eq!(delta_for(&nothing, &digest(&long)), nothing);
    let dead = State::assemble([], [all].into_iter().collect());
    assert_eq!(long.joined(&dead), dead);
    assert_eq!(
        delta_for(&dead, &digest(&long)).context().runs().collect::<Vec<_>>(),
        [Run { first: 1 << 40, last: 1 << 40, ..all }]
    );
    // A digest that was not checked claims that very many dots live, or none at all.
    let live = vec![all, Run { first: 0, last: u64::MAX, ..all }, Run { first: 9, last: 3, ..all }];
    let hostile = Digest { context: CausalContext::new(), live };
    assert_eq!(delta_for(&long, &hostile), long);
}

/// `[spec: SYNC-3]`
#[test]
fn regress_payloads_are_shared_with_the_delta() {
    let dot = Dot::new(ReplicaId::agent(1), 1);
    let value = Value::ByteVec(vec![7; 1 << 20].into());
    let write = Write { target: VertexId::ROOT.0, name: "map".into(), value, timestamp_ns: 0, stamp: 1 };
    let state = State::assemble([(dot, Record::Write(write))], [dot].into_iter().collect());
    let delta = delta_for(&state, &digest(&State::new()));
    assert!(std::ptr::eq(delta.get(dot).unwrap(), state.get(dot).unwrap()));
}

/// The example of the chapter, hashed by another implementation of `SipHash`. `[spec: SYNC-4]`
#[test]
fn oracle_fingerprint_of_an_example() {
    let example = state("dead r1.3 r1.4\nr1.5 edge root -near-> r2.1 @3");
    assert_eq!(fingerprint(&example).to_string(), "cb03d9d27daf89107fa9515e70775765");
}
