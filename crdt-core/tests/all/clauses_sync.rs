//! Digests, resynchronisation and limits of what is decoded.

use crate::clauses_common::history::{history, parts};
use crate::clauses_common::*;
use dsr_core::{Delta, Dot, Run, State, VertexId, check_well_formed, delta_for, digest, fingerprint};
use std::collections::BTreeSet;

fn dots(state: &State) -> BTreeSet<Dot> {
    state.context().runs().flat_map(Run::dots).collect()
}

/// [spec: SYNC-1]
#[test]
fn oracle_a_digest_is_what_was_seen_and_what_is_held() {
    for state in parts(&history([1, 2])) {
        let of = digest(&state);
        assert_eq!(&of.context, state.context());
        let live: Vec<Dot> = of.live.iter().copied().flat_map(Run::dots).collect();
        assert_eq!(live, state.records().map(|(dot, _)| dot).collect::<Vec<_>>());
        for dot in dots(&state) {
            assert_eq!(of.lives(dot), state.holds(dot));
        }
    }
}

/// The counterexample of the specification: e1, replaced by e2, replaced by e3, without e2's delta.
/// [spec: SYNC-2]
#[test]
fn regress_equal_contexts_do_not_mean_equal_states() {
    let mut author = Peer::new(1);
    let lamp = author.child(ROOT, "lamp");
    let mut reader = author.fork(2);
    let e1 = author.apply(&edge(lamp, "in", ROOT));
    let hall = |author: &mut Peer, to: VertexId, from: VertexId| {
        author.apply(&relocate(key(lamp, "in", from), key(lamp, "in", to)))
    };
    let mut base = author.fork(3);
    let (kitchen, attic) = (base.child(ROOT, "kitchen"), base.child(ROOT, "attic"));
    author.state.join(&base.state);
    reader.state.join(&e1);
    reader.state.join(&base.state);
    let _lost = hall(&mut author, kitchen, ROOT);
    let e3 = hall(&mut author, attic, kitchen);
    reader.state.join(&e3);
    assert_eq!(reader.state.context(), author.state.context());
    assert_ne!(reader.state, author.state);
    assert_ne!(fingerprint(&reader.state), fingerprint(&author.state));
    let delta = delta_for(&author.state, &digest(&reader.state));
    reader.state.join(&delta);
    assert_eq!(reader.state, author.state);
}

/// [spec: SYNC-3]
#[test]
fn oracle_the_delta_for_another_brings_it_up_to_date() {
    let states = parts(&history([1, 2]));
    for a in &states {
        for b in &states {
            let delta: Delta = delta_for(b, &digest(a));
            check_well_formed(&delta).unwrap();
            assert_eq!(a.joined(&delta), a.joined(b));
            assert!(delta.is_below(&a.joined(b)));
            for dot in dots(&delta) {
                let unseen = !a.context().contains(dot);
                assert!(unseen || (a.holds(dot) && b.is_dead(dot)), "{dot} is superfluous");
                assert_eq!(delta.get(dot), b.get(dot), "{dot} is sent as it is");
            }
        }
    }
}

/// [spec: SYNC-4]
#[test]
fn law_fingerprints_are_equal_for_equal_states_alone() {
    let states = parts(&history([1, 2]));
    let fingerprints: BTreeSet<_> = states.iter().map(fingerprint).collect();
    assert_eq!(fingerprints.len(), states.len());
    for state in &states {
        assert_eq!(fingerprint(&State::new().joined(state)), fingerprint(state));
        assert_eq!(digest(state).fingerprint(), fingerprint(state));
    }
}

/// [spec: SYNC-5]
#[test]
fn law_one_exchange_makes_two_replicas_equal() {
    let states = parts(&history([1, 2]));
    for a in &states {
        for b in states.iter().step_by(3) {
            let left = a.joined(&delta_for(b, &digest(a)));
            let right = b.joined(&delta_for(a, &digest(b)));
            assert_eq!(left, right);
            assert_eq!(fingerprint(&left), fingerprint(&right));
        }
    }
}
