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

/// The numbers of the specification, as it writes them.
/// [spec: LIMIT-2] [spec: LIMIT-3] [spec: LIMIT-4] [spec: LIMIT-5] [spec: LIMIT-6] [spec: LIMIT-7] [spec: LIMIT-8]
/// [spec: LIMIT-9]
#[test]
fn conform_limits_are_the_numbers_of_the_chapter() {
    let chapter = include_str!("../../../spec/limits.md");
    let numbers: [(&str, u64, u64, &str); 8] = [
        ("LIMIT-2", limits::NAME_BYTES_MAX as u64, 255, "255 bytes"),
        ("LIMIT-3", limits::VALUE_BYTES_MAX as u64, 67_108_864, "67 108 864 bytes"),
        ("LIMIT-4", limits::ATTRIBUTES_MAX as u64, 1024, "1024 attributes"),
        ("LIMIT-5", limits::STAMP_MAX, 9_007_199_254_740_991, "2⁵³ − 1"),
        ("LIMIT-6", limits::SEQUENCE_MAX, 9_007_199_254_740_991, "2⁵³ − 1"),
        ("LIMIT-7", limits::CLOUD_RUNS_MAX as u64, 1_048_576, "1 048 576 runs"),
        ("LIMIT-8", limits::RECORDS_MAX as u64, 16_777_216, "16 777 216 records"),
        ("LIMIT-9", limits::ENCODED_BYTES_MAX as u64, 1_073_741_824, "1 073 741 824 bytes"),
    ];
    for (clause, limit, number, written) in numbers {
        let (_, text) = chapter.split_once(&format!("**{clause}.**")).unwrap();
        let text = text.split("**LIMIT").next().unwrap();
        assert!(text.contains(written), "{clause}: {written}");
        assert_eq!(limit, number, "{clause}");
    }
}
