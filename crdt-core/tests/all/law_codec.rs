//! The encodings: what is written is read back, what is read is what would be written, and nothing that
//! anybody sends does harm.
use dsr_core::{
    CausalContext, DecodeError, Digest, Dot, Record, ReplicaId, Run, State, Value, Write, check_well_formed,
    decode, decode_digest, digest, encode, encode_digest, limits,
};
use dsr_testkit::{Anchors, cases, state, states, universes};
use proptest::prelude::*;

const CHAPTER: &str = include_str!("../../../spec/encoding.md");

/// The text between the fence of a language and its end.
fn fenced(language: &str) -> &'static str {
    let start = CHAPTER.split_once(&format!("```{language}\n")).unwrap().1;
    start.split_once("```").unwrap().0
}

fn example() -> State {
    state(
        "r1.1 vertex room kitchen @1
         r1.2 edge root -RT-> r1.1 @1
         r1.3 write r1.1 level=5 @1
         dead r2.4",
    )
}

/// `[spec: ENC-1]` to the byte: `[spec: ENC-2]` `[spec: ENC-3]` `[spec: ENC-4]` `[spec: ENC-5]`
/// `[spec: ENC-6]` `[spec: ENC-7]` `[spec: ENC-8]`
#[test]
fn law_the_example_of_the_chapter_is_what_is_written() {
    let bytes: Vec<u8> = fenced("bytes")
        .lines()
        .flat_map(|line| line.split("  ").next().unwrap().split(' '))
        .map(|byte| u8::from_str_radix(byte, 16).unwrap())
        .collect();
    assert_eq!(encode(&example()), bytes);
    assert_eq!(decode(&bytes), Ok(example()));
}

/// Checks both directions on a byte string: accepted bytes are canonical, refused ones are explained.
fn check_bytes(bytes: &[u8], explain: bool) -> Result<bool, TestCaseError> {
    let read = decode(bytes);
    let digest = decode_digest(bytes);
    match &read {
        Ok(state) => {
            prop_assert_eq!(encode(state), bytes);
            prop_assert_eq!(check_well_formed(state), Ok(()));
        }
        Err(error) => prop_assert!(!explain || error.to_string().len() > 10),
    }
    if let Ok(digest) = &digest {
        prop_assert_eq!(encode_digest(digest), bytes);
    }
    Ok(read.is_ok() || digest.is_ok())
}

/// All byte strings of up to three bytes, and all of up to two more after the first.
/// `[spec: ENC-1]` `[spec: ENC-10]`
#[test]
fn law_every_short_byte_string_is_canonical_or_refused() {
    let mut accepted = 0;
    for (prefix, length_max) in [(&[][..], 3), (&[2], 2), (&[0x12], 2)] {
        for length in 0..=length_max {
            for code in 0..256_u32.pow(length) {
                let bytes = [prefix, &code.to_le_bytes()[..length as usize]].concat();
                accepted += usize::from(check_bytes(&bytes, false).unwrap());
            }
        }
    }
    println!("{accepted} accepted");
    assert_eq!(accepted, 4, "the empty state, of three bytes, and the empty digest, of two: each twice");
}

/// All strings of so many of the smallest bytes after the first: small numbers are what tables, runs
/// and records are made of. `[spec: ENC-1]` `[spec: ENC-11]`
#[test]
fn law_every_string_of_small_bytes_is_canonical_or_refused() {
    let mut accepted = [0, 0];
    let scopes: [(u8, u32, u32); 6] = [(0, 7, 5), (0, 9, 4), (0, 12, 3), (0, 13, 3), (1, 8, 4), (1, 6, 5)];
    for (kind, length, base) in scopes {
        for code in 0..base.pow(length) {
            let digits = std::iter::successors(Some(code), |rest| Some(rest / base));
            let tail = digits.take(length as usize).map(|rest| u8::try_from(rest % base).unwrap());
            let bytes: Vec<u8> = [2 | kind << 4].into_iter().chain(tail).collect();
            accepted[usize::from(kind)] += usize::from(check_bytes(&bytes, false).unwrap());
        }
    }
    println!("{accepted:?} accepted");
    assert!(accepted.iter().all(|&count| count > 10), "{accepted:?}");
}

