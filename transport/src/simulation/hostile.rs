//! What strangers send: noise, and datagrams that are spelt well and lie.

use crate::origin::Origin;
use crate::wire::{Datagram, GROUP_STREAM, Item, Missing, Part};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

/// A datagram by a number. What it says of deltas cannot be decoded: forged deltas are not in the contract (NET-5).
pub(super) fn datagram(choice: u64, group: u32, members: &[Origin]) -> Vec<u8> {
    let mut random = ChaCha8Rng::seed_from_u64(choice);
    let at = usize::try_from(random.next_u64()).unwrap_or(0) % members.len().max(1);
    let stranger = Origin { replica: dsr_core::ReplicaId::agent(77), nonce: choice };
    let member = members.get(at).copied().unwrap_or(stranger);
    let number = 1 + random.next_u64() % 50;
    let huge = u64::MAX - 1 - random.next_u64() % 3;
    let part = |number, index, count| Part {
        stream: GROUP_STREAM,
        to: 0,
        number,
        index,
        count,
        total: count * 64,
        bytes: vec![0xa5; 64],
    };
    let all = |first, last| Missing { first, last, parts: Vec::new() };
    let name = || String::from("mallory");
    let (sender, item) = match random.next_u64() % 13 {
        0 => {
            let mut noise = vec![0; 200];
            random.fill_bytes(&mut noise);
            return noise;
        }
        1 => (member, Item::Part(part(number, 0, 1))),
        // Contradicts a message of another size.
        12 => (member, Item::Part(part(number, 1, 2))),
        2 => (member, Item::Part(part(huge, 3, 1000))),
        3 => (stranger, Item::Part(part(number, 7, 100_000))),
        4 => (stranger, Item::Want { origin: member, stream: GROUP_STREAM, missing: vec![all(1, huge)] }),
        5 => (member, Item::Gone { stream: GROUP_STREAM, below: huge }),
        6 => (stranger, Item::Beat { high: huge, oldest: huge, fingerprint: Some(7), name: name() }),
        7 => (member, Item::Beat { high: number * 2, oldest: number, fingerprint: Some(9), name: name() }),
        8 => (member, Item::Ack { stream: 1, below: u64::MAX, received: huge }),
        9 => (stranger, Item::Object { to: stranger, name: name() }),
        10 => (stranger, Item::Want { origin: member, stream: 1, missing: vec![all(1, 9)] }),
        _ => (member, Item::Bye),
    };
    Datagram { sender, items: vec![item] }.encode(group)
}
