//! Datagrams: what is written is read, and any bytes may be given.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use dsr_core::ReplicaId;
use dsr_transport::Origin;
use dsr_transport::wire::{
    Datagram, HEADER_BYTES, Item, Missing, Part, WANTED_MAX, WireError, group_key, part_bounds, part_count,
};
use proptest::collection::vec;
use proptest::prelude::*;

const GROUP: u32 = 0x00c0_ffee;

fn origins() -> impl Strategy<Value = Origin> {
    (any::<u32>(), any::<u32>(), any::<u64>())
        .prop_map(|(agent, incarnation, nonce)| Origin { replica: ReplicaId { agent, incarnation }, nonce })
}

fn numbers() -> impl Strategy<Value = u64> {
    prop_oneof![1..200_u64, 1..u64::MAX - 1]
}

fn parts() -> impl Strategy<Value = Item> {
    (any::<bool>(), 1..9_u32, any::<u64>(), numbers(), vec(any::<u8>(), 1..900), any::<u32>()).prop_map(
        |(group, stream, to, number, whole, at)| {
            let (stream, to) = if group { (0, 0) } else { (stream, to) };
            let total = u32::try_from(whole.len()).unwrap();
            let count = part_count(total, 100);
            let index = at % count;
            let (first, end) = part_bounds(total, count, index).unwrap();
            Item::Part(Part { stream, to, number, index, count, total, bytes: whole[first..end].to_vec() })
        },
    )
}

fn missing() -> impl Strategy<Value = Missing> {
    (1..u64::MAX / 2, 0..1_u64 << 40, vec((0..1_u32 << 20, 0..1_u32 << 20), 0..4)).prop_map(
        |(first, more, runs)| Missing {
            first,
            last: first + more,
            parts: runs.iter().map(|&(first, more)| (first, first + more)).collect(),
        },
    )
}

fn items() -> impl Strategy<Value = Item> {
    let name = "[a-zé]{0,20}";
    prop_oneof![
        3 => parts(),
        1 => (origins(), any::<u32>(), vec(missing(), 0..6))
            .prop_map(|(origin, stream, missing)| Item::Want { origin, stream, missing }),
        1 => (any::<u32>(), numbers()).prop_map(|(stream, below)| Item::Gone { stream, below }),
        1 => (1..u32::MAX, numbers(), any::<u64>())
            .prop_map(|(stream, below, received)| Item::Ack { stream, below, received }),
        1 => (numbers(), numbers(), any::<Option<u128>>(), name)
            .prop_map(|(high, oldest, fingerprint, name)| Item::Beat { high, oldest, fingerprint, name }),
        1 => name.prop_map(|name| Item::Hello { name }),
        1 => (origins(), name).prop_map(|(to, name)| Item::Object { to, name }),
        1 => Just(Item::Bye),
    ]
}