proptest! {
    #![proptest_config(cases(8000))]

    /// `[spec: ENC-1]` `[spec: ENC-7]` `[spec: ENC-8]` `[spec: ENC-11]`
    #[test]
    fn law_binary_round_trip(pair in states(2, 14, Anchors::Right)) {
        for state in &pair {
            let bytes = encode(state);
            prop_assert_eq!(decode(&bytes), Ok(state.clone()));
            let digest = digest(state);
            prop_assert_eq!(decode_digest(&encode_digest(&digest)), Ok(digest));
        }
        prop_assert_eq!(pair[0] == pair[1], encode(&pair[0]) == encode(&pair[1]));
    }

    /// `[spec: ENC-10]`
    #[test]
    fn law_any_bytes_are_canonical_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..64)) {
        check_bytes(&bytes, true)?;
    }

    /// One byte changed, one inserted, one removed, the end cut off, or something added: never two spellings.
    /// `[spec: ENC-1]` `[spec: ENC-9]` `[spec: ENC-10]`
    #[test]
    fn law_mutated_bytes_are_canonical_or_refused(
        state in states(1, 10, Anchors::Right),
        as_digest in any::<bool>(),
        edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..6_u8), 1..4),
    ) {
        let mut bytes = if as_digest { encode_digest(&digest(&state[0])) } else { encode(&state[0]) };
        for (at, byte, how) in edits {
            let at = at.index(bytes.len() + 1);
            match how {
                0 => bytes.insert(at, byte),
                1 => bytes.truncate(at),
                2 if at < bytes.len() => drop(bytes.remove(at)),
                3 if at < bytes.len() => bytes[at] = bytes[at].wrapping_add(byte % 3),
                _ if at < bytes.len() => bytes[at] = byte,
                _ => bytes.push(byte),
            }
        }
        check_bytes(&bytes, true)?;
    }

    /// What is not well-formed has bytes too, but nobody accepts them. `[spec: ENC-10]` `[spec: WF-3]`
    #[test]
    fn law_malformed_states_are_refused(universe in universes(8, Anchors::Any)) {
        let state = State::assemble(universe.records.clone(), universe.records.keys().copied().collect());
        let expected = check_well_formed(&state).map(|()| state.clone()).map_err(DecodeError::from);
        prop_assert_eq!(decode(&encode(&state)), expected);
        let unseen = State::assemble(universe.records, CausalContext::new());
        prop_assert_eq!(decode(&encode(&unseen)).is_ok(), unseen.is_empty());
    }
}

/// The error for the bytes of the example after an edit.
#[track_caller]
fn check_refused(edit: impl FnOnce(&mut Vec<u8>), expected: &str) {
    let mut bytes = encode(&example());
    edit(&mut bytes);
    assert_eq!(decode(&bytes).unwrap_err().to_string(), expected);
}

/// `[spec: ENC-2]`
#[test]
fn regress_version_of_tomorrow_or_yesterday() {
    check_refused(|bytes| bytes[0] = 3, "version 3; this library reads version 2");
    check_refused(|bytes| bytes[0] = 1, "version 1; this library reads version 2");
}

/// `[spec: ENC-2]`
#[test]
fn regress_digest_where_a_state_is_expected() {
    check_refused(|bytes| bytes[0] = 0x12, "at byte 0: 1 is no state");
    let bytes = encode(&example());
    assert_eq!(decode_digest(&bytes).unwrap_err().to_string(), "at byte 0: 0 is no digest");
}

/// `[spec: ENC-3]`
#[test]
fn regress_long_varint() {
    check_refused(
        |bytes| drop(bytes.splice(1..2, [0x82, 0])),
        "at byte 1: the integer has a shorter spelling",
    );
    let eleven = [0xff; 11];
    check_refused(
        |bytes| drop(bytes.splice(1..2, eleven)),
        "at byte 1: an integer is over 18446744073709551615",
    );
}

