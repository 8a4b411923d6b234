//! Pieces of a state: their join is the state, in any order; each is well-formed and small.

use dsr_core::{
    Dot, Record, ReplicaId, Run, State, Value, VertexId, Write, check_well_formed, decode, delta_for, digest,
    encode, limits,
};
use dsr_testkit::{Anchors, Universe, state, states};
use proptest::prelude::*;

/// All that SYNC-6 says; records of states here are small.
#[track_caller]
fn check(whole: &State, bytes: usize) {
    let pieces = whole.pieces(bytes);
    for piece in &pieces {
        assert_eq!(check_well_formed(piece), Ok(()));
        assert_eq!(decode(&encode(piece)).as_ref(), Ok(piece));
        assert!(!piece.context().is_empty() && piece.is_below(whole));
        let single = piece.len() <= 1 && piece.context().runs().count() == 1 && encode(piece).len() <= 300;
        assert!(
            encode(piece).len() <= bytes || single,
            "{} bytes of {bytes}: {piece:?}",
            encode(piece).len()
        );
    }
    let join = |state: State, piece: &State| state.joined(piece);
    assert_eq!(&pieces.iter().fold(State::new(), join), whole);
    assert_eq!(&pieces.iter().rev().fold(State::new(), join), whole);
    // A partition: every dot is in one piece.
    let dots = |state: &State| state.context().runs().map(|run| run.last - run.first + 1).sum::<u64>();
    assert_eq!(pieces.iter().map(dots).sum::<u64>(), dots(whole));
}

/// `[spec: SYNC-6]`
#[test]
fn law_pieces_of_small_universes() {
    let mut count = 0;
    for text in [
        "r1.1 vertex t a @1\nr1.2 edge root -RT-> r1.1 @1\nr1.3 write r1.2 level=1 @1\nr2.1 write r1.1 level=2 @2",
        "r1.1 edge root -in-> r3.1 @1\nr1.2 edge root -in-> r3.1 @2\nr1.4 edge root -in-> r3.1 @3\nr2.2 write r1.2 level=1 @4",
    ] {
        for whole in Universe::of(&state(text)).all_states() {
            for bytes in [0, 200, 400, 1 << 20] {
                check(&whole, bytes);
                count += 1;
            }
        }
    }
    assert!(count > 300, "{count}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// `[spec: SYNC-6]`
    #[test]
    fn law_pieces_of_any_state(pair in states(2, 30, Anchors::Right), bytes in 0_usize..2000) {
        check(&pair[0], bytes);
        // Pieces of a delta, joined into another state, with what is there.
        let delta = delta_for(&pair[0], &digest(&pair[1]));
        let joined = delta.pieces(bytes).iter().fold(pair[1].clone(), |state, piece| state.joined(piece));
        prop_assert_eq!(joined, pair[1].joined(&pair[0]));
    }

    /// Some pieces are lost: a digest still says what is lacking. `[spec: SYNC-6]`
    #[test]
    fn law_what_is_lost_of_pieces_is_named_by_a_digest(pair in states(1, 30, Anchors::Right), lost in any::<u64>()) {
        let pieces = pair[0].pieces(200);
        let kept = pieces.iter().enumerate().filter(|(at, _)| lost >> (at % 64) & 1 == 0);
        let some = kept.fold(State::new(), |state, (_, piece)| state.joined(piece));
        prop_assert_eq!(some.joined(&delta_for(&pair[0], &digest(&some))), pair[0].clone());
    }
}

/// `[spec: SYNC-6]`
#[test]
fn regress_one_large_record_is_a_piece_alone() {
    let r1 = |sequence| Dot::new(ReplicaId::agent(1), sequence);
    let write = |sequence: u64, bytes: usize| {
        let value = Value::ByteVec(vec![7; bytes].into());
        let write =
            Write { target: VertexId::ROOT.0, name: "map".into(), value, timestamp_ns: 0, stamp: sequence };
        (r1(sequence), Record::Write(write))
    };
    let context = [Run { replica: ReplicaId::agent(1), first: 1, last: limits::SEQUENCE_MAX }];
    let whole =
        State::assemble([write(5, 10), write(6, 100_000), write(900, 10)], context.into_iter().collect());
    let pieces = whole.pieces(1000);
    let sizes: Vec<usize> = pieces.iter().map(|piece| encode(piece).len()).collect();
    assert_eq!(pieces.iter().map(State::len).collect::<Vec<_>>(), [1, 1, 1], "{sizes:?}");
    assert!(sizes[0] < 1000 && sizes[1] > 100_000 && sizes[2] < 1000, "{sizes:?}");
    assert_eq!(pieces.iter().fold(State::new(), |state, piece| state.joined(piece)), whole);
    assert_eq!(State::new().pieces(1000), []);
}