fn datagrams() -> impl Strategy<Value = Datagram> {
    (origins(), vec(items(), 0..5)).prop_map(|(sender, items)| Datagram { sender, items })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// `[spec: LINK-3]`
    #[test]
    fn law_what_is_written_is_read(datagram in datagrams()) {
        let bytes = datagram.encode(GROUP);
        prop_assert_eq!(Datagram::decode(&bytes, GROUP), Ok(datagram));
        prop_assert_eq!(Datagram::decode(&bytes, GROUP + 1), Err(WireError::Check));
    }

    /// Damage is found. `[spec: LINK-3]` `[spec: LINK-1]`
    #[test]
    fn law_damage_is_found(datagram in datagrams(), at in any::<prop::sample::Index>(), bit in 0..8_u8, cut in any::<bool>()) {
        let mut bytes = datagram.encode(GROUP);
        let at = at.index(bytes.len());
        if cut { bytes.truncate(at) } else { bytes[at] ^= 1 << bit }
        prop_assert!(Datagram::decode(&bytes, GROUP).is_err());
    }

    /// Bytes whose check fits, and that mean nothing: an error with its place, or a datagram that is written as it
    /// was read. `[spec: LINK-1]`
    #[test]
    fn law_any_items_are_read_or_refused(datagram in datagrams(), noise in vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)) {
        let mut bytes = datagram.encode(GROUP);
        for (at, byte) in noise {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        prop_assume!(bytes.len() > 15);
        let fixed = with_check(&bytes);
        match Datagram::decode(&fixed, GROUP) {
            Ok(read) => prop_assert_eq!(Datagram::decode(&read.encode(GROUP), GROUP), Ok(read)),
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }
}

/// The bytes with a check that fits: by an empty datagram's encoding of the same rest.
fn with_check(bytes: &[u8]) -> Vec<u8> {
    use siphasher::sip::SipHasher24;
    use std::hash::Hasher;
    let mut hasher = SipHasher24::new_with_keys(GROUP.into(), 1);
    hasher.write(&bytes[11..]);
    let mut fixed = bytes.to_vec();
    fixed[..3].copy_from_slice(&[0xd5, 0x52, 1]);
    fixed[3..11].copy_from_slice(&hasher.finish().to_le_bytes());
    fixed
}

/// Every size up to some, every part size: parts are as few as possible, equal but for the last, and make up the
/// message. `[spec: LINK-5]`
#[test]
fn law_parts_make_up_the_message() {
    for total in 1..400_u32 {
        for size in 1..60 {
            let count = part_count(total, size);
            assert_eq!(count, total.div_ceil(total.div_ceil(total.div_ceil(size))));
            let bounds: Vec<_> = (0..count).map(|index| part_bounds(total, count, index).unwrap()).collect();
            assert_eq!((bounds[0].0, bounds[bounds.len() - 1].1), (0, total as usize));
            assert!(bounds.windows(2).all(|pair| pair[0].1 == pair[1].0));
            assert!(bounds.iter().all(|&(first, end)| end > first && end - first <= size as usize));
            assert_eq!(part_bounds(total, count, count), None);
        }
    }
    // Claims that no message has.
    for (total, count, index) in [(0, 0, 0), (5, 9, 0), (u32::MAX, u32::MAX, 7), (10, 7, 6)] {
        assert_eq!(part_bounds(total, count, index), None, "{total} {count} {index}");
    }
}

/// `[spec: LINK-3]`
#[test]
fn oracle_the_bytes_of_an_example() {
    let sender = Origin { replica: ReplicaId { agent: 3, incarnation: 1 }, nonce: 0xff };
    let bytes = Datagram { sender, items: vec![Item::Gone { stream: 0, below: 300 }] }.encode(GROUP);
    assert_eq!(bytes[..3], [0xd5, 0x52, 1]);
    let rest = [0xee, 0xff, 0xc0, 0, 3, 0, 0, 0, 1, 0, 0, 0, 0xff, 0, 0, 0, 0, 0, 0, 0, 4, 0, 0xac, 2];
    assert_eq!(bytes[11..], rest);
    assert_eq!(bytes.len() - 4, HEADER_BYTES);
    assert_ne!(group_key("lab"), group_key("home"));
}

/// What says that it is large does not make the reader reserve. `[spec: LINK-1]`
#[test]
fn regress_declared_lengths_are_not_believed() {
    let sender = Origin { replica: ReplicaId::agent(1), nonce: 1 };
    let begun = Datagram { sender, items: vec![] }.encode(GROUP);
    for (items, what) in [
        (vec![1, 0, 1, 0xff, 0xff, 0xff, 0x1f], "a part"),
        (vec![2, 0, 1, 0, 9, 0xff, 0xff, 0xff, 0x1f, 1, 7], "part 0 of 9 of 67108863 bytes"),
        ([&[3][..], &[0; 16], &[0, 0x60]].concat(), "a number of runs"),
        (vec![6, 1, 1, 0, 0x40], "a name"),
        (vec![99], "is no item"),
        (vec![5, 0, 1, 1], "a stream"),
        (vec![7, 1, 0xff], "UTF-8"),
    ] {
        let bytes = with_check(&[&begun[..], &items].concat());
        let error = Datagram::decode(&bytes, GROUP).unwrap_err().to_string();
        assert!(error.contains(what) && error.contains("at byte"), "{error}");
    }
}

/// A long request is cut, not refused. `[spec: LINK-7]`
#[test]
fn law_requests_are_bounded() {
    let sender = Origin { replica: ReplicaId::agent(1), nonce: 1 };
    let missing: Vec<Missing> =
        (1..500).map(|at| Missing { first: 2 * at, last: 2 * at, parts: vec![] }).collect();
    let want = Item::Want { origin: sender, stream: 0, missing };
    let read = Datagram::decode(&Datagram { sender, items: vec![want] }.encode(GROUP), GROUP).unwrap();
    assert!(matches!(&read.items[..], [Item::Want { missing, .. }] if missing.len() == WANTED_MAX));
}