/// `[spec: ENC-4]`
#[test]
fn regress_replica_table() {
    check_refused(|bytes| bytes[2] = 4, "at byte 3: replica 1 is not greater than the one before");
    check_refused(|bytes| bytes[2] = 6, "at byte 3: replica 1 is not greater than the one before");
    let without_runs = |bytes: &mut Vec<u8>| {
        bytes.truncate(40);
        drop(bytes.splice(7..10, [0]));
    };
    check_refused(without_runs, "replica 1 of the table is never used");
    let agent = [0x80, 0x80, 0x80, 0x80, 0x20];
    check_refused(|bytes| drop(bytes.splice(3..4, agent)), "at byte 3: twice an agent is over 8589934591");
    let incarnation = [5, 0xff, 0xff, 0xff, 0xff, 0x0f];
    check_refused(
        |bytes| drop(bytes.splice(3..4, incarnation)),
        "at byte 4: an incarnation less one is over 4294967294",
    );
}

/// `[spec: ENC-4]`
#[test]
fn regress_greatest_agent_in_its_last_incarnation() {
    let replica = ReplicaId { agent: u32::MAX, incarnation: u32::MAX };
    let state = State::assemble([], [Dot::new(replica, 1)].into_iter().collect());
    let bytes = encode(&state);
    let table = [0xff, 0xff, 0xff, 0xff, 0x1f, 0xfe, 0xff, 0xff, 0xff, 0x0f];
    assert_eq!(bytes, [&[2, 1][..], &table, &[1, 0, 0, 0, 0]].concat());
    assert_eq!(decode(&bytes), Ok(state));
}

/// `[spec: ENC-6]`
#[test]
fn regress_name_table() {
    let with_second = |name: &'static [u8]| {
        move |bytes: &mut Vec<u8>| {
            bytes[10] = 2;
            drop(bytes.splice(19..19, name.iter().copied()));
        }
    };
    check_refused(with_second(b"\x01a"), "at byte 19: name 1 is not greater than the one before");
    check_refused(with_second(b"\x01z"), "name 65 of the table is never used");
    check_refused(
        with_second(b"\x04room"),
        "at byte 19: room needs no entry: it is name 45 of the static table",
    );
    check_refused(|bytes| bytes[12] = 0xff, "at byte 12: the text is not UTF-8");
    check_refused(|bytes| bytes[11] = 0, "at byte 11: a name has 0 bytes; allowed are 1 to 255");
}

/// The table of the chapter is the one that is used: each of its names is spelled by its index and by nothing
/// else, and read back. `[spec: ENC-12]` `[spec: ENC-6]`
#[test]
fn law_the_static_table_of_the_chapter_is_what_is_written() {
    let mut table: Vec<(u8, &str)> = Vec::new();
    for line in fenced("names").lines() {
        let mut words = line.split_whitespace();
        while let (Some(index), Some(name)) = (words.next(), words.next()) {
            table.push((index.parse().unwrap(), name));
        }
    }
    table.sort_unstable();
    assert_eq!(table.len(), 64);
    assert!(table.is_sorted_by(|left, right| left.1 < right.1));
    for (at, &(index, name)) in table.iter().enumerate() {
        assert_eq!(usize::from(index), at);
        let written = state(&format!("r1.1 vertex {name} {name} @1"));
        let bytes = encode(&written);
        assert_eq!(bytes, [2, 1, 2, 1, 0, 0, 0, 1, 0, 0, 2, index, index]);
        assert_eq!(decode(&bytes), Ok(written));
    }
}

/// `[spec: ENC-8]`
#[test]
fn regress_record_fields() {
    check_refused(|bytes| bytes[21] = 17, "at byte 21: 17 is no record kind");
    check_refused(|bytes| bytes[24] = 65, "at byte 24: name 65 of a table of 65");
    check_refused(|bytes| bytes[29] = 3, "at byte 29: replica 2 of a table of 2");
    check_refused(|bytes| bytes[30] = 0, "at byte 30: sequence 0 names no event");
    check_refused(|bytes| bytes[22] = 0, "[WF-5] r1.1: stamp 0 is outside 1 to 9007199254740991");
    check_refused(
        |bytes| bytes[22] = 1,
        "[WF-5] r1.1: stamp 18446744073709551615 is outside 1 to 9007199254740991",
    );
}

