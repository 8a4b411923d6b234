//! Limits of what is decoded. Those of mutations stand with the mutations.

use dsr_core::{
    CausalContext, DecodeError, Digest, MalformedDigest, ReplicaId, Run, State, check_digest, decode, encode,
    limits,
};

/// The context r1.1 … r1.`last`.
fn seen(last: u64) -> CausalContext {
    let mut context = CausalContext::new();
    context.insert_prefix(ReplicaId::agent(1), last);
    context
}

/// [spec: LIMIT-8] [spec: LIMIT-1]
#[test]
fn oracle_more_records_than_a_state_may_hold_are_refused_unread() {
    let mut bytes = encode(&State::assemble([], seen(1)));
    assert_eq!(bytes.pop(), Some(0), "the encoding ends with the number of r1's records");
    let mut count = limits::RECORDS_MAX + 1;
    while count >= 0x80 {
        bytes.push(0x80 | u8::try_from(count & 0x7f).unwrap());
        count >>= 7;
    }
    bytes.push(u8::try_from(count).unwrap());
    let refused = decode(&bytes).unwrap_err();
    assert!(
        matches!(refused, DecodeError::TooGreat { what: "the number of records", max, .. } if max == limits::RECORDS_MAX as u64),
        "{refused}"
    );

    let last = limits::RECORDS_MAX as u64;
    let live = |last| vec![Run { replica: ReplicaId::agent(1), first: 1, last }];
    let digest = |held| Digest { context: seen(last + 1), live: live(held) };
    assert_eq!(check_digest(&digest(last)), Ok(()));
    assert_eq!(check_digest(&digest(last + 1)), Err(MalformedDigest::TooManyLive));
}

/// [spec: LIMIT-9] [spec: LIMIT-1]
#[test]
fn oracle_more_bytes_than_a_state_may_have_are_refused_unread() {
    let bytes = limits::ENCODED_BYTES_MAX + 1;
    assert_eq!(decode(&vec![0; bytes]), Err(DecodeError::TooLong { bytes }));
}