/// What the context has not seen has no spelling as a record. `[spec: ENC-8]` `[spec: WF-1]`
#[test]
fn regress_record_beyond_the_context() {
    let beyond = |at, skip, byte: usize| {
        let expected = format!(
            "at byte {at}: {skip} dots of r1 are passed over, and its context has seen no more after them"
        );
        check_refused(move |bytes| bytes[byte] = u8::try_from(skip).unwrap(), &expected);
    };
    beyond(20, 3, 20);
    beyond(32, 1, 32);
    let held_unseen = State::assemble(
        example().records().map(|(dot, record)| (dot, record.clone())).collect::<Vec<_>>(),
        [Dot::new(ReplicaId::agent(1), 1), Dot::new(ReplicaId::agent(1), 3)].into_iter().collect(),
    );
    assert!(encode(&held_unseen).is_empty());
}

/// Dead dots before records are passed over as a number, however many. `[spec: ENC-8]`
#[test]
fn regress_record_after_a_thousand_million_dead_dots() {
    let replica = ReplicaId::agent(1);
    let record = example().records().next().unwrap().1.clone();
    let runs = [
        Run { replica, first: 1, last: 1 << 40 },
        Run { replica, first: 1 << 50, last: limits::SEQUENCE_MAX },
    ];
    for sequence in [1, 1 << 40, 1 << 50, limits::SEQUENCE_MAX] {
        let context: CausalContext = runs.into_iter().collect();
        let state = State::assemble([(Dot::new(replica, sequence), record.clone())], context);
        assert_eq!(decode(&encode(&state)), Ok(state));
    }
}

/// `[spec: ENC-8]`
#[test]
fn regress_times_and_stamps_as_far_apart_as_can_be() {
    let times = [0, u64::MAX, 1 << 63, (1 << 63) - 1, 1, 0];
    let records = times.iter().zip(1..).map(|(&timestamp_ns, sequence)| {
        let stamp = if sequence % 2 == 0 { limits::STAMP_MAX } else { 1 };
        let target = Dot::default();
        let write = Write { target, name: "level".into(), value: Value::Bool(true), timestamp_ns, stamp };
        (Dot::new(ReplicaId::agent(1), sequence), Record::Write(write))
    });
    let context = (1..=6).map(|sequence| Dot::new(ReplicaId::agent(1), sequence)).collect();
    let state = State::assemble(records, context);
    assert_eq!(decode(&encode(&state)), Ok(state));
}

/// `[spec: ENC-9]`
#[test]
fn regress_trailing_bytes() {
    check_refused(|bytes| bytes.push(0), "at byte 41: 1 bytes follow the end");
}

/// Every proper beginning of an encoding is refused. `[spec: ENC-10]`
#[test]
fn regress_cut_off() {
    let bytes = encode(&example());
    for length in 0..bytes.len() {
        assert!(matches!(decode(&bytes[..length]), Err(DecodeError::End { .. })), "{length}");
    }
}

/// Counts and lengths that promise far more than follows reserve nothing. `[spec: ENC-10]`
#[test]
fn regress_declared_length_of_petabytes() {
    let huge = [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f];
    let promises = [
        [&[2][..], &huge].concat(),                   // replicas
        [&[2, 1, 2], &huge[..]].concat(),             // runs
        [&[2, 0], &huge[..]].concat(),                // names
        [&[2, 1, 2, 1, 0, 0, 0], &huge[..]].concat(), // records
        [&[2, 1, 2, 1, 0, 0, 1, 1, b'a', 1, 0, 12, 2, 0, 64, 0], &huge[..]].concat(), // items
    ];
    for bytes in promises {
        let error = decode(&bytes).unwrap_err();
        assert!(matches!(error, DecodeError::End { .. } | DecodeError::TooGreat { .. }), "{error}");
    }
}

/// Few bytes that name a thousand million dots are a few runs, before a gap and beyond it.
/// `[spec: ENC-5]` `[spec: CTX-2]`
#[test]
fn regress_cloud_of_a_thousand_million_dots() {
    let billion = [0xff, 0xff, 0xff, 0xff, 0x03];
    for skip in [0, 1] {
        let bytes = [&[2, 1, 2, 1, skip], &billion[..], &[0, 0]].concat();
        let state = decode(&bytes).unwrap();
        let first = 1 + u64::from(skip);
        let run = Run { replica: ReplicaId::agent(1), first, last: first + (1 << 30) - 1 };
        assert_eq!(state.context().runs().collect::<Vec<_>>(), [run]);
        assert_eq!(encode(&state), bytes);
        assert_eq!(state.joined(&State::new()), state);
    }
    // A digest of it, and of its records only as many as a state may hold.
    let context: CausalContext =
        [Run { replica: ReplicaId::agent(1), first: 2, last: limits::SEQUENCE_MAX }].into_iter().collect();
    let digest =
        Digest { context, live: vec![Run { replica: ReplicaId::agent(1), first: 9, last: 1 << 20 }] };
    assert_eq!(decode_digest(&encode_digest(&digest)), Ok(digest));
}

/// `[spec: ENC-5]` `[spec: LIMIT-7]`
#[test]
fn regress_more_runs_beyond_gaps_than_allowed() {
    let replica = ReplicaId::agent(1);
    let with_runs = |count: u64| {
        let runs = (1..=count).map(|at| Run { replica, first: at * 2, last: at * 2 });
        encode(&State::assemble([], runs.collect()))
    };
    let most = with_runs(1 << 20);
    assert_eq!(encode(&decode(&most).unwrap()), most);
    assert_eq!(
        decode(&with_runs((1 << 20) + 1)).unwrap_err().to_string(),
        "at byte 2097158: the number of runs beyond gaps is over 1048576"
    );
}

/// `[spec: ENC-5]` `[spec: LIMIT-6]`
#[test]
fn regress_sequence_overflow() {
    for byte in [0x1f, 0xff] {
        let great = [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, byte, 0x01];
        let bytes = [&[2, 1, 2, 1][..], &great, &great, &[0, 0]].concat();
        assert_eq!(decode(&bytes).unwrap_err().to_string(), "at byte 4: a sequence is over 9007199254740991");
    }
}

/// A digest that claims to hold what it has not seen, or very much. `[spec: ENC-11]`
#[test]
fn regress_digest_of_no_state() {
    let replica = ReplicaId::agent(1);
    let run = |first, last| Run { replica, first, last };
    let mut context = CausalContext::new();
    context.insert_prefix(replica, limits::SEQUENCE_MAX);
    let refused = |context: &CausalContext, live, expected: &str| {
        let bytes = encode_digest(&Digest { context: context.clone(), live });
        assert_eq!(decode_digest(&bytes).unwrap_err().to_string(), expected);
    };
    refused(&context, vec![run(1, limits::SEQUENCE_MAX)], "[ENC-11] over 16777216 live dots");
    let other = Run { replica: ReplicaId::agent(2), first: 1, last: 1 };
    refused(&context, vec![other], "replica 1 of the table is never used");
    context = [1, 2, 5].map(|n| Dot::new(replica, n)).into_iter().collect();
    refused(&context, vec![run(2, 3)], "[ENC-11] not every dot of r1.2 to 3 has been seen");
    refused(&context, vec![run(5, 6)], "[ENC-11] not every dot of r1.5 to 6 has been seen");
    refused(&context, vec![run(5, 5), run(1, 1)], "at byte 11: a sequence is over 9007199254740991");
}

/// Sequence 0 is no event; who assembles a state of it gets bytes that nobody accepts. `[spec: WF-1]`
#[test]
fn regress_record_under_sequence_zero() {
    let records = example().records().map(|(_, record)| (Dot::default(), record.clone())).collect::<Vec<_>>();
    let state = State::assemble(records, CausalContext::new());
    assert!(decode(&encode(&state)).is_err());
}
